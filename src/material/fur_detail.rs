//! Hand-painted fur: strands that show where light turns into shade.

use super::{Section, Surroundings, TextureRef};
use crate::render::layout::Block;

crate::section! {
    /// Fur as it is painted: a flat colour with few strokes in the light, all strokes at the terminator, half of them in shade.
    /// N·L of a detail normal cuts the three regions, so that the border of light has the shape of the clumps.
    #[derive(Copy)]
    FurDetail = "fur_detail" {
        needs: &["tangent"],
        channel: Some(("fur", "Regions of painted fur: light in red, terminator in green, shade in blue.")),
    }
    {
        /// Detail normals, tangent space, linear; they take the place of the material's normal map.
        detail_normal: TextureRef = TextureRef::default(), read LINEAR_REPEAT;
        /// Scale of their x and y.
        normal_scale: f32 = 1.0, in 0.0..=4.0;
        /// Detail colour, sRGB; multiplies the base colour's factor. `None`: the base texture is the detail, and its own blur
        /// the flat colour.
        detail_color: Option<TextureRef> = None, read SRGB_REPEAT;
        /// Without detail colours: mip levels by which the base texture is blurred into the flat colour.
        blur_levels: f32 = 4.0, in 0.0..=10.0;
        /// N·L at the ends of the terminator: shade, light; growing.
        terminator: [f32; 2] = [-0.15, 0.3], in -1.0..=1.0;
        /// Half width of the borders of the regions, N·L; at most half the terminator counts.
        softness: f32 = 0.1, in 0.0..=1.0;
        /// Shares of the detail colour in light, at the terminator and in shade.
        shares: [f32; 3] = [0.2, 0.8, 0.5], in 0.0..=1.0;
    }
}

impl Section for FurDetail {
    fn put(&self, gpu: &mut Block<'_>, _: &Surroundings<'_>) {
        let [shade, light] = self.terminator;
        gpu.put("softness", self.softness.clamp(1e-4, ((light - shade) * 0.5).max(1e-4)));
    }
}
