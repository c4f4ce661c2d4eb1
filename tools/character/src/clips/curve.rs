//! Curves over time: eases, pulses and splines.

use std::f32::consts::TAU;

/// From 0 before `from` to 1 after `to`, at rest at both ends.
pub(super) fn ease(t: f32, from: f32, to: f32) -> f32 {
    let u = ((t - from) / (to - from)).clamp(0.0, 1.0);
    u * u * u * (u * (u * 6.0 - 15.0) + 10.0)
}

/// [`ease`] up over the first two times and down again over the last two.
pub(super) fn hold(t: f32, [up, full, fade, down]: [f32; 4]) -> f32 {
    ease(t, up, full) - ease(t, fade, down)
}

/// Cosine of a phase counted in turns: 1 at `peak`, once a turn.
pub(super) fn swing(phase: f32, peak: f32) -> f32 {
    ((phase - peak) * TAU).cos()
}

/// Between two values.
pub(super) fn mix(a: f32, b: f32, share: f32) -> f32 {
    a + (b - a) * share
}

/// Keys of the weight of one blink that begins at `start` seconds: shut fast, opened slower.
pub(super) fn blink(start: f32) -> [(f32, f32); 5] {
    [(0.0, 0.0), (0.07, 1.0), (0.11, 1.0), (0.2, 0.25), (0.27, 0.0)].map(|(t, w)| (start + t, w))
}

/// A cubic spline with continuous second derivatives and given slopes at both ends.
pub(super) struct Spline {
    keys: Vec<[f32; 2]>,
    slopes: Vec<f32>,
}

impl Spline {
    /// Through `keys` (place, value), places rising, with these slopes at the first and the last.
    pub(super) fn new(keys: Vec<[f32; 2]>, first: f32, last: f32) -> Self {
        let n = keys.len();
        // Equal second derivatives on both sides of each inner key: a tridiagonal system, solved from both ends.
        let mut slopes = vec![first; n];
        slopes[n - 1] = last;
        let step = |i: usize| keys[i + 1][0] - keys[i][0];
        let rise = |i: usize| (keys[i + 1][1] - keys[i][1]) / step(i);
        let mut upper = vec![0.0; n];
        for i in 1..n - 1 {
            let (before, after) = (step(i - 1), step(i));
            let pivot = 2.0 * (before + after) - after * upper[i - 1];
            let wanted = 3.0 * (after * rise(i - 1) + before * rise(i));
            upper[i] = before / pivot;
            slopes[i] = (wanted - after * slopes[i - 1]) / pivot;
        }
        for i in (1..n - 1).rev() {
            slopes[i] -= upper[i] * slopes[i + 1];
        }
        Self { keys, slopes }
    }

    /// Value at a place, held beyond the ends.
    pub(super) fn at(&self, place: f32) -> f32 {
        let last = self.keys.len() - 2;
        let i = self.keys.iter().rposition(|k| k[0] <= place).unwrap_or(0).min(last);
        let ([x0, y0], [x1, y1]) = (self.keys[i], self.keys[i + 1]);
        let h = x1 - x0;
        let t = ((place - x0) / h).clamp(0.0, 1.0);
        let (a, b) = (self.slopes[i] * h, self.slopes[i + 1] * h);
        y0 + t * (a + t * (3.0 * (y1 - y0) - 2.0 * a - b + t * (2.0 * (y0 - y1) + a + b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spline_passes_its_keys_with_its_slopes_and_repeats_a_cubic() {
        let cubic = |x: f32| x * x * x - 2.0 * x;
        let keys: Vec<[f32; 2]> = [0.0, 0.4, 1.1, 1.5].map(|x| [x, cubic(x)]).to_vec();
        let spline = Spline::new(keys, -2.0, 3.0 * 1.5 * 1.5 - 2.0);
        for i in 0..=30 {
            let x = i as f32 * 0.05;
            assert!((spline.at(x) - cubic(x)).abs() < 1e-5, "{x}: {} for {}", spline.at(x), cubic(x));
        }
    }
}
