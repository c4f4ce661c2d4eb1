//! Diffusion profiles: how far light goes below a surface (Christensen and Burley 2015), and what becomes of it.

use serde::{Deserialize, Serialize};

use super::gaussians::GaussianSum;
use crate::material::plain_parts;

/// When the colour of a surface takes part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Texturing {
    /// After light has scattered: pores stay sharp.
    #[default]
    Post,
    /// Half before and half after, a root each: colours bleed into each other.
    PreAndPost,
}

/// How light that comes through a body is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Transmission {
    /// By a thickness that is painted or baked, without shadow: ears, leaves.
    #[default]
    Thin,
    /// By the way of light in the shadow map: a head, a hand.
    Thick,
}

plain_parts!(Texturing, Transmission);

crate::part! {
    /// How light scatters below a surface: a normalised exponential for each colour (Burley).
    #[derive(Copy)]
    DiffusionProfile {
        /// Burley's d of red, green and blue, mm: how far light goes before it leaves.
        scattering_distance_mm: [f32; 3] = [0.757, 0.322, 0.2], in 0.001..=1000.0;
        /// Index of refraction: what the surface mirrors straight on.
        ior: f32 = 1.4, in 1.0..=3.0;
        /// Metres that a metre of the scene stands for.
        world_scale: f32 = 1.0, in 0.001..=1000.0;
        /// When the colour takes part: `post` or `pre-and-post`.
        texturing: Texturing = Texturing::Post;
        /// How light comes through: `thin` or `thick`.
        transmission: Transmission = Transmission::Thin;
        /// What light that comes through is multiplied by, linear.
        transmission_tint: [f32; 3] = [1.0; 3], in 0.0..=10.0;
        /// Thickness where a map is 0 and where it is 1, mm.
        thickness_remap_mm: [f32; 2] = [0.0, 8.15], in 0.0..=1000.0;
    }
}

/// Share of the light that `max_radius_mm` holds: the last of 21 rings is half used up, as HDRP's inspector shows it.
const SHARE_WITHIN_MAX_RADIUS: f32 = 20.5 / 21.0;

/// Thickness range of a table in units of the largest d: what is thicker lets less than 0.0003 through by the profile,
/// 0.014 by a volume.
const THICKNESS_RANGE: f32 = 24.0;

/// Least radius in units of d: Burley's profile has a pole at 0.
const LEAST_RADIUS: f64 = 1e-4;

/// What comes through a volume that scatters, `sum share exp(-rate t / d)`: (share, rate).
///
/// Fitted to a path-traced wedge (random walk, albedo 0.8, d = 0.757, 0.322 and 0.2 mm), its radiance divided by that
/// of a plate that lets all through. The one curve serves the three colours: from 1 mm to 10 mm it is within 0.023 of
/// each of the 27 measured values, within 0.014 of those at 0.5 mm in green and blue. Red at 0.5 mm measures 0.09 more:
/// so near its thin end the wedge is no plate.
const VOLUME: [(f64, f64); 2] = [(0.39, 0.141), (0.61, 0.362)];

impl DiffusionProfile {
    /// Reflectance `R(r)` at distance r from where light enters, 1/mm^2, albedo 1: Burley's normalised diffusion.
    ///
    /// Finite at r = 0: below a ten-thousandth of d it is that of this distance.
    pub fn reflectance(&self, r_mm: f32) -> [f32; 3] {
        self.each(|d| {
            let x = (f64::from(r_mm.abs()) / d).max(LEAST_RADIUS);
            ((-x).exp() + (-x / 3.0).exp()) / (8.0 * std::f64::consts::PI * d * d * x)
        })
    }

    /// Line spread at distance x from a thin line of light, 1/mm, by a sum of Gaussians.
    ///
    /// Within 1.5 % of Burley's from 0.05 d to 15 d; finite at x = 0, where Burley's is not.
    pub fn line_spread(&self, x_mm: f32) -> [f32; 3] {
        GaussianSum::of(self).line_spread(f64::from(x_mm)).map(|v| v as f32)
    }

    /// Share of light that leaves within the radius, 0 to 1.
    pub fn cdf(&self, r_mm: f32) -> [f32; 3] {
        // As 1 - T it would lose the digits of small radii.
        self.each(|d| {
            let x = f64::from(r_mm.max(0.0)) / d;
            -0.25 * (-x).exp_m1() - 0.75 * (-x / 3.0).exp_m1()
        })
    }

