//! Tufts of fur: pointed clumps laid over one another like shingles.

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

/// Adds a tuft: three rings of five and a tip.
pub(super) fn add(part: &mut Part, tuft: &Tuft, weights: Weights) {
    const RING: u32 = 5;
    let first = part.vertices.len() as u32;
    let length = tuft.reach.length();
    let along = tuft.reach / length;
    let out = (tuft.out - along * tuft.out.dot(along)).normalize_or(Vec3::Y);
    let side = out.cross(along);
    let at = |t: f32| tuft.root + tuft.reach * t + out * (tuft.bend * length * t * t);
    let uv = |u: f32, v: f32| Vec2::new(tuft.column + 0.22 * (u - 0.5), v);
    for (t, share) in [(0.0, 0.72), (0.34, 1.0), (0.7, 0.6)] {
        let w = tuft.half * share;
        let h = w * 0.62;
        for (x, y, u) in [
            (-w, -0.3 * h, 0.0),
            (-0.5 * w, 0.7 * h, 0.25),
            (0.05 * w, h, 0.5),
            (0.55 * w, 0.65 * h, 0.75),
            (w, -0.3 * h, 1.0),
        ] {
            part.vertex(at(t) + side * x + out * y, uv(u, 0.04 + 0.92 * t), weights);
        }
    }
    part.quads(first, 3, RING, true);
    let tip = part.vertex(at(1.0), uv(0.5, 0.99), weights);
    for i in 0..RING {
        part.triangles.push([first + 2 * RING + i, tip, first + 2 * RING + (i + 1) % RING]);
    }
}
