//! Blinking, by a schedule that a seed and the time alone decide.

use crate::smoothstep::smoothstep;

/// Blinks now and then: about every `every_s`, seldom twice in a row. The same seed blinks at the same moments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blink {
    /// What tells it from others.
    pub seed: u64,
    /// Mean time between blinks, seconds. Range 0.5... Default: 4.
    pub every_s: f32,
}

impl Default for Blink {
    fn default() -> Self {
        Self { seed: 0, every_s: 4.0 }
    }
}

/// Lids close, stay closed and open again, seconds: people take 70, 20 and 150 ms; drawn eyes read better a frame longer.
const CLOSE_S: f32 = 0.07;
const HOLD_S: f32 = 0.04;
const OPEN_S: f32 = 0.15;
const WHOLE_S: f32 = CLOSE_S + HOLD_S + OPEN_S;
/// One blink in so many is a double one, its second this much after the first.
const DOUBLE: u64 = 6;
const AGAIN_S: f32 = WHOLE_S + 0.06;

impl Blink {
    /// How far the lids are closed. Range 0..1.
    #[must_use]
    pub fn at(&self, time_s: f64) -> f32 {
        let every = f64::from(self.every_s.max(0.5));
        let slot = libm::floor(time_s / every);
        let within = (time_s - slot * every) as f32;
        let dice = random(self.seed, slot as i64 as u64);
        // Somewhere in its slot, whole.
        let room = (self.every_s.max(0.5) - AGAIN_S - WHOLE_S).max(0.0);
        let start = share(dice) * room;
        let first = closed(within - start);
        if (dice >> 40).is_multiple_of(DOUBLE) && room > 0.0 {
            first.max(closed(within - start - AGAIN_S))
        } else {
            first
        }
    }
}

fn closed(since: f32) -> f32 {
    let open = smoothstep(0.0, OPEN_S, since - CLOSE_S - HOLD_S);
    smoothstep(0.0, CLOSE_S, since).min(1.0 - open)
}

/// Bits that a seed and a number decide (SplitMix64).
pub(crate) fn random(seed: u64, number: u64) -> u64 {
    let z = seed ^ number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A number from 0 to 1 of the lowest bits.
pub(crate) fn share(bits: u64) -> f32 {
    (bits & 0xff_ffff) as f32 / 0x100_0000 as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lids_close_wholly_every_few_seconds_and_move_smoothly() {
        let blink = Blink { seed: 7, ..Blink::default() };
        let at: Vec<f32> = (0..24_000).map(|i| blink.at(f64::from(i) * 0.005)).collect();
        let count = at.windows(2).filter(|w| w[0] < 0.5 && w[1] >= 0.5).count();
        assert!((28..=40).contains(&count), "{count} blinks in 120 s");
        assert!(at.windows(2).all(|w| (w[0] - w[1]).abs() < 0.12));
        assert_eq!(at.iter().copied().fold(0.0, f32::max), 1.0);
        assert!(at.iter().filter(|w| **w == 0.0).count() > 21_000);
        let other = Blink { seed: 8, ..blink };
        assert!((0..100).any(|i| other.at(f64::from(i) * 0.1) != blink.at(f64::from(i) * 0.1)));
    }
}
