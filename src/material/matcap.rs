//! Matcap: a picture of light on a sphere, looked up by the normal seen from the camera.

use super::{Section, Surroundings, TextureRef};
use crate::scene::ColorTarget;

crate::section! {
    /// Matcap of MToon; added to the rim before its mask.
    #[derive(Copy)]
    Matcap = "matcap" { on_line: true, of_file: true }
    {
        /// Picture, sRGB; its transform does nothing.
        texture: TextureRef = TextureRef::default(), read LOOKUP;
        /// Factor, linear; files hold 0 to 1.
        color: [f32; 3] = [1.0; 3], in 0.0..=100.0;
    }
}

impl Section for Matcap {
    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        self.color != [0.0; 3] || of.driven.shifts(ColorTarget::MatcapColor)
    }
}
