//! Keys to a threshold map.

use std::f32::consts::PI;

use super::{FaceLayout, LIT, MAX_SIDE, Mask, NEVER, Texels, distance_squared};
use crate::{Error, Result};

/// What is lit at one angle of the light.
#[derive(Clone, Debug, PartialEq)]
pub struct Key {
    /// Angle between the light and the front of the face, about its up axis, radians. Range 0..=π.
    pub angle_rad: f32,
    /// The lit part.
    pub mask: Mask,
}

/// For every texel the angle of the light at which it turns dark.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ThresholdMap {
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// Angle over π, rows from the top: lit while it is greater than that of the light. 0 is never lit, 1 always.
    pub tau: Vec<f32>,
}

/// Finds the threshold of every texel.
///
/// Between two keys the angle is divided by the distances to their borders (half a texel from the centres on either
/// side), so that each key comes back exactly when the map is cut at its angle. Where the first of two keys has no
/// border, what is farthest from the second one goes first; where the second is empty, what is deepest goes last.
///
/// # Errors
/// [`Error::Argument`] for fewer than two keys, angles that are out of range or do not grow, masks of other sizes than
/// the first, and texels that light up again: one number can hold one border only. The message names the place.
pub fn bake(keys: &[Key]) -> Result<ThresholdMap> {
    check(keys)?;
    let [first, .., last] = keys else { return Err(fault("are fewer than two")) };
    let mut tau = vec![0f32; first.mask.coverage.len()];
    for pair in keys.windows(2) {
        let [a, b] = pair else { continue };
        blend(a, b, &mut tau);
    }
    for (tau, lit) in tau.iter_mut().zip(last.mask.lit()) {
        if lit {
            *tau = 1.0;
        }
    }
    Ok(ThresholdMap { width: first.mask.width, height: first.mask.height, tau })
}

fn fault(message: impl Into<String>) -> Error {
    Error::Argument { what: "keys of a threshold map".into(), message: message.into() }
}

fn check(keys: &[Key]) -> Result<()> {
    for key in keys {
        if !(0.0..=PI).contains(&key.angle_rad) {
            return Err(fault(format!("have the angle {} rad; expected 0 to pi", key.angle_rad)));
        }
        let Mask { width, height, coverage } = &key.mask;
        if coverage.len() as u64 != u64::from(*width) * u64::from(*height) || coverage.is_empty() {
            return Err(fault(format!("have a mask of {width} x {height} with {} texels", coverage.len())));
        }
        if *width.max(height) > MAX_SIDE {
            return Err(fault(format!("have a mask of {width} x {height}; expected at most {MAX_SIDE} a side")));
        }
    }
    for pair in keys.windows(2) {
        let [a, b] = pair else { continue };
        let degrees = [a.angle_rad, b.angle_rad].map(f32::to_degrees);
        if a.angle_rad >= b.angle_rad {
            return Err(fault(format!(
                "stand at {} and then at {} degrees; expected growing angles",
                degrees[0], degrees[1]
            )));
        }
        if (a.mask.width, a.mask.height) != (b.mask.width, b.mask.height) {
            return Err(fault(format!(
                "have masks of {} x {} and {} x {}; expected one size",
                a.mask.width, a.mask.height, b.mask.width, b.mask.height
            )));
        }
        let again = || a.mask.lit().zip(b.mask.lit()).enumerate().filter(|(_, (a, b))| !*a && *b);
        if let Some((i, _)) = again().next() {
            let (x, y) = (i % a.mask.width as usize, i / a.mask.width as usize);
            return Err(fault(format!(
                "light up again between {} and {} degrees: {} texels, first at {x}, {y}; expected lit parts that only shrink",
                degrees[0],
                degrees[1],
                again().count()
            )));
        }
    }
    Ok(())
}

