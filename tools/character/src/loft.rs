//! Lofting: grids of vertices from closed or open cross-sections.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use crate::mesh::Part;
use crate::skeleton::Weights;

/// Adds rows of points as a grid of quads and returns the index of the first vertex. Outside is where a row runs to the
/// right and the next row lies below it. `uv` takes row and column as 0..1; on a closed grid the first column is repeated
/// at u = 1.
pub fn grid(
    part: &mut Part,
    rows: &[Vec<Vec3>],
    closed: bool,
    uv: impl Fn(f32, f32) -> Vec2,
    weights: impl Fn(Vec3) -> Weights,
) -> u32 {
    let first = part.vertices.len() as u32;
    let columns = rows[0].len() + usize::from(closed);
    for (r, row) in rows.iter().enumerate() {
        for c in 0..columns {
            let p = row[c % row.len()];
            let at = uv(r as f32 / (rows.len() - 1) as f32, c as f32 / (columns - 1) as f32);
            part.vertex(p, at, weights(p));
        }
    }
    part.quads(first, rows.len() as u32, columns as u32, false);
    first
}

/// Indices of the first or the last row of a grid with this many columns, for [`Part::cap`].
#[must_use]
pub fn row(first: u32, columns: u32, row: u32, is_first: bool) -> Vec<u32> {
    let start = first + row * columns;
    // The repeated column is left out.
    let ring = start..start + columns - 1;
    if is_first { ring.collect() } else { ring.rev().collect() }
}

/// Points of an upright ring: from the back over her right side to the front and on. `front` and `back` are depths from
/// the centre.
#[must_use]
pub fn ring(center: Vec3, half: f32, front: f32, back: f32, columns: usize) -> Vec<Vec3> {
    (0..columns)
        .map(|i| {
            let (s, c) = turn(i, columns);
            center + Vec3::new(-s * half, 0.0, if c > 0.0 { -c * back } else { -c * front })
        })
        .collect()
}

/// Sine and cosine of a step of the full turn, exact at the quarters, so that mirrored vertices mirror.
#[must_use]
pub fn turn(i: usize, columns: usize) -> (f32, f32) {
    let i = i % columns;
    let quarter = columns / 4;
    if columns.is_multiple_of(4) {
        // One quarter is computed; the others repeat it with other signs.
        let (q, k) = (i / quarter, i % quarter);
        let sine = |k: usize| {
            if k == 0 {
                0.0
            } else if k == quarter {
                1.0
            } else {
                (k as f32 / columns as f32 * TAU).sin()
            }
        };
        let (s, c) = (sine(k), sine(quarter - k));
        return [(s, c), (c, -s), (-s, -c), (-c, s)][q];
    }
    (i as f32 / columns as f32 * TAU).sin_cos()
}

/// Points of a ring round an axis: `right` and `up` span its plane. It runs from `up` to `right`;
/// rows that advance along `right` × `up` face outwards.
#[must_use]
pub fn ring_in(center: Vec3, right: Vec3, up: Vec3, columns: usize) -> Vec<Vec3> {
    (0..columns)
        .map(|i| {
            let (s, c) = turn(i, columns);
            center + right * s + up * c
        })
        .collect()
}
