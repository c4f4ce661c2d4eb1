//! What a material has to do with the shadow of a character on itself.

use serde::{Deserialize, Serialize};

/// Part of a material in [`SelfShadow`](crate::scene::SelfShadow). Received shadow is shade: it has exactly the shade's
/// colour, or that of the dark end of a [`ShadeRamp`](super::ShadeRamp). A face with a
/// [`FaceShadow`](super::FaceShadow) receives it only where its map leaves it to normal shading: on the neck.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CastShadow {
    /// Whether it casts. Default: true.
    pub casts: bool,
    /// How far it receives: 0 not at all, 1 whole. Range 0..1. Default: 1.
    pub received: f32,
}

impl Default for CastShadow {
    fn default() -> Self {
        Self { casts: true, received: 1.0 }
    }
}
