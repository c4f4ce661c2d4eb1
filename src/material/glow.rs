//! Light that blooms.

use serde::{Deserialize, Serialize};

/// What of a surface [`Bloom`](crate::scene::Bloom) spreads around it; nothing else blooms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Glow {
    /// Share of its emission, and of fire. Range 0..10. Default: 1.
    pub emission: f32,
    /// Share of its highlights and sparks. Range 0..10. Default: 0.
    pub highlight: f32,
}

impl Default for Glow {
    fn default() -> Self {
        Self { emission: 1.0, highlight: 0.0 }
    }
}
