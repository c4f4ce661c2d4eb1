//! Named poses of the humanoid: rotations of human bones in the character's own axes, so that they fit any VRM.

use glam::{EulerRot, Quat};

use super::Pose;
use crate::scene::{HumanBone, Scene};

/// A named pose. All of them start from the T-pose, in which VRM characters rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stance {
    /// As stored in the file: the T-pose of VRM.
    #[default]
    Rest,
    /// Standing at ease: arms down, head turned a little.
    Relaxed,
    /// Upper arms forward, elbows and one knee bent by 90°: shows how joints bend.
    Bend,
    /// At ease, the left hand held out before the body with its palm up.
    Offer,
}

/// A bone and its turn: degrees about the character's left (+X), up (+Y) and front (+Z).
type Turn = (HumanBone, [f32; 3]);

const RELAXED: &[Turn] = &[
    // The weight is on the right leg: hips and shoulders lean against each other.
    (HumanBone::Hips, [0.0, -4.0, -3.5]),
    (HumanBone::Spine, [1.0, 2.0, 2.5]),
    (HumanBone::Chest, [-1.0, 2.0, 2.5]),
    (HumanBone::UpperChest, [-1.0, 1.0, 1.5]),
    (HumanBone::Neck, [1.0, 3.0, -2.5]),
    (HumanBone::Head, [2.0, 4.0, -4.5]),
    (HumanBone::LeftShoulder, [0.0, 0.0, -5.0]),
    (HumanBone::LeftUpperArm, [8.0, 6.0, -68.0]),
    (HumanBone::LeftLowerArm, [0.0, -24.0, -4.0]),
    (HumanBone::LeftHand, [0.0, -4.0, -6.0]),
    (HumanBone::LeftThumbMetacarpal, [0.0, 16.0, -8.0]),
    (HumanBone::RightShoulder, [0.0, 0.0, 4.0]),
    (HumanBone::RightUpperArm, [6.0, -6.0, 67.0]),
    (HumanBone::RightLowerArm, [0.0, 26.0, 4.0]),
    (HumanBone::RightHand, [0.0, 5.0, 6.0]),
    (HumanBone::RightThumbMetacarpal, [0.0, -16.0, 8.0]),
    (HumanBone::RightUpperLeg, [1.0, -3.0, 5.5]),
    (HumanBone::RightFoot, [-1.0, -6.0, -2.0]),
    (HumanBone::LeftUpperLeg, [-10.0, 12.0, 2.0]),
    (HumanBone::LeftLowerLeg, [17.0, 0.0, 0.0]),
    (HumanBone::LeftFoot, [-7.0, 4.0, 1.5]),
];

const BEND: &[Turn] = &[
    (HumanBone::LeftUpperArm, [0.0, -90.0, 0.0]),
    (HumanBone::RightUpperArm, [0.0, 90.0, 0.0]),
    (HumanBone::LeftLowerArm, [0.0, 0.0, 90.0]),
    (HumanBone::RightLowerArm, [0.0, 0.0, -90.0]),
    (HumanBone::LeftUpperLeg, [-90.0, 0.0, 0.0]),
    (HumanBone::LeftLowerLeg, [90.0, 0.0, 0.0]),
];

/// What the left arm of [`Stance::Offer`] does instead of [`RELAXED`].
const OFFER: &[Turn] = &[
    (HumanBone::Head, [5.0, 11.0, -3.0]),
    (HumanBone::LeftUpperArm, [0.0, -8.0, -58.0]),
    (HumanBone::LeftLowerArm, [-62.0, -82.0, 0.0]),
    (HumanBone::LeftHand, [-52.0, 0.0, 0.0]),
];

/// Fingers of a relaxed hand, degrees of curl at the root, in the middle and at the tip.
const CURL: [f32; 3] = [16.0, 24.0, 18.0];
/// Shares of that: the little finger curls most.
const FINGERS: [(&str, f32); 4] = [("Index", 0.7), ("Middle", 0.9), ("Ring", 1.1), ("Little", 1.25)];

impl Stance {
    /// All stances.
    pub const ALL: &'static [Self] = &[Self::Rest, Self::Relaxed, Self::Bend, Self::Offer];

    /// Its name: `rest`, `relaxed`, `bend`, `offer`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rest => "rest",
            Self::Relaxed => "relaxed",
            Self::Bend => "bend",
            Self::Offer => "offer",
        }
    }

    /// The stance of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|s| s.name() == name)
    }

    fn turns(self) -> Vec<Turn> {
        match self {
            Self::Rest => Vec::new(),
            Self::Bend => BEND.to_vec(),
            Self::Relaxed | Self::Offer => {
                let held: &[Turn] = if self == Self::Offer { OFFER } else { &[] };
                let mut turns = held.to_vec();
                turns.extend(RELAXED.iter().filter(|(bone, _)| held.iter().all(|(b, _)| b != bone)));
                for bone in HumanBone::ALL {
                    let name = bone.name();
                    let sign = if name.starts_with("left") { -1.0 } else { 1.0 };
                    let finger = FINGERS.iter().find(|(f, _)| name.contains(f));
                    let joint = ["Proximal", "Intermediate", "Distal"].iter().position(|j| name.ends_with(j));
                    if let (Some((_, share)), Some(joint)) = (finger, joint) {
                        turns.push((*bone, [0.0, 0.0, sign * share * CURL.get(joint).copied().unwrap_or(0.0)]));
                    }
                }
                turns
            }
        }
    }
}

impl Pose {
    /// Turns the bones of the humanoid into a stance, from the rest pose of the file. Bones that the character lacks are
    /// skipped; a scene without a humanoid keeps its rest pose.
    pub fn set_stance(&mut self, scene: &Scene, stance: Stance) {
        let rest = scene.rest_world_from_nodes();
        for (bone, degrees) in stance.turns() {
            let Some(node) = scene.bone_node(bone) else { continue };
            let parent = scene.nodes.get(node).and_then(|n| n.parent).and_then(|p| rest.get(p));
            let parent = parent.map_or(Quat::IDENTITY, |m| m.to_scale_rotation_translation().1);
            let [x, y, z] = degrees.map(f32::to_radians);
            let turn = Quat::from_euler(EulerRot::ZYX, z, y, x);
            if let (Some(local), Some(n)) = (self.locals.get_mut(node), scene.nodes.get(node)) {
                local.rotation = (parent.inverse() * turn * parent * n.transform.rotation).normalize();
            }
        }
    }
}
