//! Painted shadow of a face: an SDF threshold map in place of normals, so that its border is a drawn shape.

use serde::{Deserialize, Serialize};

/// Where light and shade meet on a face, by the angle of the directional light about the head. Other lights shade the
/// face by its normals.
///
/// The angle is measured in the frame of the head bone as it is posed: turning head and light together changes nothing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FaceShadow {
    /// Index in [`Scene::face_maps`](crate::scene::Scene::face_maps); laid over UV set 0. Default: 0.
    pub map: usize,
    /// Measure of the thresholds. Default: linear.
    pub angle: AngleMapping,
    /// Half width of the soft border, in units of the thresholds, of which half a turn has 1. Below 1/128 a map of 8 bits
    /// shows steps. Range 0.001..0.5. Default: 0.012.
    pub softness: f32,
    /// Where the horizontal part of the direction to the light is shorter than this, the angle fades to that of light
    /// from the front: straight above there is none. Range 0.01..1. Default: 0.35.
    pub overhead_fade: f32,
}

/// What a threshold between 0 and 1 says about the angle of the light, which is 0 in front and π behind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AngleMapping {
    /// Angle over π.
    #[default]
    Linear,
    /// (1 - cos angle) / 2.
    Cosine,
}

impl Default for FaceShadow {
    fn default() -> Self {
        Self { map: 0, angle: AngleMapping::default(), softness: 0.012, overhead_fade: 0.35 }
    }
}
