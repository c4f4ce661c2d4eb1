//! Lines inside of the shape, found in the picture.

use super::{Section, Surroundings};
use crate::render::layout::Block;

crate::section! {
    /// Lines where the surface borders on another part, steps in depth or folds: what an inverted hull cannot draw. They darken
    /// what they are drawn on. Half of a line lies on each side, if both have this section.
    #[derive(Copy)]
    InnerLines = "inner_lines" {
        needs: &["prepass", "prepass_surfaces"], channel: Some(("inner-lines", "Lines inside of the shape.")),
    }
    {
        /// What the surface's colour is multiplied by, linear.
        color: [f32; 3] = [0.3, 0.22, 0.28], in 0.0..=1.0;
        /// Width, pixels of a picture 1024 high; it grows with the picture.
        width_px: f32 = 2.0, in 0.0..=16.0;
        /// Least step in depth, metres.
        step_m: f32 = 0.02, in 0.001..=1000000.0;
        /// Least fold between two normals, radians.
        fold_rad: f32 = 1.0, in 0.0..=3.15;
        /// Draws the borders between parts, too.
        between_parts: bool = true;
    }
}

impl Section for InnerLines {
    fn put(&self, gpu: &mut Block<'_>, _: &Surroundings<'_>) {
        gpu.put("steps", [self.step_m, self.fold_rad.cos()]);
        gpu.put("parts", f32::from(u8::from(self.between_parts)));
    }
}
