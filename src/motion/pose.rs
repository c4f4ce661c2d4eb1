//! A pose: local transforms, morph weights and material changes at one moment.

use std::collections::BTreeMap;

use crate::{
    material::Material,
    scene::{Scene, Transform},
};

/// State of a scene at one moment. Start from [`Pose::rest`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pose {
    /// Transform of each node relative to its parent.
    pub locals: Vec<Transform>,
    /// Morph weights of each node; empty for nodes without a mesh.
    pub morph_weights: Vec<Vec<f32>>,
    /// Materials that differ from the scene's, by index. Only numbers may differ: textures and options are fixed at
    /// upload.
    pub materials: BTreeMap<usize, Material>,
}

impl Pose {
    /// The pose as stored in the file.
    #[must_use]
    pub fn rest(scene: &Scene) -> Self {
        Self {
            locals: scene.nodes.iter().map(|n| n.transform).collect(),
            morph_weights: scene.nodes.iter().map(|n| n.morph_weights.clone()).collect(),
            materials: BTreeMap::new(),
        }
    }
}
