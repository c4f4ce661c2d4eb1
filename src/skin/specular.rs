//! How much of the light skin mirrors in all: what is left for scattering.

use std::f64::consts::PI;

use crate::material::SkinSpecular;

/// Heights of the half vector, and turns of it over half a circle, that the quadrature takes.
const HEIGHTS: usize = 96;
const TURNS: usize = 64;

/// A specular of skin with its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Speculars {
    /// Which of them.
    pub(crate) model: SkinSpecular,
    /// Roughness, of which alpha is the square, 0.02 to 1.
    pub(crate) roughness: f32,
    /// What the roughness of the sharp and of the wide lobe is multiplied by; of two lobes only.
    pub(crate) lobes: [f32; 2],
    /// Share of the sharp lobe, 0 to 1; of two lobes only.
    pub(crate) lobe_mix: f32,
    /// Share that is mirrored straight on, 0 to 1.
    pub(crate) f0: f32,
}

/// Share of light from all around that is mirrored towards a viewer at `n_dot_v`, 0 to 1: the directional albedo.
///
/// By reciprocity, also what of light from there is mirrored at all. Within 1e-3 where F0 is that of skin, 2e-3 where
/// it is 1.
pub(crate) fn directional_albedo(of: &Speculars, n_dot_v: f64) -> f64 {
    let alpha = |scale: f32| f64::from((of.roughness * scale).clamp(0.02, 1.0)).powi(2);
    let f0 = f64::from(of.f0);
    let albedo = match of.model {
        SkinSpecular::BlinnPhong => {
            // n + 2 = 2 / alpha^2
            let half_alpha2 = 0.5 * alpha(1.0).powi(2);
            let slope = |rest: f64| -(2.0 * half_alpha2 * rest.ln()).exp_m1();
            mirrored(n_dot_v, f0, slope, kelemen_visibility)
        }
        SkinSpecular::Kelemen => {
            let alpha2 = alpha(1.0).powi(2);
            let slope = |rest: f64| {
                let tan2 = -alpha2 * rest.ln();
                tan2 / (1.0 + tan2)
            };
            mirrored(n_dot_v, f0, slope, kelemen_visibility)
        }
        SkinSpecular::Ggx => ggx(n_dot_v, f0, alpha(1.0)),
        SkinSpecular::DualGgx => {
            let [sharp, wide] = of.lobes.map(|scale| ggx(n_dot_v, f0, alpha(scale)));
            wide + (sharp - wide) * f64::from(of.lobe_mix)
        }
    };
    albedo.clamp(0.0, 1.0)
}

fn ggx(n_dot_v: f64, f0: f64, alpha: f64) -> f64 {
    let alpha2 = alpha * alpha;
    let slope = |rest: f64| alpha2 * (1.0 - rest) / (rest + alpha2 * (1.0 - rest));
    let shadowed = |cosine: f64| (cosine * cosine * (1.0 - alpha2) + alpha2).sqrt();
    let of_view = shadowed(n_dot_v);
    // Smith's of both directions, correlated by their heights.
    mirrored(n_dot_v, f0, slope, |n_dot_l, _| 0.5 / (n_dot_l * of_view + n_dot_v * shadowed(n_dot_l)))
}

/// Of Kelemen and Szirmay-Kalos, G / (4 N.L N.V).
fn kelemen_visibility(_: f64, v_dot_h: f64) -> f64 {
    0.25 / (v_dot_h * v_dot_h)
}

