//! Cards: thin transparent ribbons with painted strands, over the locks.

use glam::{Vec2, Vec3};

use super::chains::{Chain, weights};
use super::surface::rooted;
use crate::mesh::Part;
use crate::picture::hash;
use crate::skeleton::Skeleton;

const ROWS: u32 = 9;

/// All cards as one part.
pub(super) fn build<'a>(skeleton: &Skeleton, chain: impl Fn(&str) -> Option<&'a Chain>) -> Part {
    let mut part = Part::new("HairCards", "HairCards");
    for i in 0..28u32 {
        // All round but for the face.
        let around = 42.0 + (360.0 - 84.0) * (i as f32 + 0.5) / 28.0;
        let long = 0.5 + 0.5 * hash(i, 1, 51);
        let end = 74.0 + 20.0 * long;
        let lift = 0.0165 + 0.004 * hash(i, 2, 51);
        let half = 0.009 + 0.005 * hash(i, 3, 51);
        let first = part.vertices.len() as u32;
        let name = if around > 180.0 {
            "HairBack_Right2"
        } else {
            "HairBack_Left2"
        };
        let strip = (i % 4) as f32 * 0.25;
        for r in 0..ROWS {
            let t = r as f32 / (ROWS - 1) as f32;
            let at = |down: f32, drift: f32| rooted(around + drift, down, 12.0, lift);
            let down = 22.0 + (end - 22.0) * t;
            let p = at(down, 6.0 * t * (hash(i, 4, 51) - 0.5));
            let along = (at(down + 1.0, 0.0) - at(down - 1.0, 0.0)).normalize();
            let out = (p - crate::head::shape::SKULL_CENTER).normalize();
            let side = out.cross(along).normalize();
            let width = half * (0.6 + 0.4 * (t * 3.0).min(1.0)) * (1.0 - 0.6 * t * t);
            for (x, u) in [(-width, 0.0), (0.0, 0.5), (width, 1.0)] {
                let q = p + side * x - out * (x * x / 0.2);
                part.vertex(q, Vec2::new(strip + 0.01 + 0.23 * u, t), weights(skeleton, chain(name), q));
                part.tangents.push(along.extend(1.0));
            }
        }
        part.quads(first, ROWS, 3, false);
    }
    part.smooth_normals();
    // Lit as the head below them.
    for v in &mut part.vertices {
        v.normal = (v.position - Vec3::new(0.0, 1.43, -0.012)).normalize();
    }
    part
}
