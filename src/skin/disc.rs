//! Places about a point from which light comes to it.

use std::f32::consts::FRAC_PI_2;

use super::DiffusionProfile;

/// Most places of a disc.
pub(crate) const MOST_TAPS: usize = 40;

/// The golden angle, radians.
const GOLDEN: f32 = 2.399_963_2;

/// Places of four discs for a profile of d = 1, each as likely as light comes from it (Golubev 2018): x, y, their radius, and
/// 1/8 pi over the density of places there. Each disc has `taps` of them; all four together are one of four times as many.
pub(crate) fn discs(taps: usize) -> [[[f32; 4]; MOST_TAPS]; 4] {
    let one = DiffusionProfile { scattering_distance_mm: [1.0; 3], ..DiffusionProfile::default() };
    let place = |disc: usize, i: usize| {
        let radius = one.inverse_cdf(((4 * i + disc) as f32 + 0.5) / (4 * taps).max(1) as f32, 0);
        let (sin, cos) = (i as f32 * GOLDEN + disc as f32 * FRAC_PI_2).sin_cos();
        let fall = (-radius / 3.0).exp();
        [cos * radius, sin * radius, radius, radius / (fall * (1.0 + fall * fall))]
    };
    std::array::from_fn(|disc| std::array::from_fn(|i| if i < taps { place(disc, i) } else { [0.0; 4] }))
}
