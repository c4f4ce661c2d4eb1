//! Diffusion profiles as sums of Gaussians: what light does on flat and on round surfaces, in closed form.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_SQRT_PI, FRAC_PI_2, PI, TAU};

use super::DiffusionProfile;

/// Burley's normalised diffusion with d = 1: (weight, variance) of nine Gaussians; the weights sum to 1.
///
/// Fitted by least squares to the edge response, the line spread and the CDF, the largest errors weighing most. Errors
/// left: edge response 0.0002, CDF 0.0008, line spread 1.5 % from 0.05 d to 15 d.
const BURLEY: [(f64, f64); 9] = [
    (0.00508, 2.376e-5),
    (0.0153, 8.2e-4),
    (0.04455, 0.009_739),
    (0.10105, 0.076_08),
    (0.19054, 0.434_55),
    (0.26313, 2.0338),
    (0.23928, 8.248),
    (0.12638, 26.23),
    (0.01469, 76.68),
];

/// Concentration of a ring kernel above which the surface counts as nearly flat: the expansion is then within 1e-7.
const NEARLY_FLAT: f64 = 1000.0;

/// One Gaussian of a profile, isotropic in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Gaussian {
    /// Share of the light, 0 to 1.
    pub(crate) weight: f64,
    /// Variance along one axis, mm^2.
    pub(crate) variance: f64,
}

/// A diffusion profile of red, green and blue as sums of Gaussians.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GaussianSum {
    channels: [Vec<Gaussian>; 3],
}

impl GaussianSum {
    /// A sum of what is listed for red, green and blue; the weights of each sum to 1.
    pub(crate) fn new(channels: [Vec<Gaussian>; 3]) -> Self {
        Self { channels }
    }

    /// The sum that stands for a profile.
    pub(crate) fn of(profile: &DiffusionProfile) -> Self {
        Self::new(std::array::from_fn(|c| {
            let d = profile.distance(c);
            BURLEY.iter().map(|&(weight, variance)| Gaussian { weight, variance: variance * d * d }).collect()
        }))
    }

    /// Line spread at distance x from a thin line of light, 1/mm.
    pub(crate) fn line_spread(&self, x_mm: f64) -> [f64; 3] {
        self.sum(|g| (-0.5 * x_mm * x_mm / g.variance).exp() / (TAU * g.variance).sqrt())
    }

    #[cfg(test)]
    /// Light at distance x inside of a straight edge of light, mm, negative outside: 0 to 1, half on the edge.
    pub(crate) fn edge(&self, x_mm: f64) -> [f64; 3] {
        self.sum(|g| normal_cdf(x_mm / g.variance.sqrt()))
    }

    #[cfg(test)]
    /// What takes the place of `max(0, N.L)` on a surface of this curvature, 1/mm, at the angle theta between N and L
    /// (Penner 2011). Exact on a cylinder.
    pub(crate) fn diffused(&self, theta: f64, curvature_per_mm: f64) -> [f64; 3] {
        self.rings(curvature_per_mm).map(|ring| ring.diffused(theta))
    }

    /// The same for one curvature and many angles.
    pub(crate) fn rings(&self, curvature_per_mm: f64) -> [Ring; 3] {
        std::array::from_fn(|c| Ring::new(&self.channels[c], curvature_per_mm))
    }

    /// Light within the penumbra of a shadow, 0 to 1 (Penner 2011).
    ///
    /// `share` is that of light as a box filter of `width_mm` finds it, 0 to 1. The penumbra is narrowed to its lit
    /// part `kept` (above 0, to 1) and light scatters over it. A width that is infinite leaves the narrowed ramp.
    pub(crate) fn penumbra(&self, share: f64, width_mm: f64, kept: f64) -> [f64; 3] {
        // The expectation of the ramp is the difference of that of two half-open ramps, which end in 1 - kept and in 1.
        self.sum(|g| {
            let sigma = g.variance.sqrt() / width_mm;
            let above = |start: f64| {
                let a = (share - start) / sigma;
                if sigma > 1e-9 {
                    sigma * (a * normal_cdf(a) + normal_density(a))
                } else {
                    (share - start).max(0.0)
                }
            };
            ((above(1.0 - kept) - above(1.0)) / kept).clamp(0.0, 1.0)
        })
    }

