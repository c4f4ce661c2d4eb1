//! The bow at the collar: two loops, two tails, and the knot that the brooch covers.

use glam::{Vec2, Vec3};

use super::before_chest;
use crate::body::weights;
use crate::loft::{grid, ring_in, row};
use crate::mesh::Part;
use crate::skeleton::Skeleton;

/// Height of the knot.
pub(super) const KNOT_Y: f32 = 1.2445;
const COLUMNS: usize = 10;

/// A flat ribbon: places of its middle, half widths and half thicknesses; `across` is the direction of its width.
fn ribbon(part: &mut Part, skeleton: &Skeleton, stations: &[(Vec3, f32, f32)], across: Vec3) {
    let places: Vec<Vec3> = stations.iter().map(|s| s.0).collect();
    let rows: Vec<Vec<Vec3>> = stations
        .iter()
        .enumerate()
        .map(|(i, (p, wide, thick))| {
            let along = (places[(i + 1).min(places.len() - 1)] - places[i.saturating_sub(1)]).normalize();
            let right = (across - along * across.dot(along)).normalize();
            // Rows advance along right × up.
            let up = along.cross(right);
            ring_in(*p, right * *wide, up * *thick, COLUMNS)
        })
        .collect();
    let bone = |p: Vec3| weights::torso(skeleton, p.with_x(p.x * 0.4));
    let first = grid(part, &rows, true, |r, c| Vec2::new(c, r), bone);
    let columns = COLUMNS as u32 + 1;
    part.cap(&row(first, columns, 0, true), Vec2::ZERO, bone(places[0]));
    let last = rows.len() as u32 - 1;
    part.cap(&row(first, columns, last, false), Vec2::ONE, bone(places[places.len() - 1]));
}

/// The bow.
pub(super) fn build(skeleton: &Skeleton) -> Part {
    let mut left = Part::new("Bow", "Cloth_Bow");
    let knot = before_chest(KNOT_Y, 0.006);
    // The loop leaves the knot narrow, swells and ends round.
    let out = |x: f32, y: f32, z: f32| knot + Vec3::new(x, y, z);
    ribbon(
        &mut left,
        skeleton,
        &[
            (out(0.001, 0.0, 0.0), 0.0042, 0.0032),
            (out(0.007, 0.0008, 0.002), 0.0062, 0.0042),
            (out(0.016, 0.0022, 0.0024), 0.0105, 0.0058),
            (out(0.026, 0.003, 0.0002), 0.0135, 0.0062),
            (out(0.0335, 0.0032, -0.0026), 0.0138, 0.0052),
            (out(0.0375, 0.003, -0.0045), 0.0118, 0.0032),
            (out(0.039, 0.003, -0.0052), 0.0085, 0.0014),
        ],
        Vec3::Y,
    );
    // The tail falls over the blouse and turns outwards.
    let tail = |y: f32, x: f32, lift: f32| before_chest(y, lift).with_x(x);
    ribbon(
        &mut left,
        skeleton,
        &[
            (tail(KNOT_Y - 0.001, 0.002, 0.005), 0.003, 0.0018),
            (tail(1.232, 0.0062, 0.0052), 0.0048, 0.0015),
            (tail(1.216, 0.0115, 0.0042), 0.0064, 0.0013),
            (tail(1.199, 0.0162, 0.0042), 0.0076, 0.0012),
            (tail(1.183, 0.0205, 0.005), 0.0088, 0.0012),
            (tail(1.177, 0.022, 0.0054), 0.0046, 0.001),
        ],
        Vec3::X,
    );
    left.smooth_normals();
    let right = left.mirrored(skeleton);
    left.append(&right);
    left
}
