//! Where a surface goes on beyond the border of a chart of its texture coordinates.

use std::collections::HashMap;

use glam::{Mat2, Mat4, Vec2, Vec3};

use crate::scene::Primitive;

/// What is nearer than this is one place, shares of the size of a surface.
const SAME: f32 = 1e-5;

/// A step over an edge at which texture coordinates are cut, in texels: the place `p` beyond it is `base + across * p`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct Seam {
    /// Columns.
    pub across: [f32; 4],
    pub base: [f32; 2],
    unused: [f32; 2],
}

/// Seams of a layer, and the nearest one of each texel, counted from 1; 0 where there is none near.
#[derive(Debug)]
pub(crate) struct Seams {
    pub list: Vec<Seam>,
    pub nearest: Vec<u16>,
}

/// A side of a triangle, in texels and in space, and the corner that is not on it.
#[derive(Clone, Copy)]
struct Side {
    texels: [Vec2; 3],
    places: [Vec3; 3],
}

impl Side {
    /// Texels to mm of a plane, whose x is along the side; the third corner lies to this side of it.
    fn flat(&self, sign: f32) -> Option<Mat2> {
        let ([a, b, c], [pa, pb, pc]) = (self.texels, self.places);
        let along = (pb - pa).try_normalize()?;
        let in_plane = |p: Vec3| {
            let x = (p - pa).dot(along);
            Vec2::new(x, sign * (p - pa - along * x).length())
        };
        let from_corners = Mat2::from_cols(b - a, c - a);
        let to_corners = Mat2::from_cols(in_plane(pb), in_plane(pc));
        let sound = from_corners.determinant().abs() > 1e-6 && to_corners.determinant().abs() > 1e-18;
        sound.then(|| to_corners * from_corners.inverse())
    }

    /// The step over it onto the triangle at its other side.
    fn step_to(&self, other: &Self) -> Option<Seam> {
        let across = other.flat(1.0)?.inverse() * self.flat(-1.0)?;
        let base = other.texels[0] - across * self.texels[0];
        let seam = Seam { across: across.to_cols_array(), base: base.to_array(), unused: [0.0; 2] };
        (across.is_finite() && base.is_finite()).then_some(seam)
    }

    fn turned(&self) -> Self {
        let turn = |[a, b, c]: [Vec3; 3]| [b, a, c];
        let [a, b, c] = self.texels;
        Self { texels: [b, a, c], places: turn(self.places) }
    }
}