/// `int D F V N.L dL`, as a mean over half vectors drawn by the distribution `D N.H`.
///
/// `sine2` gives sin^2 of the angle of the half vector that leaves the share `rest` (above 0, to 1) outside;
/// `visibility` is of N.L and V.H.
fn mirrored(n_dot_v: f64, f0: f64, sine2: impl Fn(f64) -> f64, visibility: impl Fn(f64, f64) -> f64) -> f64 {
    let side = (1.0 - n_dot_v * n_dot_v).max(0.0).sqrt();
    let turns: [f64; TURNS] = std::array::from_fn(|j| ((j as f64 + 0.5) * PI / TURNS as f64).cos() * side);
    let mut sum = 0.0;
    for i in 0..HEIGHTS {
        // Squared, so that more of the heights stand in the tail.
        let root = 1.0 - (i as f64 + 0.5) / HEIGHTS as f64;
        let s2 = sine2(root * root).clamp(0.0, 1.0);
        let (sine, cosine) = (s2.sqrt(), (1.0 - s2).sqrt());
        if cosine < 1e-9 {
            continue;
        }
        let mut ring = 0.0;
        for turn in turns {
            let v_dot_h = sine * turn + cosine * n_dot_v;
            let n_dot_l = 2.0 * v_dot_h * cosine - n_dot_v;
            if v_dot_h > 0.0 && n_dot_l > 0.0 {
                let fresnel = f0 + (1.0 - f0) * (1.0 - v_dot_h).max(0.0).powi(5);
                ring += fresnel * visibility(n_dot_l, v_dot_h) * n_dot_l * v_dot_h;
            }
        }
        sum += ring * 2.0 * root / cosine;
    }
    4.0 * sum / (HEIGHTS * TURNS) as f64
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;

    const ALL: [SkinSpecular; 4] =
        [SkinSpecular::BlinnPhong, SkinSpecular::Kelemen, SkinSpecular::Ggx, SkinSpecular::DualGgx];

    fn with_alpha(model: SkinSpecular, alpha: f64, f0: f32) -> Speculars {
        Speculars { model, roughness: alpha.sqrt() as f32, lobes: [1.0; 2], lobe_mix: 0.85, f0 }
    }

    fn number(v: &Value) -> f64 {
        v.as_f64().expect("a number")
    }

    fn agrees(text: &str, model: SkinSpecular, [alpha, whole, skin]: [&str; 3]) {
        let file: Value = serde_json::from_str(text).expect("vectors");
        for case in file["energy_table"].as_array().expect("cases") {
            for (name, f0) in [(whole, 1.0), (skin, 0.028)] {
                let of = with_alpha(model, number(&case[alpha]), f0);
                let found = directional_albedo(&of, number(&case["NoV"]));
                assert!((found - number(&case[name])).abs() <= 2e-3, "{name} of {case}: {found}");
            }
        }
    }

    #[test]
    fn albedo_of_kelemen_is_that_of_the_vectors() {
        let text = include_str!("../../tests/oracles/kelemen.json");
        agrees(text, SkinSpecular::Kelemen, ["m", "rho_F1", "rho_skin"]);
    }

    #[test]
    fn albedo_of_ggx_is_that_of_the_vectors() {
        let text = include_str!("../../tests/oracles/dual_lobe_ggx.json");
        agrees(text, SkinSpecular::Ggx, ["alpha", "rho_F1", "rho_F0028"]);
        agrees(text, SkinSpecular::DualGgx, ["alpha", "rho_F1", "rho_F0028"]);
    }

    /// What is mirrored, summed over directions of light.
    fn summed(of: &Speculars, n_dot_v: f64) -> f64 {
        let steps = 500;
        let side = (1.0 - n_dot_v * n_dot_v).sqrt();
        let alpha2 = f64::from(of.roughness).powi(4);
        let mut sum = 0.0;
        for i in 0..steps {
            let n_dot_l = (i as f64 + 0.5) / steps as f64;
            for j in 0..steps {
                let x = ((j as f64 + 0.5) * PI / steps as f64).cos() * (1.0 - n_dot_l * n_dot_l).sqrt();
                let v_dot_l = n_dot_v * n_dot_l + side * x;
                let v_dot_h = (0.5 * (1.0 + v_dot_l)).sqrt();
                let n_dot_h = (n_dot_v + n_dot_l) / (2.0 * v_dot_h);
                let c2 = n_dot_h * n_dot_h;
                let fresnel = f64::from(of.f0) + (1.0 - f64::from(of.f0)) * (1.0 - v_dot_h).powi(5);
                let seen = |c: f64| (c * c * (1.0 - alpha2) + alpha2).sqrt();
                let f = match of.model {
                    SkinSpecular::BlinnPhong => {
                        let n = 2.0 / alpha2 - 2.0;
                        (n + 2.0) / (2.0 * PI) * n_dot_h.powf(n) * 0.25 / (v_dot_h * v_dot_h)
                    }
                    SkinSpecular::Kelemen => {
                        (-(1.0 - c2) / (c2 * alpha2)).exp() / (PI * alpha2 * c2 * c2) * 0.25 / (v_dot_h * v_dot_h)
                    }
                    SkinSpecular::Ggx | SkinSpecular::DualGgx => {
                        let d = 1.0 - c2 + alpha2 * c2;
                        alpha2 / (PI * d * d) * 0.5 / (n_dot_l * seen(n_dot_v) + n_dot_v * seen(n_dot_l))
                    }
                };
                sum += f * fresnel * n_dot_l;
            }
        }
        sum * 2.0 * PI / (steps * steps) as f64
    }

    #[test]
    fn albedo_is_the_sum_over_directions_of_light() {
        for model in ALL {
            for alpha in [0.2, 0.5, 1.0] {
                for n_dot_v in [0.1, 0.4, 1.0] {
                    let of = with_alpha(model, alpha, 0.028);
                    let (found, expected) = (directional_albedo(&of, n_dot_v), summed(&of, n_dot_v));
                    assert!((found - expected).abs() <= 2e-3, "{of:?} {n_dot_v}: {found} {expected}");
                }
            }
        }
    }

    #[test]
    fn two_lobes_mix_and_never_mirror_more_than_there_is() {
        let two = Speculars { lobes: [0.75, 1.3], ..with_alpha(SkinSpecular::DualGgx, 0.2, 0.028) };
        let one = |scale: f32| {
            let roughness = two.roughness * scale;
            directional_albedo(&Speculars { model: SkinSpecular::Ggx, roughness, ..two }, 0.4)
        };
        let expected = 0.85 * one(0.75) + 0.15 * one(1.3);
        assert!((directional_albedo(&two, 0.4) - expected).abs() < 1e-6);
        for model in ALL {
            for roughness in [0.02, 0.05, 0.45, 1.0] {
                for n_dot_v in [0.001, 0.02, 0.3, 1.0] {
                    for f0 in [0.0, 0.25] {
                        let of = Speculars { model, roughness, lobes: [0.05, 4.0], lobe_mix: 0.5, f0 };
                        let found = directional_albedo(&of, n_dot_v);
                        assert!((0.0..=1.0).contains(&found), "{of:?} {n_dot_v}: {found}");
                    }
                }
            }
        }
    }
}
