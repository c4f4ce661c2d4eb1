//! Painted shadow of a face: an SDF threshold map in place of normals, so that its border is a drawn shape.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// Where light and shade meet on a face, by the angle of the directional light about the head. Other lights shade the
/// face by its normals.
///
/// The angle is measured in the frame of the head bone as it is posed: turning head and light together changes nothing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct FaceShadow {
    /// Threshold map, linear, in lilToon's layout. Red is for light from the character's right, green for light from
    /// the left: the angle over π at which a texel turns dark; 0 is never lit, 1 always. Blue is the share of normal
    /// shading (1 on the neck, so that no seam shows), alpha the strength of the map. Default: texture 0.
    pub map: TextureRef,
    /// Half width of the soft border, angle over π. Below 1/128 a map of 8 bits shows steps. Range 0.001..0.5.
    /// Default: 0.012.
    pub softness: f32,
    /// Where the horizontal part of the direction to the light is shorter than this, the angle fades to that of light
    /// from the front: straight above there is none. Range 0.01..1. Default: 0.35.
    pub overhead_fade: f32,
}

impl Default for FaceShadow {
    fn default() -> Self {
        Self { map: TextureRef::default(), softness: 0.012, overhead_fade: 0.35 }
    }
}
