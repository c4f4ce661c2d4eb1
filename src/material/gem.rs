//! A stone that is seen into: amber, ruby, jade.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// A clear or cloudy body: light is refracted into it, absorbed on its way, gathered on the far side, and shows what is
/// enclosed at several depths. The base colour does nothing.
///
/// Sources: Snell's law and Fresnel's equations; Beer-Lambert absorption.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Gem {
    /// Index of refraction. Range 1..3. Default: 1.54, amber.
    pub ior: f32,
    /// Depth of the body along the normal, metres. Range 0.0001..1. Default: 0.01.
    pub depth_m: f32,
    /// Colour of white light that crossed the depth once, linear. Range 0.001..1. Default: amber, (0.82, 0.3, 0.04).
    pub color: [f32; 3],
    /// Light that a cloudy body scatters back by itself, in place of what comes through. Range 0..1. Default: 0.12.
    pub cloudiness: f32,
    /// Strength of the light that is gathered on the side away from the light. Range 0..8. Default: 3.
    pub caustic: f32,
    /// How closely it is gathered: exponent of the cosine. Range 1..64. Default: 1.7.
    pub caustic_focus: f32,
    /// What is enclosed, sRGB with alpha, by the surface's texture coordinates. It takes the place of the detail colour of
    /// fur. Default: none.
    pub inclusions: Option<TextureRef>,
    /// Layers of it, the deepest at the depth of the body. Range 1..4. Default: 3.
    pub layers: u32,
    /// Texture coordinates a metre along the surface: how far layers move against each other. Range 0..1000. Default: 45.
    pub uv_per_m: f32,
    /// Strength of what the surface mirrors. Range 0..1. Default: 1.
    pub polish: f32,
}

impl Default for Gem {
    fn default() -> Self {
        Self::amber()
    }
}

impl Gem {
    /// Clear honey.
    #[must_use]
    pub const fn amber() -> Self {
        Self {
            ior: 1.54,
            depth_m: 0.01,
            color: [0.82, 0.3, 0.04],
            cloudiness: 0.12,
            caustic: 3.0,
            caustic_focus: 1.7,
            inclusions: None,
            layers: 3,
            uv_per_m: 45.0,
            polish: 1.0,
        }
    }

    /// Deep red, clear.
    #[must_use]
    pub const fn ruby() -> Self {
        Self {
            ior: 1.76,
            color: [0.9, 0.012, 0.07],
            cloudiness: 0.06,
            caustic: 2.6,
            caustic_focus: 2.6,
            ..Self::amber()
        }
    }

    /// Milky green.
    #[must_use]
    pub const fn jade() -> Self {
        Self {
            ior: 1.66,
            color: [0.16, 0.62, 0.3],
            cloudiness: 0.75,
            caustic: 1.2,
            caustic_focus: 1.6,
            ..Self::amber()
        }
    }
}
