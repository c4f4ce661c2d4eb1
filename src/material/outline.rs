//! Outline of MToon: an inverted hull around the shape.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// Outline of MToon.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Outline {
    /// Width and its unit. Default: world, 0.
    pub width: OutlineWidth,
    /// Mask of the width: green channel, linear. Default: none.
    pub width_mask: Option<TextureRef>,
    /// Colour, linear. Default: black.
    pub color: [f32; 3],
    /// 0 ignores the surface's shading, 1 multiplies by the shaded colour. Range 0..1. Default: 1.
    pub lighting_mix: f32,
}

impl Default for Outline {
    fn default() -> Self {
        Self { width: OutlineWidth::World { metres: 0.0 }, width_mask: None, color: [0.0; 3], lighting_mix: 1.0 }
    }
}

/// Width of an outline.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OutlineWidth {
    /// Metres in the world: thinner with distance.
    World {
        /// Width, metres. Range 0...
        metres: f32,
    },
    /// Share of the picture's height: the same at any distance.
    Screen {
        /// Width over picture height. Range 0...
        height_ratio: f32,
    },
}
