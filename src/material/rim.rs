//! Rim light of MToon: a Fresnel-shaped band and the mask that it shares with the matcap.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// Parametric rim of MToon.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Rim {
    /// Colour, linear. Range 0..1. Default: black (off).
    pub color: [f32; 3],
    /// Exponent of the falloff. Range 0... Default: 5.
    pub fresnel_power: f32,
    /// Added to 1 - N·V before the exponent. Default: 0.
    pub lift: f32,
    /// Mask of rim and matcap, sRGB. Default: none.
    pub mask: Option<TextureRef>,
    /// 0 ignores the light, 1 multiplies by it. Range 0..1. Default: 1.
    pub lighting_mix: f32,
}

impl Default for Rim {
    fn default() -> Self {
        Self { color: [0.0; 3], fresnel_power: 5.0, lift: 0.0, mask: None, lighting_mix: 1.0 }
    }
}
