//! The cap under the locks: no skin shows between them.

use glam::Vec2;

use super::lock::BAND_V;
use super::style::direction;
use crate::head::shape::skull;
use crate::mesh::Part;
use crate::picture::smoothstep;
use crate::skeleton::Skeleton;

const AROUND: u32 = 40;
const DOWN: u32 = 12;

/// Where the hairline runs, degrees from the whorl: high over the forehead, low at the nape.
fn hairline(around: f32) -> f32 {
    let side = around.abs();
    66.0 + 26.0 * smoothstep(25.0, 75.0, side) + 14.0 * smoothstep(95.0, 180.0, side)
}

/// Adds the cap as the first piece.
pub(super) fn build(part: &mut Part, skeleton: &Skeleton) {
    let weights = skeleton.only("head");
    let place = |around: f32, t: f32| {
        let down = hairline(around) * t;
        // It dips under the skin at its edge.
        skull(direction(around, down), 0.0205 - 0.0045 * smoothstep(0.0, 0.3, t) - 0.0175 * smoothstep(0.8, 1.0, t))
    };
    // From the back over her right side to the front and on: seen from outside a row runs to the right.
    for r in 0..DOWN {
        let t = (r + 1) as f32 / DOWN as f32;
        for c in 0..AROUND {
            let around = -180.0 + 360.0 * c as f32 / AROUND as f32;
            let p = place(around, t);
            let u = 0.75 + 0.25 * (0.5 + 0.48 * (c as f32 * 0.7).sin());
            part.vertex(p, Vec2::new(u, t * BAND_V * 1.4), weights);
            let tangent = (place(around, t + 0.01) - place(around, t - 0.01)).normalize();
            part.tangents.push(tangent.extend(1.0));
        }
    }
    part.quads(0, DOWN, AROUND, true);
    let ring: Vec<u32> = (0..AROUND).collect();
    part.cap(&ring, Vec2::new(0.87, 0.0), weights);
    part.tangents.push(glam::Vec4::new(0.0, -1.0, 0.0, 1.0));
}
