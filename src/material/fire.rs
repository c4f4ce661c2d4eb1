//! Fire of cartoons: a drawn shape that noise eats away.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// Heat is the drawn shape times noise that rises through it; where it is low nothing is left, and the colour goes by the
/// same number. It is moved by time alone, begins anew without a seam after each period, and shines in its own light.
/// The material must be blended; its base colour and texture do nothing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Fire {
    /// Shape as heat, red channel, linear: 1 in the heart, 0 outside; v grows downwards from the tip. It takes the place of
    /// a painted highlight. Default: none, which is one tongue as wide as the texture coordinates.
    pub heat: Option<TextureRef>,
    /// Colours of the rim, the body and the heart, linear. Range 0..1.
    /// Default: (0.9, 0.07, 0.01), (1, 0.36, 0.03), (1, 0.88, 0.42).
    pub colors: [[f32; 3]; 3],
    /// Heat at which the body and the heart begin. Range 0..1, growing. Default: (0.34, 0.62).
    pub edges: [f32; 2],
    /// Heat below which it is eaten away: 0 whole, 1 gone. Range 0..1. Default: 0.2.
    pub erosion: f32,
    /// Softness of its border, in heat. Range 0.001..0.5. Default: 0.03.
    pub softness: f32,
    /// How far noise changes the heat. Range 0..1. Default: 0.8.
    pub turbulence: f32,
    /// How far tongues sway, in texture coordinates at the tip. Range 0..0.5. Default: 0.22.
    pub sway: f32,
    /// Cells of noise across the texture. Range 1..32. Default: 4.
    pub cells: u32,
    /// Time after which it repeats, seconds. Range 0.1..60. Default: 2.
    pub period_s: f32,
    /// 0 hides what is behind it, 1 adds its light to that. Range 0..1. Default: 0.35.
    pub additive: f32,
    /// Brightness. Range 0..10. Default: 1.
    pub strength: f32,
}

impl Default for Fire {
    fn default() -> Self {
        Self {
            heat: None,
            colors: [[0.9, 0.07, 0.01], [1.0, 0.36, 0.03], [1.0, 0.88, 0.42]],
            edges: [0.34, 0.62],
            erosion: 0.2,
            softness: 0.03,
            turbulence: 0.8,
            sway: 0.22,
            cells: 4,
            period_s: 2.0,
            additive: 0.35,
            strength: 1.0,
        }
    }
}

impl Fire {
    /// Gas and ghosts.
    #[must_use]
    pub fn blue() -> Self {
        Self { colors: [[0.02, 0.1, 0.8], [0.06, 0.42, 1.0], [0.75, 0.95, 1.0]], ..Self::default() }
    }
}
