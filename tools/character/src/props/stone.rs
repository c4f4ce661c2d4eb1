//! Stones: the amber drop of the pendant and the brilliant of the hair-pin.

use glam::{Vec2, Vec3};

use super::{CORD, STONE_STANDS, before_chest};
use crate::loft::{grid, ring_in, row, turn};
use crate::mesh::Part;
use crate::skeleton::{Skeleton, blend};

/// Middle of the hair-pin, on the bangs over her left temple.
pub(super) const PIN: Vec3 = Vec3::new(0.0785, 1.487, 0.0745);

/// Axes of the hair-pin: along its bar, up, away from the head.
pub(super) fn pin_frame() -> [Vec3; 3] {
    let front = Vec3::new(0.72, 0.42, 0.62).normalize();
    let right = Vec3::new(0.55, -0.38, -0.5);
    let right = (right - front * right.dot(front)).normalize();
    [right, front.cross(right), front]
}

const AMBER_COLUMNS: usize = 32;

/// A profile with a place between each two, on a smooth curve through all of them (Catmull-Rom).
fn rounded(profile: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let at = |i: usize| Vec2::from(profile[i.min(profile.len() - 1)]);
    let mut all = vec![profile[0]];
    for i in 1..profile.len() {
        let between = (at(i - 1) + at(i)) * 0.5625 - (at(i.saturating_sub(2)) + at(i + 1)) * 0.0625;
        all.extend([between.to_array(), profile[i]]);
    }
    all
}

/// The amber drop.
pub(super) fn amber([_, lower]: [usize; 2]) -> Part {
    let mut part = Part::new("Pendant", "Accessory_Amber");
    let bone = blend(&[(lower, 1.0)]);
    let top = before_chest(CORD[1], STONE_STANDS);
    // Depth below the cap and radius.
    let profile: [[f32; 2]; 11] = [
        [0.0025, 0.0042],
        [0.0045, 0.0058],
        [0.008, 0.0076],
        [0.0125, 0.0092],
        [0.017, 0.0102],
        [0.0212, 0.0103],
        [0.025, 0.0094],
        [0.028, 0.0077],
        [0.0302, 0.0053],
        [0.0314, 0.0029],
        [0.0318, 0.0011],
    ];
    // Downwards: right × up is -Y.
    let rows: Vec<Vec<Vec3>> = rounded(&profile)
        .into_iter()
        .map(|[down, r]| ring_in(top - Vec3::Y * down, Vec3::X * r, Vec3::Z * r * 0.78, AMBER_COLUMNS))
        .collect();
    let (columns, last) = (AMBER_COLUMNS as u32 + 1, rows.len() as u32 - 1);
    let span = profile[10][0] - profile[0][0];
    let first = grid(&mut part, &rows, true, |r, c| Vec2::new(c, r), |_| bone);
    for v in &mut part.vertices {
        // As seen from the front; the back mirrors it.
        let d = v.position - top;
        v.uv = Vec2::new(0.5 + 0.47 * d.x / 0.0103, 0.02 + 0.96 * (-d.y - profile[0][0]) / span);
    }
    part.cap(&row(first, columns, 0, true), Vec2::new(0.5, 0.02), bone);
    part.cap(&row(first, columns, last, false), Vec2::new(0.5, 0.98), bone);
    part.smooth_normals();
    part
}

/// A round brilliant: table, crown and pavilion as flat facets.
pub(super) fn diamond(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("HairPinDiamond", "Accessory_Diamond");
    let bone = skeleton.only("head");
    let [right, up, front] = pin_frame();
    let radius = 0.0105;
    let at = |i: usize, n: usize, r: f32, h: f32| {
        let (s, c) = turn(i, n);
        PIN + (right * s + up * c) * r * radius + front * h * radius
    };
    let mut facet = |points: &[Vec3]| {
        let normal = (points[1] - points[0]).cross(points[2] - points[0]).normalize();
        let first = part.vertices.len() as u32;
        for p in points {
            let d = (*p - PIN) / radius;
            let i = part.vertex(*p, Vec2::new(0.5 + 0.49 * d.dot(right), 0.5 - 0.49 * d.dot(up)), bone);
            part.vertices[i as usize].normal = normal;
        }
        for k in 1..points.len() as u32 - 1 {
            part.triangles.push([first, first + k, first + k + 1]);
        }
    };
    // Counter-clockwise seen from outside: the angle falls.
    let table: Vec<Vec3> = (0..8).rev().map(|i| at(i, 8, 0.54, 0.46)).collect();
    facet(&table);
    let girdle = |i: usize, h: f32| at(i % 16, 16, 1.0, h);
    for i in 0..8 {
        let (corner, next) = (at(i, 8, 0.54, 0.46), at((i + 1) % 8, 8, 0.54, 0.46));
        let star = at(2 * i + 1, 16, 0.74, 0.35);
        let before = at((2 * i + 15) % 16, 16, 0.74, 0.35);
        let (g0, g1, g2) = (girdle(2 * i, 0.08), girdle(2 * i + 1, 0.08), girdle(2 * i + 2, 0.08));
        facet(&[corner, star, next]);
        facet(&[corner, before, g0, star]);
        facet(&[star, g0, g1]);
        facet(&[star, g1, g2]);
        let (l0, l1, l2) = (girdle(2 * i, -0.02), girdle(2 * i + 1, -0.02), girdle(2 * i + 2, -0.02));
        facet(&[g0, l0, l1, g1]);
        facet(&[g1, l1, l2, g2]);
        let tip = PIN - front * radius * 0.5;
        facet(&[l0, tip, l1]);
        facet(&[l1, tip, l2]);
    }
    orient(&mut part);
    part
}

/// Turns facets that look inwards: the stone is convex.
fn orient(part: &mut Part) {
    for t in &mut part.triangles {
        let [a, b, c] = t.map(|i| part.vertices[i as usize].position);
        let normal = (b - a).cross(c - a).normalize();
        let inwards = normal.dot((a + b + c) / 3.0 - PIN) < 0.0;
        if inwards {
            t.swap(1, 2);
        }
        for i in *t {
            part.vertices[i as usize].normal = if inwards { -normal } else { normal };
        }
    }
}
