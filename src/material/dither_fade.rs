//! Fading without blending.

use serde::{Deserialize, Serialize};

/// Leaves out samples of pixels in an even pattern, or whole pixels where each has one sample: a surface fades without
/// being sorted, as when the camera comes too near, and nothing behind its own front is seen. Blended materials
/// fade by their alpha. A fading surface goes on casting its whole shadow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DitherFade {
    /// Share that is left. Range 0..1. Default: 1.
    pub opacity: f32,
    /// Distances from the camera at which it is gone and at which it is whole, metres, growing. Range 0... Default: (0, 0).
    pub near_m: [f32; 2],
}

impl Default for DitherFade {
    fn default() -> Self {
        Self { opacity: 1.0, near_m: [0.0; 2] }
    }
}
