//! A face as a relief: its distance from an upright axis through the head, alike on both sides.

use std::collections::BTreeSet;

use glam::{Mat4, Vec2, Vec3};
use rayon::prelude::*;

use super::raster::{Corner, Raster};
use crate::color::LinearRgb;
use crate::scene::painted::Painted;
use crate::scene::{Primitive, Role, Scene};

/// Rows and columns.
pub(super) const SIDE: usize = 384;
/// Angle round the axis on either side of the front that the relief holds, radians.
pub(super) const REACH: f32 = 2.0;

/// Angle on either side of the front up to which it is looked for what a face is read by, radians.
const FRONT: f32 = 1.25;

/// Share of the head's height that the relief reaches below it, so that coarser levels of its maps keep the neck apart.
pub(super) const MARGIN: f32 = 0.09;

/// A field over the relief, rows from above.
pub(super) type Field = Vec<f32>;

/// The relief of the head's faces of one material.
pub(super) struct Relief {
    /// Where the axis stands in the world at rest; y is the height of the lower edge.
    pub(super) foot: Vec3,
    /// Height from the lower to the upper edge, metres.
    pub(super) height: f32,
    /// Distance from the axis, metres; whole, where eyes and mouth are holes in the mesh.
    pub(super) distance: Field,
    /// How far it lies behind its broader surroundings, metres: creases.
    pub(super) dent: Field,
    /// Share that follows the head: 0..1.
    pub(super) share: Field,
    /// Luminance of what the file paints there, before [`FRONT`]: 0 elsewhere.
    pub(super) painted: Field,
    /// Normals of the mesh, in the world at rest.
    pub(super) normals: Vec<Vec3>,
    /// Mean side of the mesh's triangles in front, each counted by its area, share of the height: what is finer is a facet.
    pub(super) facet: f32,
}

