//! The fur of collar and cuffs: a soft core under rows of tufts.

use std::f32::consts::TAU;

use glam::{Vec2, Vec3};

use super::tuft::{self, Tuft};
use crate::body::weights;
use crate::loft::{grid, ring_in};
use crate::mesh::{Part, Vertex};
use crate::picture::hash;
use crate::skeleton::Skeleton;

/// Half of the collar's course, from the middle of the back to the front end on her left, and its radius.
const COURSE: &[([f32; 3], f32)] = &[
    ([0.0, 1.256, -0.094], 0.0265),
    ([0.048, 1.256, -0.086], 0.0268),
    ([0.09, 1.25, -0.056], 0.0275),
    ([0.111, 1.243, -0.012], 0.0275),
    ([0.108, 1.232, 0.034], 0.0262),
    ([0.092, 1.213, 0.072], 0.024),
    ([0.077, 1.186, 0.1], 0.0215),
    ([0.068, 1.152, 0.1165], 0.0185),
    ([0.063, 1.115, 0.1225], 0.015),
];

/// Place and radius at `t` from -1 (her right end) to 1.
fn course(t: f32) -> (Vec3, f32) {
    let last = COURSE.len() - 1;
    let at = t.abs() * last as f32;
    let i = (at as usize).min(last - 1);
    let get = |k: isize| {
        let (p, r) = COURSE[k.unsigned_abs().min(last)];
        (Vec3::new(if k < 0 { -p[0] } else { p[0] }, p[1], p[2]), r)
    };
    let i = i as isize;
    let ((a, _), (b, r0), (c, r1), (d, _)) = (get(i - 1), get(i), get(i + 1), get(i + 2));
    let f = at - i as f32;
    let (f2, f3) = (f * f, f * f * f);
    let p = 0.5 * (2.0 * b + (c - a) * f + (2.0 * a - 5.0 * b + 4.0 * c - d) * f2 + (3.0 * b - a - 3.0 * c + d) * f3);
    (Vec3::new(if t < 0.0 { -p.x } else { p.x }, p.y, p.z), r0 + (r1 - r0) * f)
}

/// Frame of the collar: along it (to her left), away from the neck, up.
fn frame(t: f32) -> (Vec3, Vec3, Vec3) {
    let along = (course((t + 0.02).min(1.0)).0 - course((t - 0.02).max(-1.0)).0).normalize();
    let p = course(t).0;
    let away = Vec3::new(p.x, 0.35 * (p.y - 1.16), p.z + 0.015).normalize();
    let away = (away - along * away.dot(along)).normalize();
    (along, away, along.cross(away))
}

/// Rows of tufts on the collar: angle from away (0) over up (90) inwards; how many, how large, and how they are shifted.
const ROWS: [(f32, u32, f32, f32); 4] =
    [(-44.0, 30, 1.0, 0.0), (8.0, 30, 1.08, 0.5), (62.0, 30, 0.94, 0.0), (122.0, 22, 0.7, 0.5)];

/// The collar: rows of tufts over a core.
pub(super) fn collar(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("FurCollar", "Jacket_Fur");
    const STEPS: usize = 23;
    let place = |s: usize| (2.0 * s as f32 - (STEPS - 1) as f32) / (STEPS - 1) as f32;
    let rows: Vec<Vec<Vec3>> = (0..STEPS)
        .map(|s| {
            let t = place(s);
            let (p, r) = course(t);
            let (_, away, up) = frame(t);
            let close = (1.0 - t.abs().powi(12)).max(0.05).sqrt();
            ring_in(p, up * r * 0.86 * close, away * r * 0.86 * close, 7)
        })
        .collect();
    let first = grid(&mut part, &rows, true, |r, c| Vec2::new(4.0 * r, 0.05 * c), |p| weights::torso(skeleton, p));
    fix_winding(&mut part, first);
    for v in &mut part.vertices {
        v.normal = (v.position - course(nearest(v.position)).0).normalize_or(Vec3::Y);
    }

    for (row, (degrees, count, size, shift)) in ROWS.into_iter().enumerate() {
        for i in 0..count {
            let id = row as u32 * 100 + i;
            let vary = |seed: u32| hash(id, seed, 70 + seed) - 0.5;
            // Mirrored pairs look painted by a ruler, so both halves vary on their own.
            let t = ((i as f32 + 0.5 + shift * 0.5 - 0.125 + 0.4 * vary(6)) / count as f32 * 2.0 - 1.0) * 0.985;
            let (p, r) = course(t);
            let (along, away, up) = frame(t);
            let angle = (degrees + 14.0 * vary(1)).to_radians();
            let out = away * angle.cos() + up * angle.sin();
            let down = away * angle.sin() - up * angle.cos();
            // Downwards and outwards, towards the ends in front.
            let lean = along * (t.signum() * (0.2 + 0.75 * t * t) + 0.7 * vary(2));
            let length = (0.016 + 1.15 * r) * (1.0 + 0.45 * vary(3)) * size;
            let reach = (down * 0.95 + out * 0.18 + lean).normalize() * length;
            let tuft = Tuft {
                root: p + out * r * 0.74 - down * length * 0.34,
                reach,
                out,
                half: (0.0042 + 0.3 * r) * (1.0 + 0.3 * vary(4)) * size.sqrt(),
                bend: 0.16 + 0.16 * vary(5),
                sway: 0.3 * vary(7) + 0.1 * vary(7).signum(),
                column: 0.13 * (id % 7) as f32,
                cones: 3,
            };
            let first = part.vertices.len();
            tuft::add(&mut part, &tuft, weights::torso(skeleton, p));
            soften(&mut part.vertices[first..], p);
        }
    }
    part
}

