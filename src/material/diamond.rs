//! A cut stone that throws light back: diamond.

use serde::{Deserialize, Serialize};

/// A brilliant: rays are refracted in, thrown back and forth between facets as often as total reflection keeps them in, and
/// leave towards a studio of the scene's light, each channel by its own index. The cut stands on the surface by its normal
/// and tangent; flat facets of the mesh multiply its shards. The base colour does nothing.
///
/// Sources: Fresnel's equations; angles of the round brilliant by Tolkowsky 1919.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Diamond {
    /// Indices of refraction for red, green and blue light; equal ones do not disperse. Range 1..4.
    /// Default: (2.41, 2.42, 2.44).
    pub ior: [f32; 3],
    /// Reflections inside before a ray is let out. Range 1..6. Default: 3.
    pub bounces: u32,
    /// Facets round the stone. Range 4..16. Default: 8.
    pub facets: u32,
    /// Colour of light that crossed it, linear. Range 0..1. Default: a cold white, (0.9, 0.95, 1).
    pub color: [f32; 3],
    /// Brightness of the studio's lamps in the light's colour. Range 0..8. Default: 2.2.
    pub brilliance: f32,
}

impl Default for Diamond {
    fn default() -> Self {
        Self { ior: [2.41, 2.42, 2.44], bounces: 3, facets: 8, color: [0.9, 0.95, 1.0], brilliance: 2.2 }
    }
}

impl Diamond {
    /// Cut glass: less of the light comes back, and whiter.
    #[must_use]
    pub fn glass() -> Self {
        Self { ior: [1.51, 1.52, 1.53], bounces: 2, brilliance: 1.2, ..Self::default() }
    }
}
