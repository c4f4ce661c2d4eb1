//! The hairstyle: which locks there are and where they run.

use glam::{Quat, Vec3};

use super::lock::Lock;
use crate::head::shape::skull;
use crate::picture::{hash, smoothstep};

/// A lock and the chain that moves it (empty for none).
pub(super) type Placed = (Lock, &'static str);

/// Direction from the middle of the skull: `around` from the front to her left, `down` from the whorl, both degrees.
/// The whorl lies behind the top of the head.
pub(super) fn direction(around: f32, down: f32) -> Vec3 {
    let (sa, ca) = around.to_radians().sin_cos();
    let (sd, cd) = down.to_radians().sin_cos();
    Quat::from_rotation_x(-0.3) * Vec3::new(sd * sa, cd, sd * ca)
}

fn on_skull(around: f32, down: f32, lift: f32) -> Vec3 {
    skull(direction(around, down), lift)
}

/// A number in -1..1 that belongs to a lock.
fn vary(index: u32, seed: u32) -> f32 {
    hash(index, 17, seed) * 2.0 - 1.0
}

/// Bangs: over the forehead to the brows, parted a little to her left; and the ahoge.
pub(super) fn front() -> Vec<Placed> {
    // Tip x, tip y, root angle, half width, thickness, layer (0 over, 1 under), sideways swing of the tip.
    const BANGS: &[(f32, f32, f32, f32, f32, u32, f32)] = &[
        // Upper layer, from her right to her left.
        (-0.0705, 1.396, -52.0, 0.0125, 0.0062, 0, 0.004),
        (-0.0525, 1.4205, -38.0, 0.0135, 0.0068, 0, 0.005),
        (-0.0335, 1.4335, -25.0, 0.0135, 0.007, 0, 0.006),
        (-0.0135, 1.4125, -11.0, 0.0145, 0.0078, 0, 0.005),
        (0.0035, 1.4245, 2.0, 0.0105, 0.006, 0, 0.004),
        (0.0265, 1.4325, 14.0, 0.0135, 0.007, 0, -0.006),
        (0.0455, 1.4255, 28.0, 0.0135, 0.007, 0, -0.007),
        (0.0605, 1.411, 40.0, 0.0125, 0.0066, 0, -0.006),
        (0.0735, 1.389, 53.0, 0.0125, 0.0062, 0, -0.004),
        // Lower layer, shorter, in the gaps.
        (-0.0615, 1.4295, -45.0, 0.0115, 0.005, 1, 0.002),
        (-0.043, 1.4405, -32.0, 0.0125, 0.005, 1, 0.003),
        (-0.0235, 1.4395, -18.0, 0.012, 0.005, 1, 0.003),
        (-0.0045, 1.4385, -4.0, 0.011, 0.005, 1, 0.0),
        (0.015, 1.4405, 9.0, 0.0115, 0.005, 1, -0.002),
        (0.0365, 1.441, 21.0, 0.012, 0.005, 1, -0.003),
        (0.054, 1.434, 34.0, 0.0115, 0.005, 1, -0.003),
        // Thin strands that break the row.
        (-0.0225, 1.4205, -20.0, 0.0045, 0.003, 0, 0.009),
        (0.0375, 1.4145, 22.0, 0.0042, 0.003, 0, -0.01),
        (-0.046, 1.408, -40.0, 0.004, 0.003, 0, 0.006),
    ];
    let mut locks = Vec::new();
    for (i, &(x, y, root, width, thickness, layer, swing)) in BANGS.iter().enumerate() {
        let i = i as u32;
        let lift = if layer == 0 { 0.0155 } else { 0.0105 };
        // Roots gather at the parting.
        let from = 4.0 + (root - 4.0) * 0.55;
        let start = on_skull(from, 26.0, lift + 0.001);
        let over = on_skull(4.0 + (root - 4.0) * 0.82, 47.0, lift + 0.0045);
        let brow = on_skull(root, 66.0, lift + 0.003);
        // The tip hangs a little before the face, which falls back to the sides.
        let depth = 0.1005 - 7.2 * x * x - if layer == 0 { 0.0 } else { 0.0035 };
        let tip = Vec3::new(x, y, depth);
        let low = brow.lerp(tip, 0.55) + Vec3::new(-swing * 0.9, 0.0, 0.0035);
        let chain = if x.abs() < 0.022 {
            "HairFront_Middle"
        } else if x > 0.0 {
            "HairFront_Left"
        } else {
            "HairFront_Right"
        };
        locks.push((
            Lock {
                guide: vec![start, over, brow, low, tip],
                width,
                thickness,
                root: 0.75,
                belly: 0.5,
                twist: vary(i, 1) * 0.12 - swing * 20.0,
                strip: if layer == 0 { i % 3 } else { 3 },
            },
            chain,
        ));
    }
    // The ahoge: up from the whorl, forwards in an arc.
    for (side, height, reach, width) in [(0.008, 0.058, 0.058, 0.0052), (-0.007, 0.03, 0.046, 0.0036)] {
        let root = on_skull(0.0, 4.0, 0.012) + Vec3::X * side;
        locks.push((
            Lock {
                guide: vec![
                    root,
                    root + Vec3::new(side, height * 0.62, 0.006),
                    root + Vec3::new(side * 2.4, height, reach * 0.45),
                    root + Vec3::new(side * 3.6, height * 0.72, reach),
                ],
                width,
                thickness: 0.003,
                root: 0.8,
                belly: 0.35,
                twist: 0.3,
                strip: 0,
            },
            "",
        ));
    }
    locks
}

/// Locks before and over the ears, long ones down to the chest.
pub(super) fn side() -> Vec<Placed> {
    let mut locks = Vec::new();
    for sign in [1.0f32, -1.0] {
        let chain = if sign > 0.0 { "HairSide_Left" } else { "HairSide_Right" };
        let seed = if sign > 0.0 { 3 } else { 4 };
        // Root angle; places at cheek, jaw, collar and tip; half width; thickness.
        let list: &[(f32, [[f32; 3]; 4], f32, f32, u32)] = &[
            (
                56.0,
                [[0.0885, 1.42, 0.05], [0.0905, 1.345, 0.062], [0.092, 1.25, 0.088], [0.078, 1.098, 0.128]],
                0.0165,
                0.0095,
                0,
            ),
            (
                70.0,
                [[0.0965, 1.42, 0.024], [0.101, 1.345, 0.036], [0.104, 1.255, 0.066], [0.1, 1.135, 0.108]],
                0.0165,
                0.009,
                1,
            ),
            (
                47.0,
                [[0.0795, 1.42, 0.0675], [0.0815, 1.37, 0.0705], [0.0785, 1.33, 0.07], [0.068, 1.292, 0.0655]],
                0.0095,
                0.006,
                2,
            ),
            (
                63.0,
                [[0.0935, 1.42, 0.038], [0.0965, 1.35, 0.05], [0.099, 1.27, 0.078], [0.096, 1.192, 0.1]],
                0.0085,
                0.0055,
                2,
            ),
            (
                84.0,
                [[0.1, 1.42, -0.004], [0.1055, 1.345, 0.004], [0.112, 1.27, 0.022], [0.122, 1.2, 0.05]],
                0.0185,
                0.009,
                0,
            ),
            (
                100.0,
                [[0.0985, 1.42, -0.034], [0.104, 1.35, -0.036], [0.112, 1.29, -0.038], [0.122, 1.235, -0.04]],
                0.0195,
                0.009,
                1,
            ),
            (
                52.0,
                [[0.084, 1.42, 0.06], [0.088, 1.345, 0.07], [0.09, 1.27, 0.088], [0.082, 1.17, 0.118]],
                0.0052,
                0.004,
                1,
            ),
        ];
        for (i, (root, places, width, thickness, strip)) in list.iter().enumerate() {
            let n = i as u32;
            let from = 6.0 + (root - 6.0) * 0.8;
            let mut guide = vec![
                on_skull(from * sign, 24.0, 0.0145),
                on_skull((from * 0.3 + root * 0.7) * sign, 48.0, 0.0195),
                on_skull(root * sign, 72.0, 0.0175),
            ];
            let wave = 0.004 * vary(n, seed);
            for (k, [x, y, z]) in places.iter().enumerate() {
                let bend = if k % 2 == 0 { wave } else { -wave };
                guide.push(Vec3::new((x + bend) * sign, *y + 0.006 * vary(n * 7 + k as u32, seed), *z));
            }
            locks.push((
                Lock {
                    guide,
                    width: *width,
                    thickness: *thickness,
                    root: 0.7,
                    belly: 0.45,
                    twist: 0.25 * sign * vary(n, 9),
                    strip: *strip,
                },
                chain,
            ));
        }
    }
    locks
}

/// Where the sheet of back hair hangs: half width and depth behind the body at height `y`.
fn curtain(y: f32) -> [f32; 2] {
    const TABLE: &[[f32; 3]] = &[
        [0.86, 0.118, 0.162],
        [0.95, 0.142, 0.16],
        [1.05, 0.15, 0.154],
        [1.15, 0.142, 0.15],
        [1.22, 0.13, 0.148],
        [1.28, 0.115, 0.143],
        [1.34, 0.102, 0.131],
        [1.4, 0.098, 0.123],
        [1.44, 0.096, 0.122],
    ];
    let last = TABLE.len() - 2;
    let i = TABLE.iter().rposition(|r| r[0] <= y).unwrap_or(0).min(last);
    let t = ((y - TABLE[i][0]) / (TABLE[i + 1][0] - TABLE[i][0])).clamp(0.0, 1.0);
    [1, 2].map(|c| TABLE[i][c] + (TABLE[i + 1][c] - TABLE[i][c]) * t)
}

/// Point of the curtain: `across` -1 (her right) .. 1 (her left).
fn hang(across: f32, y: f32, lift: f32) -> Vec3 {
    let [half, depth] = curtain(y);
    let angle = across * 1.15;
    // Round at the head, flatter below.
    let flat = smoothstep(1.4, 1.2, y);
    let round = Vec3::new(angle.sin() / 1.15f32.sin() * half, y, -depth + (1.0 - angle.cos()) * (0.16 - 0.075 * flat));
    round + Vec3::new(angle.sin(), 0.0, -angle.cos()) * lift
}

/// Back hair in three layers, from the longest below to the shortest on top.
pub(super) fn back() -> Vec<Placed> {
    // Number of locks, reach to the sides, lift, tips, half width, thickness, strip offset.
    const LAYERS: &[(u32, f32, f32, [f32; 2], f32, f32, bool)] = &[
        (15, 1.06, 0.0, [0.905, 0.985], 0.0205, 0.008, true),
        (13, 1.0, 0.0075, [1.0, 1.1], 0.0195, 0.0095, false),
        (12, 1.12, 0.0135, [1.14, 1.245], 0.0205, 0.0105, false),
    ];
    let mut locks = Vec::new();
    for (layer, &(count, reach, lift, tips, width, thickness, dark)) in LAYERS.iter().enumerate() {
        let layer = layer as u32;
        for i in 0..count {
            let id = layer * 40 + i;
            let place = (i as f32 + 0.5) / count as f32 * 2.0 - 1.0;
            let across = place * reach + 0.03 * vary(id, 5);
            // Long in the middle, shorter to the sides, uneven everywhere.
            let tip_y = tips[0] + (tips[1] - tips[0]) * (0.35 * place.abs() + 0.65 * hash(id, 3, 6));
            let around = 180.0 - across * 88.0;
            let start = on_skull(around, 8.0 + 4.0 * hash(id, 1, 2), 0.009 + lift * 0.5);
            let mut guide = vec![start, on_skull(around, 34.0, 0.0125 + lift), on_skull(around, 60.0, 0.0125 + lift)];
            let top = 1.425;
            let steps = (((top - tip_y) / 0.075).round() as u32).max(3);
            let phase = hash(id, 9, 4) * 6.3;
            for k in 0..=steps {
                let t = k as f32 / steps as f32;
                let y = top + (tip_y - top) * t;
                // A slow wave, growing downwards; tips gather in twos and swing out.
                let wave = 0.05 * t * (phase + t * 5.2).sin();
                let gather = if i % 2 == 0 { 0.035 } else { -0.035 } * t * t;
                let flick = 0.016 * t.powi(4) * (0.3 + hash(id, 5, 8));
                guide.push(hang(across + wave + gather, y, lift + flick));
            }
            let chain = match across {
                a if a > 0.66 => "HairBack_Left2",
                a if a > 0.22 => "HairBack_Left1",
                a if a > -0.22 => "HairBack_Middle",
                a if a > -0.66 => "HairBack_Right1",
                _ => "HairBack_Right2",
            };
            let scale = 0.88 + 0.24 * hash(id, 2, 7);
            locks.push((
                Lock {
                    guide,
                    width: width * scale,
                    thickness,
                    root: 0.55,
                    belly: 0.42,
                    twist: 0.22 * vary(id, 3),
                    strip: if dark { 3 } else { id % 3 },
                },
                chain,
            ));
        }
    }
    // Thin strands that leave the curtain and break its outline.
    for i in 0..8u32 {
        let across = (i as f32 / 7.0 * 2.0 - 1.0) * 1.1;
        let tip_y = 0.98 + 0.2 * hash(i, 1, 31);
        let around = 180.0 - across * 88.0;
        let mut guide = vec![on_skull(around, 20.0, 0.024), on_skull(around, 50.0, 0.03)];
        for k in 0..=4 {
            let t = k as f32 / 4.0;
            guide.push(hang(
                across * (1.0 + 0.1 * t),
                1.42 + (tip_y - 1.42) * t,
                0.017 + 0.02 * t * t * hash(i, 2, 33),
            ));
        }
        let chain = if across > 0.66 {
            "HairBack_Left2"
        } else if across > 0.2 {
            "HairBack_Left1"
        } else if across > -0.2 {
            "HairBack_Middle"
        } else if across > -0.66 {
            "HairBack_Right1"
        } else {
            "HairBack_Right2"
        };
        locks.push((
            Lock { guide, width: 0.0048, thickness: 0.0035, root: 0.6, belly: 0.5, twist: 0.2, strip: i % 3 },
            chain,
        ));
    }
    locks
}
