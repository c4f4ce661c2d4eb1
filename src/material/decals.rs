//! Pictures laid over a surface: emblems, tattoos, dirt.

use super::{Section, Surroundings, TextureRef};
use crate::render::layout::Block;

/// Decals that a material has at most.
pub const MAX_DECALS: usize = 4;

crate::section! {
    /// Up to [`MAX_DECALS`] pictures from one sheet, laid over the base colour; light, shade and lines see them as paint.
    Decals = "decals" { channel: Some(("overlay", "Share that decals and stockings cover.")) }
    {
        /// The sheet, sRGB with straight alpha. Its UV set is that of the decals. Without it there are no decals.
        map: Option<TextureRef> = None, read SRGB;
        /// The decals; later ones lie over earlier ones, and those beyond [`MAX_DECALS`] are not drawn.
        placed: Vec<Decal> = Vec::new(), part Decal;
    }
}

crate::part! {
    /// One decal.
    #[derive(Copy)]
    Decal {
        /// Part of the sheet: left, top, width, height.
        sheet: [f32; 4] = [0.0, 0.0, 1.0, 1.0], in 0.0..=1.0;
        /// Its middle in the surface's texture coordinates.
        middle: [f32; 2] = [0.5; 2], in -1000.0..=1000.0;
        /// Its width and height there.
        size: [f32; 2] = [0.1; 2], in -1000.0..=1000.0;
        /// Its turn, radians, clockwise as the texture is seen.
        rotation_rad: f32 = 0.0, in -3.15..=3.15;
        /// Colour that it is multiplied by, linear, and its opacity.
        color: [f32; 4] = [1.0; 4], in 0.0..=1.0;
        /// Multiplies what is below it instead of covering it.
        multiplies: bool = false;
    }
}

impl Decal {
    /// Rows from texture coordinates to 0..1 over the decal, of which the last number says whether it multiplies; its part of
    /// the sheet; its colour.
    fn rows(&self) -> [[f32; 4]; 4] {
        let (sin, cos) = self.rotation_rad.sin_cos();
        let [w, h] = self.size.map(|s| s.abs().max(1e-6));
        let [x, y] = self.middle;
        // Turned back, scaled, and moved so that 0..1 spans the decal.
        let row = |a: f32, b: f32, scale: f32| {
            let (a, b) = (a / scale, b / scale);
            [a, b, 0.5 - a * x - b * y, 0.0]
        };
        let mut row_v = row(-sin, cos, h);
        row_v[3] = f32::from(u8::from(self.multiplies));
        [row(cos, sin, w), row_v, self.sheet, self.color]
    }
}

impl Section for Decals {
    fn put(&self, gpu: &mut Block<'_>, _: &Surroundings<'_>) {
        let rows: [[[f32; 4]; 4]; MAX_DECALS] =
            std::array::from_fn(|i| self.placed.get(i).map_or([[0.0; 4]; 4], Decal::rows));
        gpu.put("placed", rows);
        gpu.put("count", self.placed.len().min(MAX_DECALS) as u32);
    }

    fn is_on(&self, _: &Surroundings<'_>) -> bool {
        self.map.is_some() && !self.placed.is_empty()
    }
}
