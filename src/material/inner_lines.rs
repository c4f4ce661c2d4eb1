//! Lines inside of the shape, found in the picture.

use serde::{Deserialize, Serialize};

/// Lines where the surface borders on another part, steps in depth or folds: what an inverted hull cannot draw. They darken
/// what they are drawn on. Half of a line lies on each side, if both have this section.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct InnerLines {
    /// What the surface's colour is multiplied by, linear. Range 0..1. Default: (0.3, 0.22, 0.28).
    pub color: [f32; 3],
    /// Width, pixels of a picture 1024 high; it grows with the picture. Range 0..16. Default: 2.
    pub width_px: f32,
    /// Least step in depth, metres. Range 0.001... Default: 0.02.
    pub step_m: f32,
    /// Least fold between two normals, radians. Range 0..π. Default: 1.
    pub fold_rad: f32,
    /// Draws the borders between parts, too. Default: true.
    pub between_parts: bool,
}

impl Default for InnerLines {
    fn default() -> Self {
        Self { color: [0.3, 0.22, 0.28], width_px: 2.0, step_m: 0.02, fold_rad: 1.0, between_parts: true }
    }
}
