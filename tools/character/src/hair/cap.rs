//! The cap under the locks: smooth, it flows from the whorl; no skin shows through it.

use glam::Vec2;

use super::lock::{BAND_V, STRIPS};
use super::surface::shell;
use crate::mesh::Part;
use crate::picture::smoothstep;
use crate::skeleton::Skeleton;

const AROUND: u32 = 48;
const DOWN: u32 = 15;

/// Where the hairline runs, degrees from the whorl: high over the forehead, low at the nape.
fn hairline(around: f32) -> f32 {
    let side = around.abs();
    77.0 + 15.0 * smoothstep(25.0, 75.0, side) + 14.0 * smoothstep(95.0, 180.0, side)
}

/// Adds the cap as the first piece.
pub(super) fn build(part: &mut Part, skeleton: &Skeleton) {
    let weights = skeleton.only("head");
    // It dips under the skin at its edge.
    let place = |around: f32, t: f32| shell(around, hairline(around) * t, -0.0205 * smoothstep(0.9, 1.0, t));
    // From the back over her right side to the front and on: seen from outside a row runs to the right.
    for r in 0..DOWN {
        // The middle is small, so that the whorl is round.
        let t = ((r as f32 + 0.35) / (DOWN as f32 - 0.65)).powf(1.15);
        for c in 0..AROUND {
            let around = -180.0 + 360.0 * c as f32 / AROUND as f32;
            // There and back over the first strip, so that it has no seam.
            let [from, to] = STRIPS[0];
            let across = (c as f32 / AROUND as f32 * 4.0).fract();
            let u = from + (to - from) * (0.12 + 0.76 * (1.0 - (2.0 * across - 1.0).abs()));
            let ring = 62.0 + 17.0 * around.to_radians().cos();
            let v = BAND_V * hairline(around) * t / ring;
            part.vertex(place(around, t), Vec2::new(u, v), weights);
            let tangent = (place(around, t + 0.01) - place(around, t - 0.01)).normalize();
            part.tangents.push(tangent.extend(1.0));
        }
    }
    part.quads(0, DOWN, AROUND, true);
    let ring: Vec<u32> = (0..AROUND).collect();
    part.cap(&ring, Vec2::new(0.11, -0.002), weights);
    part.tangents.push(glam::Vec4::new(0.0, -1.0, 0.0, 1.0));
}
