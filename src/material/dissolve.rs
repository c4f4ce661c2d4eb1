//! Burning away.

use super::{Section, Surroundings};
use crate::render::layout::Block;

crate::section! {
    /// Noise that eats a surface away, with a glowing border; what is gone casts no shadow. Lines round
    /// the shape grow thin and have gone at an amount of 0.1.
    #[derive(Copy)]
    Dissolve = "dissolve" {
        unlit: true, on_line: true,
        channel: Some(("dissolve", "Surfaces that burn away: the border dark green, what is whole yellow.")),
    }
    {
        /// How much is gone: 0 nothing, 1 all.
        amount: f32 = 0.0, in 0.0..=1.0;
        /// Size of a cell of noise on the surface at rest, metres: the same on every material, whatever its texture
        /// coordinates. They have at most 256 cells.
        cell_m: f32 = 0.03, in 0.001..=1.0;
        /// Width of the glowing border, in amount.
        border: f32 = 0.06, in 0.0..=0.5;
        /// Colour of the border, linear; above 1 it glows.
        color: [f32; 3] = [2.0, 0.6, 0.1], in 0.0..=10.0;
    }
}

impl Section for Dissolve {
    fn put(&self, gpu: &mut Block<'_>, of: &Surroundings<'_>) {
        let cells = of.metres_per_uv.map(|m| (m / self.cell_m).round().clamp(1.0, 256.0) as i32);
        gpu.put("cells", cells);
    }
}
