//! A posture in terms of the body, and the bones' rotations that make it.

use glam::{EulerRot, Quat, Vec3};

use super::curve::mix;
use crate::skeleton::Skeleton;

/// Turn by degrees: yaw to her left, then pitch forward and down, then roll, which lifts her left side.
pub(super) fn turn(yaw: f32, pitch: f32, roll: f32) -> Quat {
    Quat::from_euler(EulerRot::YXZ, yaw.to_radians(), pitch.to_radians(), roll.to_radians())
}

/// An arm. All angles in degrees; all zero is an arm that hangs straight down with the palm to the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Arm {
    /// Shoulder blade up.
    pub raise: f32,
    /// Shoulder blade forward.
    pub protract: f32,
    /// Upper arm forward.
    pub swing: f32,
    /// Upper arm away from the body.
    pub abduct: f32,
    /// Upper arm about its length; positive brings a bent forearm before the body.
    pub twist: f32,
    /// Bend of the elbow.
    pub elbow: f32,
    /// Forearm and hand about their length; positive turns the palm backwards.
    pub pronate: f32,
    /// Hand towards the palm.
    pub flex: f32,
    /// Hand towards the little finger.
    pub deviate: f32,
    /// Share of a relaxed curl of the fingers: 0 straight, 1 relaxed, 4 a fist.
    pub curl: f32,
    /// Fingers apart.
    pub spread: f32,
}

/// Where a foot is. For the right foot sides are mirrored.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Foot {
    /// Place of the ankle, metres; x outwards from the middle.
    pub ankle: Vec3,
    /// Toes out, degrees.
    pub out: f32,
    /// Toes down, heel up, degrees.
    pub pitch: f32,
    /// Pitch of the toes against the ground, degrees.
    pub toes: f32,
    /// Direction of the knee outwards, degrees.
    pub knee: f32,
}

/// The whole body at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Posture {
    /// Place of the hips, metres.
    pub hips: Vec3,
    /// Directions of pelvis, chest and head in the world.
    pub pelvis: Quat,
    pub chest: Quat,
    pub head: Quat,
    /// Left and right.
    pub arms: [Arm; 2],
    pub feet: [Foot; 2],
    /// Gaze against the head, degrees: yaw to her left, pitch down.
    pub gaze: [f32; 2],
}

/// Shares of the spine's turn that its bones take.
const SPINE: [(&str, f32); 3] = [("spine", 0.34), ("chest", 0.36), ("upperChest", 0.3)];
/// Shares of the head's turn.
const NECK: [(&str, f32); 2] = [("neck", 0.42), ("head", 0.58)];
/// Curl of a relaxed finger at its three joints, degrees, and the share of each finger.
const CURL: [(&str, f32); 3] = [("Proximal", 17.0), ("Intermediate", 23.0), ("Distal", 14.0)];
const FINGERS: [(&str, f32, f32); 4] =
    [("Index", 0.75, 1.0), ("Middle", 0.92, 0.2), ("Ring", 1.06, -0.6), ("Little", 1.16, -1.4)];

/// A turn mirrored from her left to her right side.
fn mirrored(q: Quat) -> Quat {
    Quat::from_xyzw(q.x, -q.y, -q.z, q.w)
}

impl Posture {
    /// The same, elsewhere.
    pub(super) fn moved(&self, way: Vec3) -> Self {
        let feet = self.feet.map(|foot| Foot { ankle: foot.ankle + way, ..foot });
        Self { hips: self.hips + way, feet, ..*self }
    }

    /// Rotation of each bone against its parent.
    pub(super) fn rotations(&self, skeleton: &Skeleton) -> Vec<Quat> {
        let mut pose = vec![Quat::IDENTITY; skeleton.bones.len()];
        pose[skeleton.find("hips")] = self.pelvis;
        let mut share_out = |delta: Quat, shares: &[(&str, f32)]| {
            for (bone, share) in shares {
                pose[skeleton.find(bone)] = Quat::IDENTITY.slerp(delta, *share);
            }
        };
        share_out(self.pelvis.inverse() * self.chest, &SPINE);
        share_out(self.chest.inverse() * self.head, &NECK);
        for (i, side) in ["left", "right"].into_iter().enumerate() {
            let mut set = |name: &str, q: Quat| {
                pose[skeleton.find(&format!("{side}{name}"))] = (if i == 0 { q } else { mirrored(q) }).normalize();
            };
            arm(self.arms[i], &mut set);
        }
        for (i, side) in ["left", "right"].into_iter().enumerate() {
            self.leg(skeleton, side, self.feet[i], &mut pose);
        }
        pose
    }

