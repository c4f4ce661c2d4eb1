//! Normal map.

use super::{Section, Surroundings, TextureRef};

crate::section! {
    /// Tangent-space normal map, glTF convention (+Y up), linear.
    #[derive(Copy)]
    NormalMap = "normal_map" { needs: &["tangent"], on_line: true, of_file: true }
    {
        /// Texture, linear.
        texture: TextureRef = TextureRef::default(), read LINEAR;
        /// Scale of x and y.
        scale: f32 = 1.0, in -100.0..=100.0;
    }
}

impl Section for NormalMap {
    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        // Painted fur brings normals of its own.
        of.material.fur_detail.is_none()
    }
}
