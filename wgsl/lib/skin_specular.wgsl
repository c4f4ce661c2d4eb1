// Highlights of skin, without Fresnel's factor, 1/sr: Blinn and Phong's distribution with its normalisation, Kelemen's and
// Szirmay-Kalos' lobe over Beckmann's distribution (2001), and two lobes of GGX. The first two divide by |L + V|² = 4 (L·H)².
import package::lib::brdf::{LEAST_ALPHA, ggx_distribution, smith_visibility};

// Below it L and V are opposite, and the half vector has no direction.
const LEAST_L_DOT_H: f32 = 1e-3;

fn over_sum_of_directions(distribution: f32, l_dot_h: f32) -> f32 {
    let c = max(l_dot_h, LEAST_L_DOT_H);
    return distribution / (4.0 * c * c);
}

// The exponent 2/alpha² - 2 makes highlights as wide as those of GGX.
fn blinn_phong_distribution(n_dot_h: f32, alpha: f32) -> f32 {
    let a = clamp(alpha, LEAST_ALPHA, 1.0);
    let a2 = a * a;
    // 1e-6: pow of 0 is left to no driver. Rounding may take N·H past 1, which such exponents would not forgive.
    return pow(clamp(n_dot_h, 1e-6, 1.0), 2.0 / a2 - 2.0) / (3.14159265 * a2);
}

fn blinn_phong_lobe(n_dot_h: f32, l_dot_h: f32, alpha: f32) -> f32 {
    return over_sum_of_directions(blinn_phong_distribution(n_dot_h, alpha), l_dot_h);
}

// Density of slopes whose root mean square is m. Below 1e-3 of N·H it is 0 in f32, whose fourth power would be, too.
fn beckmann_distribution(n_dot_h: f32, m: f32) -> f32 {
    let c = clamp(n_dot_h, 1e-3, 1.0);
    let c2 = c * c;
    let m2 = max(m, LEAST_ALPHA) * max(m, LEAST_ALPHA);
    let tan2 = (1.0 - c) * (1.0 + c) / c2;
    return exp(-tan2 / m2) / (3.14159265 * m2 * c2 * c2);
}

fn kelemen_lobe(n_dot_h: f32, l_dot_h: f32, m: f32) -> f32 {
    return over_sum_of_directions(beckmann_distribution(n_dot_h, m), l_dot_h);
}

// Each lobe has its own shadowing: one of the mean roughness is off by up to a third.
fn dual_ggx_lobe(n_dot_h: f32, n_dot_l: f32, n_dot_v: f32, sharp_alpha: f32, wide_alpha: f32, mix_of_sharp: f32) -> f32 {
    let h = saturate(n_dot_h);
    let l = max(n_dot_l, 1e-4);
    let v = max(n_dot_v, 1e-4);
    let sharp = max(sharp_alpha, LEAST_ALPHA);
    let wide = max(wide_alpha, LEAST_ALPHA);
    return mix(
        ggx_distribution(h, wide) * smith_visibility(l, v, wide),
        ggx_distribution(h, sharp) * smith_visibility(l, v, sharp),
        mix_of_sharp,
    );
}
