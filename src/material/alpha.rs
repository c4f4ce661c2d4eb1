//! Opacity and draw order.

use serde::{Deserialize, Serialize};

use super::plain_parts;

crate::part! {
    /// Opacity and draw order of a material.
    #[derive(Copy)]
    Alpha {
        /// How alpha is used.
        mode: AlphaMode = AlphaMode::Opaque;
        /// Alpha below which [`AlphaMode::Mask`] cuts; above 1 nothing is left.
        cutoff: f32 = 0.5, in 0.0..=1000.0;
        /// Cuts [`AlphaMode::Mask`] and [`AlphaMode::Blend`] by noise on the surface instead: as many pixels are left as alpha says,
        /// in any order of surfaces, and depth is right. For means of many pictures
        /// ([`render_accumulated`](crate::Renderer::render_accumulated)), in which it becomes smooth; one alone is grainy. The cutoff
        /// counts in shadows alone.
        hashed: bool = false;
        /// Whether [`AlphaMode::Blend`] writes depth (MToon `transparentWithZWrite`).
        write_depth: bool = false;
        /// Order among transparent materials, low first (MToon `renderQueueOffsetNumber`).
        queue_offset: i32 = 0, in -9..=9;
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
plain_parts!(AlphaMode);
