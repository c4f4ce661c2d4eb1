//! Whether a face can still be read: the contrast of its features under the file's own shading and under the map.

use glam::{Vec2, Vec3};
use rayon::prelude::*;
use serde::Serialize;

use super::Guide;
use super::landmarks::{Landmarks, place};
use super::relief::{Relief, SIDE};
use crate::material::Toon;
use crate::smoothstep::smoothstep;

/// Least share of a feature's contrast that the map must keep.
pub const KEPT: f32 = 0.8;
/// Contrast below which nobody sees a feature.
const SEEN: f32 = 0.012;
/// Contrast of the paint alone from which eyes and brows count as painted.
const PAINTED: f32 = 0.05;
/// Lights: as many, over this angle on both sides of the front, at this height, radians. Further back a face lies in shade as a
/// whole, by the file and by the map.
const LIGHTS: usize = 12;
const WIDEST: f32 = 1.44;
const PITCH: f32 = 0.3;
/// Half width of the border of the map, as [`FaceShadow`](crate::material::FaceShadow) has it.
const SOFTNESS: f32 = 0.012;

/// What lives from the shading of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Feature {
    /// The eyes, where the face's own texture paints them.
    Eyes,
    /// The brows, likewise.
    Brows,
    /// The nose.
    Nose,
    /// The mouth.
    Mouth,
}

impl Feature {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Eyes, Self::Brows, Self::Nose, Self::Mouth];
}

/// The contrast of a feature against the skin around it, under the light that takes most of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Contrast {
    /// Which feature.
    pub feature: Feature,
    /// Where that light stands, degrees to the character's left.
    pub yaw_deg: f32,
    /// As the file shades it: deviation of the luminance from what is around, share of that.
    pub before: f32,
    /// Under the map.
    pub after: f32,
}

impl Contrast {
    /// Whether enough of it is left.
    #[must_use]
    pub fn is_kept(&self) -> bool {
        self.after >= KEPT * self.before
    }
}

impl Guide {
    /// The contrast of a feature as the file shades it and under the map; `shades` are what the luminance of its lit colour is
    /// multiplied by in shade, before and after. `None` without landmarks, and for eyes and brows that the face's own texture does
    /// not paint: those are parts of their own.
    #[must_use]
    pub fn contrast(&self, feature: Feature, toon: &Toon, shades: [f32; 2]) -> Option<Contrast> {
        let (width, cells) = cells(&self.relief, self.landmarks.as_ref()?, feature);
        if matches!(feature, Feature::Eyes | Feature::Brows) {
            let painted: Vec<f32> = cells.iter().map(|i| self.relief.painted[*i]).collect();
            if deviation(width, &painted) < PAINTED {
                return None;
            }
        }
        Some(self.worst(width, &cells, feature, toon, shades))
    }

    /// Share of the front of the face that light from the front shows otherwise under the map than by the file: more than some
    /// of it, and the map does not belong to this mesh.
    #[must_use]
    pub fn changed(&self, toon: &Toon) -> f32 {
        let front = (0..SIDE * SIDE).into_par_iter().filter(|i| {
            let from = Vec2::new((i % SIDE) as f32, (i / SIDE) as f32) / SIDE as f32 - 0.5;
            from.x.abs() < 0.2 && from.y.abs() < 0.4
        });
        let to_light = Vec3::new(0.0, PITCH.sin(), PITCH.cos());
        let differs = |i: usize| {
            let own = own(toon, self.relief.normals[i], to_light);
            (lit(self.thresholds.of_cell(i), 0.0, own) - own).abs() > 0.5
        };
        let counts = front.map(|i| (usize::from(differs(i)), 1));
        let (changed, all) = counts.reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1));
        changed as f32 / all.max(1) as f32
    }

    fn worst(&self, width: usize, cells: &[usize], feature: Feature, toon: &Toon, shades: [f32; 2]) -> Contrast {
        let thresholds: Vec<[f32; 3]> = cells.iter().map(|i| self.thresholds.of_cell(*i)).collect();
        let lights = (0..LIGHTS).into_par_iter().map(|i| {
            let yaw = (i as f32 / (LIGHTS - 1) as f32 * 2.0 - 1.0) * WIDEST;
            let to_light = Vec3::new(yaw.sin() * PITCH.cos(), PITCH.sin(), yaw.cos() * PITCH.cos());
            let by_file: Vec<f32> = cells.iter().map(|i| own(toon, self.relief.normals[*i], to_light)).collect();
            let mapped = thresholds.iter().zip(&by_file).map(|(at, own)| lit(*at, yaw, *own)).collect();
            let [before, after] = [(by_file, shades[0]), (mapped, shades[1])].map(|(lit, shade)| {
                let painted = cells.iter().map(|i| self.relief.painted[*i]);
                let luminance = painted.zip(lit).map(|(painted, lit)| painted * (shade + (1.0 - shade) * lit));
                deviation(width, &luminance.collect::<Vec<_>>())
            });
            Contrast { feature, yaw_deg: yaw.to_degrees(), before, after }
        });
        let share = |c: &Contrast| if c.before > SEEN { c.after / c.before } else { f32::MAX };
        let none = Contrast { feature, yaw_deg: 0.0, before: 0.0, after: 0.0 };
        let lights: Vec<Contrast> = lights.collect();
        lights.into_iter().min_by(|a, b| share(a).total_cmp(&share(b))).unwrap_or(none)
    }

    /// Leaves a feature to the file's own shading by a share, with a smooth border.
    pub fn leave(&mut self, feature: Feature, share: f32) {
        let Some(landmarks) = self.landmarks else { return };
        let (middle, half) = bounds(&landmarks, feature);
        for i in 0..SIDE * SIDE {
            let up = 1.0 - ((i / SIDE) as f32 + 0.5) / SIDE as f32;
            let angle = Relief::angle((i % SIDE) as f32);
            if angle.abs() < 1.0 {
                let across = angle.sin() * self.relief.distance[i] / self.relief.height;
                // Both sides of the face have one.
                let from = ((Vec2::new(across.abs(), up) - middle.with_x(middle.x.abs())) / half).length();
                self.thresholds.leave(i, share * ((1.5 - from) / 0.6).clamp(0.0, 1.0));
            }
        }
    }
}

