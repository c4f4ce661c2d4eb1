//! How textures are referred to.

use serde::{Deserialize, Serialize};

/// A texture as a material uses it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TextureRef {
    /// Index in [`Scene::textures`](crate::scene::Scene::textures).
    pub texture: usize,
    /// Index in [`Primitive::uvs`](crate::scene::Primitive::uvs): 0 or 1. Default: 0.
    pub uv_set: u32,
    /// Transform of the UVs. Default: identity.
    pub transform: UvTransform,
}

/// UV transform of `KHR_texture_transform`: scale, then rotate counter-clockwise (v grows downwards), then offset.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct UvTransform {
    /// Offset, UV units. Default: 0.
    pub offset: [f32; 2],
    /// Rotation, radians. Default: 0.
    pub rotation_rad: f32,
    /// Scale. Default: 1.
    pub scale: [f32; 2],
}

impl Default for UvTransform {
    fn default() -> Self {
        Self { offset: [0.0; 2], rotation_rad: 0.0, scale: [1.0; 2] }
    }
}
