//! Boots: shaft and foot, straps with buckles, laces, sole.

use glam::{Vec2, Vec3};

use super::weights;
use crate::loft::{grid, ring_in, row};
use crate::mesh::Part;
use crate::picture::smoothstep;
use crate::skeleton::Skeleton;

const COLUMNS: usize = 20;
/// Upper edge.
const BOOT_TOP: f32 = 0.278;

/// Sections of the left boot: front and back point (y, z), half width.
const BOOT: &[([f32; 2], [f32; 2], f32)] = &[
    ([0.262, 0.031], [0.262, -0.062], 0.0455),
    ([BOOT_TOP, 0.0365], [BOOT_TOP + 0.004, -0.0705], 0.0512),
    ([BOOT_TOP - 0.001, 0.0395], [BOOT_TOP + 0.003, -0.0735], 0.0538),
    ([0.266, 0.0395], [0.268, -0.074], 0.054),
    ([0.262, 0.037], [0.262, -0.0715], 0.052),
    ([0.235, 0.034], [0.235, -0.069], 0.0496),
    ([0.2, 0.029], [0.2, -0.0625], 0.0454),
    ([0.165, 0.0255], [0.165, -0.0545], 0.0412),
    ([0.135, 0.0245], [0.13, -0.053], 0.0385),
    ([0.112, 0.029], [0.098, -0.0565], 0.0372),
    ([0.098, 0.04], [0.07, -0.064], 0.037),
    ([0.086, 0.054], [0.044, -0.0705], 0.0372),
    ([0.076, 0.07], [0.024, -0.0715], 0.0378),
    ([0.068, 0.087], [0.02, -0.045], 0.0395),
    ([0.062, 0.104], [0.02, -0.005], 0.0418),
    ([0.058, 0.12], [0.019, 0.04], 0.0432),
    ([0.0525, 0.135], [0.018, 0.078], 0.0418),
    ([0.044, 0.147], [0.018, 0.108], 0.0355),
    ([0.034, 0.1535], [0.0185, 0.13], 0.0245),
];

/// Point of the left boot: section counted from above, share of the turn from the back over her right side.
fn boot_point(section: f32, turn_share: f32, out: f32) -> Vec3 {
    let i = (section as usize).min(BOOT.len() - 2);
    let f = section - i as f32;
    let mix = |a: f32, b: f32| a + (b - a) * f;
    let (a, b) = (BOOT[i], BOOT[i + 1]);
    let front = Vec3::new(0.0, mix(a.0[0], b.0[0]), mix(a.0[1], b.0[1]));
    let back = Vec3::new(0.0, mix(a.1[0], b.1[0]), mix(a.1[1], b.1[1]));
    let half = mix(a.2, b.2);
    let (s, c) = (turn_share * std::f32::consts::TAU).sin_cos();
    let deep = (back - front) * 0.5;
    let p = (front + back) * 0.5
        + Vec3::X * 0.079
        + Vec3::NEG_X * (half + out) * s
        + deep * (1.0 + out / deep.length()) * c;
    p + toes_out(p)
}

/// Toes point out a little.
fn toes_out(p: Vec3) -> Vec3 {
    Vec3::X * 0.09 * p.z.max(0.0) * smoothstep(0.12, 0.06, p.y)
}

/// The left boot, with straps, laces and sole.
pub(super) fn build(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Boots", "Boots");
    let rows: Vec<Vec<Vec3>> = BOOT
        .iter()
        .map(|(front, back, half)| {
            let (f, b) = (Vec3::new(0.0, front[0], front[1]), Vec3::new(0.0, back[0], back[1]));
            let center = (f + b) * 0.5 + Vec3::X * 0.079;
            // The ring starts at the back and runs over her right side to the front.
            ring_in(center, Vec3::NEG_X * *half, (b - f) * 0.5, COLUMNS).into_iter().map(|p| p + toes_out(p)).collect()
        })
        .collect();
    let mut lengths = vec![0.0f32];
    for (a, b) in BOOT.iter().zip(&BOOT[1..]) {
        let step = ((a.0[0] - b.0[0]).hypot(a.0[1] - b.0[1]) + (a.1[0] - b.1[0]).hypot(a.1[1] - b.1[1])) * 0.5;
        lengths.push(lengths[lengths.len() - 1] + step);
    }
    let total = lengths[lengths.len() - 1];
    let uv = |r: f32, c: f32| {
        let i = (r * (BOOT.len() - 1) as f32).round() as usize;
        Vec2::new(c, 0.01 + 0.8 * lengths[i] / total)
    };
    let first = grid(&mut part, &rows, true, uv, |p| weights::leg(skeleton, p));
    let tip = row(first, COLUMNS as u32 + 1, rows.len() as u32 - 1, false);
    part.cap(&tip, Vec2::new(0.5, 0.815), weights::leg(skeleton, rows[rows.len() - 1][0]));
    straps(&mut part, skeleton);
    laces(&mut part, skeleton);
    sole(&mut part, skeleton);
    part
}

/// Sections of the boot that the straps lie on: below the edge, round the ankle.
const STRAPS: [f32; 2] = [4.9, 8.3];

fn straps(part: &mut Part, skeleton: &Skeleton) {
    for section in STRAPS {
        // Height of a section differs, the straps' does not.
        let wide = 0.0075 / (BOOT[section as usize].0[0] - BOOT[section as usize + 1].0[0]);
        let rows: Vec<Vec<Vec3>> = [(-1.0, -0.001), (-0.9, 0.0024), (0.9, 0.0024), (1.0, -0.001)]
            .iter()
            .map(|(at, out)| {
                (0..COLUMNS).map(|c| boot_point(section + at * wide, c as f32 / COLUMNS as f32, *out)).collect()
            })
            .collect();
        grid(part, &rows, true, |r, c| Vec2::new(0.45 * c, 0.935 + 0.02 * r), |p| weights::leg(skeleton, p));
    }
}

