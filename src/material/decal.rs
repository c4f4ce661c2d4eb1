//! Pictures laid over a surface: emblems, tattoos, dirt.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// Decals that a material has at most.
pub const MAX_DECALS: usize = 4;

/// Up to [`MAX_DECALS`] pictures from one sheet, laid over the base colour; light, shade and lines see them as paint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Decals {
    /// The sheet, sRGB with straight alpha. Its UV set is that of the decals. Default: none, and no decals.
    pub map: Option<TextureRef>,
    /// The decals; later ones lie over earlier ones, and those beyond [`MAX_DECALS`] are not drawn. Default: none.
    pub placed: Vec<Decal>,
}

/// One decal.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Decal {
    /// Part of the sheet: left, top, width, height. Range 0..1. Default: all of it, (0, 0, 1, 1).
    pub sheet: [f32; 4],
    /// Its middle in the surface's texture coordinates. Default: (0.5, 0.5).
    pub middle: [f32; 2],
    /// Its width and height there. Default: (0.1, 0.1).
    pub size: [f32; 2],
    /// Its turn, radians, clockwise as the texture is seen. Range -π..π. Default: 0.
    pub rotation_rad: f32,
    /// Colour that it is multiplied by, linear, and its opacity. Range 0..1. Default: white.
    pub color: [f32; 4],
    /// Multiplies what is below it instead of covering it. Default: false.
    pub multiplies: bool,
}

impl Default for Decal {
    fn default() -> Self {
        Self {
            sheet: [0.0, 0.0, 1.0, 1.0],
            middle: [0.5; 2],
            size: [0.1; 2],
            rotation_rad: 0.0,
            color: [1.0; 4],
            multiplies: false,
        }
    }
}