fn nearest(p: Vec3) -> f32 {
    let t = (0..=80)
        .map(|i| i as f32 / 40.0 - 1.0)
        .min_by(|a, b| course(*a).0.distance_squared(p).total_cmp(&course(*b).0.distance_squared(p)));
    t.unwrap_or(0.0)
}

/// Normals lean to those of the whole form, so that light falls on fur as on one soft body.
fn soften(vertices: &mut [Vertex], axis: Vec3) {
    for v in vertices {
        let whole = (v.position - axis).normalize_or(Vec3::Y);
        v.normal = (v.normal * 0.45 + whole * 0.55).normalize_or(whole);
    }
}

/// Turns the triangles of a closed tube outwards.
fn fix_winding(part: &mut Part, first: u32) {
    let middle = |ring: &[u32; 3]| ring.iter().map(|i| part.vertices[*i as usize].position).sum::<Vec3>() / 3.0;
    let vote: f32 = part
        .triangles
        .iter()
        .filter(|t| t[0] >= first)
        .map(|t| {
            let [a, b, c] = t.map(|i| part.vertices[i as usize].position);
            (b - a).cross(c - a).dot(middle(t) - course(nearest(middle(t))).0)
        })
        .sum();
    if vote < 0.0 {
        part.triangles.iter_mut().filter(|t| t[0] >= first).for_each(|t| t.swap(1, 2));
    }
}

/// The cuff of the left sleeve: a soft ring under two rows of tufts, over which looks lay a coat of short hair.
pub(super) fn cuff(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("FurCuffs", "Jacket_Cuff");
    let center = Vec3::new(0.486, 1.215, -0.0155);
    let (radius, thick) = (0.0268, 0.0098);
    let bone = weights::arm(skeleton, center - Vec3::X * 0.03);
    const AROUND: usize = 28;
    const TUBE: usize = 10;
    // A ring round the wrist; its own section turns about it.
    let rows: Vec<Vec<Vec3>> = (0..=TUBE)
        .map(|k| {
            let (s, c) = ((k % TUBE) as f32 / TUBE as f32 * TAU).sin_cos();
            let reach = radius + thick * 0.8 * c;
            let middle = center + Vec3::X * thick * 1.1 * s;
            ring_in(middle, Vec3::NEG_Z * reach, Vec3::Y * reach, AROUND)
        })
        .collect();
    grid(&mut part, &rows, true, |r, c| Vec2::new(c, 0.06 + 0.04 * (1.0 - (2.0 * r - 1.0).abs())), |_| bone);
    part.smooth_normals();
    let about = |degrees: f32| {
        let (s, c) = degrees.to_radians().sin_cos();
        Vec3::new(0.0, c, s)
    };
    for (row, (count, from, size)) in [(13u32, -0.7f32, 1.0f32), (13, 0.1, 0.92)].into_iter().enumerate() {
        for i in 0..count {
            let id = 500 + row as u32 * 100 + i;
            let vary = |seed: u32| hash(id, seed, 80 + seed) - 0.5;
            let radial = about((i as f32 + 0.5 * row as f32 + 0.4 * vary(1)) * 360.0 / count as f32);
            let axis = center + radial * radius;
            let length = 0.0235 * size * (1.0 + 0.4 * vary(3));
            let out = (radial + Vec3::X * from * 0.5).normalize();
            let sideways = Vec3::X.cross(radial) * (0.5 * vary(2));
            let tuft = Tuft {
                root: axis + radial * thick * 0.42 + Vec3::X * thick * from,
                reach: (Vec3::X + radial * 0.12 + sideways).normalize() * length,
                out,
                half: 0.0072 * size * (1.0 + 0.3 * vary(4)),
                bend: 0.12 + 0.14 * vary(5),
                sway: 0.3 * vary(7) + 0.1 * vary(7).signum(),
                column: 0.13 * (id % 7) as f32,
                cones: 2,
            };
            let first = part.vertices.len();
            tuft::add(&mut part, &tuft, bone);
            soften(&mut part.vertices[first..], axis);
        }
    }
    part
}
