//! Sparks that flash one by one as the surface turns: glitter, dust in a stone.

use super::{Section, Surroundings};
use crate::render::layout::Block;

crate::section! {
    /// Grains with normals of their own. Their number on the picture stays the same at any distance, and no grain appears or
    /// goes at once.
    #[derive(Copy)]
    Sparkle = "sparkle" { needs: &["tangent"], channel: Some(("sparkle", "Light of sparks.")) }
    {
        /// Colour that is added, times the light's, linear; above 1 it glows.
        color: [f32; 3] = [1.0; 3], in 0.0..=10.0;
        /// Distance between grains, pixels.
        spacing_px: f32 = 6.0, in 2.0..=64.0;
        /// How far their normals lean from the surface's, tangent of the angle.
        spread: f32 = 0.6, in 0.0..=2.0;
        /// Half angle in which a grain shines, radians.
        size_rad: f32 = 0.2, in 0.02..=0.5;
    }
    presets {
        /// Glitter.
        glitter {}
        /// Snow and frost: sparse, at every angle.
        snow { spacing_px: 12.0, spread: 1.0, size_rad: 0.1 }
        /// What hangs in a clear stone: few, and faint.
        dust { color: [0.9, 0.8, 0.7], spacing_px: 14.0, spread: 0.8, size_rad: 0.16 }
    }
}

impl Section for Sparkle {
    fn put(&self, gpu: &mut Block<'_>, _: &Surroundings<'_>) {
        gpu.put("size_cos", self.size_rad.cos());
    }
}
