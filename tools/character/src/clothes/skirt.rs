//! The pleated skirt with its belt, on chains that swing.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use crate::body::shape::torso;
use crate::loft::{grid, ring};
use crate::mesh::Part;
use crate::model::{Model, Spring};
use crate::picture::smoothstep;
use crate::skeleton::{Skeleton, Weights, blend};

const PLEATS: usize = 22;
const TOP: f32 = 0.968;
const HEM: f32 = 0.692;
/// Rows from the waist to the hem.
const ROWS: usize = 9;
/// Chains round the hips: name and angle from the front to her left, degrees.
const CHAINS: &[(&str, f32)] = &[
    ("Skirt_Front", 0.0),
    ("SkirtLeft_Front", 45.0),
    ("SkirtLeft_Side", 90.0),
    ("SkirtLeft_Back", 135.0),
    ("Skirt_Back", 180.0),
    ("SkirtRight_Back", -135.0),
    ("SkirtRight_Side", -90.0),
    ("SkirtRight_Front", -45.0),
];
/// Heights of the joints.
const JOINTS: [f32; 3] = [0.905, 0.8, HEM];

/// Point of the skirt's mean surface at height `y`.
fn surface(angle: f32, y: f32, out: f32) -> Vec3 {
    let t = ((TOP - y) / (TOP - HEM)).clamp(0.0, 1.2);
    let [half, front, back] = torso(TOP);
    // A bell: out over the hips, then falling.
    let flare = 0.122 * (0.62 * t + 0.38 * (1.0 - (1.0 - t).powi(3)));
    let (s, c) = angle.sin_cos();
    let deep = if c > 0.0 { front } else { back };
    let grow = 0.0065 + flare + out;
    Vec3::new(s * (half + grow), y, c * (deep + grow * 1.02) - 0.004 * t)
}

/// Adds the bones of the chains and their springs.
fn chains(model: &mut Model) -> Vec<[usize; 2]> {
    let hips = model.skeleton.find("hips");
    CHAINS
        .iter()
        .map(|(name, degrees)| {
            let mut parent = hips;
            let joints: Vec<usize> = JOINTS
                .iter()
                .enumerate()
                .map(|(i, y)| {
                    parent = model.skeleton.add(format!("{name}_{i}"), parent, surface(degrees.to_radians(), *y, 0.0));
                    parent
                })
                .collect();
            model.springs.push(Spring {
                name: (*name).to_owned(),
                joints: joints.clone(),
                // Stiff, so that it keeps its bell at the speed of a run.
                stiffness: [3.6; 2],
                drag: 0.28,
                gravity: 0.25,
                radius: 0.02,
                colliders: vec!["legs"],
            });
            [joints[0], joints[1]]
        })
        .collect()
}

/// Hips at the waist; below, the two nearest chains, and in front the thigh, which lifts the cloth.
fn weights(skeleton: &Skeleton, bones: &[[usize; 2]], p: Vec3) -> Weights {
    let lower = smoothstep(0.84, 0.76, p.y);
    let angle = p.x.atan2(p.z);
    let lap = 0.66 * smoothstep(0.95, 0.8, p.y) * smoothstep(2.3, 0.6, angle.abs());
    let left = smoothstep(-0.045, 0.045, p.x);
    let free = smoothstep(0.945, 0.86, p.y) * (1.0 - lap);
    let mut list =
        vec![(skeleton.find("leftUpperLeg"), lap * left), (skeleton.find("rightUpperLeg"), lap * (1.0 - left))];
    list.push((skeleton.find("hips"), 1.0 - free - lap));
    for ((_, degrees), [a, b]) in CHAINS.iter().zip(bones) {
        let away = (angle - degrees.to_radians() + 3.0 * PI).rem_euclid(TAU) - PI;
        let near = (1.0 - away.abs() / (PI / 4.0)).max(0.0);
        let share = free * near * near * (3.0 - 2.0 * near);
        list.push((*a, share * (1.0 - lower)));
        list.push((*b, share * lower));
    }
    blend(&list)
}

/// The skirt, outside and inside.
pub(super) fn build(model: &mut Model) -> Part {
    let bones = chains(model);
    let skeleton = &model.skeleton;
    let mut part = Part::new("Skirt", "Skirt");
    let weight = |p: Vec3| weights(skeleton, &bones, p);
    let step = TAU / PLEATS as f32;
    // Corners of a pleat: angle in pleats, depth below the outside, u within the pleat.
    const CORNERS: [(f32, f32, f32); 4] = [(0.0, 0.15, 0.0), (0.42, 0.0, 0.36), (0.86, -0.12, 0.68), (0.6, 1.0, 0.88)];
    let height = |r: usize| TOP + (HEM - TOP) * (r as f32 / (ROWS - 1) as f32).powf(1.05);
    let row = |y: f32, inside: f32| -> Vec<Vec3> {
        let t = (TOP - y) / (TOP - HEM);
        let depth = 0.0016 + 0.0165 * smoothstep(0.02, 0.9, t);
        (0..PLEATS)
            .flat_map(|k| {
                CORNERS.map(|(at, fold, _)| {
                    // Half a pleat off, so that a face lies in front.
                    let angle = -PI + (k as f32 + at - 0.43 + 0.5) * step;
                    // The hem waves a little.
                    let dip = 0.004 * smoothstep(0.7, 1.0, t) * (angle * 3.0).cos();
                    // Inside no cloth lies in folds, so that none comes through those outside.
                    let deep = if inside > 0.0 { 1.1 } else { fold };
                    surface(angle, y - dip, -deep * depth - inside)
                })
            })
            .collect()
    };
    let per_row = PLEATS * CORNERS.len();
    let uv = |r: f32, c: f32| {
        let i = (c * per_row as f32).round() as usize;
        let (k, corner) = (i / CORNERS.len(), i % CORNERS.len());
        Vec2::new((k as f32 + CORNERS[corner].2) / PLEATS as f32, 0.01 + 0.93 * r)
    };
    // Outside, then under the hem, then up inside.
    let outside: Vec<Vec<Vec3>> = (0..ROWS).map(|r| row(height(r), 0.0)).collect();
    grid(&mut part, &outside, true, uv, weight);
    let inside: Vec<Vec<Vec3>> = [HEM + 0.0002, HEM + 0.002, 0.76, 0.84]
        .iter()
        .enumerate()
        .map(|(i, y)| row(*y, if i == 0 { 0.0 } else { 0.0032 }))
        .collect();
    grid(&mut part, &inside, true, |r, c| Vec2::new(uv(0.0, c).x, 0.955 + 0.04 * r), weight);
    part
}

/// The belt round the waist.
pub(super) fn belt(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Belt", "Cloth_Belt");
    let rows: Vec<Vec<Vec3>> =
        [(0.973, 0.004), (0.9755, 0.0085), (0.974, 0.0115), (0.952, 0.0185), (0.9505, 0.0165), (0.953, 0.012)]
            .iter()
            .map(|(y, out)| {
                let [half, front, back] = torso(*y);
                ring(Vec3::new(0.0, *y, 0.0), half + out, front + out, back + out, 40)
            })
            .collect();
    let bone = blend(&[(skeleton.find("hips"), 0.75), (skeleton.find("spine"), 0.25)]);
    grid(&mut part, &rows, true, |r, c| Vec2::new(c, r), |_| bone);
    part
}
