//! Lit colour.

use super::{AlphaMode, Options, Section, Surroundings, TextureRef};
use crate::render::layout::Block;

crate::section! {
    /// Lit colour (glTF base colour, MToon lit colour).
    #[derive(Copy)]
    Base = "base" { unlit: true, on_line: true, of_file: true }
    {
        /// Factor, linear RGBA; files hold 0 to 1.
        color: [f32; 4] = [1.0; 4], in 0.0..=100.0;
        /// Texture, sRGB with straight alpha; multiplies the factor.
        texture: Option<TextureRef> = None, read SRGB;
    }
}

impl Section for Base {
    fn put(&self, gpu: &mut Block<'_>, of: &Surroundings<'_>) {
        let alpha = of.material.alpha;
        let cutoff = match alpha.mode {
            AlphaMode::Mask => alpha.cutoff,
            AlphaMode::Blend if of.material.has_core() => alpha.opaque_cutoff,
            _ => 0.5,
        };
        gpu.put("alpha_cutoff", cutoff);
        gpu.put("least_alpha", alpha.least_alpha);
        gpu.put("hash_m", of.metres_per_uv);
    }

    fn options(&self, on: &mut Options, of: &Surroundings<'_>) {
        on.set("alpha_hashed", of.material.is_hashed());
    }

    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        !of.material.burns()
    }
}