    fn sum(&self, of: impl Fn(&Gaussian) -> f64) -> [f64; 3] {
        std::array::from_fn(|c| self.channels[c].iter().map(|g| g.weight * of(g)).sum())
    }
}

/// One colour of a profile, wrapped round a cylinder.
///
/// Over the chord `2/k sin(x/2)` a Gaussian of variance v is the von Mises kernel of concentration `1 / (k^2 v)`, under
/// which the term n of the cosine series of `max(0, cos)` shrinks by `I_n / I_0`. Narrow kernels need too many terms:
/// they are expanded about the flat surface.
pub(crate) struct Ring {
    /// Constant term, then that of `cos theta`, then those of `cos 2 theta`, `cos 4 theta` and so on.
    terms: Vec<f64>,
    /// Weight and standard deviation, rad, of the narrow kernels.
    narrow: Vec<(f64, f64)>,
}

impl Ring {
    fn new(gaussians: &[Gaussian], curvature_per_mm: f64) -> Self {
        let mut ring = Self { terms: Vec::new(), narrow: Vec::new() };
        let mut total = 0.0;
        for g in gaussians {
            // At least this narrow: `concentration` would be infinite on a flat surface.
            let sigma = (curvature_per_mm.abs() * g.variance.sqrt()).max(1e-150);
            let concentration = 1.0 / (sigma * sigma);
            // A wide Gaussian does not fit round the ring: what does is `sqrt(2 pi k) exp(-k) I_0(k)` of it.
            if concentration > NEARLY_FLAT {
                let s = sigma * sigma;
                let weight = g.weight * (1.0 + s / 8.0 + 9.0 * s * s / 128.0);
                ring.narrow.push((weight, sigma));
                total += weight;
            } else {
                let (scaled_i0, ratios) = bessel_ratios(concentration);
                let weight = g.weight * (TAU * concentration).sqrt() * scaled_i0;
                ring.add(weight, &ratios);
                total += weight;
            }
        }
        let scale = if total > 0.0 { 1.0 / total } else { 0.0 };
        ring.terms.iter_mut().for_each(|t| *t *= scale);
        ring.narrow.iter_mut().for_each(|(weight, _)| *weight *= scale);
        ring
    }

    /// Adds the cosine series of `max(0, cos)`, of which only the first and the even terms are not 0.
    fn add(&mut self, weight: f64, ratios: &[f64]) {
        let odd_and_even = ratios.len() / 2 + 1;
        if self.terms.len() < odd_and_even {
            self.terms.resize(odd_and_even, 0.0);
        }
        self.terms[0] += weight / PI;
        self.terms[1] += weight * 0.5 * ratios[1];
        for half in 1..odd_and_even - 1 {
            let m = half as f64;
            let sign = if half % 2 == 1 { 2.0 } else { -2.0 };
            self.terms[half + 1] += weight * sign / (PI * (4.0 * m * m - 1.0)) * ratios[2 * half];
        }
    }

    /// Light at the angle theta from where it falls straight.
    pub(crate) fn diffused(&self, theta: f64) -> f64 {
        let cosine = theta.cos();
        let mut sum = self.narrow.iter().map(|&(weight, sigma)| weight * narrow_diffused(theta, sigma)).sum::<f64>();
        if let [constant, first, even @ ..] = self.terms.as_slice() {
            // Clenshaw's recurrence in cos 2 theta.
            let x = 2.0 * cosine * cosine - 1.0;
            let (mut b1, mut b2) = (0.0, 0.0);
            for term in even.iter().rev() {
                (b1, b2) = (term + 2.0 * x * b1 - b2, b1);
            }
            sum += constant + first * cosine + x * b1 - b2;
        }
        sum.max(0.0)
    }
}

