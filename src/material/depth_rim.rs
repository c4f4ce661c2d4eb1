//! Light along the contour, found in the depth of the picture: as wide on a far character as on a near one.

use super::{Options, Section, Surroundings, TextureRef};
use crate::render::layout::Block;

crate::section! {
    /// A rim of constant width, on the side of the directional light.
    ///
    /// A pixel belongs to it where the picture is farther by `threshold_m` at `width_px` along the surface's normal as it is
    /// seen; creases that are shallower get none.
    #[derive(Copy)]
    DepthRim = "depth_rim" { needs: &["prepass"], channel: Some(("depth-rim", "Rim by depth.")) }
    {
        /// Colour that is added in the light's colour, linear; a cool white.
        color: [f32; 3] = [0.55, 0.56, 0.6], in 0.0..=1.0;
        /// How far the rim takes the surface's own colour.
        tint: f32 = 0.7, in 0.0..=1.0;
        /// Strength.
        strength: f32 = 1.0, in 0.0..=1.0;
        /// Width, pixels of a picture 1024 high; it grows with the picture.
        width_px: f32 = 4.0, in 0.0..=64.0;
        /// Least step in depth, metres.
        threshold_m: f32 = 0.04, in 0.0001..=1000.0;
        /// N·L between which it fades in, growing; where the contour itself looks away from the light there is none either.
        /// With both below -1 it is all round.
        light_side: [f32; 2] = [0.0, 0.3], in -2.0..=1.0;
        /// Colour of the rim on the side away from the light, as bounced light has it, linear; black for none.
        shade_color: [f32; 3] = [0.0; 3], in 0.0..=1.0;
        /// Share in which point and spot lights draw rims on their own sides.
        punctual: f32 = 1.0, in 0.0..=1.0;
        /// Mask of the width: red channel, linear.
        width_mask: Option<TextureRef> = None, read LINEAR;
        /// Distances from the camera at which the rim begins to fade and has gone, metres, growing.
        fade_m: [f32; 2] = [25.0, 50.0], in 0.0..=1000000.0;
    }
}

impl Section for DepthRim {
    fn put(&self, gpu: &mut Block<'_>, _: &Surroundings<'_>) {
        gpu.put("color", self.color.map(|c| c * self.strength));
        gpu.put("shade_color", self.shade_color.map(|c| c * self.strength));
    }

    fn options(&self, on: &mut Options, _: &Surroundings<'_>) {
        on.set("depth_rim_shade", self.shade_color != [0.0; 3]);
    }

    fn is_on(&self, _: &Surroundings<'_>) -> bool {
        self.strength > 0.0
    }
}
