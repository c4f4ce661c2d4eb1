//! The angle of the light at which each place of a face turns dark, as a painter lays it out: a calm line over the cheek, the
//! nose, the light under the far eye, the crease of the mouth.

use std::f32::consts::PI;

use glam::Vec2;
use rayon::prelude::*;

use super::FaceStyle;
use super::landmarks::{Landmarks, at};
use super::relief::{Field, MARGIN, REACH, Relief, SIDE, sample, smoothed};
use crate::smoothstep::smoothstep;

/// Thresholds over the relief.
pub(super) struct Thresholds {
    /// For light from the character's left: angle over π at which a place turns dark.
    from_left: Field,
    /// Share of normal shading: behind the face, and below the head.
    normal: Field,
}

impl Thresholds {
    /// Of a face; without landmarks of the smooth head alone.
    pub(super) fn new(relief: &Relief, landmarks: Option<&Landmarks>, style: FaceStyle) -> Self {
        let degree = SIDE as f32 / (2.0 * REACH.to_degrees());
        let row = SIDE as f32;
        // The head as if it had no features, and features without what is finer than them, or than the mesh.
        let head = smoothed(&relief.distance, 13.0 * degree, 0.07 * row);
        let fine = (0.5 * relief.facet).clamp(0.011, 0.07);
        let features = smoothed(&relief.distance, (fine / 0.011 * 2.5).min(13.0) * degree, fine * row);
        // A mesh of few triangles models no cheek: light that stays there would be a blot.
        let modelled = smoothstep(0.034, 0.02, fine);
        // Few triangles say more by their normals than by where they lie.
        let facing = (modelled < 1.0).then(|| {
            let facing: Field = relief.normals.par_iter().map(|n| n.x.atan2(n.z)).collect();
            smoothed(&facing, 1.5 * degree, 0.008 * row)
        });
        let share = smoothed(&relief.share, 2.0 * degree, 0.01 * row);
        // Normals of few triangles shade in patches: there the map reaches farther back.
        let farther_deg = ((fine - 0.011) / 0.03).clamp(0.0, 1.0) * 15.0;
        let angles: [(f32, f32); SIDE] = std::array::from_fn(|x| {
            let angle = Relief::angle(x as f32);
            (angle, angle.sin())
        });
        let heights: [(f32, f32); SIDE] = std::array::from_fn(|y| {
            let up = 1.0 - (y as f32 + 0.5) / SIDE as f32;
            (up, beyond(landmarks, up))
        });
        let cells = (0..SIDE * SIDE).into_par_iter();
        let (mut from_left, mut normal): (Field, Field) = cells
            .map(|i| {
                let (x, y) = (i % SIDE, i / SIDE);
                let ((angle, sin), (up, beyond)) = (angles[x], heights[y]);
                let turned = azimuth(&head, x, y);
                let across = sin * relief.distance[i] / relief.height;
                let place = Vec2::new(across, up);
                // The line between light and shade runs round what stands out.
                let in_front = smoothstep(40.0, 15.0, angle.to_degrees().abs());
                let round = landmarks.filter(|_| in_front > 0.0).map_or(0.0, |l| {
                    let raised = (features[i] - head[i]) / relief.height;
                    let slope = facing.as_ref().map_or(0.0, |f| (f[i] - turned).to_degrees().clamp(-60.0, 60.0));
                    let by_height = (raised * 1000.0).clamp(-12.0, 22.0);
                    (by_height * modelled + slope * (1.0 - modelled)) * (1.0 - near_eye(l, place)) * in_front
                });
                let mut dark_at = 90.0 + turned.to_degrees() + round;
                if let Some(landmarks) = landmarks {
                    dark_at += modelled * cheek_light(landmarks, place, dark_at);
                    if modelled < 1.0 {
                        dark_at += (1.0 - modelled) * cheek(landmarks, place);
                    }
                    dark_at = drawn(landmarks, style, place, dark_at);
                }
                let behind = smoothstep(77.0 + farther_deg, 100.0 + farther_deg, turned.to_degrees().abs());
                let below = smoothstep(0.98, 0.75, share[i]).max(beyond);
                ((dark_at / 180.0).clamp(0.0, 1.0), behind.max(below))
            })
            .unzip();
        if let Some(landmarks) = landmarks.filter(|l| l.mouth_is_bare()) {
            mouth(relief, landmarks, &mut from_left);
        }
        // Whatever lies outside of the picture repeats its edge.
        for i in 0..SIDE {
            for edge in [i, (SIDE - 1) * SIDE + i, i * SIDE, i * SIDE + SIDE - 1] {
                normal[edge] = 1.0;
            }
        }
        Self { from_left, normal }
    }

