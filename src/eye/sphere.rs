//! The sphere that most of a surface lies on.

use glam::{DMat3, DVec3};

/// A point of a surface, and how much of the surface it stands for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub at: DVec3,
    /// Square metres.
    pub area: f64,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Sphere {
    pub centre: DVec3,
    pub radius: f64,
}

/// What lies so much off the sphere hardly counts at first, and in the end; shares of the radius.
const LOOSE: f64 = 0.3;
const TIGHT: f64 = 0.01;
/// Rounds from the one to the other, and with the last.
const ROUNDS: i32 = 40;
const TIGHTENING: f64 = 0.85;

impl Sphere {
    /// Least squares, in rounds in which what lies off the sphere counts less and less (weights of Geman and McClure): a cornea,
    /// an iris or a socket takes no part in the end. `None` where points lie in a plane or on a line.
    pub fn through(samples: &[Sample]) -> Option<Self> {
        let mut sphere = Self::weighted(samples, |_| 1.0)?;
        for round in 0..ROUNDS {
            let width = (LOOSE * TIGHTENING.powi(round)).max(TIGHT);
            let of = sphere;
            sphere = Self::weighted(samples, |p| {
                let off = of.height(p) / width;
                (1.0 + off * off).powi(-2)
            })?;
        }
        Some(sphere)
    }

    /// Height of a point above it, shares of the radius.
    pub fn height(&self, point: DVec3) -> f64 {
        point.distance(self.centre) / self.radius - 1.0
    }

    /// Least squares of |p|² = 2 p·c + k, about the mean of the points and in units of their spread.
    fn weighted(samples: &[Sample], weight: impl Fn(DVec3) -> f64) -> Option<Self> {
        let weights: Vec<f64> = samples.iter().map(|s| s.area * weight(s.at)).collect();
        let all = || samples.iter().zip(&weights);
        let sum: f64 = weights.iter().sum();
        let mean = all().map(|(s, w)| s.at * *w).sum::<DVec3>() / sum;
        let scale = (all().map(|(s, w)| s.at.distance_squared(mean) * w).sum::<f64>() / sum).sqrt();
        let (mut normal, mut right) = (DMat3::ZERO, DVec3::ZERO);
        for (s, w) in all() {
            let p = (s.at - mean) / scale;
            normal += DMat3::from_cols(p * p.x, p * p.y, p * p.z) * (*w / sum);
            // The mean of |p|² is 1; about the mean, k does not depend on c.
            right += p * ((p.length_squared() - 1.0) * 0.5 * w / sum);
        }
        // Of points in a plane it is zero.
        let is_solid = normal.determinant() > 1e-12;
        let centre = is_solid.then(|| normal.inverse() * right)?;
        let radius = (1.0 + centre.length_squared()).sqrt();
        let found = Self { centre: mean + centre * scale, radius: radius * scale };
        (found.centre.is_finite() && found.radius.is_finite()).then_some(found)
    }
}
