//! The body of hair that all locks lie on: round the head a shell that flows from the whorl, below it a curtain.

use glam::{Quat, Vec3};

use super::lock::Lock;
use crate::head::shape::skull;
use crate::picture::{hash, smoothstep};

/// A lock and the chain that moves it (empty for none).
pub(super) type Placed = (Lock, &'static str);

/// How far hair turns round the whorl before it falls, degrees.
const SWIRL: f32 = 48.0;

/// Direction from the middle of the skull: `around` from the front to her left, `down` from the whorl, both degrees.
/// The whorl lies behind the top of the head.
pub(super) fn direction(around: f32, down: f32) -> Vec3 {
    let turned = around + SWIRL * (-down.max(0.0) / 13.0).exp();
    let (sa, ca) = turned.to_radians().sin_cos();
    let (sd, cd) = down.to_radians().sin_cos();
    Quat::from_rotation_x(-0.3) * Vec3::new(sd * sa, cd, sd * ca)
}

/// Point over the shell, `lift` metres outwards. Hair stands off the head: most over the crown.
pub(super) fn shell(around: f32, down: f32, lift: f32) -> Vec3 {
    let behind = 0.5 - 0.5 * around.to_radians().cos();
    let volume = 0.0185
        + 0.0075 * smoothstep(95.0, 20.0, down)
        + 0.003 * behind * smoothstep(-10.0, 25.0, down) * smoothstep(95.0, 60.0, down);
    skull(direction(around, down), volume + lift)
}

/// Where a lock leaves the cap: from inside of it at `start` degrees from the whorl up to `lift`.
pub(super) fn rooted(around: f32, down: f32, start: f32, lift: f32) -> Vec3 {
    const DEEP: f32 = 0.007;
    // The way to the equator is shorter behind.
    let way = 45.0 + 7.0 * around.to_radians().cos();
    shell(around, down, -DEEP + (lift + DEEP) * smoothstep(start, start + way, down))
}

/// A number in -1..1 that belongs to a lock.
pub(super) fn vary(index: u32, seed: u32) -> f32 {
    hash(index, 17, seed) * 2.0 - 1.0
}

/// Where the sheet of back hair hangs: half width and depth behind the body at height `y`.
fn curtain(y: f32) -> [f32; 2] {
    const TABLE: &[[f32; 3]] = &[
        [0.86, 0.112, 0.164],
        [0.95, 0.136, 0.164],
        [1.05, 0.142, 0.158],
        [1.15, 0.134, 0.152],
        [1.22, 0.123, 0.149],
        [1.28, 0.113, 0.143],
        [1.34, 0.107, 0.133],
        [1.4, 0.1055, 0.128],
        [1.44, 0.103, 0.128],
    ];
    let last = TABLE.len() - 2;
    let i = TABLE.iter().rposition(|r| r[0] <= y).unwrap_or(0).min(last);
    let t = ((y - TABLE[i][0]) / (TABLE[i + 1][0] - TABLE[i][0])).clamp(0.0, 1.0);
    [1, 2].map(|c| TABLE[i][c] + (TABLE[i + 1][c] - TABLE[i][c]) * t)
}

/// Point of the curtain: `across` -1 (her right) .. 1 (her left).
pub(super) fn hang(across: f32, y: f32, lift: f32) -> Vec3 {
    let [half, depth] = curtain(y);
    // Round as the head above, flatter below.
    let high = smoothstep(1.13, 1.46, y);
    let reach = 1.15 + 0.386 * high;
    let angle = across * reach;
    let bulge = 0.085 + 0.034 * high;
    let round = Vec3::new(angle.sin() / reach.sin() * half, y, -depth + (1.0 - angle.cos()) * bulge);
    round + Vec3::new(angle.sin(), 0.0, -angle.cos()) * lift
}
