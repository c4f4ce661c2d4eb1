//! The bones of a humanoid, and how they are turned.

use std::collections::BTreeMap;

use glam::{Quat, Vec3};

use crate::motion::Pose;
use crate::motion::bone_names::bones_of;
use crate::motion::places::{Place, place_all};
use crate::motion::retarget::facing;
use crate::motion::rotation::{between, direction, inverse, mul, turn};
use crate::scene::{HumanBone, Scene, Transform};

/// The skeleton of a scene at rest, facing +Z whatever the file does.
pub(super) struct Rig<'a> {
    pub scene: &'a Scene,
    pub bones: BTreeMap<HumanBone, usize>,
    pub rest: Vec<Place>,
    parents: Vec<Option<usize>>,
    root: Place,
    /// Whether the file promises a T-pose.
    has_t_pose: bool,
}

impl<'a> Rig<'a> {
    pub fn of(scene: &'a Scene) -> Self {
        let bones = bones_of(scene);
        let root = Place { rotation: facing(scene, &bones), ..Place::ORIGIN };
        let parents = scene.nodes.iter().map(|n| n.parent).collect();
        let has_t_pose = scene.character.as_ref().is_some_and(|c| !c.bones.is_empty());
        let mut rig = Self { scene, bones, rest: Vec::new(), parents, root, has_t_pose };
        let locals: Vec<Transform> = scene.nodes.iter().map(|n| n.transform).collect();
        rig.rest = rig.places_of(&locals);
        rig
    }

    pub fn node(&self, bone: HumanBone) -> Option<usize> {
        self.bones.get(&bone).copied()
    }

    /// Places of all nodes in a pose.
    pub fn places(&self, pose: &Pose) -> Vec<Place> {
        self.places_of(&pose.locals)
    }

    fn places_of(&self, locals: &[Transform]) -> Vec<Place> {
        let mut places = Vec::with_capacity(locals.len());
        place_all(&self.parents, locals, &self.root, &mut places);
        places
    }

    /// Turns a bone from rest, in the axes of the character as they are turned with its parent.
    pub fn turn(&self, pose: &mut Pose, bone: HumanBone, by: Quat) {
        let Some(node) = self.node(bone) else { return };
        let above = self.above(&self.rest, node).rotation;
        let by = mul(mul(inverse(self.straight(bone, true)), by), self.straight(bone, false));
        let (Some(local), Some(rest)) = (pose.locals.get_mut(node), self.scene.nodes.get(node)) else { return };
        local.rotation = (inverse(above) * by * above * rest.transform.rotation).normalize();
    }

    /// Turns a node to this rotation among all nodes of a pose.
    pub fn set_rotation(&self, pose: &mut Pose, node: usize, rotation: Quat) {
        let above = self.above(&self.places(pose), node).rotation;
        if let Some(local) = pose.locals.get_mut(node) {
            local.rotation = mul(inverse(above), rotation).normalize();
        }
    }

    /// Moves a node.
    pub fn shift(&self, pose: &mut Pose, node: usize, by: Vec3) {
        let above = self.above(&self.rest, node);
        if let Some(local) = pose.locals.get_mut(node) {
            local.translation += turn(inverse(above.rotation), by) / above.scale;
        }
    }

    fn above(&self, places: &[Place], node: usize) -> Place {
        self.parents.get(node).copied().flatten().and_then(|p| places.get(p)).copied().unwrap_or(self.root)
    }

    /// What takes an arm at rest into the T-pose: that of a bone, or of the bone above it.
    fn straight(&self, bone: HumanBone, above: bool) -> Quat {
        use HumanBone::{LeftHand, LeftLowerArm, LeftUpperArm, RightHand, RightLowerArm, RightUpperArm};
        let name = bone.name();
        let (upper, lower, hand, side) = if name.starts_with("left") {
            (LeftUpperArm, LeftLowerArm, LeftHand, Vec3::X)
        } else {
            (RightUpperArm, RightLowerArm, RightHand, Vec3::NEG_X)
        };
        let is_finger = ["Thumb", "Index", "Middle", "Ring", "Little"].iter().any(|f| name.contains(f));
        let of = match (bone, above) {
            _ if self.has_t_pose => None,
            (b, false) if b == upper => Some([upper, lower]),
            (b, true) if b == lower => Some([upper, lower]),
            (b, _) if b == lower || b == hand || is_finger => Some([lower, hand]),
            _ => None,
        };
        let place = |bone| Some(self.rest.get(self.node(bone)?)?.position);
        let along = of.and_then(|[from, to]| direction(place(to)? - place(from)?));
        along.map_or(Quat::IDENTITY, |along| between(along, side))
    }
}