    /// Thresholds for light from the right and from the left, and the share of normal shading, at a place of the relief.
    pub(super) fn at(&self, place: Vec2) -> [f32; 3] {
        both(self.side(place), self.side(Vec2::new(1.0 - place.x, place.y)))
    }

    /// The same in the middle of a cell.
    pub(super) fn of_cell(&self, cell: usize) -> [f32; 3] {
        let mirrored = cell / SIDE * SIDE + (SIDE - 1 - cell % SIDE);
        let side = |cell: usize| [self.from_left[cell], self.normal[cell]];
        both(side(cell), side(mirrored))
    }

    /// Threshold for light from the left, and share of normal shading.
    fn side(&self, place: Vec2) -> [f32; 2] {
        [sample(&self.from_left, place), sample(&self.normal, place)]
    }
}

impl Thresholds {
    /// Leaves a cell to normal shading by this share at least.
    pub(super) fn leave(&mut self, cell: usize, share: f32) {
        if let Some(normal) = self.normal.get_mut(cell) {
            *normal = normal.max(share);
        }
    }
}

/// What both sides hold, of a place and of its mirror image: the mean is the same on both, to the last bit.
fn both([left, normal]: [f32; 2], [right, mirrored]: [f32; 2]) -> [f32; 3] {
    [right, left, 0.5 * (normal + mirrored)]
}

/// Share of normal shading at a height, whatever the angle.
fn beyond(landmarks: Option<&Landmarks>, up: f32) -> f32 {
    // Nothing follows the head there.
    let under = smoothstep(0.8, 0.6, up * (1.0 + MARGIN) / MARGIN);
    // Hair that is one mesh with the face begins where a forehead ends.
    let over = landmarks.map_or(0.0, |l| smoothstep(1.1, 1.35, (up - l.eye[1]) / (l.eye[1] - l.chin).max(1e-4)));
    under.max(over)
}

/// Where the surface looks to, as an angle from the front to the character's left, radians.
fn azimuth(distance: &[f32], x: usize, y: usize) -> f32 {
    let (low, high) = (x.saturating_sub(1), (x + 1).min(SIDE - 1));
    let step = (high - low) as f32 * 2.0 * REACH / SIDE as f32;
    let slope = (distance[y * SIDE + high] - distance[y * SIDE + low]) / step.max(1e-6);
    Relief::angle(x as f32) - slope.atan2(distance[y * SIDE + x].max(1e-6))
}

/// 1 on the eyes and their lids, which stay clean.
fn near_eye(l: &Landmarks, place: Vec2) -> f32 {
    let out = Vec2::new(place.x.abs() - l.eye[0], place.y - l.eye[1])
        / (Vec2::from(l.eye_half) * 1.35).max(Vec2::splat(1e-4));
    smoothstep(1.2, 0.8, out.length())
}

/// How much longer light stays under the far eye, degrees, while the nose shades what lies between.
fn cheek_light(l: &Landmarks, place: Vec2, dark_at: f32) -> f32 {
    // The far side of light from the left.
    let side = -place.x;
    if side <= 0.0 {
        return 0.0;
    }
    let top = l.eye[1] - 0.9 * l.eye_half[1];
    let bottom = l.mouth + 0.25 * (l.nose - l.mouth);
    let down = (top - place.y) / (top - bottom).max(1e-4);
    let half = l.eye_half[0] * (1.05 - 0.85 * down);
    let inside = smoothstep(1.0, 0.25, (side - l.eye[0] * (1.0 - 0.12 * down)).abs() / half.max(1e-4));
    let within = smoothstep(-0.25, 0.1, down) * smoothstep(1.05, 0.6, down);
    (100.0 - dark_at).clamp(0.0, 26.0) * inside * within
}

