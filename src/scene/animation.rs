//! Animation clips as stored in a glTF file.

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
