//! Back hair: a dark layer inside, large clumps in slow S-curves, middle locks over their borders, thin ones that leave them.

use glam::Vec3;

use super::lock::{INNER, Lock, THIN};
use super::surface::{Placed, hang, rooted, vary};
use crate::picture::{hash, smoothstep};

/// Height where the shell ends and the curtain begins.
const TOP: f32 = 1.425;

/// A course from the whorl down the curtain to `tip`.
struct Fall {
    across: f32,
    tip: f32,
    lift: f32,
    /// How far the tip curls to her left, as a share of the half width of the curtain, and outwards, metres.
    curl: [f32; 2],
    /// Degrees from the whorl where it starts.
    start: f32,
    id: u32,
}

fn guide(fall: &Fall) -> Vec<Vec3> {
    let &Fall { across, tip, lift, curl, start, id } = fall;
    let around = 180.0 - across * 88.0;
    // The equator of the head as seen from the whorl.
    let last = 90.0 + 17.0 * around.to_radians().cos() - 4.0 - 10.0 * around.to_radians().sin().abs();
    let mut guide: Vec<Vec3> =
        [0.0, 0.2, 0.4, 0.6, 0.8, 1.0].map(|t| rooted(around, start + (last - start) * t, start, lift)).to_vec();
    // Beside the ears the curtain turns back: the locks take their time for it.
    let top = TOP - 0.035 * smoothstep(0.6, 1.0, across.abs());
    let steps = (((top - tip) / 0.06).round() as u32).max(4);
    for k in 0..=steps {
        let t = k as f32 / steps as f32;
        let y = top + (tip - top) * t;
        // Neighbours wave together, but for a little.
        let below = TOP - y;
        let free = smoothstep(0.0, 0.26, below);
        let phase = below * 13.5 + 1.3 * across + 0.5 * vary(id, 4);
        let sway = 0.15 * free * phase.sin();
        // Over the collar out, at the waist in.
        let swell = -0.014 * free * (phase * 1.2 + 1.0).sin();
        let end = smoothstep(0.66, 1.0, t).powf(1.5);
        let up = 0.012 * end * (curl[0].abs() * 8.0).min(1.0);
        guide.push(hang(across + sway + curl[0] * end, y + up, lift + swell + curl[1] * end));
    }
    guide
}

fn chain(across: f32) -> &'static str {
    match across {
        a if a > 0.66 => "HairBack_Left2",
        a if a > 0.22 => "HairBack_Left1",
        a if a > -0.22 => "HairBack_Middle",
        a if a > -0.66 => "HairBack_Right1",
        _ => "HairBack_Right2",
    }
}

/// Large clumps: place across, tip, half width, lift, curl.
const LARGE: &[(f32, f32, f32, f32, f32)] = &[
    (-0.98, 1.04, 0.035, 0.0045, -0.28),
    (-0.61, 0.95, 0.039, 0.0065, 0.26),
    (-0.235, 1.01, 0.043, 0.005, -0.22),
    (0.065, 0.925, 0.039, 0.0075, 0.3),
    (0.42, 0.995, 0.041, 0.0055, -0.26),
    (0.75, 0.945, 0.034, 0.007, 0.24),
    (1.03, 1.045, 0.033, 0.0045, 0.3),
];

/// Forks of each: where they leave it, side, spread, length, half width.
const FORKS: &[(f32, f32, f32, f32, f32)] =
    &[(0.52, -0.8, 0.02, 0.9, 0.017), (0.6, 0.75, 0.022, 1.0, 0.0125), (0.66, 0.2, 0.018, 1.05, 0.005)];

/// All of it.
pub(super) fn build() -> Vec<Placed> {
    let mut locks = Vec::new();
    // The inside.
    for i in 0..7u32 {
        let across = (i as f32 / 3.0 - 1.0) * 1.06;
        let fall = Fall {
            across,
            tip: 0.965 + 0.09 * hash(i, 3, 6),
            lift: -0.004,
            curl: [0.1 * vary(i, 8), 0.0],
            start: 25.0,
            id: i,
        };
        let lock = Lock {
            guide: guide(&fall),
            width: 0.034,
            thickness: 0.006,
            root: 0.7,
            belly: 0.4,
            roll: [0.0, 0.2 * vary(i, 9)],
            strip: INNER,
        };
        locks.push((lock, chain(across)));
    }
    for (i, &(across, tip, width, lift, curl)) in (0u32..).zip(LARGE) {
        let fall = Fall { across, tip, lift, curl: [curl, 0.014 * hash(i, 5, 8)], start: 6.0, id: i + 20 };
        let lock = Lock {
            guide: guide(&fall),
            width,
            thickness: 0.015,
            root: 0.62,
            belly: 0.55,
            // Each lies over its neighbour with one edge.
            roll: [0.09, 0.4 * vary(i, 3)],
            strip: (i % 2) as usize,
        };
        for (n, &(from, side, spread, reach, width)) in (0u32..).zip(FORKS) {
            let more = 0.06 * vary(i * 3 + n, 11);
            locks.push((lock.fork(from + more, side, spread, reach + more, width), chain(across)));
        }
        locks.push((lock, chain(across)));
    }
    // Over the borders, shorter.
    for i in 0..6u32 {
        let across = -0.88 + 1.76 * i as f32 / 5.0 + 0.07 * vary(i, 13);
        let fall = Fall {
            across,
            tip: 1.06 + 0.15 * hash(i, 3, 16),
            lift: 0.0165 + 0.002 * vary(i, 14),
            curl: [0.22 * vary(i, 18), 0.012],
            start: 22.0 + 12.0 * hash(i, 2, 19),
            id: i + 40,
        };
        let lock = Lock {
            guide: guide(&fall),
            width: 0.018 + 0.006 * hash(i, 2, 17),
            thickness: 0.0095,
            root: 0.25,
            belly: 0.45,
            roll: [0.12 * vary(i, 15), 0.6 * vary(i, 23)],
            strip: 2 + (i % 2) as usize,
        };
        locks.push((lock, chain(across)));
    }
    for i in 0..7u32 {
        let across = (i as f32 / 3.0 - 1.0) * 1.1 + 0.1 * vary(i, 30);
        let fall = Fall {
            across,
            tip: 0.93 + 0.24 * hash(i, 1, 31),
            // Hidden down to where they leave.
            lift: 0.007,
            curl: [0.3 * vary(i, 34), 0.022 + 0.014 * hash(i, 2, 33)],
            start: 30.0,
            id: i + 60,
        };
        let lock = Lock {
            guide: guide(&fall),
            width: 0.0046,
            thickness: 0.0038,
            root: 0.5,
            belly: 0.5,
            roll: [0.0, 0.4],
            strip: THIN,
        };
        locks.push((lock, chain(across)));
    }
    locks
}
