//! The course of a lock: a smooth curve through its guide, measured by length.

use glam::Vec3;

use crate::head::shape::SKULL_CENTER;

const SAMPLES: usize = 96;
/// Height of the ring of light at the front of the head and at its back, metres.
const BAND_Y: [f32; 2] = [1.503, 1.492];

/// A curve by its length.
pub(super) struct Course {
    points: Vec<Vec3>,
    lengths: Vec<f32>,
}

/// Point of the Catmull-Rom curve through the guide, `t` in 0..1.
fn along(guide: &[Vec3], t: f32) -> Vec3 {
    let last = guide.len() as isize - 1;
    let at = t.clamp(0.0, 1.0) * last as f32;
    let i = (at.floor() as isize).clamp(0, last - 1);
    let get = |k: isize| {
        if k < 0 {
            guide[0] * 2.0 - guide[1]
        } else if k > last {
            guide[last as usize] * 2.0 - guide[last as usize - 1]
        } else {
            guide[k as usize]
        }
    };
    // Centripetal, so that uneven guides give no bulges.
    let p = [get(i - 1), get(i), get(i + 1), get(i + 2)];
    let mut knots = [0.0; 4];
    for k in 0..3 {
        knots[k + 1] = knots[k] + p[k].distance(p[k + 1]).sqrt().max(1e-4);
    }
    let t = knots[1] + (knots[2] - knots[1]) * (at - i as f32);
    let mix = |a: Vec3, b: Vec3, i: usize, k: usize| a + (b - a) * ((t - knots[i]) / (knots[k] - knots[i]));
    let (a, b, c) = (mix(p[0], p[1], 0, 1), mix(p[1], p[2], 1, 2), mix(p[2], p[3], 2, 3));
    mix(mix(a, b, 0, 2), mix(b, c, 1, 3), 1, 2)
}

/// Away from the head, and below it away from the neck.
fn outward(p: Vec3) -> Vec3 {
    let below = ((SKULL_CENTER.y - p.y) / 0.08).clamp(0.0, 1.0);
    let from = SKULL_CENTER.with_y(p.y.min(SKULL_CENTER.y)) - Vec3::Z * (0.008 * below);
    (p - from).normalize_or(Vec3::Z)
}

impl Course {
    /// Through these points.
    pub(super) fn new(guide: &[Vec3]) -> Self {
        let points: Vec<Vec3> = (0..=SAMPLES).map(|i| along(guide, i as f32 / SAMPLES as f32)).collect();
        let mut lengths = vec![0.0];
        for pair in points.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + pair[0].distance(pair[1]));
        }
        Self { points, lengths }
    }

    /// Length, metres.
    pub(super) fn total(&self) -> f32 {
        self.lengths[SAMPLES]
    }

    /// Point at a share of the length.
    fn at(&self, share: f32) -> Vec3 {
        let want = share.clamp(0.0, 1.0) * self.total();
        let i = self.lengths.iter().rposition(|l| *l <= want).unwrap_or(0).min(SAMPLES - 1);
        let t = (want - self.lengths[i]) / (self.lengths[i + 1] - self.lengths[i]).max(1e-9);
        self.points[i].lerp(self.points[i + 1], t)
    }

    /// Point, direction to the tip, across to the right as seen from outside, and outwards; rolled about the direction.
    pub(super) fn frame(&self, t: f32, roll: f32) -> [Vec3; 4] {
        let p = self.at(t);
        let along = (self.at(t + 0.025) - self.at(t - 0.025)).normalize_or(Vec3::NEG_Y);
        let out = outward(p);
        let out = (out - along * out.dot(along)).normalize_or(Vec3::Z);
        let side = out.cross(along);
        let (sin, cos) = roll.sin_cos();
        [p, along, side * cos + out * sin, out * cos - side * sin]
    }

    /// Where it crosses the ring of light the last time, as a share of the length.
    pub(super) fn ring(&self) -> Option<f32> {
        let over = |p: Vec3| p.y - (BAND_Y[1] + (BAND_Y[0] - BAND_Y[1]) * ((p.z + 0.11) / 0.2).clamp(0.0, 1.0));
        (0..SAMPLES)
            .rfind(|i| over(self.points[*i]) >= 0.0 && over(self.points[i + 1]) < 0.0)
            .map(|i| (self.lengths[i] / self.total()).clamp(0.04, 0.9))
    }

    /// Shares of the length at which sections stand: denser where it bends, and towards the tip, which is left out.
    pub(super) fn stations(&self, count: usize) -> Vec<f32> {
        let mut effort = vec![0.0];
        for i in 0..SAMPLES {
            let (a, b) = (
                self.points[i + 1] - self.points[i],
                self.points[(i + 2).min(SAMPLES)] - self.points[(i + 1).min(SAMPLES - 1)],
            );
            let bend = if a.length_squared() > 0.0 && b.length_squared() > 0.0 {
                a.angle_between(b)
            } else {
                0.0
            };
            effort.push(effort[i] + a.length() * (1.0 + 0.6 * self.lengths[i] / self.total()) + 0.13 * bend);
        }
        (0..count)
            .map(|s| {
                let want = effort[SAMPLES] * s as f32 / (count - 1) as f32;
                let i = effort.iter().rposition(|e| *e <= want).unwrap_or(0).min(SAMPLES - 1);
                let part = ((want - effort[i]) / (effort[i + 1] - effort[i]).max(1e-9)).min(1.0);
                0.975 * (self.lengths[i] + (self.lengths[i + 1] - self.lengths[i]) * part) / self.total()
            })
            .collect()
    }
}
