//! UVs that scroll and turn over time (MToon).

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// UV animation of MToon; moves all textures but the matcap.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct UvAnimation {
    /// Mask of the motion: blue channel, linear. Default: none.
    pub mask: Option<TextureRef>,
    /// Scroll along u, UV units a second. Default: 0.
    pub scroll_u_per_s: f32,
    /// Scroll along v (downwards), UV units a second. Default: 0.
    pub scroll_v_per_s: f32,
    /// Rotation about the centre (0.5, 0.5), radians a second, counter-clockwise. Default: 0.
    pub rotation_rad_per_s: f32,
}

impl UvAnimation {
    /// Whether anything moves.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.scroll_u_per_s != 0.0 || self.scroll_v_per_s != 0.0 || self.rotation_rad_per_s != 0.0
    }
}