/// Thresholds of what is lit at `a` and dark at `b`.
fn blend(a: &Key, b: &Key, tau: &mut [f32]) {
    let band = |i: usize| a.mask.coverage[i] >= LIT && b.mask.coverage[i] < LIT;
    if !(0..tau.len()).any(band) {
        return;
    }
    let to_dark = distance_squared(&a.mask, false);
    let to_lit = distance_squared(&b.mask, true);
    let beyond = |squared: u32| (squared != NEVER).then(|| f64::from(squared).sqrt() - 0.5);
    let deepest = |distances: &[u32]| {
        (0..distances.len()).filter(|i| band(*i)).filter_map(|i| beyond(distances[i])).fold(0.0, f64::max) + 0.5
    };
    let (max_in, max_out) = (deepest(&to_dark), deepest(&to_lit));
    let [from, to] = [a.angle_rad, b.angle_rad].map(f64::from);
    for i in (0..tau.len()).filter(|i| band(*i)) {
        let share = match (beyond(to_dark[i]), beyond(to_lit[i])) {
            (Some(inside), Some(outside)) => inside / (inside + outside),
            (None, Some(outside)) => 1.0 - outside / max_out,
            (Some(inside), None) => inside / max_in,
            (None, None) => 0.5,
        };
        tau[i] = ((from + (to - from) * share) / std::f64::consts::PI) as f32;
    }
}

impl ThresholdMap {
    /// What is lit at an angle of the light, radians.
    #[must_use]
    pub fn mask(&self, angle_rad: f32) -> Mask {
        let lit = |tau: &f32| if *tau > angle_rad / PI { 255 } else { 0 };
        Mask { width: self.width, height: self.height, coverage: self.tau.iter().map(lit).collect() }
    }

    /// The map in lilToon's layout: red for light from the character's right, green for light from her left, blue
    /// (share of normal shading) 0, alpha (strength) full. This map is for light from her left, which is the right of the
    /// texture; red is its mirror image.
    #[must_use]
    pub fn mirrored(&self) -> Texels {
        let rgba = self.tau.iter().map(|tau| [(tau.clamp(0.0, 1.0) * 65535.0).round() as u16; 4]).collect();
        Texels { width: self.width, height: self.height, rgba, is_8_bit: false }.laid_out(FaceLayout::Mirrored)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A border that moves from left to right, with a bump.
    fn keys() -> Vec<Key> {
        (0..=6)
            .map(|k| {
                let edge = |y: u32| f64::from(k) * 8.0 - 4.0 + 3.0 * (f64::from(y) * 0.3).sin();
                let mask = Mask::from_fn(40, 24, |x, y| f64::from(x) >= edge(y) && k < 6);
                Key { angle_rad: PI * k as f32 / 6.0, mask }
            })
            .collect()
    }

    #[test]
    fn cut_at_its_angle_every_key_comes_back() {
        let keys = keys();
        let map = bake(&keys).expect("nested keys");
        for key in &keys {
            assert_eq!(map.mask(key.angle_rad), key.mask, "{} rad", key.angle_rad);
        }
    }

    #[test]
    fn the_lit_part_only_shrinks() {
        let map = bake(&keys()).expect("nested keys");
        for step in 0..180 {
            let [now, next] = [step, step + 1].map(|d| map.mask((d as f32).to_radians()));
            assert!(now.lit().zip(next.lit()).all(|(a, b)| a || !b), "at {step} degrees");
        }
    }

    #[test]
    fn faults_name_place_and_reason() {
        let message = |keys: &[Key]| bake(keys).map(|_| ()).unwrap_err().to_string();
        let good = keys();
        assert!(message(&good[..1]).contains("fewer than two"));
        let mut wrong = good.clone();
        wrong[2].angle_rad = f32::NAN;
        assert!(message(&wrong).contains("NaN"));
        wrong[2].angle_rad = 0.1;
        assert!(message(&wrong).contains("growing"));
        let mut wrong = good.clone();
        wrong[3].mask.coverage[5] = 255;
        assert!(message(&wrong).contains("1 texels, first at 5, 0"), "{}", message(&wrong));
        wrong[3].mask = Mask::from_fn(3, 3, |_, _| false);
        assert!(message(&wrong).contains("3 x 3"));
    }

    #[test]
    fn both_sides_are_mirror_images() {
        let map = bake(&keys()).expect("nested keys");
        for row in map.mirrored().rgba.chunks_exact(40) {
            assert!((0..40).all(|x| row[x][0] == row[39 - x][1]));
        }
    }
}
