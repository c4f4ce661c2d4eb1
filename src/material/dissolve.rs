//! Burning away.

use serde::{Deserialize, Serialize};

/// Noise that eats a surface away, with a glowing border; what is gone casts no shadow. Lines round
/// the shape grow thin and have gone at an amount of 0.1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Dissolve {
    /// How much is gone: 0 nothing, 1 all. Range 0..1. Default: 0.
    pub amount: f32,
    /// Size of a cell of noise on the surface at rest, metres: the same on every material, whatever its texture coordinates.
    /// They have at most 256 cells. Range 0.001..1. Default: 0.03.
    pub cell_m: f32,
    /// Width of the glowing border, in amount. Range 0..0.5. Default: 0.06.
    pub border: f32,
    /// Colour of the border, linear; above 1 it glows. Range 0..10. Default: (2, 0.6, 0.1).
    pub color: [f32; 3],
}

impl Default for Dissolve {
    fn default() -> Self {
        Self { amount: 0.0, cell_m: 0.03, border: 0.06, color: [2.0, 0.6, 0.1] }
    }
}
