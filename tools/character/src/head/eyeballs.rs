//! The second set of eyes: spheres with cornea, iris disc and sclera, for physically shaded eyes. They rest shrunk inside
//! the skull; the morph `eyeballs` brings them forth while the plane eyes go back.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use crate::mesh::Part;
use crate::skeleton::{Skeleton, Weights};

/// Middle of the left eyeball, and its radius. An anime eye is no ball: this one is as wide as the opening asks.
const MIDDLE: Vec3 = Vec3::new(0.0365, 1.4115, 0.0418);
const RADIUS: f32 = 0.0255;
/// Angle of the iris' edge (limbus) seen from the middle of the ball.
const LIMBUS: f32 = 0.5;
/// Depth of the iris disc behind the limbus plane, and height of the cornea above the ball, shares of the radius.
const IRIS_BACK: f32 = 0.06;
const CORNEA_RISE: f32 = 0.1;
/// Size at rest.
const SHRUNK: f32 = 0.05;
const STEPS: u32 = 24;

/// A surface of revolution about the gaze: rings of (angle from the gaze or radius, height), shares of the radius.
fn lathe(name: &str, material: &'static str, skeleton: &Skeleton, rings: &[[f32; 2]]) -> Part {
    let mut part = Part::new(name, material);
    let weights: Weights = skeleton.only("leftEye");
    let tip = rings[0][1];
    part.vertex(MIDDLE + Vec3::Z * tip * RADIUS, Vec2::splat(0.5), weights);
    let widest = rings.iter().map(|r| r[0]).fold(0.0, f32::max);
    // The texture spans the whole surface, which may go on round the back.
    let full = if rings.iter().any(|r| r[1] < 0.0) {
        2.0 * widest
    } else {
        widest
    };
    for [radius, height] in &rings[1..] {
        for s in 0..STEPS {
            let d = Vec2::from_angle(s as f32 / STEPS as f32 * TAU);
            let p = MIDDLE + Vec3::new(d.x * radius, d.y * radius, *height) * RADIUS;
            let spread = if *height < 0.0 { 2.0 * widest - radius } else { *radius } / full;
            part.vertex(p, Vec2::new(0.5 + d.x * spread * 0.49, 0.5 - d.y * spread * 0.49), weights);
        }
    }
    for s in 0..STEPS {
        let next = (s + 1) % STEPS;
        part.triangles.push([0, 1 + s, 1 + next]);
        for r in 0..rings.len() as u32 - 2 {
            let (a, b) = (1 + r * STEPS, 1 + (r + 1) * STEPS);
            part.quad(a + s, b + s, b + next, a + next);
        }
    }
    part.smooth_normals();
    let full: Vec<Vec3> = part.vertices.iter().map(|v| v.position).collect();
    for (i, p) in full.iter().enumerate() {
        let rest = MIDDLE - Vec3::Z * 0.03 + (*p - MIDDLE) * SHRUNK;
        part.vertices[i].position = rest;
        part.offset("eyeballs", i as u32, *p - rest);
    }
    let right = part.mirrored(skeleton);
    part.append(&right);
    part
}

/// Cornea, iris and sclera.
pub(super) fn build(skeleton: &Skeleton) -> Vec<Part> {
    let on_ball = |angle: f32| [angle.sin(), angle.cos()];
    let (edge, plane) = LIMBUS.sin_cos();
    // The sclera is open at the iris and closed at the back, where nobody looks.
    let mut sclera: Vec<[f32; 2]> =
        (0..=12).map(|i| on_ball(LIMBUS + (PI * 0.62 - LIMBUS) * i as f32 / 12.0)).collect();
    // A well behind the iris.
    let floor = plane - IRIS_BACK * 2.0;
    sclera.splice(0..0, [[0.0, floor], [edge * 0.99, floor]]);
    let iris: Vec<[f32; 2]> = (0..=5)
        .map(|i| {
            let t = i as f32 / 5.0;
            [edge * t, plane - IRIS_BACK * (1.0 - 0.5 * t * t)]
        })
        .collect();
    let cornea: Vec<[f32; 2]> = (0..=7)
        .map(|i| {
            let t = i as f32 / 7.0;
            let angle = LIMBUS * 1.12 * t;
            let rise = 1.0 + 0.004 + CORNEA_RISE * (1.0 - t * t).powi(2);
            [angle.sin() * rise, angle.cos() * rise]
        })
        .collect();
    vec![
        lathe("EyeballSclera", "EyeballSclera", skeleton, &sclera),
        lathe("EyeballIris", "EyeballIris", skeleton, &iris),
        lathe("EyeballCornea", "EyeballCornea", skeleton, &cornea),
    ]
}
