//! UVs that scroll and turn over time (MToon).

use super::{Section, Surroundings, TextureRef};

crate::section! {
    /// UV animation of MToon; moves all textures but the matcap.
    #[derive(Copy)]
    UvAnimation = "uv_animation" { unlit: true, on_line: true, of_file: true }
    {
        /// Mask of the motion: blue channel, linear.
        mask: Option<TextureRef> = None, read LINEAR;
        /// Scroll along u, UV units a second.
        scroll_u_per_s: f32 = 0.0, in -1000.0..=1000.0;
        /// Scroll along v (downwards), UV units a second.
        scroll_v_per_s: f32 = 0.0, in -1000.0..=1000.0;
        /// Rotation about the centre (0.5, 0.5), radians a second, counter-clockwise.
        rotation_rad_per_s: f32 = 0.0, in -1000.0..=1000.0;
    }
}

impl UvAnimation {
    /// Whether anything moves.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.scroll_u_per_s != 0.0 || self.scroll_v_per_s != 0.0 || self.rotation_rad_per_s != 0.0
    }
}

impl Section for UvAnimation {
    fn is_on(&self, _: &Surroundings<'_>) -> bool {
        self.is_active()
    }
}