impl Relief {
    /// Of the parts of a material that are a face. `None` without such parts under a head bone.
    pub(super) fn new(scene: &Scene, material: usize) -> Option<Self> {
        let paint = Painted::new(scene, scene.materials.get(material)?);
        let (low, high) = scene.face_box(Some(material))?;
        let head = high.y - low.y;
        let low = low.with_y(low.y - MARGIN * head);
        let height = high.y - low.y;
        // Masks have no back: they lie round the same axis as a whole head.
        let depth = ((high.z - low.z) * 0.5).max(0.4 * head);
        let foot = Vec3::new((low.x + high.x) * 0.5, low.y, high.z - depth);
        let mut raster = Raster::new(SIDE);
        let (mut area, mut sides) = (0.0, 0.0);
        let metres = Vec2::new(2.0 * REACH * depth, height);
        for (primitive, matrix, shares) in faces(scene, material)? {
            let corner = |v: usize| {
                let position = matrix.transform_point3(Vec3::from(primitive.positions[v]));
                let (place, distance) = place(foot, height, position);
                let [u, w] = paint.uv(primitive, v);
                let normal = primitive.normals.get(v).map_or(Vec3::Z, |n| matrix.transform_vector3(Vec3::from(*n)));
                let [nx, ny, nz] = normal.normalize_or(Vec3::Z).to_array();
                Corner { uv: place, value: [distance, shares[v], u, w, nx, ny, nz] }
            };
            let corners: Vec<Corner<7>> = (0..primitive.positions.len()).map(corner).collect();
            for t in primitive.indices.chunks_exact(3) {
                let corner = |i: usize| corners.get(t[i] as usize).copied();
                if let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) {
                    // Behind the head, angles jump.
                    let is_behind = [a, b, c].iter().any(|c| (c.uv.x - 0.5).abs() > 0.7);
                    if [a, b, c].iter().all(|c| (c.uv.x - 0.5).abs() < 0.25) {
                        let of = 0.5 * ((b.uv - a.uv) * metres).perp_dot((c.uv - a.uv) * metres).abs();
                        (area, sides) = (area + of, sides + of * (2.0 * of).sqrt());
                    }
                    if !is_behind {
                        raster.triangle([a, b, c], |old, new| new[0] > old[0])?;
                    }
                }
            }
        }
        if raster.texels.iter().all(Option::is_none) {
            return None;
        }
        raster.grow(SIDE);
        let value = |texel: &Option<[f32; 7]>| texel.unwrap_or([depth, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        let field = |pick: &(dyn Fn([f32; 7]) -> f32 + Sync)| -> Field {
            let field: Field = raster.texels.par_iter().map(|texel| pick(value(texel))).collect();
            even(&field)
        };
        let front = [-FRONT, FRONT].map(|angle| Self::cell(Vec2::new(0.5 + 0.5 * angle / REACH, 0.0))[0]);
        let luminance = |(i, texel): (usize, &Option<[f32; 7]>)| {
            if !(front[0]..=front[1]).contains(&(i % SIDE)) {
                return 0.0;
            }
            let [.., u, w, _, _, _] = value(texel);
            let [r, g, b, _] = paint.at([u, w]);
            LinearRgb([r, g, b]).luminance()
        };
        let painted: Field = raster.texels.par_iter().enumerate().map(luminance).collect();
        let distance = field(&|v| v[0]);
        let (broad, fine) = (smoothed(&distance, 7.0, 7.0), smoothed(&distance, 1.0, 1.0));
        Some(Self {
            foot,
            height,
            dent: broad.iter().zip(&fine).map(|(b, f)| b - f).collect(),
            distance,
            share: field(&|v| v[1]),
            painted: even(&painted),
            facet: sides / f32::max(area, 1e-12) / height,
            normals: raster.texels.par_iter().map(|t| Vec3::from_slice(&value(t)[4..]).normalize_or(Vec3::Z)).collect(),
        })
    }

    /// Place on the relief, 0..1 from the character's right and from above, and distance from the axis, of a point of the world
    /// at rest.
    pub(super) fn place(&self, position: Vec3) -> (Vec2, f32) {
        place(self.foot, self.height, position)
    }

    /// Angle round the axis from the front to the character's left at a column, radians.
    pub(super) fn angle(column: f32) -> f32 {
        ((column + 0.5) / SIDE as f32 * 2.0 - 1.0) * REACH
    }

    /// Column and row of a place.
    pub(super) fn cell(place: Vec2) -> [usize; 2] {
        [place.x, place.y].map(|c| ((c * SIDE as f32).max(0.0) as usize).min(SIDE - 1))
    }

    /// Distance along the face from the middle to the character's left, and height over the lower edge, shares of the height.
    pub(super) fn across_and_up(&self, position: Vec3) -> Vec2 {
        Vec2::new(position.x - self.foot.x, position.y - self.foot.y) / self.height
    }
}

fn place(foot: Vec3, height: f32, position: Vec3) -> (Vec2, f32) {
    let out = position - foot;
    let angle = out.x.atan2(out.z);
    (Vec2::new(0.5 + 0.5 * angle / REACH, 1.0 - out.y / height), out.with_y(0.0).length())
}

/// Both sides are one, so that light from both shows the same face.
fn even(field: &[f32]) -> Field {
    let rows = field.chunks_exact(SIDE);
    rows.flat_map(|row| row.iter().zip(row.iter().rev()).map(|(a, b)| 0.5 * (a + b))).collect()
}

/// A field's value between its cells; outside of it that of the edge.
pub(super) fn sample(field: &[f32], place: Vec2) -> f32 {
    let at = |c: f32| (c * SIDE as f32 - 0.5).clamp(0.0, SIDE as f32 - 1.0);
    let (x, y) = (at(place.x), at(place.y));
    let (i, j, s, t) = (x as usize, y as usize, x.fract(), y.fract());
    let (k, l) = ((i + 1).min(SIDE - 1), (j + 1).min(SIDE - 1));
    let row = |j: usize| field[j * SIDE + i] * (1.0 - s) + field[j * SIDE + k] * s;
    row(j) * (1.0 - t) + row(l) * t
}

/// Rows that are smoothed side by side.
const STRIP: usize = 16;

/// A field smoothed by a bell of this half width (standard deviation), cells across and down.
pub(super) fn smoothed(field: &[f32], across: f32, down: f32) -> Field {
    let mut out = field.to_vec();
    for width in [across, down] {
        let strips = out.par_chunks_exact(STRIP * SIDE).map(|rows| {
            let mut strip: Vec<[f32; STRIP]> =
                (0..SIDE).map(|x| std::array::from_fn(|row| rows[row * SIDE + x])).collect();
            // Three boxes are nearly a bell.
            (0..3).for_each(|_| boxed(&mut strip, width.round() as usize));
            strip
        });
        let strips: Vec<_> = strips.collect();
        // Turned: what was across is down the next time.
        out.par_chunks_exact_mut(SIDE).enumerate().for_each(|(x, row)| {
            row.chunks_exact_mut(STRIP).zip(&strips).for_each(|(to, strip)| to.copy_from_slice(&strip[x]));
        });
    }
    out
}

/// Means of as many cells on both sides along rows that lie side by side; the ends go on beyond the edges.
fn boxed(strip: &mut [[f32; STRIP]], reach: usize) {
    if reach == 0 {
        return;
    }
    let old = strip.to_vec();
    let at = |x: usize| &old[x.saturating_sub(reach).min(SIDE - 1)];
    let count = (2 * reach + 1) as f32;
    let mut sums = [0.0; STRIP];
    for x in 0..=2 * reach {
        sums.iter_mut().zip(at(x)).for_each(|(sum, value)| *sum += value);
    }
    for (x, cell) in strip.iter_mut().enumerate() {
        *cell = sums.map(|sum| sum / count);
        let (next, last) = (at(x + 2 * reach + 1), at(x));
        sums.iter_mut().zip(next.iter().zip(last)).for_each(|(sum, (next, last))| *sum += next - last);
    }
}

/// The parts of a material that are a face, what takes each to the world at rest, and how much of each vertex follows the head.
pub(super) fn faces(scene: &Scene, material: usize) -> Option<Vec<(&Primitive, Mat4, Vec<f32>)>> {
    let head = scene.head_node()?;
    let world = scene.rest_world_from_nodes();
    let below: BTreeSet<usize> = scene.descendants(head);
    let parts = scene.mesh_nodes().flat_map(|(node, mesh)| mesh.primitives.iter().map(move |p| (node, p)));
    let faces: Vec<_> = parts
        .filter(|(_, p)| p.material == material && p.role == Role::Face)
        .map(|(node, p)| (p, scene.rest_placement(&world, node), scene.shares(node, p, &below)))
        .collect();
    (!faces.is_empty()).then_some(faces)
}
