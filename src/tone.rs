//! Colours by lightness, chroma and hue, in which a painter's rules can be said.
//!
//! Source: Björn Ottosson, "A perceptual color space for image processing" (2020), Oklab and its polar form.

use std::f32::consts::PI;
use std::sync::LazyLock;

use glam::{Mat3, Vec2, Vec3};

use crate::smoothstep::smoothstep;

/// A colour in Oklch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Tone {
    /// Lightness as it is perceived: 0 black, 1 white.
    pub(crate) lightness: f32,
    /// Distance from grey: pure red has 0.26.
    pub(crate) chroma: f32,
    /// Hue, radians: pink 0, yellow a third of a turn, blue three quarters.
    pub(crate) hue_rad: f32,
}

const LMS_FROM_LINEAR: Mat3 = Mat3::from_cols_array(&[
    0.412_221_46,
    0.211_903_5,
    0.088_302_46,
    0.536_332_55,
    0.680_699_5,
    0.281_718_85,
    0.051_445_995,
    0.107_396_96,
    0.629_978_7,
]);
const LAB_FROM_ROOTS: Mat3 = Mat3::from_cols_array(&[
    0.210_454_26,
    1.977_998_5,
    0.025_904_037,
    0.793_617_8,
    -2.428_592_2,
    0.782_771_77,
    -0.004_072_047,
    0.450_593_7,
    -0.808_675_77,
]);

/// Of the second matrix, and of the first.
static INVERSES: LazyLock<[Mat3; 2]> = LazyLock::new(|| [LAB_FROM_ROOTS.inverse(), LMS_FROM_LINEAR.inverse()]);

/// Lightness, and how red and how yellow, of a linear colour: the rectangular form of a [`Tone`].
pub(crate) fn oklab(linear: [f32; 3]) -> Vec3 {
    let lms = LMS_FROM_LINEAR * Vec3::from(linear).max(Vec3::ZERO);
    LAB_FROM_ROOTS * Vec3::new(lms.x.cbrt(), lms.y.cbrt(), lms.z.cbrt())
}

impl Tone {
    /// Of a linear colour.
    pub(crate) fn of(linear: [f32; 3]) -> Self {
        let [lightness, a, b] = oklab(linear).to_array();
        Self { lightness, chroma: a.hypot(b), hue_rad: b.atan2(a) }
    }

    /// The linear colour, nearer to grey where it would leave 0..=1.
    pub(crate) fn to_linear(self) -> [f32; 3] {
        let fits = |chroma: f32| {
            let linear = self.with_chroma(chroma).unbound();
            linear.min_element() >= -1e-4 && linear.max_element() <= 1.0001
        };
        let [mut inside, mut outside] = [0.0, self.chroma];
        if fits(outside) {
            inside = outside;
        } else {
            // Halved and not stepped, so that neighbours stay neighbours.
            for _ in 0..12 {
                let middle = 0.5 * (inside + outside);
                *(if fits(middle) { &mut inside } else { &mut outside }) = middle;
            }
        }
        self.with_chroma(inside).unbound().clamp(Vec3::ZERO, Vec3::ONE).to_array()
    }

    fn unbound(self) -> Vec3 {
        let ab = Vec2::from_angle(self.hue_rad) * self.chroma;
        let [roots_from_lab, linear_from_lms] = *INVERSES;
        let roots = roots_from_lab * Vec3::new(self.lightness, ab.x, ab.y);
        linear_from_lms * (roots * roots * roots)
    }

    pub(crate) fn with_chroma(self, chroma: f32) -> Self {
        Self { chroma, ..self }
    }

    /// How much it is like the skin of people, fair to dark: 0..1.
    pub(crate) fn like_skin(self) -> f32 {
        smoothstep(0.45, 0.6, self.hue_rad)
            * smoothstep(1.5, 1.25, self.hue_rad)
            * smoothstep(0.015, 0.035, self.chroma)
            * smoothstep(0.2, 0.15, self.chroma)
            * smoothstep(0.35, 0.5, self.lightness)
    }

    /// How far another is: 0.02 is seen side by side, white and black are 1 apart.
    pub(crate) fn distance(self, other: Self) -> f32 {
        let ab = |t: Self| Vec2::from_angle(t.hue_rad) * t.chroma;
        (ab(self) - ab(other)).length().hypot(self.lightness - other.lightness)
    }

    /// Between this and another, by a share of that.
    pub(crate) fn mixed(self, other: Self, share: f32) -> Self {
        let ab = |t: Self| Vec2::from_angle(t.hue_rad) * t.chroma;
        let ab = ab(self).lerp(ab(other), share);
        let lightness = self.lightness + (other.lightness - self.lightness) * share;
        Self { lightness, chroma: ab.length(), hue_rad: ab.y.atan2(ab.x) }
    }

    /// Its hue turned towards another one by at most an angle.
    pub(crate) fn towards(self, hue_rad: f32, most_rad: f32) -> Self {
        let way = (hue_rad - self.hue_rad + PI).rem_euclid(2.0 * PI) - PI;
        Self { hue_rad: self.hue_rad + way.clamp(-most_rad, most_rad), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Srgb;

    #[test]
    fn tones_return_and_stand_where_the_source_says() {
        for hex in ["#ff0000", "#00ff00", "#0000ff", "#ffffff", "#808080", "#1a1a24", "#ffd24a"] {
            let color = Srgb::from_hex(hex).unwrap();
            assert_eq!(crate::color::LinearRgb(Tone::of(color.to_linear().0).to_linear()).to_srgb(), color, "{hex}");
        }
        // The table of the source: pure red is L .628, a .225, b .126.
        let red = Tone::of([1.0, 0.0, 0.0]);
        assert!((red.lightness - 0.628).abs() < 1e-3 && (red.chroma - 0.2577).abs() < 1e-3, "{red:?}");
        assert!((red.hue_rad.to_degrees() - 29.23).abs() < 0.1, "{red:?}");
    }

    #[test]
    fn what_lies_outside_is_only_paler() {
        let out = Tone { lightness: 0.9, chroma: 0.4, hue_rad: 4.6 };
        let inside = Tone::of(out.to_linear());
        assert!((inside.lightness - 0.9).abs() < 0.01 && inside.chroma < 0.2, "{inside:?}");
    }
}