/// `max(0, cos)` under a von Mises kernel of small standard deviation, rad: to the third order of it.
fn narrow_diffused(theta: f64, sigma: f64) -> f64 {
    // From the terminator, positive where lit; beyond half a turn the other side counts.
    let turned = theta.abs() % TAU;
    let from_terminator = FRAC_PI_2 - turned.min(TAU - turned);
    let (sine, cosine) = from_terminator.sin_cos();
    if sigma < 1e-6 {
        return sine.max(0.0);
    }
    // Moments of a standard normal above -a, the place of the terminator.
    let a = from_terminator / sigma;
    if a < -9.0 {
        return 0.0;
    }
    let density = normal_density(a);
    let (m0, m1) = (normal_cdf(a), density);
    let m2 = m0 - a * density;
    let m3 = 2.0 * m1 + a * a * density;
    let m4 = 3.0 * m2 - a * a * a * density;
    let m5 = 4.0 * m3 + a * a * a * a * density;
    let s = sigma * sigma;
    // exp((cos x - 1) / s) is normal but for the factor 1 + s z^4 / 24.
    let straight = m0 + s * (m4 / 24.0 - m2 / 2.0);
    let across = sigma * (m1 + s * (m5 / 24.0 - m3 / 6.0));
    ((sine * straight + cosine * across) / (1.0 + s / 8.0)).max(0.0)
}

/// `exp(-x) I_0(x)`, and `I_n(x) / I_0(x)` from n = 0 as far as they count, at least two; by downward recurrence.
fn bessel_ratios(x: f64) -> (f64, Vec<f64>) {
    // exp(-n^2 / 2x) is about what the ratio is: 7 sqrt(x) leaves 2e-11.
    let wanted = 8 + (7.0 * x.sqrt()) as usize;
    let start = wanted + 24;
    let mut f = vec![0.0; start + 2];
    f[start] = 1e-280;
    for n in (1..=start).rev() {
        f[n - 1] = f[n + 1] + 2.0 * n as f64 / x * f[n];
        if f[n - 1] > 1e200 {
            // Only ratios matter; terms that become 0 are too small to count.
            let scale = 1.0 / f[n - 1];
            f[n - 1..].iter_mut().for_each(|v| *v *= scale);
        }
    }
    // exp(x) = I_0 + 2 (I_1 + I_2 + ...)
    let whole = f[0] + 2.0 * f[1..].iter().sum::<f64>();
    let first = f[0];
    f.truncate(wanted);
    f.iter_mut().for_each(|v| *v /= first);
    (first / whole, f)
}

fn normal_density(z: f64) -> f64 {
    (-0.5 * z * z).exp() * FRAC_2_SQRT_PI * 0.5 * FRAC_1_SQRT_2
}

fn normal_cdf(z: f64) -> f64 {
    0.5 + 0.5 * erf(z * FRAC_1_SQRT_2)
}

/// Error function, to 1e-15: the series whose terms are all positive.
fn erf(x: f64) -> f64 {
    if x.abs() > 5.9 {
        return x.signum();
    }
    let square = x * x;
    let mut term = x;
    let mut sum = x;
    let mut n = 0.5;
    while term.abs() > 1e-16 * sum.abs() {
        n += 1.0;
        term *= square / n;
        sum += term;
    }
    (FRAC_2_SQRT_PI * (-square).exp() * sum).clamp(-1.0, 1.0)
}

#[cfg(test)]
pub(super) mod tests {
    use serde_json::Value;

    use super::*;

    fn number(v: &Value) -> f64 {
        v.as_f64().expect("a number")
    }

    fn numbers(v: &Value) -> [f64; 3] {
        std::array::from_fn(|c| number(&v[c]))
    }

    fn read(text: &str) -> Value {
        serde_json::from_str(text).expect("vectors")
    }

