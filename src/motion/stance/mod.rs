//! Named poses of the humanoid: rotations of human bones in the character's own axes, so that they fit any VRM.

mod arms;
mod legs;
mod rig;

use glam::{EulerRot, Quat};

use super::Pose;
use crate::scene::{HumanBone, Scene};
use rig::Rig;

/// A named pose. All of them start from the T-pose, in which VRM characters rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stance {
    /// As stored in the file: the T-pose of VRM.
    #[default]
    Rest,
    /// Standing at ease: weight on the right leg, shoulders against the hips, arms beside the body.
    Relaxed,
    /// Upper arms forward, elbows and one knee bent by 90°: shows how joints bend.
    Bend,
    /// At ease, the left hand held out before the body with its palm up.
    Offer,
}

/// A bone and its turn: degrees about the character's left (+X), up (+Y) and front (+Z).
type Turn = (HumanBone, [f32; 3]);

/// Weight on the right leg: hips and shoulders lean against each other, and the head leans against the shoulders.
const HIPS: [f32; 3] = [0.0, -8.0, -6.0];
/// Shared by the bones between hips and neck.
const TORSO: [f32; 3] = [-3.0, 6.0, 9.0];
/// Shared by neck and head.
const HEAD: [f32; 3] = [3.0, 8.0, -10.0];

const ARMS: &[Turn] = &[
    // One arm hangs a little behind, the other one has begun a gesture.
    (HumanBone::RightShoulder, [0.0, 0.0, 5.0]),
    (HumanBone::RightUpperArm, [2.0, -8.0, 70.0]),
    (HumanBone::RightLowerArm, [4.0, 22.0, 8.0]),
    (HumanBone::RightHand, [0.0, 4.0, -20.0]),
    (HumanBone::RightThumbMetacarpal, [0.0, -12.0, 8.0]),
    (HumanBone::LeftShoulder, [0.0, 0.0, -4.0]),
    (HumanBone::LeftUpperArm, [30.0, 8.0, -70.0]),
    (HumanBone::LeftLowerArm, [-16.0, -62.0, 0.0]),
    (HumanBone::LeftHand, [-10.0, -4.0, 18.0]),
    (HumanBone::LeftThumbMetacarpal, [0.0, 8.0, 4.0]),
];

const BEND: &[Turn] = &[
    (HumanBone::LeftUpperArm, [0.0, -90.0, 0.0]),
    (HumanBone::RightUpperArm, [0.0, 90.0, 0.0]),
    (HumanBone::LeftLowerArm, [0.0, 0.0, 90.0]),
    (HumanBone::RightLowerArm, [0.0, 0.0, -90.0]),
    (HumanBone::LeftUpperLeg, [-90.0, 0.0, 0.0]),
    (HumanBone::LeftLowerLeg, [90.0, 0.0, 0.0]),
];

/// What the left arm of [`Stance::Offer`] does instead of [`ARMS`].
const OFFER: &[Turn] = &[
    (HumanBone::LeftUpperArm, [0.0, -8.0, -58.0]),
    (HumanBone::LeftLowerArm, [-62.0, -82.0, 0.0]),
    (HumanBone::LeftHand, [-52.0, 0.0, 0.0]),
];

/// Fingers of a relaxed hand, degrees of curl at the root, in the middle and at the tip.
const CURL: [f32; 3] = [18.0, 26.0, 18.0];
/// Shares of that in the left and the right hand, and degrees of spread at the root, towards the thumb.
const FINGERS: [(&str, [f32; 2], f32); 4] = [
    ("Index", [0.3, 0.5], 4.0),
    ("Middle", [0.75, 0.8], 1.0),
    ("Ring", [1.1, 1.05], -2.0),
    ("Little", [0.8, 1.1], -7.0),
];

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

    fn turns(self, rig: &Rig<'_>) -> Vec<Turn> {
        let held: &[Turn] = match self {
            Self::Rest => return Vec::new(),
            Self::Bend => return BEND.to_vec(),
            Self::Relaxed => &[],
            Self::Offer => OFFER,
        };
        let mut turns = vec![(HumanBone::Hips, HIPS)];
        turns.extend(shared(rig, &[HumanBone::Spine, HumanBone::Chest, HumanBone::UpperChest], TORSO));
        turns.extend(shared(rig, &[HumanBone::Neck, HumanBone::Head], HEAD));
        turns.extend(held);
        turns.extend(ARMS.iter().filter(|(bone, _)| held.iter().all(|(b, _)| b != bone)));
        turns.extend(HumanBone::ALL.iter().filter_map(|bone| Some((*bone, finger(*bone)?))));
        turns
    }
}

/// A turn that some bones make together: those of them that there are, in equal parts.
fn shared(rig: &Rig<'_>, bones: &[HumanBone], turn: [f32; 3]) -> Vec<Turn> {
    let there: Vec<HumanBone> = bones.iter().copied().filter(|bone| rig.node(*bone).is_some()).collect();
    let share = 1.0 / there.len().max(1) as f32;
    there.into_iter().map(|bone| (bone, turn.map(|degrees| degrees * share))).collect()
}

/// The curl of a joint of a finger.
fn finger(bone: HumanBone) -> Option<[f32; 3]> {
    let name = bone.name();
    let (hand, sign) = if name.starts_with("left") { (0, -1.0) } else { (1, 1.0) };
    let (_, shares, spread) = FINGERS.iter().find(|(finger, ..)| name.contains(finger))?;
    let joint = ["Proximal", "Intermediate", "Distal"].iter().position(|j| name.ends_with(j))?;
    let spread = if joint == 0 { *spread } else { 0.0 };
    Some([0.0, sign * spread, sign * shares[hand] * CURL[joint]])
}

impl Pose {
    /// Turns the bones of the humanoid into a stance, from the rest pose of the file. Bones are those that the file names, else
    /// those whose nodes have the names of bones; ones that the character lacks are skipped, and a scene without a humanoid keeps
    /// its rest pose. At ease, both feet stand flat on the ground and the arms keep clear of the body.
    pub fn set_stance(&mut self, scene: &Scene, stance: Stance) {
        let rig = Rig::of(scene);
        for (bone, degrees) in stance.turns(&rig) {
            let [x, y, z] = degrees.map(f32::to_radians);
            rig.turn(self, bone, Quat::from_euler(EulerRot::ZYX, z, y, x));
        }
        if matches!(stance, Stance::Relaxed | Stance::Offer) {
            legs::stand(&rig, self);
            arms::clear(&rig, self);
        }
    }
}
