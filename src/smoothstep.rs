//! The S-shaped way from 0 to 1.

/// 0 at `from`, 1 at `to`, smooth between; either may be the greater.
pub(crate) fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
