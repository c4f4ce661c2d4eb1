//! Shapes that swinging joints stay out of, or in (`VRMC_springBone`, `VRMC_springBone_extended_collider`).

use glam::Vec3;

use super::places::Place;
use super::rotation::{dot, length, turn};
use crate::scene::ColliderShape;

/// How deep a joint is in a shape: the direction out of it, and the distance to its surface, negative within. `None` where no
/// direction leads out.
pub(crate) fn distance(shape: &ColliderShape, node: &Place, joint: Vec3, hit_radius: f32) -> Option<(Vec3, f32)> {
    let from = |p: Vec3| Vec3::new(joint.x - p.x, joint.y - p.y, joint.z - p.z);
    match *shape {
        ColliderShape::Sphere { offset, radius, inside } => round(from(node.point(offset)), radius, hit_radius, inside),
        ColliderShape::Capsule { offset, tail, radius, inside } => {
            let (start, end) = (node.point(offset), node.point(tail));
            let along = Vec3::new(end.x - start.x, end.y - start.y, end.z - start.z);
            let delta = from(start);
            let square = dot(along, along);
            let share = if square > 0.0 {
                (dot(delta, along) / square).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let delta = Vec3::new(delta.x - along.x * share, delta.y - along.y * share, delta.z - along.z * share);
            round(delta, radius, hit_radius, inside)
        }
        ColliderShape::Plane { offset, normal } => {
            let normal = turn(node.rotation, normal);
            Some((normal, dot(from(node.point(offset)), normal) - hit_radius))
        }
    }
}

fn round(delta: Vec3, radius: f32, hit_radius: f32, inside: bool) -> Option<(Vec3, f32)> {
    let from_middle = length(delta);
    if !(from_middle > 0.0 && from_middle < f32::MAX) {
        return None;
    }
    let out = Vec3::new(delta.x / from_middle, delta.y / from_middle, delta.z / from_middle);
    Some(if inside {
        (Vec3::new(-out.x, -out.y, -out.z), radius - hit_radius - from_middle)
    } else {
        (out, from_middle - radius - hit_radius)
    })
}
