//! A pose: local transforms, morph weights and material changes at one moment.

use std::collections::BTreeMap;

use crate::{
    Error, Result,
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

    /// Refuses what is not a pose of this scene. Empty lists are those of rest.
    pub(crate) fn check(&self, scene: &Scene) -> Result<()> {
        let fault = |what: String, message: String| Err(Error::Argument { what, message });
        for (name, count) in [("locals", self.locals.len()), ("morph_weights", self.morph_weights.len())] {
            if count != scene.nodes.len() && count != 0 {
                let message = format!("has {count} nodes; the scene has {}", scene.nodes.len());
                return fault(format!("pose.{name}"), message);
            }
        }
        let name = |node: usize| &scene.nodes[node].name;
        if let Some(at) = self.locals.iter().position(|local| !local.matrix().is_finite()) {
            return fault(format!("pose.locals[{at}] {:?}", name(at)), "is not finite".to_owned());
        }
        let is_finite = |weights: &Vec<f32>| weights.iter().all(|w| w.is_finite());
        if let Some(at) = self.morph_weights.iter().position(|w| !is_finite(w)) {
            return fault(format!("pose.morph_weights[{at}] {:?}", name(at)), "is not finite".to_owned());
        }
        match self.materials.keys().find(|m| **m >= scene.materials.len()) {
            Some(at) => fault(format!("pose.materials[{at}]"), format!("there are {}", scene.materials.len())),
            None => Ok(()),
        }
    }
}
