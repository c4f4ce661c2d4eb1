//! The jacket: torso and sleeves as one surface, open in front, with a lining; and the blouse under it.

use glam::{Vec2, Vec3};

use super::{sleeve, trim};
use crate::body::shape::torso;
use crate::body::weights;
use crate::loft::{grid, ring};
use crate::mesh::Part;
use crate::picture::smoothstep;
use crate::skeleton::Skeleton;

/// Heights of the jacket's rows, from the neck down.
const HEIGHTS: &[f32] =
    &[1.254, 1.246, 1.236, 1.222, 1.205, 1.186, 1.166, 1.146, 1.126, 1.105, 1.08, 1.05, 1.02, 0.992, 0.97, 0.95, 0.936];
/// Columns from the middle of the back to the front edge.
pub(super) const COLUMNS: usize = 20;
/// The armhole: first and last row, first and last column.
const HOLE: [usize; 4] = [1, 7, 6, 14];
/// Distance over the skin.
pub(super) const OUT: f32 = 0.0085;

/// Half angle of the front opening at height `y`, radians from straight ahead.
fn opening(y: f32) -> f32 {
    0.46 + 0.12 * smoothstep(1.12, 0.94, y) + 0.15 * smoothstep(1.16, 1.25, y)
}

/// Point of the left half: `column` 0 at the back .. 1 at the front edge.
pub(super) fn body_point(y: f32, column: f32, out: f32) -> Vec3 {
    let [half, front, back] = torso(y);
    // Over the waist the cloth stands off; the hem flares.
    let loose = 0.006 * smoothstep(1.08, 1.0, y) + 0.014 * smoothstep(0.985, 0.936, y);
    let angle = (std::f32::consts::PI - opening(y)) * column;
    let (s, c) = angle.sin_cos();
    let deep = if c > 0.0 { back } else { front };
    // Shoulder blades and bust are fuller than an ellipse.
    let square = |v: f32| v.signum() * v.abs().powf(0.9);
    let middle = -0.006 * smoothstep(1.1, 1.25, y);
    Vec3::new(square(s) * (half + out + loose), y, middle - square(c) * (deep + out + loose))
}

fn edge_column(c: usize) -> f32 {
    c as f32 / (COLUMNS - 1) as f32
}

fn in_hole(r: usize, c: usize) -> bool {
    (HOLE[0]..HOLE[1]).contains(&r) && (HOLE[2]..HOLE[3]).contains(&c)
}

/// Step into the hole from one of its ends.
fn corner(at: usize, start: usize, end: usize) -> Option<isize> {
    match at {
        _ if at == start => Some(1),
        _ if at == end => Some(-1),
        _ => None,
    }
}

/// The loop of the armhole: over the top to the front, down, back below, up; with row and column.
pub(super) fn armhole() -> Vec<(usize, usize)> {
    let [top, bottom, back, front] = HOLE;
    let mut loop_ = Vec::new();
    loop_.extend((back..front).map(|c| (top, c)));
    loop_.extend((top..bottom).map(|r| (r, front)));
    loop_.extend((back + 1..=front).rev().map(|c| (bottom, c)));
    loop_.extend((top + 1..=bottom).rev().map(|r| (r, back)));
    loop_
}

/// Texture of the jacket: torso in the left two thirds, sleeve in the right one.
fn body_uv(r: usize, c: usize) -> Vec2 {
    let down = (HEIGHTS[0] - HEIGHTS[r]) / (HEIGHTS[0] - HEIGHTS[HEIGHTS.len() - 1]);
    Vec2::new(0.02 + 0.6 * edge_column(c), 0.02 + 0.96 * down)
}

/// The left half: outside in `Jacket`, inside in `Jacket_Lining`.
pub(super) fn left(skeleton: &Skeleton) -> [Part; 2] {
    let mut jacket = Part::new("Jacket", "Jacket");
    let bone = |p: Vec3| weights::torso(skeleton, p);
    let index = |r: usize, c: usize| (r * COLUMNS + c) as u32;
    for (r, y) in HEIGHTS.iter().enumerate() {
        for c in 0..COLUMNS {
            let mut p = body_point(*y, edge_column(c), OUT);
            // The armhole has no corners.
            if let [Some(down), Some(on)] = [corner(r, HOLE[0], HOLE[1]), corner(c, HOLE[2], HOLE[3])] {
                let y = y + 0.4 * (HEIGHTS[r.wrapping_add_signed(down)] - y);
                p = body_point(y, edge_column(c) + 0.4 * on as f32 / (COLUMNS - 1) as f32, OUT);
            }
            if c == 0 {
                p.x = 0.0;
            }
            jacket.vertex(p, body_uv(r, c), bone(p));
        }
    }
    for r in 0..HEIGHTS.len() - 1 {
        for c in 0..COLUMNS - 1 {
            if !in_hole(r, c) {
                // On her left half a row runs from the back to the front: to the left, seen from outside.
                jacket.quad(index(r, c + 1), index(r + 1, c + 1), index(r + 1, c), index(r, c));
            }
        }
    }
    sleeve::add(&mut jacket, skeleton);

    let rows = HEIGHTS.len();
    let mut edge: Vec<(usize, usize)> = (0..COLUMNS - 1).map(|c| (rows - 1, c)).collect();
    edge.extend((0..rows).rev().map(|r| (r, COLUMNS - 1)));
    let line: Vec<Vec3> = edge.iter().map(|(r, c)| jacket.vertices[index(*r, *c) as usize].position).collect();
    trim::piping(&mut jacket, skeleton, &line, 0.0022);
    trim::lapel(&mut jacket, skeleton);
    let lining = lining(&jacket, skeleton, &edge);
    [jacket, lining]
}