    /// The six Gaussians of d'Eon and Luebke 2007, as the vectors list them.
    pub(in crate::skin) fn six() -> GaussianSum {
        let file = read(include_str!("../../tests/oracles/gaussian_profile.json"));
        let variances = file["variance_mm2"].as_array().expect("variances");
        GaussianSum::new(std::array::from_fn(|c| {
            let one =
                |(i, v): (usize, &Value)| Gaussian { weight: number(&file["weights_rgb"][i][c]), variance: number(v) };
            variances.iter().enumerate().map(one).collect()
        }))
    }

    fn close(found: [f64; 3], expected: [f64; 3], within: f64) -> bool {
        (0..3).all(|c| (found[c] - expected[c]).abs() <= within)
    }

    /// The integral from 0 to infinity of a function of a hyperbolic cosine, which falls fast.
    fn over_hyperbola(of: impl Fn(f64) -> f64) -> f64 {
        let step = 0.01;
        0.5 * step * of(1.0) + (1..2500).map(|i| step * of((f64::from(i) * step).cosh())).sum::<f64>()
    }

    #[test]
    fn line_spread_is_that_of_the_vectors() {
        let file = read(include_str!("../../tests/oracles/gaussian_profile.json"));
        for case in file["cases"].as_array().expect("cases") {
            let (found, expected) = (six().line_spread(number(&case["r"])), numbers(&case["line"]));
            assert!((0..3).all(|c| (found[c] / expected[c] - 1.0).abs() <= 1e-9), "{case}: {found:?}");
        }
    }

    #[test]
    fn nine_gaussians_spread_light_as_burley_does() {
        let weights: f64 = BURLEY.iter().map(|(weight, _)| weight).sum();
        assert!((weights - 1.0).abs() < 1e-12);
        let of = GaussianSum::of(&DiffusionProfile::default());
        let d = 0.757_f32;
        for step in 0..60 {
            let x = 0.01 * 1.13_f64.powi(step);
            // The line spread of exp(-r)/r is 2 K_0, and what lies within x of K_0 is the second of these.
            let k0 = |x: f64| over_hyperbola(|c| (-x * c).exp());
            let within = |x: f64| over_hyperbola(|c| -(-x * c).exp_m1() / c);
            let line = (k0(x) + k0(x / 3.0)) / (4.0 * PI);
            let edge = 0.5 + (within(x) + 3.0 * within(x / 3.0)) / (4.0 * PI);
            let x_mm = x * f64::from(d);
            assert!((of.edge(x_mm)[0] - edge).abs() <= 3e-4, "{x}: {} {edge}", of.edge(x_mm)[0]);
            assert!((of.edge(-x_mm)[0] + of.edge(x_mm)[0] - 1.0).abs() < 1e-12);
            let found = of.line_spread(x_mm)[0] * f64::from(d);
            if (0.05..15.0).contains(&x) {
                assert!((found / line - 1.0).abs() <= 0.016, "{x}: {found} {line}");
            }
        }
    }

    #[test]
    fn light_on_a_round_surface_is_that_of_the_vectors() {
        let file = read(include_str!("../../tests/oracles/penner_lut.json"));
        let highest = number(&file["curvature_max"]);
        let of = six();
        let mut worst = 0.0_f64;
        for j in 0..32 {
            let curvature = (j as f64 + 0.5) / 32.0 * highest;
            let rings = of.rings(curvature);
            for i in 0..32 {
                let n_dot_l: f64 = 2.0 * (i as f64 + 0.5) / 32.0 - 1.0;
                let expected = numbers(&file["ring_line"][j][i]);
                for c in 0..3 {
                    worst = worst.max((rings[c].diffused(n_dot_l.acos()) - expected[c]).abs());
                }
            }
        }
        assert!(worst <= 2e-6, "{worst}");
        for case in file["probes"].as_array().expect("probes") {
            let found = of.diffused(number(&case["NoL"]).acos(), number(&case["curvature"]));
            assert!(close(found, numbers(&case["ring_line"]), 2e-6), "{case}: {found:?}");
        }
    }

