//! The pleated skirt with its belt, on chains that swing.

use std::f32::consts::{PI, TAU};

use glam::{Vec2, Vec3};

use crate::body::shape::torso;
use crate::loft::{grid, ring};
use crate::mesh::Part;
use crate::model::{Model, Spring};
use crate::picture::smoothstep;
use crate::skeleton::{Skeleton, Weights, blend};

/// Box pleats round the skirt.
pub(super) const PLEATS: usize = 16;
const TOP: f32 = 0.968;
const HEM: f32 = 0.692;
/// Rows from the waist to the hem.
const ROWS: usize = 8;
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

/// Corners of a box pleat: angle in pleats, depth of the fold, drop of the hem, u within the pleat. The face lies outside,
/// the gap between two faces behind it.
const CORNERS: [[f32; 4]; 5] = [
    [0.0, 0.0, 0.0095, 0.0],
    [0.41, 0.12, 0.004, 0.41],
    [0.82, 0.0, 0.0095, 0.82],
    [0.86, 1.0, -0.011, 0.86],
    [0.96, 1.0, -0.011, 0.96],
];

/// Angle of a corner of pleat `k`: a face lies in front.
fn corner_angle(k: usize, at: f32) -> f32 {
    -PI + (k as f32 + at - 0.41 + 0.5 * (PLEATS % 2) as f32) * TAU / PLEATS as f32
}

/// The skirt, outside and inside.
pub(super) fn build(model: &mut Model) -> Part {
    let bones = chains(model);
    let skeleton = &model.skeleton;
    let mut part = Part::new("Skirt", "Skirt");
    let weight = |p: Vec3| weights(skeleton, &bones, p);
    let height = |r: usize| TOP + (HEM - TOP) * (r as f32 / (ROWS - 1) as f32).powf(1.05);
    let row = |y: f32, inside: f32| -> Vec<Vec3> {
        let t = (TOP - y) / (TOP - HEM);
        // Sewn down over the hips, free below.
        let depth = 0.0012 + 0.0225 * smoothstep(0.05, 0.95, t);
        let place = |k: usize, [at, fold, drop, _]: [f32; 4]| {
            // Inside no cloth lies in folds, so that none comes through those outside.
            let fold = if inside > 0.0 { 1.08 } else { fold };
            // Above, the faces meet.
            let at = at + (1.0 - at) * (at / 0.82).min(1.0).powi(3) * 0.8 * smoothstep(0.42, 0.06, t);
            surface(corner_angle(k, at), y - drop * smoothstep(0.75, 1.0, t), -fold * depth - inside)
        };
        (0..PLEATS).flat_map(|k| CORNERS.map(|corner| place(k, corner))).collect()
    };
    let per_row = PLEATS * CORNERS.len();
    let uv = |r: f32, c: f32| {
        let i = (c * per_row as f32).round() as usize;
        let (k, corner) = (i / CORNERS.len(), i % CORNERS.len());
        Vec2::new((k as f32 + CORNERS[corner][3]) / PLEATS as f32, 0.01 + 0.93 * r)
    };
    // Outside, then under the hem, then up inside.
    let outside: Vec<Vec<Vec3>> = (0..ROWS).map(|r| row(height(r), 0.0)).collect();
    grid(&mut part, &outside, true, uv, weight);
    let outer = part.vertices.len();
    let inside: Vec<Vec<Vec3>> = [HEM + 0.0002, HEM + 0.002, 0.76, 0.84]
        .iter()
        .enumerate()
        .map(|(i, y)| row(*y, if i == 0 { 0.0 } else { 0.0032 }))
        .collect();
    grid(&mut part, &inside, true, |r, c| Vec2::new(uv(0.0, c).x, 0.955 + 0.04 * r), weight);
    part.smooth_normals();
    press(&mut part, outer);
    part
}

/// Normals of pressed cloth: those of a face hardly turn over its width, so that light steps from pleat to pleat.
fn press(part: &mut Part, outer: usize) {
    let columns = PLEATS * CORNERS.len() + 1;
    for i in 0..outer {
        let (k, corner) = ((i % columns) / CORNERS.len() % PLEATS, i % columns % CORNERS.len());
        if corner < 3 {
            let v = &mut part.vertices[i];
            let middle = corner_angle(k, CORNERS[1][0]);
            let own = v.position.x.atan2(v.position.z);
            let turn = (own - middle + 3.0 * PI).rem_euclid(TAU) - PI;
            let (s, c) = (middle + 0.55 * turn).sin_cos();
            v.normal = Vec3::new(s, 0.26, c).normalize();
        }
    }
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
