//! Teeth and tongue behind the lips; they show where the mouth opens.

use glam::{Vec2, Vec3};

use super::expressions::STATES;
use super::shape::front;
use super::state::{Face, MOUTH_WIDTH, MOUTH_Y};
use crate::mesh::Part;
use crate::skeleton::Skeleton;

/// Adds a curved sheet whose vertices follow the upper (`share` 0) or the lower lip (1).
fn sheet(
    part: &mut Part,
    skeleton: &Skeleton,
    rows: u32,
    columns: u32,
    uv: [Vec2; 2],
    at: impl Fn(&Face, f32, f32) -> Vec3,
) {
    let first = part.vertices.len() as u32;
    let weights = skeleton.only("head");
    let place = |i: u32| {
        (
            (i / columns) as f32 / (rows - 1) as f32,
            (2.0 * (i % columns) as f32 - (columns - 1) as f32) / (columns - 1) as f32,
        )
    };
    for i in 0..rows * columns {
        let (r, c) = place(i);
        let t = uv[0] + (uv[1] - uv[0]) * Vec2::new((c + 1.0) * 0.5, r);
        part.vertex(at(&Face::default(), r, c), t, weights);
    }
    part.quads(first, rows, columns, false);
    for (name, state) in STATES {
        let state = state();
        for i in 0..rows * columns {
            let (r, c) = place(i);
            let offset = at(&state, r, c) - at(&Face::default(), r, c);
            if offset.length() > 2e-6 {
                part.offset(name, first + i, offset);
            }
        }
    }
}

/// Upper teeth and tongue, to be joined to the pocket of the mouth.
pub(super) fn build(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Mouth", "Mouth");
    let lip_z = front(0.0, MOUTH_Y).z;
    let arc = |c: f32, half: f32, depth: f32| Vec3::new(half * c, 0.0, lip_z - depth - 0.0105 * c * c);
    // At rest the teeth end above the line of the lips.
    sheet(&mut part, skeleton, 3, 9, [Vec2::new(0.02, 0.55), Vec2::new(0.98, 0.72)], |face, r, c| {
        let y =
            MOUTH_Y + 0.006 - 0.0052 * r + face.mouth.up * 0.5 - (face.mouth.down * 0.4).min(0.0022) + 0.0008 * c * c;
        // Round lips hide them.
        let y = y + 1.6 * (MOUTH_WIDTH - 0.0006 - face.mouth.width).max(0.0);
        arc(c, 0.0122, 0.0066).with_y(y)
    });
    sheet(&mut part, skeleton, 5, 7, [Vec2::new(0.05, 0.78), Vec2::new(0.95, 0.98)], |face, r, c| {
        let drop = face.mouth.down;
        let y = MOUTH_Y - 0.0045 - drop * 0.55 - 0.0035 * r * r + 0.001 * (1.0 - c * c);
        arc(c, 0.0092 * (1.0 - 0.12 * r), 0.0062 + 0.014 * (1.0 - r)).with_y(y)
    });
    part.smooth_normals();
    part
}
