//! A card in a stack, as flat eyes are built.

use serde::{Deserialize, Serialize};

/// Place in a stack of cards that lie on one another: white of the eye, iris, lights.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Layer {
    /// Higher ones lie over lower ones wherever they coincide. Each stands 0.1 mm nearer to the viewer than the one below,
    /// which no picture shows but the depth test sees at any distance up to 20 m. Range -8..8. Default: 0.
    pub index: i32,
    /// 1: lit colour in any shade, as lights of eyes are drawn. Range 0..1. Default: 0.
    pub stay_lit: f32,
}

impl Default for Layer {
    fn default() -> Self {
        Self { index: 0, stay_lit: 0.0 }
    }
}