/// Point of the lining: deeper at the armhole, where a lowered arm dents the cloth.
fn lining_point(r: usize, c: usize) -> Vec3 {
    let y = HEIGHTS[r].clamp(HEIGHTS[HEIGHTS.len() - 1] + 0.0015, HEIGHTS[0] - 0.001);
    let middle = 0.5 * (HOLE[2] + HOLE[3]) as f32;
    let dent = smoothstep(8.0, 4.0, (c as f32 - middle).abs()) * smoothstep(1.06, 1.11, y) * smoothstep(1.24, 1.2, y);
    let inset = OUT - 0.0034 - 0.046 * dent;
    let p = body_point(y, edge_column(c) * if c == COLUMNS - 1 { 0.994 } else { 1.0 }, inset);
    if c == 0 { p.with_x(0.0) } else { p }
}

/// The lining: a shell inside the torso, joined along hem, front edge and neck. It is closed at the armhole too, so that
/// nobody looks into the sleeve.
fn lining(jacket: &Part, skeleton: &Skeleton, edge: &[(usize, usize)]) -> Part {
    let mut lining = Part::new("JacketLining", "Jacket_Lining");
    let bone = |p: Vec3| weights::torso(skeleton, p);
    let add = |lining: &mut Part, r: usize, c: usize| {
        let p = lining_point(r, c);
        lining.vertex(p, body_uv(r, c), bone(p));
    };
    // Coarser than the outside.
    let rows: Vec<usize> = (0..HEIGHTS.len()).filter(|r| r % 2 == 0).collect();
    let columns: Vec<usize> = (0..COLUMNS).filter(|c| c % 2 == 0 || c + 1 == COLUMNS).collect();
    for r in &rows {
        for c in &columns {
            add(&mut lining, *r, *c);
        }
    }
    lining.quads(0, rows.len() as u32, columns.len() as u32, false);
    // Rim: outer edge to inner edge.
    let base = lining.vertices.len() as u32;
    for (r, c) in edge {
        let outer = jacket.vertices[r * COLUMNS + c];
        lining.vertex(outer.position, outer.uv, outer.weights);
        add(&mut lining, *r, *c);
    }
    for i in 0..edge.len() as u32 - 1 {
        let (a, b) = (base + 2 * i, base + 2 * i + 2);
        lining.quad(a, a + 1, b + 1, b);
    }
    lining
}

/// The blouse: a shell under the jacket with a stand-up collar.
pub(super) fn blouse(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Blouse", "Cloth_Blouse");
    // Height, distance over the skin; the first rows are the collar, turned in at its edge.
    let heights: &[(f32, f32)] = &[
        (1.262, 0.0015),
        (1.2735, 0.003),
        (1.275, 0.0048),
        (1.272, 0.0068),
        (1.258, 0.0072),
        (1.25, 0.0048),
        (1.236, 0.0036),
        (1.22, 0.0036),
        (1.2, 0.0036),
        (1.175, 0.0036),
        (1.15, 0.0036),
        (1.125, 0.0036),
        (1.1, 0.0036),
        (1.07, 0.004),
        (1.035, 0.0045),
        (1.0, 0.005),
        (0.965, 0.004),
        (0.93, 0.003),
    ];
    let rows: Vec<Vec<Vec3>> = heights
        .iter()
        .enumerate()
        .map(|(i, (y, out))| {
            if i < 5 {
                let radius = 0.0345 + 0.003 * smoothstep(1.27, 1.25, *y) + out;
                return ring(Vec3::new(0.0, *y, -0.0232), radius * 1.05, radius, radius, 28)
                    .into_iter()
                    // The collar opens in front.
                    .map(|p| p - Vec3::Y * 0.006 * smoothstep(-0.005, 0.02, p.z))
                    .collect();
            }
            // Narrower than the body under the arms: there the jacket follows them, and nobody looks.
            let [half, front, back] = torso(*y);
            let narrow = 0.048 * smoothstep(1.0, 1.1, *y) * smoothstep(1.245, 1.2, *y);
            ring(Vec3::new(0.0, *y, 0.0), half + out - narrow, front + out, back + out - narrow * 0.4, 28)
        })
        .collect();
    let (top, bottom) = (1.275f32, 0.93f32);
    grid(
        &mut part,
        &rows,
        true,
        |r, c| {
            let i = (r * (heights.len() - 1) as f32).round() as usize;
            let v = if i < 2 {
                0.005 * i as f32
            } else {
                0.02 + (top - heights[i].0) / (top - bottom) * 0.97
            };
            Vec2::new(c, v)
        },
        |p| weights::torso(skeleton, p.with_x(p.x * 0.55)),
    );
    part
}
