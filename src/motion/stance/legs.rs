//! Standing on one leg: hips over it, both feet flat on the ground, the knees where that puts them.

use glam::{Mat3, Quat, Vec3};

use super::rig::Rig;
use crate::motion::Pose;
use crate::motion::places::Place;
use crate::motion::rotation::{about, direction, mul};
use crate::scene::HumanBone;

/// A leg that stands; lengths in lengths of the leg, angles in degrees to the character's left.
struct Leg {
    bones: [HumanBone; 3],
    /// Where its ankle stands, from rest: left, front.
    ankle: [f32; 2],
    foot_yaw: f32,
    knee_yaw: f32,
    /// How far it is stretched at most.
    stretch: f32,
}

/// How far the hips go over the leg that carries.
const SHIFT: f32 = -0.05;

const LEGS: [Leg; 2] = [
    Leg {
        bones: [HumanBone::RightUpperLeg, HumanBone::RightLowerLeg, HumanBone::RightFoot],
        ankle: [0.0, -0.035],
        foot_yaw: -10.0,
        knee_yaw: -4.0,
        stretch: 0.999,
    },
    Leg {
        bones: [HumanBone::LeftUpperLeg, HumanBone::LeftLowerLeg, HumanBone::LeftFoot],
        ankle: [0.02, 0.06],
        foot_yaw: 22.0,
        knee_yaw: -10.0,
        stretch: 0.978,
    },
];

/// Stands a humanoid on its right leg.
pub(super) fn stand(rig: &Rig<'_>, pose: &mut Pose) {
    let nodes = LEGS.each_ref().map(|leg| leg.bones.map(|bone| rig.node(bone)));
    let (Some(hips), [[Some(a), Some(b), Some(c)], [Some(d), Some(e), Some(f)]]) = (rig.node(HumanBone::Hips), nodes)
    else {
        return;
    };
    let nodes = [[a, b, c], [d, e, f]];
    let bones = nodes.map(|[upper, lower, foot]| {
        let [hip, knee, ankle] = [upper, lower, foot].map(|node| rig.rest[node].position);
        [hip.distance(knee), knee.distance(ankle)]
    });
    let length: f32 = bones[0].iter().sum();
    let ankles = [0, 1].map(|i| {
        let [left, front] = LEGS[i].ankle;
        rig.rest[nodes[i][2]].position + Vec3::new(left, 0.0, front) * length
    });
    rig.shift(pose, hips, Vec3::X * SHIFT * length);
    let places = rig.places(pose);
    // As high as both legs reach.
    let drop = [0, 1].map(|i| {
        let hip = places[nodes[i][0]].position;
        let rest = rig.rest[nodes[i][0]].position.distance(rig.rest[nodes[i][2]].position);
        let reach = (bones[i][0] + bones[i][1]) * LEGS[i].stretch;
        let reach = reach.min(rest);
        let flat = (hip - ankles[i]).with_y(0.0).length();
        hip.y - ankles[i].y - (reach * reach - flat * flat).max(0.0).sqrt()
    });
    rig.shift(pose, hips, Vec3::NEG_Y * drop[0].max(drop[1]));
    for i in [0, 1] {
        let places = rig.places(pose);
        let [upper, lower, foot] = nodes[i];
        let yaw = about(Vec3::Y, LEGS[i].knee_yaw.to_radians());
        let hip = places[upper].position;
        let knee = knee(hip, ankles[i], bones[i], yaw * Vec3::Z);
        for (node, next, from, to) in [(upper, lower, hip, knee), (lower, foot, knee, ankles[i])] {
            rig.set_rotation(pose, node, aimed(&rig.rest[node], &rig.rest[next], to - from, yaw * Vec3::Z));
        }
        let yaw = about(Vec3::Y, LEGS[i].foot_yaw.to_radians());
        rig.set_rotation(pose, foot, mul(yaw, rig.rest[foot].rotation));
    }
}

/// Where a knee is that bends to `front`.
fn knee(hip: Vec3, ankle: Vec3, [upper, lower]: [f32; 2], front: Vec3) -> Vec3 {
    let way = ankle - hip;
    let long = way.length().clamp((upper - lower).abs() + 1e-6, upper + lower);
    let along = way.normalize_or(Vec3::NEG_Y);
    let cos = ((upper * upper + long * long - lower * lower) / (2.0 * upper * long).max(1e-12)).clamp(-1.0, 1.0);
    let front = (front - along * front.dot(along)).normalize_or(Vec3::Z);
    hip + (along * cos + front * (1.0 - cos * cos).sqrt()) * upper
}

/// Rotation of a bone that leads this way, its front to `front`; at rest its front is that of the character.
fn aimed(rest: &Place, next: &Place, way: Vec3, front: Vec3) -> Quat {
    let frame = |way: Vec3, front: Vec3| {
        let y = direction(way)?;
        let x = direction(y.cross(front))?;
        Some(Quat::from_mat3(&Mat3::from_cols(x, y, x.cross(y))))
    };
    let frames = frame(next.position - rest.position, Vec3::Z).zip(frame(way, front));
    frames.map_or(rest.rotation, |(at_rest, now)| mul(now * at_rest.inverse(), rest.rotation))
}