/// Laces that cross over the tongue, each a thin tube.
fn laces(part: &mut Part, skeleton: &Skeleton) {
    const WIRE: f32 = 0.0019;
    for k in 0..5 {
        let (upper, lower) = (5.55 + 1.02 * k as f32, 6.45 + 1.02 * k as f32);
        for side in [-1.0f32, 1.0] {
            let rows: Vec<Vec<Vec3>> = [-1.0f32, -0.45, 0.45, 1.0]
                .iter()
                .map(|s| {
                    // Those from one side lie over those from the other.
                    let high = 0.0006 + if s.abs() < 0.6 { 0.0022 + 0.0005 * side } else { 0.0 };
                    let turn = 0.5 + side * s * 0.058;
                    let at = |s: f32, out: f32| boot_point(upper + (lower - upper) * (0.5 + 0.5 * s), turn, out);
                    let p = at(*s, high);
                    let out = (at(*s, high + 0.01) - p).normalize();
                    let next =
                        boot_point(lower, 0.5 + side * 0.058, high) - boot_point(upper, 0.5 - side * 0.058, high);
                    let along = (next - out * out.dot(next)).normalize();
                    ring_in(p, out.cross(along) * WIRE, out * WIRE, 4)
                })
                .collect();
            grid(part, &rows, true, |r, c| Vec2::new(0.6 + 0.3 * r, 0.935 + 0.02 * c), |p| weights::leg(skeleton, p));
        }
    }
}

/// The sole: outline of the foot, heel block at the back.
fn sole(part: &mut Part, skeleton: &Skeleton) {
    // z, half width, centre x, from heel to toe.
    const OUTLINE: &[[f32; 3]] = &[
        [-0.074, 0.014, 0.079],
        [-0.066, 0.0255, 0.079],
        [-0.045, 0.0335, 0.079],
        [-0.016, 0.035, 0.0795],
        [-0.0125, 0.035, 0.0795],
        [0.03, 0.0378, 0.0818],
        [0.042, 0.0396, 0.0826],
        [0.07, 0.042, 0.0847],
        [0.1, 0.0425, 0.0875],
        [0.13, 0.0365, 0.0905],
        [0.148, 0.0255, 0.092],
        [0.157, 0.012, 0.0928],
    ];
    let outline = |grow: f32| -> Vec<Vec3> {
        let side = |sign: f32| OUTLINE.iter().map(move |[z, half, x]| Vec3::new(x + sign * (half + grow), 0.0, *z));
        side(-1.0).chain(side(1.0).rev()).collect()
    };
    let lift = |p: Vec3, top: bool| {
        // Heel and ball touch the ground, the arch between does not.
        let arch = smoothstep(-0.0155, -0.013, p.z) * smoothstep(0.042, 0.03, p.z);
        p + Vec3::Y
            * if top {
                0.024
            } else {
                0.0125 * arch + 0.003 * smoothstep(0.12, 0.157, p.z)
            }
    };
    let rows: Vec<Vec<Vec3>> = [
        (0.0008, true, 0.001),
        (0.0042, true, -0.003),
        (0.0036, true, -0.008),
        (0.0016, false, 0.002),
        (0.0, false, 0.0),
    ]
    .iter()
    .map(|(grow, top, more)| outline(*grow).into_iter().map(|p| lift(p, *top) + Vec3::Y * *more).collect())
    .collect();
    let columns = OUTLINE.len() as u32 * 2 + 1;
    let first = grid(part, &rows, true, |r, c| Vec2::new(c, 0.86 + 0.06 * r), |p| weights::leg(skeleton, p));
    part.cap(&row(first, columns, 4, false), Vec2::new(0.5, 0.9), weights::leg(skeleton, Vec3::new(0.08, 0.0, 0.02)));
    part.cap(&row(first, columns, 0, true), Vec2::new(0.5, 0.85), weights::leg(skeleton, Vec3::new(0.08, 0.02, 0.02)));
}

/// Buckled straps of the left boot: two bands and their frames.
pub(super) fn buckles(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Buckles", "Metal_Buckle");
    for section in STRAPS {
        // A square frame on the outer side of the leg.
        let at = boot_point(section, 0.73, 0.0034);
        let bone = weights::leg(skeleton, at);
        frame(&mut part, at, Vec3::NEG_Z * 0.0105, Vec3::Y * 0.0105, bone);
    }
    part
}

/// A square frame of round wire about `center`; outside is `right` × `up`.
fn frame(part: &mut Part, center: Vec3, right: Vec3, up: Vec3, bone: crate::skeleton::Weights) {
    const WIRE: f32 = 0.0021;
    let out = right.cross(up).normalize();
    let corners: Vec<Vec3> = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)]
        .iter()
        .flat_map(|(x, y)| {
            // Corners are cut twice, so that they look round.
            let c = center + right * *x + up * *y;
            let (dx, dy) = (right * *x * 0.3, up * *y * 0.3);
            if x * y > 0.0 {
                [c - dx, c - dy]
            } else {
                [c - dy, c - dx]
            }
        })
        .collect();
    let n = corners.len();
    let mut rows: Vec<Vec<Vec3>> = (0..n)
        .map(|i| {
            let away = (corners[i] - center).normalize();
            ring_in(corners[i], away * WIRE, out * WIRE, 6)
        })
        .collect();
    rows.push(rows[0].clone());
    grid(part, &rows, true, Vec2::new, |_| bone);
}
