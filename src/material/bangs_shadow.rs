//! Shadow of the bangs, as a face receives it.

use serde::{Deserialize, Serialize};

/// How a surface shows the shadow that bangs, hands, clothes and other characters cast on it. Casters, direction and
/// softness are those of [`Bangs`](crate::scene::Bangs). Where a [`FaceShadow`](super::FaceShadow) leaves a material to
/// normal shading, as on the neck, there is none.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BangsShadow {
    /// What lit colour is multiplied by in full shadow, linear. Range 0..1. Default: a warm dark, (0.86, 0.58, 0.52).
    pub color: [f32; 3],
    /// Strength. Range 0..1. Default: 1.
    pub strength: f32,
    /// Shares of light between which the shadow fades: equal ones give a hard edge. Range 0..1, growing.
    /// Default: (0.3, 0.7).
    pub edges: [f32; 2],
    /// Receives the shadow of lids and lashes too, as the eyeball does. Default: false.
    pub lids: bool,
}

impl Default for BangsShadow {
    fn default() -> Self {
        Self { color: [0.86, 0.58, 0.52], strength: 1.0, edges: [0.3, 0.7], lids: false }
    }
}
