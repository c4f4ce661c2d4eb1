//! A pose: local transforms, morph weights and shifts of materials at one moment.

use glam::Quat;

use super::Shifts;
use crate::{
    Error, Result,
    scene::{HumanBone, Scene, Transform},
};

/// State of a scene at one moment. Start from [`Pose::rest`].
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    /// Transform of each node relative to its parent.
    pub locals: Vec<Transform>,
    /// Morph weights of each node; empty for nodes without a mesh.
    pub morph_weights: Vec<Vec<f32>>,
    /// What expressions shift of materials.
    pub shifts: Shifts,
    /// What the diameter of pupils is multiplied by: expressions set it as [`Pupils`](crate::scene::Pupils) says, an application
    /// may. Range 0... Default: 1.
    pub pupil_scale: f32,
}

impl Default for Pose {
    fn default() -> Self {
        Self { locals: Vec::new(), morph_weights: Vec::new(), shifts: Shifts::default(), pupil_scale: 1.0 }
    }
}

impl Pose {
    /// The pose as stored in the file.
    #[must_use]
    pub fn rest(scene: &Scene) -> Self {
        Self {
            locals: scene.nodes.iter().map(|n| n.transform).collect(),
            morph_weights: scene.nodes.iter().map(|n| n.morph_weights.clone()).collect(),
            ..Self::default()
        }
    }

    /// Turns a bone about the character's own axes (x to its left, y up, z forward), whatever those of its node are, on top
    /// of what the pose has; whether there is such a bone.
    pub fn turn(&mut self, scene: &Scene, bone: HumanBone, by: Quat) -> bool {
        let Some(node) = scene.bone_node(bone).filter(|n| *n < self.locals.len()) else { return false };
        let world = scene.world_from_nodes(&self.locals);
        let above = scene.nodes[node].parent.map_or(Quat::IDENTITY, |p| world[p].to_scale_rotation_translation().1);
        let rotation = &mut self.locals[node].rotation;
        *rotation = (above.inverse() * by * above * *rotation).normalize();
        true
    }

    /// Refuses what is not a pose of this scene, but for transforms that are not finite. Empty lists are those of rest.
    pub(crate) fn check(&self, scene: &Scene) -> Result<()> {
        let fault = |what: String, message: String| Err(Error::Argument { what, message });
        for (name, count) in [("locals", self.locals.len()), ("morph_weights", self.morph_weights.len())] {
            if count != scene.nodes.len() && count != 0 {
                let message = format!("has {count} nodes; the scene has {}", scene.nodes.len());
                return fault(format!("pose.{name}"), message);
            }
        }
        if !(0.0..=f32::MAX).contains(&self.pupil_scale) {
            return fault("pose.pupil_scale".to_owned(), format!("is {}; expected a number from 0", self.pupil_scale));
        }
        let name = |node: usize| &scene.nodes[node].name;
        let is_finite = |weights: &Vec<f32>| weights.iter().all(|w| w.is_finite());
        if let Some(at) = self.morph_weights.iter().position(|w| !is_finite(w)) {
            return fault(format!("pose.morph_weights[{at}] {:?}", name(at)), "is not finite".to_owned());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::scene::{Character, Expression, MorphBind, Node};

    #[test]
    fn a_bone_turns_about_the_axes_of_the_character() {
        let node = |parent, rotation| Node {
            parent,
            transform: Transform { rotation, ..Transform::default() },
            ..Node::default()
        };
        // The head's node lies on its side, under a body that is turned.
        let scene = Scene {
            nodes: vec![node(None, Quat::from_rotation_y(0.7)), node(Some(0), Quat::from_rotation_z(1.2))],
            character: Some(Character { bones: [(HumanBone::Head, 1)].into(), ..Character::default() }),
            ..Scene::default()
        };
        let mut pose = Pose::rest(&scene);
        let before = scene.world_from_nodes(&pose.locals)[1];
        assert!(pose.turn(&scene, HumanBone::Head, Quat::from_rotation_y(0.5)));
        let after = scene.world_from_nodes(&pose.locals)[1];
        let expected = Quat::from_rotation_y(0.5) * before.transform_vector3(Vec3::X);
        assert!(after.transform_vector3(Vec3::X).abs_diff_eq(expected, 1e-5));
        assert!(!pose.turn(&scene, HumanBone::Hips, Quat::IDENTITY));
    }

    #[test]
    fn expressions_that_a_character_lacks_are_skipped_on_request() {
        let happy = Expression {
            name: "happy".to_owned(),
            morphs: vec![MorphBind { node: 0, target: 0, weight: 0.5 }],
            ..Expression::default()
        };
        let scene = Scene {
            nodes: vec![Node { morph_weights: vec![0.0], ..Node::default() }],
            character: Some(Character { expressions: vec![happy], ..Character::default() }),
            ..Scene::default()
        };
        let mut pose = Pose::rest(&scene);
        pose.express(&scene, &[("happy", 1.0), ("winking", 1.0)]);
        assert_eq!(pose.morph_weights[0], [0.5]);
        assert!(pose.set_expressions(&scene, &[("winking".to_owned(), 1.0)]).is_err());
    }
}
