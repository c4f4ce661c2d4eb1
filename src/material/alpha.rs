//! Opacity and draw order.

use serde::{Deserialize, Serialize};

/// Opacity and draw order of a material.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Alpha {
    /// How alpha is used. Default: opaque.
    pub mode: AlphaMode,
    /// Alpha below which [`AlphaMode::Mask`] cuts. Range 0..1. Default: 0.5.
    pub cutoff: f32,
    /// Whether [`AlphaMode::Blend`] writes depth (MToon `transparentWithZWrite`). Default: false.
    pub write_depth: bool,
    /// Order among transparent materials, low first (MToon `renderQueueOffsetNumber`). Range -9..9. Default: 0.
    pub queue_offset: i32,
}

impl Default for Alpha {
    fn default() -> Self {
        Self { mode: AlphaMode::Opaque, cutoff: 0.5, write_depth: false, queue_offset: 0 }
    }
}

/// How alpha is used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AlphaMode {
    /// Ignored.
    #[default]
    Opaque,
    /// Cut at [`Alpha::cutoff`].
    Mask,
    /// Blended.
    Blend,
}
