//! Painted shadow of a face: an SDF threshold map in place of normals, so that its border is a drawn shape.

use serde::{Deserialize, Serialize};

use super::{Options, Section, Surroundings, plain_parts};
use crate::render::layout::Block;
use crate::sdf::{FaceMap, MAX_PITCHES};

crate::section! {
    /// Where light and shade meet on a face, by the angle of the directional light about the head. Other lights shade the
    /// face by its normals.
    ///
    /// The angle is measured in the frame of the head bone as it is posed: turning head and light together changes nothing.
    #[derive(Copy)]
    FaceShadow = "face_shadow" {
        on_line: true, needs: &["face_light"],
        channel: Some((
            "face-shadow",
            "Share of light by a face's threshold map; dark grey times the light of everything else.",
        )),
        more_channels: &[(
            "face-map",
            "Threshold map of a face: for light from its right in red, from its left in green; blue where normals shade.",
        )],
    }
    {
        /// Index in [`Scene::face_maps`](crate::scene::Scene::face_maps); laid over the set of texture coordinates that
        /// it names.
        map: usize = 0, read FACE;
        /// Measure of the thresholds.
        angle: AngleMapping = AngleMapping::Linear;
        /// Half width of the soft border, in units of the thresholds, of which half a turn has 1. Below 1/128 a map of 8 bits
        /// shows steps.
        softness: f32 = 0.012, in 0.001..=0.5;
        /// Where the horizontal part of the direction to the light is shorter than this, the angle fades to that of light
        /// from the front: straight above there is none.
        overhead_fade: f32 = 0.35, in 0.01..=1.0;
    }
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
plain_parts!(AngleMapping);

impl FaceShadow {
    fn map_in<'a>(&self, of: &Surroundings<'a>) -> Option<&'a FaceMap> {
        of.face_maps.get(self.map)
    }
}

impl Section for FaceShadow {
    fn put(&self, gpu: &mut Block<'_>, of: &Surroundings<'_>) {
        let pitches = self.map_in(of).map_or([0.0].as_slice(), |m| m.pitches_rad.as_slice());
        let placed: [f32; MAX_PITCHES] = std::array::from_fn(|i| pitches.get(i).copied().unwrap_or(0.0));
        gpu.put("cosine", f32::from(u8::from(self.angle == AngleMapping::Cosine)));
        gpu.put("pitches", placed);
        gpu.put("pitch_count", pitches.len().clamp(1, MAX_PITCHES) as u32);
    }

    fn options(&self, on: &mut Options, of: &Surroundings<'_>) {
        let Some(map) = self.map_in(of) else { return };
        on.set("face_relief", map.uv_set == 1);
        on.set("face_stack", map.pitches_rad.len() > 1);
        on.set("face_back", !map.back.is_empty());
        on.set("face_masks", !map.masks.is_empty());
    }

    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        self.map_in(of).is_some()
    }
}
