//! What a consumer compares a threshold map with: the measure of the light's angle.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::{Error, Result};

/// How the angle of the light becomes a threshold between 0 and 1. The angle is counted from the front of the face: 0 in
/// front, 180 degrees behind. A texel is lit while its value is greater than the threshold, so that what turns dark late
/// is bright in the map.
///
/// Keys are stored by angle: the same drawings serve every consumer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    /// Angle over 180 degrees, which is 1 - θ/180 of the angle θ from behind. What
    /// [`FaceShadow`](crate::material::FaceShadow) reads by default.
    #[default]
    Linear,
    /// (1 - cos angle) / 2: shaders that compare with the dot product of front and light, over 0 to 180 degrees.
    Genshin,
    /// lilToon's `0.5 - cos angle`, which is 0 at 60 and 1 at 120 degrees: outside of them the whole map is lit or dark.
    Liltoon,
    /// Values at angles in degrees, `[[0, 0.0], [90, 1.0]]`, with straight lines between and the outer values beyond:
    /// at least two, both columns growing, or values falling for a shader in which light has the lower value.
    #[serde(untagged)]
    Points(Vec<[f64; 2]>),
}

impl Profile {
    /// Refuses points that are no function of the angle.
    ///
    /// # Errors
    /// [`Error::Argument`] that names the point.
    pub fn check(&self) -> Result<()> {
        let Self::Points(points) = self else { return Ok(()) };
        let fault = |message: String| Err(Error::Argument { what: "profile".into(), message });
        if !(2..=256).contains(&points.len()) {
            return fault(format!("has {} points; expected 2 to 256", points.len()));
        }
        let in_range = |[angle, value]: &&[f64; 2]| (0.0..=180.0).contains(angle) && (0.0..=1.0).contains(value);
        if let Some([angle, value]) = points.iter().find(|p| !in_range(p)) {
            return fault(format!(
                "has the point [{angle}, {value}]; expected an angle of 0 to 180 and a value of 0 to 1"
            ));
        }
        for pair in points.windows(2) {
            let [a, b] = pair else { continue };
            let turned = self.is_falling() != (b[1] < a[1]);
            if b[0] <= a[0] || b[1] == a[1] || turned {
                return fault(format!(
                    "goes from {a:?} to {b:?}; expected growing angles, and values that all grow or all fall"
                ));
            }
        }
        Ok(())
    }

    /// Whether light has the lower value: the map is the negative of one that grows.
    #[must_use]
    pub fn is_falling(&self) -> bool {
        matches!(self, Self::Points(points) if points.first().zip(points.last()).is_some_and(|(a, b)| b[1] < a[1]))
    }

    /// Threshold at an angle in radians, as if it grew with the angle (of a falling profile: 1 minus the value). No map
    /// can hold what lies outside 0..=1.
    #[must_use]
    pub fn threshold(&self, angle_rad: f64) -> f64 {
        match self {
            Self::Linear => angle_rad / PI,
            Self::Genshin => 0.5 - 0.5 * angle_rad.cos(),
            Self::Liltoon => 0.5 - angle_rad.cos(),
            Self::Points(points) => {
                let degrees = angle_rad.to_degrees();
                let after = points.partition_point(|p| p[0] < degrees).min(points.len().saturating_sub(1));
                let (Some(a), Some(b)) = (points.get(after.saturating_sub(1)), points.get(after)) else { return 0.0 };
                let share = ((degrees - a[0]) / (b[0] - a[0]).max(1e-12)).clamp(0.0, 1.0);
                let value = if after == 0 { a[1] } else { a[1] + (b[1] - a[1]) * share };
                if self.is_falling() { 1.0 - value } else { value }
            }
        }
    }