    /// Radius within which the share `u` (0 to 1) of the light of a channel (0 red, 1 green, 2 blue) leaves, mm.
    ///
    /// `y^3 + 3 y = 4 (1 - u)` with `y = exp(-r / 3d)` has the one root `2 sinh(asinh(2 (1 - u)) / 3)`. Finite at 1.
    pub fn inverse_cdf(&self, u: f32, channel: usize) -> f32 {
        let d = self.distance(channel);
        let beyond = 1.0 - f64::from(u.clamp(0.0, 1.0 - f32::EPSILON / 2.0));
        let y = 2.0 * ((2.0 * beyond).asinh() / 3.0).sinh();
        (-3.0 * d * y.ln()).max(0.0) as f32
    }

    /// Radius that holds all but a forty-second of the light in the channel that scatters farthest, mm.
    pub fn max_radius_mm(&self) -> f32 {
        let d = &self.scattering_distance_mm;
        let farthest = (1..3).fold(0, |best, c| if d[c] > d[best] { c } else { best });
        self.inverse_cdf(SHARE_WITHIN_MAX_RADIUS, farthest)
    }

    /// Share of light that comes through a plate, 0 to 1, by the profile alone: 1 - CDF. Thickness in mm.
    ///
    /// That is `int 2 pi r R(hypot(r, t)) dr`, and too dark: see [`Self::transmittance_of_volume`].
    pub fn transmittance(&self, thickness_mm: f32) -> [f32; 3] {
        self.each(|d| {
            let x = f64::from(thickness_mm.max(0.0)) / d;
            0.25 * (-x).exp() + 0.75 * (-x / 3.0).exp()
        })
    }

    /// Share of light that comes through a plate of a true volume, 0 to 1. Thickness in mm.
    ///
    /// `0.39 exp(-0.141 t / d) + 0.61 exp(-0.362 t / d)`, fitted to a path-traced wedge: 1.3 times what the profile
    /// gives where t = 1.3 d, 3 times where t = 8 d.
    pub fn transmittance_of_volume(&self, thickness_mm: f32) -> [f32; 3] {
        self.each(|d| {
            let x = f64::from(thickness_mm.max(0.0)) / d;
            VOLUME.iter().map(|(share, rate)| share * (-rate * x).exp()).sum()
        })
    }

    /// Largest thickness that tables of transmittance hold, mm: 24 of the largest d.
    pub fn thickness_range_mm(&self) -> f32 {
        THICKNESS_RANGE * self.scattering_distance_mm.iter().copied().fold(0.0, f32::max)
    }

    /// Share that is mirrored straight on, 0 to 1: Fresnel's of the index of refraction.
    pub fn f0(&self) -> f32 {
        let root = (self.ior - 1.0) / (self.ior + 1.0);
        root * root
    }

    /// Burley's d of a channel, mm.
    pub(super) fn distance(&self, channel: usize) -> f64 {
        f64::from(self.scattering_distance_mm[channel])
    }

    fn each(&self, of: impl Fn(f64) -> f64) -> [f32; 3] {
        std::array::from_fn(|c| of(self.distance(c)) as f32)
    }
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;

    fn number(v: &Value) -> f32 {
        v.as_f64().expect("a number") as f32
    }

    fn grey(d: f32) -> DiffusionProfile {
        DiffusionProfile { scattering_distance_mm: [d; 3], ..DiffusionProfile::default() }
    }

    #[test]
    fn burleys_profile_is_that_of_the_vectors() {
        let text = include_str!("../../tests/oracles/burley_profile.json");
        let file: Value = serde_json::from_str(text).expect("vectors");
        for case in file["cases"].as_array().expect("cases") {
            let (of, r) = (grey(number(&case["d"])), number(&case["r"]));
            let expected = number(&case["R"]);
            assert!((of.reflectance(r)[0] - expected).abs() <= 1e-5 * expected, "{case}");
            assert!((of.cdf(r)[1] - number(&case["cdf"])).abs() <= 1e-5, "{case}");
            assert!((of.transmittance(r)[2] - number(&case["T"])).abs() <= 1e-5, "{case}");
        }
        for case in file["inverse"].as_array().expect("inverse") {
            let (of, u, r) = (grey(number(&case["d"])), number(&case["u"]), number(&case["r"]));
            // The share itself is rounded: near 1 that moves the radius.
            let rounding = 2e-7 / (1.0 - u) * 3.0 * number(&case["d"]);
            let found = of.inverse_cdf(u, 0);
            assert!((found - r).abs() <= 1e-5 * r.max(1e-2) + rounding, "{case}: {found}");
        }
    }