impl Seams {
    /// Of parts with their places at rest; `texel_of` places texture coordinates among `side` texels, of which those as
    /// near as `reach` are near.
    pub fn of<'a>(
        parts: impl Iterator<Item = (&'a Primitive, Mat4)>,
        texel_of: impl Fn(Vec2) -> Vec2,
        side: u32,
        reach: f32,
    ) -> Self {
        let parts: Vec<_> = parts.collect();
        let places =
            parts.iter().flat_map(|(part, rest)| part.positions.iter().map(|p| rest.transform_point3(Vec3::from(*p))));
        let (low, high) = places.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
        let grain = ((high - low).length() * SAME).max(1e-12);
        let mut sides: HashMap<[[i32; 3]; 2], Vec<Side>> = HashMap::new();
        for (part, rest) in parts {
            let Some(uvs) = part.uvs.first() else { continue };
            for t in part.indices.chunks_exact(3) {
                let corner = |i: u32| {
                    let place = rest.transform_point3(Vec3::from(*part.positions.get(i as usize)?));
                    Some((place, texel_of(Vec2::from(*uvs.get(i as usize)?))))
                };
                let [Some(a), Some(b), Some(c)] = [t[0], t[1], t[2]].map(corner) else { continue };
                for [a, b, c] in [[a, b, c], [b, c, a], [c, a, b]] {
                    let side = Side { texels: [a.1, b.1, c.1], places: [a.0, b.0, c.0] };
                    // Ends of a side by their place: corners are apart where coordinates are.
                    let key = |p: Vec3| (p / grain).round().as_ivec3().to_array();
                    let (from, to) = (key(a.0), key(b.0));
                    let (key, side) = if from <= to {
                        ([from, to], side)
                    } else {
                        ([to, from], side.turned())
                    };
                    sides.entry(key).or_default().push(side);
                }
            }
        }
        let mut found: Vec<(Side, Seam)> = Vec::new();
        for pair in sides.values() {
            let [one, other] = pair.as_slice() else { continue };
            let is_cut = (0..2).any(|end| one.texels[end].distance(other.texels[end]) > 0.01);
            if is_cut {
                found.extend([(one, other), (other, one)].into_iter().filter_map(|(a, b)| Some((*a, a.step_to(b)?))));
            }
        }
        // Maps have no order; pictures do.
        found.sort_by(|(a, _), (b, _)| {
            a.texels[0].to_array().partial_cmp(&b.texels[0].to_array()).unwrap_or(std::cmp::Ordering::Equal)
        });
        found.truncate(usize::from(u16::MAX));
        let mut nearest = vec![0; if found.is_empty() { 1 } else { (side * side) as usize }];
        let mut away = vec![reach * reach; nearest.len()];
        for (number, (Side { texels: [a, b, c], .. }, _)) in (1u16..).zip(&found) {
            let along = *b - *a;
            let inside = along.perp_dot(*c - *a).signum();
            let clamped = |v: Vec2| v.clamp(Vec2::ZERO, Vec2::splat(side as f32)).as_uvec2();
            let (low, high) = (clamped(a.min(*b) - reach), clamped(a.max(*b) + reach + 1.0));
            for y in low.y..high.y {
                for x in low.x..high.x {
                    let p = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) - *a;
                    let share = (p.dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
                    let distance = p.distance_squared(along * share);
                    let at = (y * side + x) as usize;
                    if distance < away[at] && along.perp_dot(p) * inside >= 0.0 {
                        (away[at], nearest[at]) = (distance, number);
                    }
                }
            }
        }
        Self { list: found.into_iter().map(|(_, seam)| seam).collect(), nearest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_lead_to_the_same_place_of_the_surface() {
        // A strip of two squares whose charts are turned and of another size.
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let moved = |p: &[f32; 3]| [p[0] + 1.0, p[1], p[2]];
        let uvs = vec![[0.1, 0.1], [0.3, 0.1], [0.3, 0.3], [0.1, 0.3]];
        // u up, v to the left.
        let others =
            [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]: [f32; 2]| [0.5 + 0.4 * y, 0.9 - 0.4 * x]);
        let part = Primitive {
            positions: positions.iter().copied().chain(positions.iter().map(moved)).collect(),
            uvs: vec![uvs.into_iter().chain(others).collect()],
            indices: vec![0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7],
            ..Primitive::default()
        };
        let seams = Seams::of([(&part, Mat4::IDENTITY)].into_iter(), |uv| uv * 100.0, 100, 8.0);
        assert_eq!(seams.list.len(), 2);
        let over = |at: Vec2| {
            let seam = seams.list[usize::from(seams.nearest[(at.y as usize) * 100 + at.x as usize]) - 1];
            move |p: Vec2| Vec2::from(seam.base) + Mat2::from_cols_array(&seam.across) * p
        };
        // Beyond the right border by a tenth of a square, halfway up.
        let found = over(Vec2::new(29.5, 20.5))(Vec2::new(32.0, 20.0));
        assert!(found.distance(Vec2::new(70.0, 86.0)) < 1e-3, "{found}");
        // And back.
        let back = over(Vec2::new(70.5, 88.5))(Vec2::new(70.0, 94.0));
        assert!(back.distance(Vec2::new(28.0, 20.0)) < 1e-3, "{back}");
        assert_eq!(seams.nearest[15 * 100 + 15], 0);
    }
}
