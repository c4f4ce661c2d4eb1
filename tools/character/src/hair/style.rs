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

/// Hair stands off the head: not at the whorl, most over the crown, metres.
const VOLUME: f32 = 0.0085;

fn on_skull(around: f32, down: f32, lift: f32) -> Vec3 {
    skull(direction(around, down), lift + VOLUME * smoothstep(-12.0, 34.0, down))
}

/// A number in -1..1 that belongs to a lock.
fn vary(index: u32, seed: u32) -> f32 {
    hash(index, 17, seed) * 2.0 - 1.0
}

/// Bangs: over the forehead to the brows, parted a little to her left; and the ahoge.
pub(super) fn front() -> Vec<Placed> {
    // Tip x, tip y, root angle, half width, thickness, layer (0 over, 1 under), sideways swing of the tip.
    const BANGS: &[(f32, f32, f32, f32, f32, u32, f32)] = &[
        // Upper layer, from her right to her left: broad clumps whose tips lean together.
        (-0.0805, 1.376, -58.0, 0.0145, 0.007, 0, 0.005),
        (-0.0665, 1.402, -46.0, 0.0185, 0.0084, 0, 0.006),
        (-0.0445, 1.4255, -33.0, 0.0165, 0.008, 0, -0.006),
        (-0.0215, 1.4215, -18.0, 0.0175, 0.0088, 0, 0.009),
        (0.0015, 1.4135, -4.0, 0.0185, 0.0096, 0, 0.006),
        (0.0235, 1.4275, 12.0, 0.0155, 0.008, 0, -0.008),
        (0.049, 1.4245, 26.0, 0.0185, 0.0088, 0, 0.008),
        (0.0675, 1.3985, 42.0, 0.0175, 0.0082, 0, -0.005),
        (0.0795, 1.3735, 56.0, 0.0135, 0.0068, 0, -0.005),
        // Lower layer, shorter, in the gaps.
        (-0.0575, 1.4355, -41.0, 0.0155, 0.005, 1, 0.004),
        (-0.0335, 1.4445, -27.0, 0.0155, 0.005, 1, 0.004),
        (-0.0095, 1.4385, -11.0, 0.015, 0.005, 1, 0.003),
        (0.0135, 1.4425, 5.0, 0.0145, 0.005, 1, -0.003),
        (0.0355, 1.4425, 19.0, 0.0155, 0.005, 1, -0.003),
        (0.0585, 1.4325, 35.0, 0.0155, 0.005, 1, -0.004),
        // Thin strands that break the row.
        (-0.0125, 1.4095, -14.0, 0.0046, 0.003, 0, 0.012),
        (0.0145, 1.4175, 10.0, 0.0046, 0.003, 0, -0.008),
        (-0.0735, 1.391, -51.0, 0.0042, 0.003, 0, 0.006),
        (0.0735, 1.3875, 50.0, 0.0042, 0.003, 0, 0.004),
    ];
    let mut locks = Vec::new();
    for (i, &(x, y, root, width, thickness, layer, swing)) in BANGS.iter().enumerate() {
        let i = i as u32;
        let lift = if layer == 0 { 0.0155 } else { 0.0105 };
        // Roots gather at the parting.
        let from = 4.0 + (root - 4.0) * 0.55;
        let root_angle = 4.0 + (root - 4.0) * 1.15;
        let start = on_skull(root_angle, 4.0, 0.008);
        let crown = on_skull(from, 24.0, lift + 0.002);
        let over = on_skull(4.0 + (root - 4.0) * 0.82, 47.0, lift + 0.0045);
        let brow = on_skull(root, 66.0, lift + 0.003);
        // The tip hangs a little before the face, which falls back to the sides.
        let depth = 0.0955 - 6.6 * x * x - if layer == 0 { 0.0 } else { 0.0025 };
        let tip = Vec3::new(x, y, depth);
        let low = brow.lerp(tip, 0.55) + Vec3::new(-swing * 0.9, 0.0, 0.0055);
        let chain = if x.abs() < 0.022 {
            "HairFront_Middle"
        } else if x > 0.0 {
            "HairFront_Left"
        } else {
            "HairFront_Right"
        };
        locks.push((
            Lock {
                guide: vec![start, crown, over, brow, low, tip],
                width,
                thickness,
                root: 0.75,
                belly: 0.56,
                twist: vary(i, 1) * 0.12 - swing * 20.0,
                strip: if layer == 0 { i % 3 } else { 3 },
            },
            chain,
        ));
    }
    // The ahoge: up from the whorl, forwards in an arc.
    let root = on_skull(0.0, 4.0, 0.009) + Vec3::X * 0.008;
    let arc = [
        [0.0, 0.0, 0.0],
        [0.0064, 0.0276, 0.004],
        [0.016, 0.046, 0.0222],
        [0.0272, 0.045, 0.05],
        [0.0352, 0.03, 0.074],
    ];
    locks.push((
        Lock {
            guide: arc.map(|p| root + Vec3::from_array(p)).to_vec(),
            width: 0.006,
            thickness: 0.0034,
            root: 0.55,
            belly: 0.45,
            twist: 0.5,
            strip: 0,
        },
        "",
    ));
    locks
}

