//! Tufts of fur: pointed leaves laid over one another like shingles. What separates them is painted, not outlined.

use glam::{Vec2, Vec3};

use crate::mesh::Part;
use crate::skeleton::Weights;

/// A clump: where it grows, which way it points, which way is out of the fur.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tuft {
    /// Middle of the root.
    pub(super) root: Vec3,
    /// From root to tip, with its length.
    pub(super) reach: Vec3,
    /// Unit vector out of the fur.
    pub(super) out: Vec3,
    /// Half width.
    pub(super) half: f32,
    /// Bend of the tip: out of the fur where positive, a share of the length.
    pub(super) bend: f32,
    /// Column of the texture, 0..1.
    pub(super) column: f32,
}

/// Heights along a tuft and its width there.
const STATIONS: [[f32; 2]; 4] = [[0.0, 0.8], [0.3, 1.0], [0.6, 0.74], [0.83, 0.38]];
/// Across a tuft: side, height over its edges, texture.
const ACROSS: [[f32; 3]; 4] = [[-1.0, -0.2, 0.0], [-0.36, 0.34, 0.32], [0.36, 0.34, 0.68], [1.0, -0.2, 1.0]];

/// Adds a tuft: a curved leaf of four columns that runs into a tip.
pub(super) fn add(part: &mut Part, tuft: &Tuft, weights: Weights) {
    let columns = ACROSS.len() as u32;
    let first = part.vertices.len() as u32;
    let length = tuft.reach.length();
    let along = tuft.reach / length;
    let out = (tuft.out - along * tuft.out.dot(along)).normalize_or(Vec3::Y);
    let side = out.cross(along);
    let at = |t: f32| tuft.root + tuft.reach * t + out * (tuft.bend * length * t * t);
    let uv = |u: f32, v: f32| Vec2::new(tuft.column + 0.24 * (u - 0.5), v);
    for [t, share] in STATIONS {
        let w = tuft.half * share;
        for [x, y, u] in ACROSS {
            part.vertex(at(t) + (side * x + out * y) * w, uv(u, 0.02 + 0.96 * t), weights);
        }
    }
    part.quads(first, STATIONS.len() as u32, columns, false);
    let tip = part.vertex(at(1.0), uv(0.5, 0.99), weights);
    let last = first + (STATIONS.len() as u32 - 1) * columns;
    for i in 0..columns - 1 {
        part.triangles.push([last + i, tip, last + i + 1]);
    }
}
