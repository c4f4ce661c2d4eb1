//! Tufts of fur: cards with pointed strands, laid over one another like shingles.

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
const STATIONS: [[f32; 2]; 4] = [[0.0, 0.7], [0.34, 1.0], [0.68, 1.05], [1.0, 0.9]];
/// Across a tuft: side, height over its edges, texture.
const ACROSS: [[f32; 3]; 3] = [[-1.0, -0.24, 0.0], [0.0, 0.3, 0.5], [1.0, -0.24, 1.0]];

/// Adds a tuft: a curved card; the strands at its end are cut out of it by the texture's alpha.
pub(super) fn add(part: &mut Part, tuft: &Tuft, weights: Weights) {
    let first = part.vertices.len() as u32;
    let length = tuft.reach.length();
    let along = tuft.reach / length;
    let out = (tuft.out - along * tuft.out.dot(along)).normalize_or(Vec3::Y);
    let side = out.cross(along);
    for [t, share] in STATIONS {
        let w = tuft.half * share;
        let middle = tuft.root + tuft.reach * t + out * (tuft.bend * length * t * t);
        for [x, y, u] in ACROSS {
            let at = Vec2::new(tuft.column + 0.24 * (u - 0.5), 0.02 + 0.96 * t);
            part.vertex(middle + (side * x + out * y) * w, at, weights);
        }
    }
    part.quads(first, STATIONS.len() as u32, ACROSS.len() as u32, false);
}
