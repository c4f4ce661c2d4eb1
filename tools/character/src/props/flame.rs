//! The flame over her left palm: crossing cards, shrunk into the hand until the expression `flame` lights it.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use crate::mesh::Part;
use crate::model::Expression;
use crate::skeleton::Skeleton;

/// Where it burns: over the palm, which looks down in the T-pose.
const FOOT: Vec3 = Vec3::new(0.6, 1.188, -0.006);
/// Height and half width, metres.
const HEIGHT: f32 = 0.15;
const HALF: f32 = 0.05;
/// Size at rest, inside the palm.
const SHRUNK: f32 = 0.02;

/// Cards through one axis.
pub(super) fn build(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Flame", "Accessory_Flame");
    let bone = skeleton.only("leftHand");
    for card in 0..3 {
        let (s, c) = (card as f32 * PI / 3.0).sin_cos();
        let across = Vec3::new(s, 0.0, c);
        let first = part.vertices.len() as u32;
        for r in 0..2 {
            for k in 0..3 {
                let (x, up) = (k as f32 - 1.0, 1.0 - r as f32);
                let full = FOOT + across * x * HALF - Vec3::Y * HEIGHT * (up * 1.08 - 0.08);
                let rest = FOOT + Vec3::Y * 0.024 + (full - FOOT) * SHRUNK;
                let i = part.vertex(rest, Vec2::new(0.5 + 0.5 * x, 1.0 - up), bone);
                part.offset("flame", i, full - rest);
            }
        }
        part.quads(first, 2, 3, false);
    }
    part.smooth_normals();
    part
}

/// The expression that lights it.
pub(super) fn expression() -> Expression {
    Expression { name: "flame", preset: false, morphs: vec![("flame", 1.0)], ..Expression::default() }
}
