//! Lit colour, normal map, emission, and how textures are referred to.

use serde::{Deserialize, Serialize};

/// Lit colour (glTF base colour, MToon lit colour).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Base {
    /// Factor, linear RGBA. Range 0..1. Default: white.
    pub color: [f32; 4],
    /// Texture, sRGB with straight alpha; multiplies the factor. Default: none.
    pub texture: Option<TextureRef>,
}

impl Default for Base {
    fn default() -> Self {
        Self { color: [1.0; 4], texture: None }
    }
}

/// Tangent-space normal map, glTF convention (+Y up), linear.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct NormalMap {
    /// Texture, linear.
    pub texture: TextureRef,
    /// Scale of x and y. Default: 1.
    pub scale: f32,
}

impl Default for NormalMap {
    fn default() -> Self {
        Self { texture: TextureRef::default(), scale: 1.0 }
    }
}

/// Light of its own, added after shading.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Emission {
    /// Colour, linear, times its strength; may exceed 1. Default: black.
    pub color: [f32; 3],
    /// Texture, sRGB; multiplies the colour. Default: none.
    pub texture: Option<TextureRef>,
    /// Movement of the texture, UV units a second. Default: (0, 0).
    pub scroll_per_s: [f32; 2],
    /// Swells and ebbs. Default: none.
    pub blink: Option<Blink>,
}

/// Light that swells and ebbs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Blink {
    /// Time from one peak to the next, seconds. Range 0.05..60. Default: 1.5.
    pub period_s: f32,
    /// Share of the light that stays between peaks. Range 0..1. Default: 0.2.
    pub low: f32,
    /// 0 swells like breath, 1 is switched on and off. Range 0..1. Default: 0.
    pub sharpness: f32,
}

impl Default for Blink {
    fn default() -> Self {
        Self { period_s: 1.5, low: 0.2, sharpness: 0.0 }
    }
}

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
