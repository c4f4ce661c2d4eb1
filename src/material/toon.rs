//! How light becomes colour: two tones with a band between them (MToon), or none at all.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// Shading model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shading {
    /// Two tones and a band.
    Toon(Toon),
    /// The base colour, whatever the light.
    Unlit,
}

impl Default for Shading {
    fn default() -> Self {
        Self::Toon(Toon::default())
    }
}

/// Two-tone shading of `VRMC_materials_mtoon` 1.0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Toon {
    /// Colour in shade, linear. Range 0..1. Default: black, as in the specification.
    pub shade_color: [f32; 3],
    /// Texture of the shade colour, sRGB; multiplies it. Default: none.
    pub shade_texture: Option<TextureRef>,
    /// Moves the band: positive lights more. Range -1..1. Default: 0.
    pub shift: f32,
    /// Adds its red channel, linear, times `shift_texture_scale` to `shift`. Default: none.
    pub shift_texture: Option<TextureRef>,
    /// Scale of the shift texture. Default: 1.
    pub shift_texture_scale: f32,
    /// Hardness of the band: 0 is Lambert-soft, 1 a hard edge. Range 0..1. Default: 0.9.
    pub toony: f32,
    /// 0 keeps the direction of ambient light, 1 makes it even. Range 0..1. Default: 0.9.
    pub gi_equalization: f32,
}

impl Default for Toon {
    fn default() -> Self {
        Self {
            shade_color: [0.0; 3],
            shade_texture: None,
            shift: 0.0,
            shift_texture: None,
            shift_texture_scale: 1.0,
            toony: 0.9,
            gi_equalization: 0.9,
        }
    }
}