/// Share of light where the map has these thresholds.
fn lit([right, left, normal]: [f32; 3], yaw: f32, own: f32) -> f32 {
    let tau = if yaw >= 0.0 { left } else { right };
    let mapped = smoothstep(-SOFTNESS, SOFTNESS, tau - yaw.abs() / std::f32::consts::PI);
    mapped + (own - mapped) * normal
}

/// MToon's shading of a normal.
fn own(toon: &Toon, normal: Vec3, to_light: Vec3) -> f32 {
    let x = normal.dot(to_light) + toon.shift;
    ((x + 1.0 - toon.toony) / (2.0 - 2.0 * toon.toony).max(1e-3)).clamp(0.0, 1.0)
}

/// Middle and half size of a feature; of two, of the left one.
fn bounds(l: &Landmarks, feature: Feature) -> (Vec2, Vec2) {
    let span = l.eye[1] - l.chin;
    let (eye, half) = (Vec2::from(l.eye), Vec2::from(l.eye_half));
    match feature {
        Feature::Eyes => (eye, half * 1.2),
        Feature::Brows => (eye + Vec2::new(0.0, 1.9 * half.y), half * Vec2::new(1.3, 0.6)),
        Feature::Nose => (Vec2::new(0.0, l.nose - 0.04 * span), Vec2::new(0.5 * l.eye[0], 0.17 * span)),
        Feature::Mouth => (Vec2::new(0.0, l.mouth), Vec2::new(0.9 * l.mouth_half, 0.1 * span)),
    }
}

/// The box of cells of a feature, row by row, and how many are a row.
fn cells(relief: &Relief, l: &Landmarks, feature: Feature) -> (usize, Vec<usize>) {
    let (middle, half) = bounds(l, feature);
    let [left, top] = Relief::cell(place(relief, middle.x - half.x, middle.y + half.y));
    let [right, bottom] = Relief::cell(place(relief, middle.x + half.x, middle.y - half.y));
    let cells = (top..=bottom).flat_map(|y| (left..=right).map(move |x| y * SIDE + x)).collect();
    ((right + 1).saturating_sub(left), cells)
}

/// Root mean square of what stands out from the plane that lies through the luminance of a box, share of its mean: a border
/// between light and shade that crosses the whole box counts little, a mark in it counts whole.
fn deviation(width: usize, values: &[f32]) -> f32 {
    let height = values.len().checked_div(width).unwrap_or(0);
    if height < 2 || width < 2 {
        return 0.0;
    }
    let count = values.len() as f32;
    let mean = values.iter().sum::<f32>() / count;
    let places = (0..height).flat_map(|y| {
        let up = y as f32 / (height - 1) as f32 - 0.5;
        (0..width).map(move |x| Vec2::new(x as f32 / (width - 1) as f32 - 0.5, up))
    });
    let (mut slope, mut square) = (Vec2::ZERO, Vec2::ZERO);
    for (at, value) in places.clone().zip(values) {
        slope += at * (value - mean);
        square += at * at;
    }
    let slope = slope / square.max(Vec2::splat(1e-6));
    let off = |(at, value): (Vec2, &f32)| (value - mean - slope.dot(at)).powi(2);
    (places.zip(values).map(off).sum::<f32>() / count).sqrt() / mean.max(1e-3)
}
