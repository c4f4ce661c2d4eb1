//! Animation clips as stored in a glTF file, and what those of a VRMA move.

use std::collections::BTreeMap;

use super::HumanBone;

/// A clip.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animation {
    /// Name in the file; may be empty.
    pub name: String,
    /// Animated properties.
    pub channels: Vec<AnimationChannel>,
}

/// Keys of one property of one node.
#[derive(Clone, Debug, PartialEq)]
pub struct AnimationChannel {
    /// Index in [`Scene::nodes`](super::Scene::nodes).
    pub node: usize,
    /// Key times, seconds, strictly growing, not empty.
    pub times: Vec<f32>,
    /// How values between keys are made.
    pub interpolation: Interpolation,
    /// Key values.
    pub values: AnimationValues,
}

/// What nodes of a file of humanoid movements (`VRMC_vrm_animation`) stand for; its clips move any character.
///
/// Eyes and the gaze expressions (`lookUp` and its kin) never stand in it: both follow [`look_at`](Self::look_at).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AnimationRig {
    /// Humanoid bones and their nodes: rotations count, and the translation of the hips.
    pub bones: BTreeMap<HumanBone, usize>,
    /// Expressions, presets and custom ones by name, each with the node whose x of the translation is the weight, to be clamped
    /// to 0..1.
    pub expressions: Vec<(String, usize)>,
    /// The node whose local rotation is the gaze, from straight ahead. `None`: clips do not move the gaze.
    pub look_at: Option<usize>,
}

/// Interpolation between keys (glTF 2.0, appendix C).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Linear; spherical for rotations.
    #[default]
    Linear,
    /// The value of the key before.
    Step,
    /// Cubic Hermite; three values a key: in-tangent, value, out-tangent.
    CubicSpline,
}

/// Values of the animated property.
#[derive(Clone, Debug, PartialEq)]
pub enum AnimationValues {
    /// Translations, metres.
    Translation(Vec<[f32; 3]>),
    /// Rotations, quaternions `(x, y, z, w)`.
    Rotation(Vec<[f32; 4]>),
    /// Scales.
    Scale(Vec<[f32; 3]>),
    /// Morph weights, one for each target and key, key-major.
    MorphWeights(Vec<f32>),
}