/// How much longer light stays on the cheek, degrees, where a mesh models none: the border of light bends round it, and
/// runs in towards temple and chin.
fn cheek(l: &Landmarks, place: Vec2) -> f32 {
    let middle = l.mouth + 0.4 * (l.eye[1] - l.mouth);
    let off = (place.y - middle) / (l.eye[1] - l.chin).max(1e-4);
    20.0 * (-(off / 0.42).powi(2)).exp() - 10.0
}

/// The nose: its shade on the far side, and a mark under the tip where the file paints none.
fn drawn(l: &Landmarks, style: FaceStyle, place: Vec2, dark_at: f32) -> f32 {
    let side = -place.x;
    let (tall, wide) = match style {
        FaceStyle::Soft => (0.36, 0.24),
        FaceStyle::Classic => (0.5, 0.48),
        FaceStyle::Minimal => (0.0, 0.0),
    };
    let bottom = l.nose - 0.16 * (l.nose - l.mouth);
    let tall = tall * (l.eye[1] - bottom);
    let wide = wide * l.eye_half[0];
    let mut dark_at = dark_at;
    if tall > 0.0 && side > -0.02 * wide {
        // A triangle along the bridge, whose lower edge rises outwards.
        let up = (place.y - bottom) / tall;
        let out = side / wide.max(1e-5);
        let edge = 1.0 - up.max(0.0);
        let lower = 0.18 * out;
        if up > lower && up < 1.0 && out < edge {
            let grown = out / edge.max(1e-3);
            dark_at = dark_at.min(36.0 + 27.0 * grown.max(up * 0.4));
        }
    }
    if !l.nose_is_painted {
        let from = Vec2::new(place.x / (0.2 * l.eye_half[0]), (place.y - bottom) / (0.055 * l.eye_half[0]).max(1e-5));
        if from.length() < 1.0 {
            dark_at = 0.0;
        }
    }
    dark_at
}

/// The crease between the lips, thinner towards its ends, where the mesh has it.
fn mouth(relief: &Relief, l: &Landmarks, dark_at: &mut [f32]) {
    // Height of the crease along the mouth, smoothed over its neighbours.
    let columns = 25usize;
    let along = |i: usize| i as f32 / (columns - 1) as f32 * l.mouth_half;
    let deepest = |across: f32| {
        let rows = (-8..=8).map(|i| l.mouth + i as f32 * 0.002);
        rows.max_by(|a, b| at(relief, &relief.dent, across, *a).total_cmp(&at(relief, &relief.dent, across, *b)))
            .unwrap_or(l.mouth)
    };
    let heights: Vec<f32> = (0..columns).map(|i| deepest(along(i))).collect();
    let smooth = |i: usize| {
        let near = &heights[i.saturating_sub(3)..(i + 4).min(columns)];
        near.iter().sum::<f32>() / near.len() as f32
    };
    let smoothed: Vec<f32> = (0..columns).map(smooth).collect();
    for y in 0..SIDE {
        let up = 1.0 - (y as f32 + 0.5) / SIDE as f32;
        for x in 0..SIDE {
            let angle = Relief::angle(x as f32);
            if angle.abs() > 0.25 * PI {
                continue;
            }
            let across = (angle.sin() * relief.distance[y * SIDE + x] / relief.height).abs();
            let share = across / l.mouth_half.max(1e-5);
            if share < 0.85 {
                let i = ((share * (columns - 1) as f32).round() as usize).min(columns - 1);
                let thick = 0.0042 * (1.0 - (share / 0.85).powi(2)).max(0.15);
                if (up - smoothed[i]).abs() < thick {
                    dark_at[y * SIDE + x] = 0.0;
                }
            }
        }
    }
}
