//! Thighs, stockings, and the shorts under the skirt.

use glam::{Vec2, Vec3};

use super::shape::{leg, torso};
use super::weights;
use crate::loft::{grid, ring, row};
use crate::mesh::Part;
use crate::picture::smoothstep;
use crate::skeleton::Skeleton;

const COLUMNS: usize = 20;
/// Upper edge of the stockings.
const STOCKING_TOP: f32 = 0.634;

/// A ring of the left leg at height `y`, `out` metres above the skin.
fn leg_ring(y: f32, out: f32) -> Vec<Vec3> {
    let [radius, z] = leg(y);
    let radius = radius * 0.94 + out;
    // Axis a little further out at the hip; calves stand back, shins are straight.
    let x = 0.077 + 0.004 * smoothstep(0.5, 0.8, y);
    let calf = 0.006 * (-((y - 0.31) / 0.07).powi(2)).exp();
    let knee = 0.004 * (-((y - 0.455) / 0.03).powi(2)).exp();
    ring(Vec3::new(x, y, z), radius * 0.97, radius + knee - calf * 0.3, radius + calf, COLUMNS)
}

/// The left thigh, from the hip to the stocking.
pub(super) fn thigh(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Skin", "Body_Skin");
    let heights = [0.84, 0.79, 0.745, 0.71, 0.683, 0.665, 0.653, 0.643, 0.634, 0.615];
    let rows: Vec<Vec<Vec3>> = heights
        .iter()
        .map(|y| {
            // The hem presses in; the skin above it swells.
            let swell = 0.0052 * (-((y - 0.65) / 0.014f32).powi(2)).exp();
            leg_ring(*y, swell - 0.0045 * smoothstep(0.642, 0.628, *y))
        })
        .collect();
    let first = grid(&mut part, &rows, true, |r, c| Vec2::new(c, 0.02 + 0.44 * r), |p| weights::leg(skeleton, p));
    let columns = COLUMNS as u32 + 1;
    part.cap(&row(first, columns, 0, true), Vec2::new(0.5, 0.01), weights::leg(skeleton, rows[0][0]));
    part.cap(
        &row(first, columns, rows.len() as u32 - 1, false),
        Vec2::new(0.5, 0.47),
        weights::leg(skeleton, rows[9][0]),
    );
    part
}

/// The left stocking.
pub(super) fn stocking(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Stockings", "Stocking");
    // The band: turned in above, a step below.
    let heights = [
        0.622, STOCKING_TOP, 0.6338, 0.631, 0.609, 0.6062, 0.6055, 0.601, 0.57, 0.54, 0.51, 0.485, 0.465, 0.445, 0.425,
        0.4, 0.37, 0.335, 0.3, 0.26, 0.22,
    ];
    let rows: Vec<Vec<Vec3>> = heights
        .iter()
        .enumerate()
        .map(|(i, y)| {
            let out = match i {
                0 => -0.0022,
                1 => -0.0004,
                2 => 0.0012,
                3 | 4 => 0.0024,
                5 => 0.002,
                _ => 0.0014,
            };
            // It presses into the thigh.
            leg_ring(*y, out - 0.002 * smoothstep(0.59, 0.61, *y))
        })
        .collect();
    let top = heights[1];
    let bottom = heights[heights.len() - 1];
    let uv = |r: f32, c: f32| {
        let i = (r * (heights.len() - 1) as f32).round() as usize;
        Vec2::new(c, ((top - heights[i]) / (top - bottom)).max(-0.002) * 0.98 + 0.01)
    };
    grid(&mut part, &rows, true, uv, |p| weights::leg(skeleton, p));
    part
}

/// Shorts: they close the body under the skirt.
pub(super) fn shorts(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Shorts", "Cloth_Shorts");
    let rows: Vec<Vec<Vec3>> = [0.945, 0.9, 0.86, 0.83, 0.8, 0.775, 0.757]
        .iter()
        .enumerate()
        .map(|(i, y)| {
            let [half, front, back] = torso(*y);
            let close = [1.0, 1.0, 1.0, 1.0, 0.93, 0.72, 0.35][i];
            ring(Vec3::new(0.0, *y, 0.0), (half + 0.002) * close, (front + 0.002) * close, (back + 0.002) * close, 20)
        })
        .collect();
    let first = grid(&mut part, &rows, true, |r, c| Vec2::new(c, r), |p| weights::torso(skeleton, p));
    let hips = skeleton.only("hips");
    part.cap(&row(first, 21, 6, false), Vec2::new(0.5, 1.0), hips);
    part.cap(&row(first, 21, 0, true), Vec2::new(0.5, 0.0), weights::torso(skeleton, rows[0][0]));
    part
}
