//! Burning away.

use serde::{Deserialize, Serialize};

/// Noise that eats a surface away, with a glowing border; what is gone casts no shadow. Lines round
/// the shape grow thin and have gone at an amount of 0.1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Dissolve {
    /// How much is gone: 0 nothing, 1 all. Range 0..1. Default: 0.
    pub amount: f32,
    /// Cells of noise across the texture coordinates. Range 1..256. Default: 10.
    pub cells: u32,
    /// Width of the glowing border, in amount. Range 0..0.5. Default: 0.06.
    pub border: f32,
    /// Colour of the border, linear; above 1 it glows. Range 0..10. Default: (2, 0.6, 0.1).
    pub color: [f32; 3],
}

impl Default for Dissolve {
    fn default() -> Self {
        Self { amount: 0.0, cells: 10, border: 0.06, color: [2.0, 0.6, 0.1] }
    }
}
