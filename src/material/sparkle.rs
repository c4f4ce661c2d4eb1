//! Sparks that flash one by one as the surface turns: glitter, dust in a stone.

use serde::{Deserialize, Serialize};

/// Grains with normals of their own. Their number on the picture stays the same at any distance, and no grain appears or
/// goes at once.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sparkle {
    /// Colour that is added, times the light's, linear; above 1 it glows. Range 0..10. Default: white.
    pub color: [f32; 3],
    /// Distance between grains, pixels. Range 2..64. Default: 6.
    pub spacing_px: f32,
    /// How far their normals lean from the surface's, tangent of the angle. Range 0..2. Default: 0.6.
    pub spread: f32,
    /// Half angle in which a grain shines, radians. Range 0.02..0.5. Default: 0.2.
    pub size_rad: f32,
}

impl Default for Sparkle {
    fn default() -> Self {
        Self { color: [1.0; 3], spacing_px: 6.0, spread: 0.6, size_rad: 0.2 }
    }
}

impl Sparkle {
    /// Snow and frost: sparse, at every angle.
    #[must_use]
    pub fn snow() -> Self {
        Self { spacing_px: 12.0, spread: 1.0, size_rad: 0.1, ..Self::default() }
    }

    /// What hangs in a clear stone: few, and faint.
    #[must_use]
    pub fn dust() -> Self {
        Self { color: [0.9, 0.8, 0.7], spacing_px: 14.0, spread: 0.8, size_rad: 0.16 }
    }
}
