//! Light along the contour, found in the depth of the picture: as wide on a far character as on a near one.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// A rim of constant width, on the side of the directional light.
///
/// A pixel belongs to it where the picture is farther by `threshold_m` at `width_px` along the surface's normal as it is
/// seen; creases that are shallower get none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DepthRim {
    /// Colour that is added in the light's colour, linear. Range 0..1. Default: a cool white, (0.55, 0.56, 0.6).
    pub color: [f32; 3],
    /// How far the rim takes the surface's own colour. Range 0..1. Default: 0.7.
    pub tint: f32,
    /// Strength. Range 0..1. Default: 1.
    pub strength: f32,
    /// Width, pixels of a picture 1024 high; it grows with the picture. Range 0..64. Default: 4.
    pub width_px: f32,
    /// Least step in depth, metres. Default: 0.04.
    pub threshold_m: f32,
    /// N·L between which it fades in; where the contour itself looks away from the light there is none either. Range -1..1,
    /// growing; with both below -1 it is all round. Default: (0, 0.3).
    pub light_side: [f32; 2],
    /// Colour of the rim on the side away from the light, as bounced light has it, linear; black for none. Range 0..1.
    /// Default: black.
    pub shade_color: [f32; 3],
    /// Share in which point and spot lights draw rims on their own sides. Range 0..1. Default: 1.
    pub punctual: f32,
    /// Mask of the width: red channel, linear, read with the base texture's sampler. Default: none.
    pub width_mask: Option<TextureRef>,
    /// Distances from the camera at which the rim begins to fade and has gone, metres, growing. Range 0...
    /// Default: (25, 50).
    pub fade_m: [f32; 2],
}

impl Default for DepthRim {
    fn default() -> Self {
        Self {
            color: [0.55, 0.56, 0.6],
            tint: 0.7,
            strength: 1.0,
            width_px: 4.0,
            threshold_m: 0.04,
            light_side: [0.0, 0.3],
            shade_color: [0.0; 3],
            punctual: 1.0,
            width_mask: None,
            fade_m: [25.0, 50.0],
        }
    }
}
