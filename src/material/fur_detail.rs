//! Hand-painted fur: strands that show where light turns into shade.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// Fur as it is painted: a flat colour with few strokes in the light, all strokes at the terminator, half of them in shade.
/// N·L of a detail normal cuts the three regions, so that the border of light has the shape of the clumps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FurDetail {
    /// Detail normals, tangent space, linear; they take the place of the material's normal map. Default: texture 0.
    pub detail_normal: TextureRef,
    /// Scale of their x and y. Range 0..4. Default: 1.
    pub normal_scale: f32,
    /// Detail colour, sRGB; multiplies the base colour's factor. `None`: the base texture is the detail, and its own blur
    /// the flat colour. Default: none.
    pub detail_color: Option<TextureRef>,
    /// Without detail colours: mip levels by which the base texture is blurred into the flat colour. Range 0..10.
    /// Default: 4.
    pub blur_levels: f32,
    /// N·L at the ends of the terminator: shade, light; growing. Range -1..1. Default: (-0.15, 0.3).
    pub terminator: [f32; 2],
    /// Half width of the borders of the regions, N·L; at most half the terminator counts. Range 0..1. Default: 0.1.
    pub softness: f32,
    /// Shares of the detail colour in light, at the terminator and in shade. Range 0..1. Default: (0.2, 0.8, 0.5).
    pub shares: [f32; 3],
}

impl Default for FurDetail {
    fn default() -> Self {
        Self {
            detail_normal: TextureRef::default(),
            normal_scale: 1.0,
            detail_color: None,
            blur_levels: 4.0,
            terminator: [-0.15, 0.3],
            softness: 0.1,
            shares: [0.2, 0.8, 0.5],
        }
    }
}