    #[test]
    fn round_surfaces_keep_light_and_their_limits() {
        for of in [six(), GaussianSum::of(&DiffusionProfile::default())] {
            for curvature in [0.0, 1e-9, 0.01, 0.05, 0.1, 0.3, 1.0, 1e3, 1e9] {
                let rings = of.rings(curvature);
                let whole = |ring: &Ring| {
                    let step = TAU / 20_000.0;
                    (0..20_000).map(|i| ring.diffused((f64::from(i) + 0.5) * step - PI) * step).sum::<f64>()
                };
                for ring in &rings {
                    assert!((whole(ring) - 2.0).abs() < 1e-6, "{curvature}: {}", whole(ring));
                }
                let mut last = [0.0; 3];
                for i in 0..=400 {
                    let n_dot_l = f64::from(i) / 200.0 - 1.0;
                    let now = std::array::from_fn(|c| rings[c].diffused(n_dot_l.acos()));
                    assert!((0..3).all(|c| now[c] >= last[c] - 1e-9), "falls: {curvature} {n_dot_l}");
                    if n_dot_l < 0.0 {
                        assert!(now[0] >= now[1] - 1e-9 && now[1] >= now[2] - 1e-9, "{curvature} {n_dot_l}: {now:?}");
                    }
                    if curvature < 1e-8 {
                        assert!(close(now, [n_dot_l.max(0.0); 3], 1e-8), "Lambert: {n_dot_l} {now:?}");
                    }
                    if curvature > 1e8 {
                        assert!(close(now, [1.0 / PI; 3], 1e-4), "even: {n_dot_l} {now:?}");
                    }
                    last = now;
                }
            }
        }
    }

    #[test]
    fn narrow_kernels_join_the_series() {
        for theta in [0.0, 1.0, 1.5, FRAC_PI_2, 1.6, 1.7, 3.0, PI] {
            let (ratios, sigma) = (bessel_ratios(NEARLY_FLAT).1, NEARLY_FLAT.sqrt().recip());
            let mut ring = Ring { terms: Vec::new(), narrow: Vec::new() };
            ring.add(1.0, &ratios);
            let (series, narrow) = (ring.diffused(theta), narrow_diffused(theta, sigma));
            assert!((series - narrow).abs() < 1e-6, "{theta}: {series} {narrow}");
        }
    }

    #[test]
    fn penumbra_is_that_of_the_vectors() {
        let file = read(include_str!("../../tests/oracles/penner_penumbra.json"));
        for case in file["cases"].as_array().expect("cases") {
            let [share, width, kept] = ["s", "width_mm", "tighten"].map(|name| number(&case[name]));
            let found = six().penumbra(share, width, kept);
            assert!(close(found, numbers(&case["shadow"]), 1e-9), "{case}: {found:?}");
        }
    }

    #[test]
    fn wide_penumbra_is_the_narrowed_ramp() {
        let of = GaussianSum::of(&DiffusionProfile::default());
        for i in 0..=20 {
            let share = f64::from(i) / 20.0;
            assert!(close(of.penumbra(share, f64::INFINITY, 0.5), [(2.0 * share - 1.0).max(0.0); 3], 1e-12));
            assert!(of.penumbra(share, 1e-9, 0.5).iter().all(|v| (0.0..=1.0).contains(v)));
        }
        assert!(of.penumbra(0.0, 16.0, 0.5)[0] <= 0.02);
    }

    #[test]
    fn error_function_has_its_known_values() {
        let known = [
            (0.0, 0.0),
            (0.5, 0.520_499_877_813_046_5),
            (1.0, 0.842_700_792_949_714_9),
            (3.0, 0.999_977_909_503_001_4),
        ];
        for (x, expected) in known {
            assert!((erf(x) - expected).abs() < 1e-14 && (erf(-x) + expected).abs() < 1e-14, "{x}: {}", erf(x));
        }
        assert!((erf(5.89) - 1.0).abs() < 1e-14);
    }
}