    /// Angle in radians whose threshold this is, 0..=π.
    #[must_use]
    pub fn angle_rad(&self, threshold: f64) -> f64 {
        match self {
            Self::Linear => threshold * PI,
            Self::Genshin => (1.0 - 2.0 * threshold).clamp(-1.0, 1.0).acos(),
            Self::Liltoon => (0.5 - threshold).clamp(-1.0, 1.0).acos(),
            Self::Points(points) => {
                let value = if self.is_falling() { 1.0 - threshold } else { threshold };
                let before = |p: &[f64; 2]| if self.is_falling() { p[1] > value } else { p[1] < value };
                let after = points.partition_point(before).clamp(1, points.len().saturating_sub(1).max(1));
                let (Some(a), Some(b)) = (points.get(after - 1), points.get(after)) else { return 0.0 };
                (a[0] + (b[0] - a[0]) * ((value - a[1]) / (b[1] - a[1])).clamp(0.0, 1.0)).to_radians()
            }
        }
        .clamp(0.0, PI)
    }

    /// Angles between which thresholds differ, radians.
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        match self {
            Self::Linear | Self::Genshin => [0.0, PI],
            Self::Liltoon => [PI / 3.0, PI * 2.0 / 3.0],
            Self::Points(points) => {
                let at = |p: Option<&[f64; 2]>| p.map_or(0.0, |p| p[0].to_radians());
                [at(points.first()), at(points.last())]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(profile: &Profile, degrees: f64) -> f64 {
        profile.threshold(degrees.to_radians())
    }

    #[test]
    fn consumers_find_their_own_measure() {
        let close = |a: f64, b: f64| assert!((a - b).abs() < 1e-12, "{a} for {b}");
        close(at(&Profile::Linear, 45.0), 0.25);
        close(at(&Profile::Genshin, 60.0), 0.25);
        close(at(&Profile::Liltoon, 90.0), 0.5);
        close(at(&Profile::Liltoon, 60.0), 0.0);
        assert!(at(&Profile::Liltoon, 30.0) < 0.0 && at(&Profile::Liltoon, 150.0) > 1.0);
        let points = Profile::Points(vec![[30.0, 0.1], [60.0, 0.5], [90.0, 0.7]]);
        for (angle, value) in [(0.0, 0.1), (30.0, 0.1), (45.0, 0.3), (60.0, 0.5), (75.0, 0.6), (180.0, 0.7)] {
            close(at(&points, angle), value);
        }
        close(at(&Profile::Points(vec![[0.0, 1.0], [90.0, 0.0]]), 45.0), 0.5);
        close(at(&Profile::Points(vec![[0.0, 1.0], [90.0, 0.0]]), 90.0), 1.0);
    }

    #[test]
    fn angles_come_back() {
        let rising = Profile::Points(vec![[0.0, 0.1], [60.0, 0.5], [180.0, 0.7]]);
        let falling = Profile::Points(vec![[0.0, 1.0], [60.0, 0.2], [180.0, 0.0]]);
        for profile in [Profile::Linear, Profile::Genshin, Profile::Liltoon, rising, falling] {
            for degrees in [60.0, 61.0, 75.0, 90.0, 119.0] {
                let angle = profile.angle_rad(at(&profile, degrees)).to_degrees();
                assert!((angle - degrees).abs() < 1e-5, "{profile:?}: {angle} for {degrees}");
            }
        }
    }

    #[test]
    fn points_that_turn_back_are_refused() {
        let check = |points: &[[f64; 2]]| Profile::Points(points.to_vec()).check();
        assert!(check(&[[0.0, 0.0], [90.0, 1.0]]).is_ok());
        assert!(check(&[[0.0, 1.0], [90.0, 0.0]]).is_ok());
        for points in [
            &[[0.0, 0.0]][..],
            &[[0.0, 0.0], [0.0, 1.0]],
            &[[0.0, 0.0], [10.0, 0.0]],
            &[[0.0, 0.0], [10.0, 0.5], [20.0, 0.4]],
            &[[0.0, f64::NAN], [10.0, 0.5]],
            &[[0.0, 0.0], [181.0, 0.5]],
        ] {
            assert!(check(points).is_err(), "{points:?}");
        }
    }
}