    #[test]
    fn radius_that_holds_the_light_is_that_of_hdrp() {
        let of =
            DiffusionProfile { scattering_distance_mm: [0.2, 0.756_862_8, 0.321_6], ..DiffusionProfile::default() };
        assert!((of.max_radius_mm() - 7.834_259).abs() < 1e-4, "{}", of.max_radius_mm());
    }

    #[test]
    fn extremes_of_what_is_valid_stay_finite() {
        for d in [0.001, 1000.0] {
            let of = grey(d);
            for r in [0.0, 1e-6, 1.0, 1e6] {
                let all = [of.reflectance(r), of.cdf(r), of.transmittance(r), of.line_spread(r)];
                assert!(all.as_flattened().iter().all(|v| v.is_finite() && *v >= 0.0), "{d} {r}: {all:?}");
            }
            for u in [-1.0, 0.0, 0.5, 1.0, 2.0] {
                assert!(of.inverse_cdf(u, 2).is_finite());
            }
        }
    }

    #[test]
    fn less_light_comes_through_what_is_thicker_and_red_comes_farthest() {
        let of = DiffusionProfile::default();
        assert_eq!((of.transmittance(0.0), of.transmittance_of_volume(0.0)), ([1.0; 3], [1.0; 3]));
        let mut last = ([1.0; 3], [1.0; 3]);
        for step in 1..200 {
            let t = 0.05 * step as f32;
            let now = (of.transmittance(t), of.transmittance_of_volume(t));
            for c in 0..3 {
                assert!(now.0[c] < last.0[c] && now.1[c] < last.1[c], "{t}");
                assert!(now.1[c] > now.0[c], "a volume lets more through: {t}");
            }
            assert!(now.0.is_sorted_by(|a, b| a > b) && now.1.is_sorted_by(|a, b| a > b), "{t}: {now:?}");
            last = now;
        }
        assert!(of.transmittance_of_volume(of.thickness_range_mm()).iter().all(|v| *v < 0.014));
        assert!(of.transmittance(of.thickness_range_mm()).iter().all(|v| *v < 3e-4));
    }

    #[test]
    fn transmittance_is_that_of_the_vectors() {
        let text = include_str!("../../tests/oracles/transmittance.json");
        let file: Value = serde_json::from_str(text).expect("vectors");
        let d = [0.756_862_8, 0.321_568_64, 0.200_000_02];
        let of = DiffusionProfile { scattering_distance_mm: d, ..DiffusionProfile::default() };
        for case in file["cases"].as_array().expect("cases") {
            let found = of.transmittance(number(&case["thickness_mm"]));
            for c in 0..3 {
                assert!((found[c] - number(&case["T_burley"][c])).abs() <= 1e-5, "{case}: {found:?}");
            }
        }
    }

    #[test]
    fn transmittance_of_a_volume_is_that_of_the_wedge() {
        // Radiance of the wedge by thickness, mm, over that of a plate that lets all through (0.8 cos 16.4 degrees).
        let wedge = [
            (1.0, [0.5523, 0.3363, 0.222]),
            (2.0, [0.3684, 0.17, 0.089]),
            (3.0, [0.2697, 0.103, 0.0427]),
            (5.0, [0.1609, 0.0354, 0.0079]),
            (8.0, [0.0831, 0.0073, 0.0]),
        ];
        for (thickness, radiance) in wedge {
            let found = DiffusionProfile::default().transmittance_of_volume(thickness);
            for c in 0..3 {
                let expected: f32 = radiance[c] / (0.8 * 0.959);
                assert!((found[c] - expected).abs() <= 0.025, "{thickness}: {found:?}");
            }
        }
    }

    #[test]
    fn straight_on_skin_mirrors_the_28_thousandth_part() {
        assert!((DiffusionProfile::default().f0() - 0.027_778).abs() < 1e-5);
    }
}