    /// Thigh, shank and foot, so that the ankle comes to its place.
    fn leg(&self, skeleton: &Skeleton, side: &str, foot: Foot, pose: &mut [Quat]) {
        let sign = if side == "left" { 1.0 } else { -1.0 };
        let bones = ["UpperLeg", "LowerLeg", "Foot", "Toes"].map(|name| skeleton.find(&format!("{side}{name}")));
        let [hip, knee, ankle, _] = bones.map(|b| skeleton.bones[b].position);
        let (thigh, shank) = (knee - hip, ankle - knee);
        let (a, b) = (thigh.length(), shank.length());
        let joint = self.hips + self.pelvis * (hip - skeleton.place("hips"));
        let goal = foot.ankle * Vec3::new(sign, 1.0, 1.0);
        let way = (goal - joint).normalize();
        let reach = joint.distance(goal).clamp((a - b).abs() + 0.01, a + b - 1e-4);
        // Corner at the hip of the triangle of thigh, shank and reach.
        let corner = ((a * a + reach * reach - b * b) / (2.0 * a * reach)).clamp(-1.0, 1.0).acos();
        let forward = turn(sign * foot.knee, 0.0, 0.0) * Vec3::Z;
        let axis = forward.cross(way).normalize();
        let thigh_way = Quat::from_axis_angle(axis, -corner) * way;
        let shank_way = (way * reach - thigh_way * a).normalize();
        let thigh_turn = frame(thigh_way, axis) * frame(thigh / a, Vec3::X).inverse();
        let shank_turn = frame(shank_way, axis) * frame(shank / b, Vec3::X).inverse();
        let foot_turn = turn(sign * foot.out, foot.pitch, 0.0);
        let toes_turn = turn(sign * foot.out, foot.toes, 0.0);
        let mut above = self.pelvis;
        for (bone, world) in bones.into_iter().zip([thigh_turn, shank_turn, foot_turn, toes_turn]) {
            pose[bone] = (above.inverse() * world).normalize();
            above = world;
        }
    }
}

/// Rotation that takes -Y to `down` and +X as near as can be to `side`.
fn frame(down: Vec3, side: Vec3) -> Quat {
    let up = -down;
    let x = (side - up * side.dot(up)).normalize();
    Quat::from_mat3(&glam::Mat3::from_cols(x, up, x.cross(up)))
}

/// Sets the bones of the left arm.
fn arm(arm: Arm, set: &mut impl FnMut(&str, Quat)) {
    let about = |axis: Vec3, degrees: f32| Quat::from_axis_angle(axis, degrees.to_radians());
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    let blade = about(y, -arm.protract) * about(z, arm.raise);
    set("Shoulder", blade);
    // Angles of the upper arm are those against the chest, whatever the shoulder blade does.
    let upper = about(x, -arm.swing) * about(z, arm.abduct - 90.0) * about(x, arm.twist);
    set("UpperArm", blade.inverse() * upper);
    // Half of the forearm's turn at each end, so that neither joint wrings.
    set("LowerArm", about(y, -arm.elbow) * about(x, arm.pronate * 0.5));
    set("Hand", about(x, arm.pronate * 0.5) * about(y, arm.deviate) * about(z, -arm.flex));
    for (finger, share, side) in FINGERS {
        for (joint, degrees) in CURL {
            // A fist bends all fingers alike.
            let even = mix(share, 1.0, ((arm.curl - 1.0) / 3.0).clamp(0.0, 1.0));
            let bend = about(z, -degrees * even * arm.curl);
            let apart = if joint == "Proximal" {
                about(y, -side * arm.spread)
            } else {
                Quat::IDENTITY
            };
            set(&format!("{finger}{joint}"), apart * bend);
        }
    }
    let thumb = arm.curl.min(2.5);
    set("ThumbMetacarpal", about(y, 8.0 * thumb) * about(z, -6.0 * thumb));
    set("ThumbProximal", about(y, 7.0 * thumb));
    set("ThumbDistal", about(y, 9.0 * thumb));
}
