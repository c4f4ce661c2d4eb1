//! A cut stone that throws light back: diamond.

use super::{Section, Surroundings};

crate::section! {
    /// A brilliant: rays are refracted in, thrown back and forth between facets as often as total reflection keeps them in, and
    /// leave towards a studio of the scene's light, each channel by its own index. The cut stands on the surface by its normal
    /// and tangent; flat facets of the mesh multiply its shards. The base colour does nothing.
    ///
    /// Sources: Fresnel's equations; angles of the round brilliant by Tolkowsky 1919.
    #[derive(Copy)]
    Diamond = "diamond" {
        is_model: true, needs: &["tangent"],
        channel: Some((
            "stone",
            "Stones: light that is gathered or thrown back in red, depth of what is enclosed in green, what is mirrored in blue.",
        )),
    }
    {
        /// Indices of refraction for red, green and blue light; equal ones do not disperse.
        ior: [f32; 3] = [2.41, 2.42, 2.44], in 1.0..=4.0;
        /// Reflections inside before a ray is let out.
        bounces: u32 = 3, in 1..=6;
        /// Facets round the stone.
        facets: u32 = 8, in 4..=16;
        /// Colour of light that crossed it, linear; a cold white.
        color: [f32; 3] = [0.9, 0.95, 1.0], in 0.0..=1.0;
        /// Brightness of the studio's lamps in the light's colour.
        brilliance: f32 = 2.2, in 0.0..=8.0;
    }
    presets {
        /// A diamond.
        brilliant {}
        /// Cut glass: less of the light comes back, and whiter.
        glass { ior: [1.51, 1.52, 1.53], bounces: 2, brilliance: 1.2 }
    }
}

impl Section for Diamond {
    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        of.material.gem.is_none()
    }
}
