//! What lies between two keys: from distances to codes.

use super::BakeOptions;
use super::border::HALF;
use super::threshold::{degrees, fault};
use crate::Result;

/// What lies between two keys.
#[derive(Clone, Copy, Debug)]
pub(super) struct Band {
    /// Thresholds of the two keys, in codes.
    pub(super) from: f64,
    pub(super) to: f64,
    /// Least and greatest code of a texel that is lit at the first and dark at the second.
    low: u16,
    high: u16,
}

/// The bands between keys that growing angles are of.
///
/// # Errors
/// Keys that are too close for the bits of a code.
pub(super) fn bands(angles_rad: &[f32], options: &BakeOptions) -> Result<Vec<Band>> {
    let max = options.depth.max();
    let threshold = |angle: f32| options.profile.threshold(f64::from(angle)) * f64::from(max);
    let band = |pair: &[f32]| {
        let [from, to] = [threshold(pair[0]), threshold(pair[1])];
        // The outermost codes are never and always lit, and no texel ties with a key.
        let (low, high) = ((from + 0.25).ceil().max(1.0), (to - 0.25).floor().min(f64::from(max - 1)));
        // Beyond the angles that the profile tells apart; those at its ends are rounded on their way to radians.
        let rounded = 0.05;
        if to <= rounded || from >= f64::from(max) - rounded {
            let code = if to <= rounded { 1 } else { max - 1 };
            return Ok(Band { from, to, low: code, high: code });
        }
        if low > high {
            let [a, b] = [pair[0], pair[1]].map(degrees);
            return Err(fault(format!(
                "at {a} and {b} degrees are too close for {} bits: no code lies between them; expected a wider step{}",
                if max == 255 { 8 } else { 16 },
                if max == 255 { " or 16 bits" } else { "" }
            )));
        }
        Ok(Band { from, to, low: low as u16, high: high as u16 })
    };
    angles_rad.windows(2).map(band).collect()
}

/// Distance from a texel to a border.
pub(super) fn distance(squared: u32) -> f64 {
    f64::from(squared).sqrt() - f64::from(HALF)
}

impl Band {
    /// Code at a share of the way between the keys.
    pub(super) fn code(&self, share: f64, shift: f64) -> u16 {
        let exact = self.from + (self.to - self.from) * share;
        ((exact + 0.5 + shift).floor()).clamp(f64::from(self.low), f64::from(self.high)) as u16
    }

    /// Codes of texels that have both borders: in single precision, and anew in double where that could round wrongly.
    pub(super) fn between(&self, inside: &[u32], outside: &[u32], out: &mut [u16]) {
        const LANES: usize = 8;
        /// Adding it rounds to whole numbers.
        const ROUND: f32 = 8_388_608.0;
        /// Three roundings of 24 bits on a value of 16.
        const UNSURE: f32 = 0.5 - 0.02;
        let exact = |i: usize| {
            let (inside, outside) = (distance(inside[i]), distance(outside[i]));
            self.code(inside / (inside + outside), 0.0)
        };
        let (from, span) = (self.from as f32, (self.to - self.from) as f32);
        let (low, high) = (f32::from(self.low), f32::from(self.high));
        let blocks = inside.chunks(LANES).zip(outside.chunks(LANES)).enumerate();
        for (block, (inside, outside)) in blocks {
            let at = block * LANES;
            let mut unsure = inside.len() < LANES;
            if let (Some(inside), Some(outside)) = (inside.first_chunk::<LANES>(), outside.first_chunk::<LANES>()) {
                let mut off = [0f32; LANES];
                for i in 0..LANES {
                    // Squares of 31 bits, which convert faster with a sign.
                    let a = (inside[i] as i32 as f32).sqrt() - 0.5;
                    let b = (outside[i] as i32 as f32).sqrt() - 0.5;
                    let value = (from + span * (a / (a + b))).max(low).min(high);
                    let rounded = value + ROUND;
                    off[i] = (value - (rounded - ROUND)).abs();
                    out[at + i] = rounded.to_bits() as u16;
                }
                unsure = off.iter().any(|o| *o > UNSURE);
            }
            if unsure {
                (at..at + inside.len()).for_each(|i| out[i] = exact(i));
            }
        }
    }
}

/// Where a monotone cubic through distances of growing thresholds is 0, as a share of the way between the middle two.
/// Without a key on one side, it leaves the last one as a straight line.
pub(super) fn zero_of_cubic(
    before: Option<(f64, f64)>,
    a: (f64, f64),
    b: (f64, f64),
    after: Option<(f64, f64)>,
) -> f64 {
    let secant = |a: (f64, f64), b: (f64, f64)| (b.1 - a.1) / (b.0 - a.0).max(1e-12);
    let middle = secant(a, b);
    // Both fall, so that their weighted harmonic mean keeps the cubic from turning.
    let slope = |left: f64, right: f64, left_width: f64, right_width: f64| {
        let (v, w) = (2.0 * right_width + left_width, right_width + 2.0 * left_width);
        if left * right > 0.0 {
            (v + w) / (v / left + w / right)
        } else {
            0.0
        }
    };
    let width = b.0 - a.0;
    let from = before.map_or(middle, |p| slope(secant(p, a), middle, a.0 - p.0, width)) * width;
    let to = after.map_or(middle, |n| slope(middle, secant(b, n), width, n.0 - b.0)) * width;
    let at = |u: f64| {
        let (s, v) = (u * u, 1.0 - u);
        a.1 * (1.0 + 2.0 * u) * v * v + from * u * v * v + b.1 * s * (3.0 - 2.0 * u) - to * s * v
    };
    // It falls all the way: halve until nothing is left of a code.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..32 {
        let u = 0.5 * (low + high);
        if at(u) > 0.0 { low = u } else { high = u }
    }
    0.5 * (low + high)
}

/// Ordered dither of 8 x 8 texels (Bayer 1973), -0.5..0.5 codes.
pub(super) fn bayer(x: usize, y: i16) -> f64 {
    let (x, y) = (x & 7, y as usize & 7);
    let bits = (0..3).map(|bit| (((x ^ y) >> bit & 1) << (5 - 2 * bit)) | ((y >> bit & 1) << (4 - 2 * bit)));
    (bits.sum::<usize>() as f64 + 0.5) / 64.0 - 0.5
}
