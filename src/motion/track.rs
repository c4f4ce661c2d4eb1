//! Keys of one property over time, and what lies between them (glTF 2.0, 3.11 and appendix C). Sampling is stateless.

use glam::{Quat, Vec3};

use super::rotation::{mix, slerp, unit};
use crate::scene::Interpolation;

/// Keys: their times, seconds, strictly growing; and their values, three a key (in-tangent, value, out-tangent) for splines.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Track<V> {
    pub times: Vec<f32>,
    pub interpolation: Interpolation,
    pub values: Vec<V>,
}

/// Where a moment lies among keys.
#[derive(Clone, Copy, Debug, PartialEq)]
enum At {
    Key(usize),
    Between {
        /// The key before.
        key: usize,
        /// Share of the way to the next.
        share: f32,
        /// Length of the way, seconds.
        seconds: f32,
    },
}

fn at(times: &[f32], time: f64) -> At {
    // NaN counts as the beginning.
    let after = times.partition_point(|t| f64::from(*t) <= time);
    if after == 0 {
        return At::Key(0);
    }
    if after >= times.len() {
        return At::Key(times.len() - 1);
    }
    let (from, to) = (times[after - 1], times[after]);
    At::Between { key: after - 1, share: ((time - f64::from(from)) / f64::from(to - from)) as f32, seconds: to - from }
}

/// Shares of value, out-tangent, next value and its in-tangent in a cubic Hermite spline; tangents times the length.
fn hermite(u: f32, seconds: f32) -> [f32; 4] {
    let (u2, u3) = (u * u, u * u * u);
    [2.0 * u3 - 3.0 * u2 + 1.0, seconds * (u3 - 2.0 * u2 + u), -2.0 * u3 + 3.0 * u2, seconds * (u3 - u2)]
}

impl<V: Copy> Track<V> {
    /// A value that stands still.
    pub fn constant(value: V) -> Self {
        Self { times: vec![0.0], interpolation: Interpolation::Step, values: vec![value] }
    }

    /// The value of a key.
    fn value(&self, key: usize) -> V {
        match self.interpolation {
            Interpolation::CubicSpline => self.values[key * 3 + 1],
            Interpolation::Linear | Interpolation::Step => self.values[key],
        }
    }

    /// The same with every value, and for splines tangent, mapped: linear maps commute with interpolation.
    pub fn map(&self, value: impl Fn(V) -> V, tangent: impl Fn(V) -> V) -> Self {
        let is_spline = self.interpolation == Interpolation::CubicSpline;
        let of = |(i, v): (usize, &V)| {
            if is_spline && i % 3 != 1 {
                tangent(*v)
            } else {
                value(*v)
            }
        };
        Self { values: self.values.iter().enumerate().map(of).collect(), ..self.clone_times() }
    }

    fn clone_times(&self) -> Self {
        Self { times: self.times.clone(), interpolation: self.interpolation, values: Vec::new() }
    }
}

impl Track<Quat> {
    pub fn sample(&self, time: f64) -> Quat {
        let (key, share, seconds) = match at(&self.times, time) {
            At::Key(key) => return unit(self.value(key)),
            At::Between { key, share, seconds } => (key, share, seconds),
        };
        match self.interpolation {
            Interpolation::Step => self.values[key],
            Interpolation::Linear => slerp(self.values[key], self.values[key + 1], share),
            Interpolation::CubicSpline => {
                let [p, m, q, n] = hermite(share, seconds);
                let [a, b, c, d] = self.spline(key).map(|q| [q.x, q.y, q.z, q.w]);
                let [x, y, z, w] = std::array::from_fn(|i| p * a[i] + m * b[i] + q * c[i] + n * d[i]);
                unit(Quat::from_xyzw(x, y, z, w))
            }
        }
    }
}