/// Locks before and over the ears, long ones down to the chest.
pub(super) fn side() -> Vec<Placed> {
    let mut locks = Vec::new();
    for sign in [1.0f32, -1.0] {
        // Behind the ear a lock swings with the back hair: the side chain, whose root lies before the ear, would lift it.
        let chain = |root: f32| match (root > 90.0, sign > 0.0) {
            (false, true) => "HairSide_Left",
            (false, false) => "HairSide_Right",
            (true, true) => "HairBack_Left2",
            (true, false) => "HairBack_Right2",
        };
        let seed = if sign > 0.0 { 3 } else { 4 };
        // Root angle; places at cheek, jaw, collar and tip; half width; thickness.
        let list: &[(f32, [[f32; 3]; 4], f32, f32, u32)] = &[
            (
                56.0,
                [[0.0915, 1.42, 0.034], [0.0925, 1.345, 0.044], [0.092, 1.25, 0.1], [0.08, 1.098, 0.146]],
                0.0165,
                0.0095,
                0,
            ),
            (
                70.0,
                [[0.0985, 1.42, 0.012], [0.102, 1.345, 0.022], [0.104, 1.255, 0.078], [0.102, 1.135, 0.126]],
                0.0165,
                0.009,
                1,
            ),
            (
                47.0,
                [[0.0845, 1.42, 0.053], [0.0855, 1.37, 0.056], [0.0825, 1.33, 0.057], [0.073, 1.287, 0.0565]],
                0.0095,
                0.006,
                2,
            ),
            (
                63.0,
                [[0.0955, 1.42, 0.026], [0.0975, 1.35, 0.036], [0.099, 1.27, 0.086], [0.098, 1.192, 0.116]],
                0.0085,
                0.0055,
                2,
            ),
            (
                84.0,
                [[0.1, 1.42, -0.012], [0.1055, 1.345, -0.002], [0.112, 1.27, 0.034], [0.118, 1.208, 0.078]],
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
                116.0,
                [[0.0935, 1.42, -0.062], [0.0985, 1.35, -0.07], [0.106, 1.28, -0.078], [0.116, 1.19, -0.082]],
                0.0205,
                0.009,
                2,
            ),
            (
                94.0,
                [[0.09, 1.42, -0.024], [0.0895, 1.35, -0.022], [0.089, 1.285, -0.018], [0.092, 1.205, -0.008]],
                0.0205,
                0.007,
                3,
            ),
            (
                52.0,
                [[0.0885, 1.42, 0.045], [0.0905, 1.345, 0.054], [0.09, 1.27, 0.098], [0.084, 1.17, 0.136]],
                0.0052,
                0.004,
                1,
            ),
        ];
        for (i, (root, places, width, thickness, strip)) in list.iter().enumerate() {
            let n = i as u32;
            let from = 6.0 + (root - 6.0) * 0.8;
            // Neighbours do not lie in one surface.
            let apart = 0.0022 * (n % 3) as f32;
            let mut guide = vec![
                on_skull(root * sign, 4.0, 0.008),
                on_skull(from * sign, 24.0, 0.0165 + apart),
                on_skull((from * 0.3 + root * 0.7) * sign, 48.0, 0.0225 + apart),
                on_skull(root * sign, 72.0, 0.0175 + apart),
            ];
            let wave = 0.004 * vary(n, seed);
            for (k, [x, y, z]) in places.iter().enumerate() {
                let bend = if k % 2 == 0 { wave } else { -wave };
                guide.push(Vec3::new((x + 0.005 + apart + bend) * sign, *y + 0.006 * vary(n * 7 + k as u32, seed), *z));
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
                chain(*root),
            ));
        }
    }
    locks
}

/// Where the sheet of back hair hangs: half width and depth behind the body at height `y`.
fn curtain(y: f32) -> [f32; 2] {
    const TABLE: &[[f32; 3]] = &[
        [0.86, 0.105, 0.168],
        [0.95, 0.126, 0.166],
        [1.05, 0.134, 0.161],
        [1.15, 0.132, 0.157],
        [1.22, 0.126, 0.155],
        [1.28, 0.118, 0.15],
        [1.34, 0.11, 0.139],
        [1.4, 0.107, 0.131],
        [1.44, 0.105, 0.13],
    ];
    let last = TABLE.len() - 2;
    let i = TABLE.iter().rposition(|r| r[0] <= y).unwrap_or(0).min(last);
    let t = ((y - TABLE[i][0]) / (TABLE[i + 1][0] - TABLE[i][0])).clamp(0.0, 1.0);
    [1, 2].map(|c| TABLE[i][c] + (TABLE[i + 1][c] - TABLE[i][c]) * t)
}

/// Point of the curtain: `across` -1 (her right) .. 1 (her left).
fn hang(across: f32, y: f32, lift: f32) -> Vec3 {
    let [half, depth] = curtain(y);
    // Round as the head above, flatter below.
    let high = smoothstep(1.13, 1.46, y);
    let reach = 1.15 + 0.386 * high;
    let angle = across * reach;
    let bulge = 0.085 + 0.034 * high;
    let round = Vec3::new(angle.sin() / reach.sin() * half, y, -depth + (1.0 - angle.cos()) * bulge);
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
            // Roots dive into the cap round the whorl, so that no ends show.
            let mut guide = vec![
                on_skull(around, 3.0 + 5.0 * hash(id, 1, 2), 0.008),
                on_skull(around + 5.0 * vary(id, 12), 18.0, 0.0135 + lift * 0.8),
                on_skull(around, 38.0, 0.0125 + lift),
                on_skull(around, 62.0, 0.0125 + lift),
            ];
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
            let scale = 0.72 + 0.62 * hash(id, 2, 7);
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
