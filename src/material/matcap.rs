//! Matcap: a picture of light on a sphere, looked up by the normal seen from the camera.

use serde::{Deserialize, Serialize};

/// Matcap of MToon; added to the rim before its mask.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Matcap {
    /// Index in [`Scene::textures`](crate::scene::Scene::textures); sRGB, no UV transform.
    pub texture: usize,
    /// Factor, linear. Default: white.
    pub color: [f32; 3],
}

impl Default for Matcap {
    fn default() -> Self {
        Self { texture: 0, color: [1.0; 3] }
    }
}
