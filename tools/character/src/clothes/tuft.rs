//! Tufts of fur: clumps of three curved, tapered cones, laid over one another like shingles.

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
    /// How far the tip stands out of the fur, a share of the length.
    pub(super) bend: f32,
    /// How far the tip turns to the side, a share of the length.
    pub(super) sway: f32,
    /// Column of the texture.
    pub(super) column: f32,
    /// Cones: 1 to 3.
    pub(super) cones: usize,
}

/// Share of the texture's height and width that a tuft takes: the hairs that looks lay on fur have the size of the texture.
pub(super) const UV: [f32; 2] = [0.12, 0.2];

/// Places along a cone and its width there; the tip follows.
const MAIN: &[[f32; 2]] = &[[0.0, 0.72], [0.27, 1.0], [0.55, 0.9], [0.8, 0.52]];
const SIDE: &[[f32; 2]] = &[[0.0, 0.7], [0.4, 1.0], [0.75, 0.6]];
/// Cones of a clump: stations, turn to the side, length, width, place to the side, height.
const CONES: [(&[[f32; 2]], f32, f32, f32, f32, f32); 3] =
    [(MAIN, 0.0, 1.0, 1.0, 0.0, 0.0), (SIDE, 0.42, 0.76, 0.62, 0.55, -0.3), (SIDE, -0.5, 0.62, 0.58, -0.58, -0.36)];

/// Adds a tuft. Its normals are those of its cones; see `soften`.
pub(super) fn add(part: &mut Part, tuft: &Tuft, weights: Weights) {
    let length = tuft.reach.length();
    let along = tuft.reach / length;
    let out = (tuft.out - along * tuft.out.dot(along)).normalize_or(Vec3::Y);
    let side = out.cross(along);
    let turned = if tuft.sway < 0.0 { -1.0 } else { 1.0 };
    for (stations, turn, long, wide, shift, height) in CONES.into_iter().take(tuft.cones) {
        let turn = turn * turned;
        let way = (along + side * turn).normalize() * length * long;
        let root = tuft.root + (side * shift * turned + out * height) * tuft.half;
        let half = tuft.half * wide;
        let spine = |t: f32| {
            // Up out of its neighbours, down, and out again at the tip.
            let lift = 0.55 * half * (t * std::f32::consts::PI).sin() + tuft.bend * length * long * t * t * t;
            root + way * t + out * lift + side * (tuft.sway * length * long * t * t)
        };
        let uv = |t: f32, x: f32| Vec2::new(tuft.column + UV[0] * 0.5 * (1.0 + x * wide), UV[1] * (0.04 + 0.92 * t));
        let first = part.vertices.len() as u32;
        for [t, share] in stations {
            let tangent = (spine(t + 0.05) - spine(t - 0.05)).normalize();
            let up = (out - tangent * out.dot(tangent)).normalize_or(out);
            let right = up.cross(tangent);
            let w = half * share;
            for (x, y) in [(-1.0, -0.32), (0.0, 0.42), (1.0, -0.32)] {
                let i = part.vertex(spine(*t) + (right * x + up * y) * w, uv(*t, x), weights);
                part.vertices[i as usize].normal = (up + right * x * 1.1).normalize();
            }
        }
        let rows = stations.len() as u32;
        part.quads(first, rows, 3, false);
        let tangent = (spine(1.0) - spine(0.9)).normalize();
        let tip = part.vertex(spine(1.0), uv(1.0, 0.0), weights);
        part.vertices[tip as usize].normal = (out + tangent).normalize_or(out);
        let last = first + 3 * (rows - 1);
        part.triangles.extend([[last, tip, last + 1], [last + 1, tip, last + 2]]);
    }
}
