//! How much of the scene's light a material takes.

use serde::{Deserialize, Serialize};

/// Keeps a character readable in any light: bounds on its luminance, and how far its colour counts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LightResponse {
    /// Least luminance of the direct light that is taken. Range 0..1. Default: 0.
    pub min: f32,
    /// Greatest luminance. Range 0..10. Default: 1.
    pub max: f32,
    /// 0 takes the light's colour, 1 its luminance alone. Range 0..1. Default: 0.
    pub monochrome: f32,
}

impl Default for LightResponse {
    fn default() -> Self {
        Self { min: 0.0, max: 1.0, monochrome: 0.0 }
    }
}
