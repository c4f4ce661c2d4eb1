//! A gentle second band on the lit side of the border of light and shade.

use serde::{Deserialize, Serialize};

/// Light that passes into shade through a colour, as it does through skin: the lit colour is tinted where the surface is
/// about to turn dark. Works on normals and on a [`FaceShadow`](super::FaceShadow) alike.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Transition {
    /// What the lit colour is multiplied by at the border, linear. Range 0..1. Default: a warm blush, (1, 0.86, 0.81).
    pub color: [f32; 3],
    /// Strength. Range 0..1. Default: 1.
    pub strength: f32,
    /// How far it reaches from the border into the light: in angle over π on a face with a map, in N·L elsewhere.
    /// Range 0.01..1. Default: 0.2.
    pub width: f32,
}

impl Default for Transition {
    fn default() -> Self {
        Self { color: [1.0, 0.86, 0.81], strength: 1.0, width: 0.2 }
    }
}
