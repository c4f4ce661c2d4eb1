//! How wide a pupil stands open in a light, and how fast it follows another.

use crate::scene::Pupils;

/// A step of time beyond which an eye has got used to its light, whatever came between, seconds.
const LONGEST_STEP_S: f32 = 5.0;

/// The light reflex of a pair of pupils: their diameter, which follows the light in time.
///
/// ```
/// use hikage::{eye::PupilReflex, scene::Pupils};
/// let (mut reflex, pupils) = (PupilReflex::default(), Pupils::default());
/// let wide = reflex.follow(&pupils, 0.0, 1.0);
/// let narrower = reflex.follow(&pupils, 0.1, 1000.0);
/// assert!(wide == 4.9 && narrower < wide && narrower > PupilReflex::steady_mm(1000.0));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PupilReflex {
    /// When it followed the light last, seconds, and the diameter then, mm.
    last: Option<(f32, f32)>,
}

impl PupilReflex {
    /// Diameter in a light that stays, mm, by its luminance, cd/m²: from 7.9 in the dark to 1.9. Moon and Spencer 1944.
    #[must_use]
    pub fn steady_mm(luminance: f32) -> f32 {
        4.9 - 3.0 * (0.4 * luminance.max(0.0).log10()).tanh()
    }

    /// The diameter at a time, seconds, in the light of then, cd/m²; mm. It nears the steady one by `1 - exp(-dt/tau)` of the
    /// way, with the time constant of the direction.
    ///
    /// The first time, after a step back and after one beyond 5 s it is steady at once; the same time twice changes nothing.
    pub fn follow(&mut self, pupils: &Pupils, time_s: f32, luminance: f32) -> f32 {
        let steady = Self::steady_mm(luminance);
        let diameter = match self.last {
            Some((then, last)) if (0.0..=LONGEST_STEP_S).contains(&(time_s - then)) => {
                let tau = if steady < last {
                    pupils.constriction_s
                } else {
                    pupils.dilation_s
                };
                last + (steady - last) * reached(time_s - then, tau)
            }
            _ => steady,
        };
        self.last = Some((time_s, diameter));
        diameter
    }

    /// The diameter when it followed the light last, mm; `None` before the first time.
    #[must_use]
    pub fn diameter_mm(&self) -> Option<f32> {
        self.last.map(|(_, diameter)| diameter)
    }
}

/// Share of the way that is behind after a step of time. A time constant of 0 goes it at once.
fn reached(step_s: f32, tau_s: f32) -> f32 {
    if step_s > 0.0 {
        -(-step_s / tau_s.max(0.0)).exp_m1()
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// After a step of time from one light to another.
    fn after(pupils: &Pupils, [from, to]: [f32; 2], steps: &[f32]) -> f32 {
        let mut reflex = PupilReflex::default();
        let (mut time, mut found) = (0.0, reflex.follow(pupils, 0.0, from));
        for step in steps {
            time += step;
            found = reflex.follow(pupils, time, to);
        }
        assert_eq!(reflex.diameter_mm(), Some(found));
        found
    }

    #[test]
    fn steady_pupils_are_those_of_moon_and_spencer() {
        // Computed from the formula in double precision.
        for (luminance, expected) in [(0.01, 6.892_11), (1.0, 4.9), (100.0, 2.907_89), (10_000.0, 2.134_99)] {
            let found = PupilReflex::steady_mm(luminance);
            assert!((found - expected).abs() < 1e-4, "{luminance}: {found} {expected}");
        }
        for (luminance, expected) in [(0.0, 7.9), (-1.0, 7.9), (f32::NAN, 7.9), (f32::MAX, 1.9), (f32::INFINITY, 1.9)] {
            let found = PupilReflex::steady_mm(luminance);
            assert!((found - expected).abs() < 1e-4, "{luminance}: {found}");
        }
        let all: Vec<f32> = (-60..=60).map(|i| PupilReflex::steady_mm((i as f32 * 0.1).exp2().powi(3))).collect();
        assert!(all.windows(2).all(|w| w[0] > w[1]), "more light, wider pupils: {all:?}");
    }

    #[test]
    fn pupils_narrow_quicker_than_they_widen() {
        let pupils = Pupils::default();
        let (dark, bright) = (PupilReflex::steady_mm(0.1), PupilReflex::steady_mm(1000.0));
        let narrowed = (after(&pupils, [0.1, 1000.0], &[0.3]) - dark) / (bright - dark);
        let widened = (after(&pupils, [1000.0, 0.1], &[0.3]) - bright) / (dark - bright);
        assert!((narrowed - (1.0 - (-1f32).exp())).abs() < 1e-5, "{narrowed}");
        assert!((widened - (1.0 - (-0.25f32).exp())).abs() < 1e-5, "{widened}");
    }

    #[test]
    fn it_is_the_same_at_any_rate_of_frames() {
        let pupils = Pupils::default();
        for lights in [[0.1, 1000.0], [1000.0, 0.1]] {
            let whole = after(&pupils, lights, &[0.5]);
            for steps in [&[0.25, 0.25][..], &[0.1, 0.4], &[0.05; 10]] {
                let found = after(&pupils, lights, steps);
                assert!((found - whole).abs() < 1e-5, "{steps:?}: {found} {whole}");
            }
        }
    }

    #[test]
    fn what_does_not_follow_is_steady_at_once() {
        let pupils = Pupils::default();
        let [from, to] = [1.0, 500.0].map(PupilReflex::steady_mm);
        for (step, expected) in [(0.0, from), (-0.1, to), (5.1, to), (f32::NAN, to)] {
            assert_eq!(after(&pupils, [1.0, 500.0], &[step]), expected, "{step}");
        }
        let at_once = Pupils { constriction_s: 0.0, dilation_s: 0.0, ..pupils.clone() };
        assert_eq!(after(&at_once, [1.0, 500.0], &[0.0]), from);
        assert!((after(&at_once, [1.0, 500.0], &[1e-3]) - to).abs() < 1e-6);
        for light in [0.0, f32::INFINITY, f32::NAN] {
            for steps in [&[0.02][..], &[0.0, 0.02, 1.0]] {
                assert!(after(&pupils, [100.0, light], steps).is_finite(), "{light}");
                assert!(after(&at_once, [light, 100.0], steps).is_finite(), "{light}");
            }
        }
    }
}
