//! Triangles written into a square picture.

use glam::{Vec2, Vec3A};

/// Texels that the triangles' boxes may cover in all, in pictures: those of an unwrapped face cover it about twice, and a
/// hostile file must not keep us busy.
const MOST: usize = 64;

/// A vertex: where it lies in the picture, 0..1, and what it holds.
#[derive(Clone, Copy)]
pub(super) struct Corner<const N: usize> {
    pub(super) uv: Vec2,
    pub(super) value: [f32; N],
}

/// A picture of some numbers a texel.
pub(super) struct Raster<const N: usize> {
    pub(super) side: usize,
    /// `None` where nothing lies.
    pub(super) texels: Vec<Option<[f32; N]>>,
    spent: usize,
}

impl<const N: usize> Raster<N> {
    pub(super) fn new(side: usize) -> Self {
        Self { side, texels: vec![None; side * side], spent: 0 }
    }

    /// Writes a triangle, with its values between those of its corners, where `wins` prefers the new value over the one that is
    /// there. `None` once triangles have covered the picture so often that nobody can have meant it.
    pub(super) fn triangle(
        &mut self,
        [a, b, c]: [Corner<N>; 3],
        mut wins: impl FnMut(&[f32; N], &[f32; N]) -> bool,
    ) -> Option<()> {
        let side = self.side as f32;
        let [p, q, r] = [a, b, c].map(|corner| corner.uv * side - 0.5);
        let bound = |x: f32| x.clamp(0.0, side - 1.0) as usize;
        let (low, high) = (p.min(q).min(r).ceil(), p.max(q).max(r).floor());
        let [left, right, top, bottom] = [bound(low.x), bound(high.x), bound(low.y), bound(high.y)];
        self.spent += (right + 1).saturating_sub(left) * (bottom + 1).saturating_sub(top);
        if self.spent > MOST * self.texels.len() {
            return None;
        }
        let area = (q - p).perp_dot(r - p);
        if area.abs() < 1e-9 || !area.is_finite() {
            return Some(());
        }
        // Shares of the three corners at once.
        let (along, from) = ([r - q, p - r, q - p], [q, r, p]);
        let [along_x, from_x] = [along, from].map(|of| Vec3A::from(of.map(|p| p.x)));
        let [along_y, from_y] = [along, from].map(|of| Vec3A::from(of.map(|p| p.y)));
        for y in top..=bottom {
            let of_row = along_x * (y as f32 - from_y);
            for x in left..=right {
                let shares = (of_row - along_y * (x as f32 - from_x)) / area;
                if shares.min_element() >= -1e-4 {
                    let [u, v, w] = shares.to_array();
                    let texel = &mut self.texels[y * self.side + x];
                    let value = std::array::from_fn(|i| a.value[i] * u + b.value[i] * v + c.value[i] * w);
                    if texel.as_ref().is_none_or(|old| wins(old, &value)) {
                        *texel = Some(value);
                    }
                }
            }
        }
        Some(())
    }

    /// Covers what lies round the triangles, ring by ring, with the mean of what is covered beside it.
    pub(super) fn grow(&mut self, rings: usize) {
        let side = self.side;
        let beside = |i: usize| {
            let (x, y) = (i % side, i / side);
            let rows = y.saturating_sub(1)..(y + 2).min(side);
            rows.flat_map(move |y| (x.saturating_sub(1)..(x + 2).min(side)).map(move |x| y * side + x))
        };
        let texels = &mut self.texels;
        let mut ring: Vec<usize> =
            (0..texels.len()).filter(|i| texels[*i].is_none() && beside(*i).any(|n| texels[n].is_some())).collect();
        let mut is_queued = vec![false; texels.len()];
        for _ in 0..rings {
            let mean = |i: &usize| {
                let near = beside(*i).filter_map(|n| texels[n]);
                let (sum, count) = near.fold(([0.0; N], 0usize), |(sum, count), value| {
                    (std::array::from_fn(|c: usize| sum[c] + value[c]), count + 1)
                });
                sum.map(|c: f32| c / count.max(1) as f32)
            };
            let means: Vec<[f32; N]> = ring.iter().map(mean).collect();
            ring.iter().zip(means).for_each(|(i, mean)| texels[*i] = Some(mean));
            let mut next = Vec::new();
            for n in ring.iter().flat_map(|i| beside(*i)) {
                if texels[n].is_none() && !std::mem::replace(&mut is_queued[n], true) {
                    next.push(n);
                }
            }
            if next.is_empty() {
                break;
            }
            ring = next;
        }
    }
}
