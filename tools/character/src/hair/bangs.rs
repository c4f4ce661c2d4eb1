//! Bangs: large clumps whose tips frame the eyes, one lock between the eyes, and the ahoge.

use glam::Vec3;

use super::lock::{Lock, THIN, UNDER};
use super::surface::{Placed, rooted, shell, vary};
use crate::picture::smoothstep;

/// A lock over the forehead: angle at the whorl and at the hairline; x at the brow; tip x and y; half width; thickness; lift;
/// strip.
struct Bang([f32; 2], f32, [f32; 2], f32, f32, f32, usize);

/// From her right to her left.
const LARGE: &[Bang] = &[
    Bang([-50.0, -58.0], -0.083, [-0.0585, 1.382], 0.0175, 0.0075, 0.003, 1),
    Bang([-6.0, -30.0], -0.0455, [-0.027, 1.4305], 0.0285, 0.0085, 0.0055, 0),
    Bang([10.0, -4.0], -0.0105, [0.0055, 1.406], 0.0135, 0.007, 0.0085, 2),
    Bang([16.0, 21.0], 0.0345, [0.0245, 1.4335], 0.0245, 0.0085, 0.006, 1),
    Bang([36.0, 48.0], 0.079, [0.0565, 1.388], 0.0175, 0.0075, 0.0035, 0),
];

/// Forks: which large lock, where they leave it, side, spread, length, half width.
const FORKS: &[(usize, f32, f32, f32, f32, f32)] = &[
    (0, 0.45, -0.8, 0.005, 0.98, 0.011),
    (0, 0.5, 0.8, 0.003, 0.86, 0.007),
    (1, 0.4, -0.85, 0.014, 1.0, 0.0125),
    (1, 0.5, 0.6, 0.002, 1.0, 0.008),
    (2, 0.55, -0.75, 0.006, 0.93, 0.0068),
    (3, 0.4, 0.85, 0.014, 1.0, 0.0115),
    (3, 0.5, -0.6, 0.002, 0.99, 0.0072),
    (4, 0.45, 0.8, 0.005, 0.97, 0.011),
    (4, 0.5, -0.8, 0.003, 0.85, 0.007),
    (1, 0.6, -0.2, -0.004, 1.06, 0.0042),
    (2, 0.6, 0.5, 0.009, 0.98, 0.0042),
    (3, 0.6, 0.25, 0.003, 1.07, 0.004),
];

/// Shorter ones in the gaps.
const LOWER: &[Bang] = &[
    Bang([-30.0, -46.0], -0.062, [-0.0565, 1.434], 0.0185, 0.005, -0.001, UNDER),
    Bang([-12.0, -22.0], -0.031, [-0.0335, 1.4465], 0.0205, 0.005, -0.001, UNDER),
    Bang([0.0, -4.0], -0.006, [-0.0085, 1.4445], 0.0205, 0.005, -0.001, UNDER),
    Bang([14.0, 12.0], 0.0185, [0.0165, 1.4475], 0.0205, 0.005, 0.0, UNDER),
    Bang([26.0, 36.0], 0.053, [0.0485, 1.436], 0.0185, 0.005, -0.001, UNDER),
];

/// Depth before the face at this x, for the brow and for tips.
fn before_face(x: f32, gap: f32) -> f32 {
    0.0868 - 6.4 * x * x + gap
}

fn guide(&Bang([whorl, root], brow, [x, y], width, _, lift, _): &Bang) -> Vec<Vec3> {
    let fall = 1.446 + 0.25 * (y - 1.42);
    // Only large ones reach the whorl.
    let start = if width > 0.015 && lift > 0.0 { 4.0 } else { 16.0 };
    let mut guide: Vec<Vec3> = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]
        .map(|t| start + (77.0 - start) * t)
        .map(|down| rooted(whorl + (root - whorl) * smoothstep(10.0, 66.0, down), down, start, lift))
        .to_vec();
    guide.extend([
        Vec3::new(brow, fall + (1.487 - fall) * 0.35, before_face(brow, 0.0125 + 0.5 * lift)),
        // Out at the brow, in at the tip.
        Vec3::new(brow + (x - brow) * 0.3, fall + (y - fall) * 0.35, before_face(brow, 0.0118 + 0.4 * lift)),
        Vec3::new(x, y, before_face(x, 0.006 - 0.003 * smoothstep(0.045, 0.06, x.abs()))),
    ]);
    guide
}

fn chain(x: f32) -> &'static str {
    match x {
        x if x.abs() < 0.022 => "HairFront_Middle",
        x if x > 0.0 => "HairFront_Left",
        _ => "HairFront_Right",
    }
}

/// All of them.
pub(super) fn build() -> Vec<Placed> {
    let mut locks = Vec::new();
    let lock = |i: usize, bang: &Bang| {
        let Bang(_, brow, [x, _], width, thickness, lift, strip) = *bang;
        Lock {
            guide: guide(bang),
            width,
            thickness,
            root: if width > 0.015 { 0.55 } else { 0.1 },
            belly: if lift > 0.0 { 0.56 } else { 0.7 },
            // The edge that the tip leans to lies lower.
            roll: [0.06 * vary(i as u32, 1), (x - brow) * 8.0],
            strip,
        }
    };
    let large: Vec<Lock> = LARGE.iter().enumerate().map(|(i, b)| lock(i, b)).collect();
    for (large, Bang(_, _, [x, _], ..)) in large.iter().zip(LARGE) {
        locks.push((large.clone(), chain(*x)));
    }
    for &(of, from, side, spread, reach, width) in FORKS {
        locks.push((large[of].fork(from, side, spread, reach, width), chain(LARGE[of].2[0])));
    }
    for (i, bang) in LOWER.iter().enumerate() {
        locks.push((lock(i + 20, bang), chain(bang.2[0])));
    }
    locks.push((ahoge(), ""));
    locks
}

/// Up from the whorl, forwards in an arc.
fn ahoge() -> Lock {
    let root = shell(0.0, 6.0, -0.004) + Vec3::X * 0.004;
    let arc = [
        [0.0, 0.0, 0.0],
        [0.004, 0.0276, 0.002],
        [0.013, 0.0475, 0.0202],
        [0.0252, 0.0485, 0.048],
        [0.0352, 0.034, 0.073],
        [0.0372, 0.0235, 0.082],
    ];
    Lock {
        guide: arc.map(|p| root + Vec3::from_array(p)).to_vec(),
        width: 0.0068,
        thickness: 0.0045,
        root: 0.55,
        belly: 0.4,
        roll: [0.0, 0.6],
        strip: THIN,
    }
}