impl Track<Vec3> {
    pub fn sample(&self, time: f64) -> Vec3 {
        let (key, share, seconds) = match at(&self.times, time) {
            At::Key(key) => return self.value(key),
            At::Between { key, share, seconds } => (key, share, seconds),
        };
        match self.interpolation {
            Interpolation::Step => self.values[key],
            Interpolation::Linear => mix(self.values[key], self.values[key + 1], share),
            Interpolation::CubicSpline => {
                let [p, m, q, n] = hermite(share, seconds);
                let [a, b, c, d] = self.spline(key).map(|v| v.to_array());
                Vec3::from_array(std::array::from_fn(|i| p * a[i] + m * b[i] + q * c[i] + n * d[i]))
            }
        }
    }
}

impl<V: Copy> Track<V> {
    /// Value and out-tangent of a key, value and in-tangent of the next.
    fn spline(&self, key: usize) -> [V; 4] {
        let at = key * 3;
        [self.values[at + 1], self.values[at + 2], self.values[at + 4], self.values[at + 3]]
    }
}

/// Weights of several morph targets: the values of each key follow each other.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WeightTrack {
    pub targets: usize,
    pub keys: Track<f32>,
}

impl WeightTrack {
    /// The weight of one target.
    pub fn sample(&self, target: usize, time: f64) -> f32 {
        let Track { times, interpolation, values } = &self.keys;
        let n = self.targets;
        let per_key = if *interpolation == Interpolation::CubicSpline {
            3
        } else {
            1
        };
        let of = |key: usize, part: usize| values[(key * per_key + part) * n + target];
        match at(times, time) {
            At::Key(key) => of(key, per_key / 2),
            At::Between { key, share, seconds } => match interpolation {
                Interpolation::Step => of(key, 0),
                Interpolation::Linear => of(key, 0) * (1.0 - share) + of(key + 1, 0) * share,
                Interpolation::CubicSpline => {
                    let [p, m, q, n] = hermite(share, seconds);
                    p * of(key, 1) + m * of(key, 2) + q * of(key + 1, 1) + n * of(key + 1, 0)
                }
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(interpolation: Interpolation, values: &[f32]) -> Track<Vec3> {
        Track { times: vec![1.0, 2.0, 4.0], interpolation, values: values.iter().map(|v| Vec3::splat(*v)).collect() }
    }

    #[test]
    fn ends_hold_and_steps_jump_at_their_key() {
        for interpolation in [Interpolation::Step, Interpolation::Linear] {
            let track = track(interpolation, &[1.0, 3.0, 5.0]);
            for (time, expected) in [(0.0, 1.0), (1.0, 1.0), (2.0, 3.0), (4.0, 5.0), (9.0, 5.0), (f64::NAN, 1.0)] {
                assert_eq!(track.sample(time).x, expected, "{interpolation:?} at {time}");
            }
        }
        assert_eq!(track(Interpolation::Step, &[1.0, 3.0, 5.0]).sample(1.999).x, 1.0);
        assert_eq!(track(Interpolation::Linear, &[1.0, 3.0, 5.0]).sample(3.0).x, 4.0);
    }

    #[test]
    fn splines_pass_their_keys_with_their_slopes() {
        // In-tangent, value, out-tangent; a parabola x² is one such spline.
        let of = |t: f32| [2.0 * t, t * t, 2.0 * t];
        let track = track(Interpolation::CubicSpline, &[of(1.0), of(2.0), of(4.0)].concat());
        for time in [1.0, 1.3, 2.0, 2.5, 3.9, 4.0] {
            assert!((f64::from(track.sample(time).x) - time * time).abs() < 1e-5, "{time}");
        }
        let weights = WeightTrack {
            targets: 2,
            keys: Track {
                times: vec![0.0, 1.0],
                interpolation: Interpolation::Linear,
                values: vec![0.0, 1.0, 1.0, 0.0],
            },
        };
        assert_eq!((weights.sample(0, 0.25), weights.sample(1, 0.25)), (0.25, 0.75));
    }
}
