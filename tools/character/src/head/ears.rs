//! The ears: closed shells with a rim and a hollow, set into the side of the head.

use std::f32::consts::TAU;

use glam::{Quat, Vec2, Vec3};

use super::shape::EAR;
use crate::mesh::Part;
use crate::skeleton::Skeleton;

/// Steps round the ear and rings from the head over the rim into the hollow.
const STEPS: u32 = 24;
/// Distance from the middle as a share of the outline, and height over the side of the head, metres: the back, the helix,
/// the groove inside it, the inner fold, the hollow.
const RINGS: &[[f32; 2]] = &[
    [0.6, -0.012],
    [0.84, 0.0],
    [1.0, 0.0078],
    [0.98, 0.0122],
    [0.88, 0.013],
    [0.8, 0.0112],
    [0.72, 0.0086],
    [0.6, 0.0104],
    [0.48, 0.0104],
    [0.34, 0.0066],
    [0.18, 0.0056],
];

/// The left ear.
fn left(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Face", "Face");
    let weights = skeleton.only("head");
    // The ear stands out to the back and leans a little.
    let turn = Quat::from_rotation_y(0.26) * Quat::from_rotation_x(-0.16) * Quat::from_rotation_z(-0.12);
    let middle = EAR + Vec3::new(-0.0075, 0.0, -0.002);
    let place = |angle: f32, share: f32, height: f32| {
        let (s, c) = angle.sin_cos();
        // Wide above, a narrow lobe that leans to the cheek; forward is +Z.
        let below = (-s).max(0.0);
        let wide = 0.0138 + 0.0036 * s;
        let tall = 0.0262 - 0.001 * below;
        let lobe = 0.0025 * below * below;
        // Seen from the front it is round above, and its lobe lies against the head.
        let round = (s * share).abs().powi(4) * if s < 0.0 { 0.9 } else { 0.65 };
        let height = height - (height + 0.002).max(0.0) * round - (height - 0.002).max(0.0) * 0.3 * below;
        let flat = Vec3::new(height, s * tall * share, c * wide * share + lobe * share);
        // The front edge lies against the cheek.
        middle + turn * (flat - Vec3::X * 0.006 * (c * share).max(0.0))
    };
    for [share, height] in RINGS {
        for i in 0..STEPS {
            let angle = i as f32 / STEPS as f32 * TAU;
            let uv = Vec2::new(0.86 + 0.05 * angle.cos() * share, 0.9 - 0.08 * angle.sin() * share);
            part.vertex(place(angle, *share, *height), uv, weights);
        }
    }
    for r in 0..RINGS.len() as u32 - 1 {
        for i in 0..STEPS {
            let next = (i + 1) % STEPS;
            let (a, b) = (r * STEPS, (r + 1) * STEPS);
            part.quad(a + i, b + i, b + next, a + next);
        }
    }
    let inner: Vec<u32> = (0..STEPS).rev().map(|i| (RINGS.len() as u32 - 1) * STEPS + i).collect();
    part.cap(&inner, Vec2::new(0.86, 0.9), weights);
    let outer: Vec<u32> = (0..STEPS).collect();
    part.cap(&outer, Vec2::new(0.86, 0.81), weights);
    part
}

/// Both ears.
pub(super) fn build(skeleton: &Skeleton) -> Part {
    let mut ears = left(skeleton);
    let volume: f32 = ears
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|i| ears.vertices[i as usize].position - EAR);
            a.dot(b.cross(c))
        })
        .sum();
    if volume < 0.0 {
        ears.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    ears.smooth_normals();
    let mut right = ears.mirrored(skeleton);
    right.vertices.iter_mut().for_each(|v| v.uv.x = 1.0 - v.uv.x);
    ears.append(&right);
    ears
}
