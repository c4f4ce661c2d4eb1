//! What a picture of an eye shows: how large its pupil and its iris are painted.

use super::EyeRow;
use crate::scene::Image;

/// Radii in a picture of an eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Painted {
    /// Of the pupil, share of the iris' radius as it is painted; 0 where none is.
    pub pupil: f32,
    /// Of the iris, share of what was taken for it; `None` where no edge is found.
    pub iris: Option<f32>,
}

/// Rings of a picture out to this share of the iris, and places on each.
const RINGS: usize = 96;
const FARTHEST: f32 = 1.6;
const PLACES: usize = 48;
/// Least step of lightness that is an edge.
const EDGE: f32 = 0.06;

impl Painted {
    /// Of the picture that lies so on an eye; `None` where its pixels are not there.
    pub fn of(image: &Image, row: &EyeRow) -> Option<Self> {
        let rings: Vec<f32> = (0..RINGS).map(|ring| mean(image, row, radius(ring))).collect::<Option<_>>()?;
        // Over a tenth of the iris, as an eye would see them.
        let window = (0.05 / radius(1)) as usize;
        let smooth = |at: usize| {
            let (low, high) = (at.saturating_sub(window), (at + window + 1).min(RINGS));
            rings[low..high].iter().sum::<f32>() / (high - low) as f32
        };
        let step = |at: &usize| smooth(at + window) - smooth(at - window);
        let ring_of =
            |share: f32| ((share / FARTHEST * RINGS as f32) as usize).clamp(2 * window, RINGS - 1 - 2 * window);
        let edge = (ring_of(0.55)..ring_of(1.45)).max_by(|a, b| step(a).total_cmp(&step(b)));
        let iris = edge.filter(|at| step(at) > EDGE).map(radius);
        let whole = iris.unwrap_or(1.0);
        let (inner, middle) = (smooth(0), (ring_of(0.5 * whole)..ring_of(0.8 * whole)).map(smooth).fold(0.0, f32::max));
        let half = 0.5 * (inner + middle);
        let pupil = (0..ring_of(0.8 * whole)).find(|at| rings[*at] > half).filter(|_| middle - inner > 0.5 * EDGE);
        Some(Self { pupil: pupil.map_or(0.0, |at| (radius(at) / whole).clamp(0.05, 0.9)), iris })
    }
}

fn radius(ring: usize) -> f32 {
    ring as f32 * FARTHEST / RINGS as f32
}

/// Mean lightness along a ring, 0 to 1 as it is painted.
fn mean(image: &Image, row: &EyeRow, radius: f32) -> Option<f32> {
    let mut sum = 0.0;
    for place in 0..PLACES {
        let (sin, cos) = (place as f32 / PLACES as f32 * std::f32::consts::TAU).sin_cos();
        let at = |of: [f32; 3]| of[0] * radius * cos + of[1] * radius * sin + of[2];
        let pixel = |at: f32, size: u32| ((at.rem_euclid(1.0) * size as f32) as u32).min(size.saturating_sub(1));
        let (x, y) = (pixel(at(row.uv[0]), image.width), pixel(at(row.uv[1]), image.height));
        let first = 4 * (y as usize * image.width as usize + x as usize);
        let [r, g, b] = image.pixels.get(first..first + 3)?.try_into().ok()?;
        sum += (0.2126 * f32::from(r) + 0.7152 * f32::from(g) + 0.0722 * f32::from(b)) / 255.0;
    }
    Some(sum / PLACES as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of a pupil and an iris on white, radii in shares of half of its side.
    fn eye(pupil: f32, iris: f32) -> Image {
        let side = 256u32;
        let of = |i: u32| {
            let place = |c: u32| (c as f32 + 0.5) / side as f32 * 2.0 - 1.0;
            let rho = place(i % side).hypot(place(i / side));
            if rho < pupil {
                [5, 5, 8, 255]
            } else if rho < iris {
                [120, 80, 40, 255]
            } else {
                [230, 225, 220, 255]
            }
        };
        Image { width: side, height: side, pixels: (0..side * side).flat_map(of).collect(), ..Image::default() }
    }

    #[test]
    fn radii_are_found() {
        // The picture reaches to twice the iris that is taken for granted.
        let row = EyeRow { uv: [[0.25, 0.0, 0.5], [0.0, -0.25, 0.5]], ..EyeRow::default() };
        let found = Painted::of(&eye(0.15, 0.4), &row).expect("pixels");
        assert!((found.iris.expect("an edge") - 0.8).abs() < 0.04, "{found:?}");
        assert!((found.pupil - 0.375).abs() < 0.05, "{found:?}");
    }

    #[test]
    fn what_is_not_painted_is_not_found() {
        let found = Painted::of(&eye(0.0, 2.0), &EyeRow::default()).expect("pixels");
        assert_eq!(found, Painted { pupil: 0.0, iris: None });
        assert_eq!(Painted::of(&Image { width: 4, height: 4, ..Image::default() }, &EyeRow::default()), None);
    }
}
