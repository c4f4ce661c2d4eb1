//! Locks before and over the ears: long ones down to the chest, short ones along the cheeks.

use glam::Vec3;

use super::lock::{INNER, Lock, THIN};
use super::surface::{Placed, rooted, vary};

/// A lock of her left side: root angle; places at cheek, jaw, collar, chest and tip; half width; thickness; lift; strip.
struct Side(f32, [[f32; 3]; 5], f32, f32, f32, usize);

const LEFT: &[Side] = &[
    // The large one that frames the face.
    Side(
        66.0,
        [
            [0.097, 1.42, 0.028],
            [0.095, 1.345, 0.042],
            [0.101, 1.262, 0.094],
            [0.098, 1.19, 0.132],
            [0.068, 1.085, 0.142],
        ],
        0.0215,
        0.011,
        0.006,
        0,
    ),
    // Over the ear.
    Side(
        86.0,
        [
            [0.1045, 1.42, -0.006],
            [0.107, 1.345, 0.002],
            [0.1245, 1.28, 0.044],
            [0.131, 1.228, 0.094],
            [0.103, 1.142, 0.122],
        ],
        0.0225,
        0.011,
        0.0035,
        1,
    ),
    // Before the ear, shorter.
    Side(
        56.0,
        [
            [0.0825, 1.42, 0.0525],
            [0.0765, 1.386, 0.06],
            [0.0785, 1.348, 0.0645],
            [0.0815, 1.308, 0.0695],
            [0.058, 1.266, 0.068],
        ],
        0.0145,
        0.0075,
        0.0055,
        2,
    ),
    Side(
        76.0,
        [
            [0.1025, 1.42, 0.014],
            [0.1035, 1.345, 0.024],
            [0.112, 1.27, 0.076],
            [0.107, 1.21, 0.122],
            [0.098, 1.14, 0.137],
        ],
        0.0135,
        0.009,
        0.008,
        3,
    ),
    // Behind the neck, dark.
    Side(
        95.0,
        [
            [0.092, 1.42, -0.03],
            [0.0885, 1.36, -0.034],
            [0.083, 1.315, -0.045],
            [0.08, 1.285, -0.06],
            [0.078, 1.262, -0.075],
        ],
        0.022,
        0.006,
        -0.004,
        INNER,
    ),
];

/// Both sides; they are not alike.
pub(super) fn build() -> Vec<Placed> {
    let mut locks = Vec::new();
    for sign in [1.0f32, -1.0] {
        let seed = if sign > 0.0 { 3 } else { 4 };
        let chain = |inner: bool| match (inner, sign > 0.0) {
            (false, true) => "HairSide_Left",
            (false, false) => "HairSide_Right",
            (true, true) => "HairBack_Left2",
            (true, false) => "HairBack_Right2",
        };
        let mut side = Vec::new();
        for (n, Side(root, places, width, thickness, lift, strip)) in (0u32..).zip(LEFT) {
            let mut guide: Vec<Vec3> =
                [5.0, 20.0, 36.0, 52.0, 66.0, 79.0].map(|down| rooted(root * sign, down, 5.0, *lift)).to_vec();
            for (k, [x, y, z]) in (0u32..).zip(places) {
                let apart = 0.004 * vary(n * 7 + k, seed) * (k as f32 / 2.0).min(1.0);
                let long = if k > 2 {
                    0.014 * vary(n, seed + 20) * (k - 2) as f32
                } else {
                    0.0
                };
                guide.push(Vec3::new((x + apart) * sign, y + long, z + 0.5 * apart.abs()));
            }
            let lock = Lock {
                guide,
                width: *width,
                thickness: *thickness,
                root: 0.5,
                belly: 0.42,
                roll: [0.08 * sign, 0.55 * sign * if n % 2 == 0 { 1.0 } else { -0.7 }],
                strip: *strip,
            };
            locks.push((lock.clone(), chain(*strip == INNER)));
            side.push(lock);
        }
        // Of which, from where, side, spread, length, half width.
        for (of, from, across, spread, reach, width) in [
            (0, 0.5, 0.75, 0.012, 0.93, 0.0095),
            (0, 0.55, -0.7, 0.01, 1.04, 0.008),
            (1, 0.5, 0.7, 0.012, 0.95, 0.0105),
            (1, 0.5, -0.75, 0.014, 0.88, 0.009),
            (3, 0.5, 0.5, 0.01, 1.1, 0.0045),
            (0, 0.4, -0.2, 0.016, 0.85, 0.0042),
        ] {
            let mut fork = side[of].fork(from, across * sign, spread, reach, width);
            if width < 0.006 {
                fork.strip = THIN;
            }
            locks.push((fork, chain(false)));
        }
    }
    locks
}
