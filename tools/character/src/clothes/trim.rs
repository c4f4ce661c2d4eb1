//! What is sewn onto the jacket: piping along its edges, and the lapels.

use glam::{Vec2, Vec3};

use super::jacket::{OUT, body_point};
use crate::body::weights;
use crate::loft::{grid, ring_in};
use crate::mesh::Part;
use crate::skeleton::Skeleton;

/// Place of the piping's colour in the texture.
const GOLD: Vec2 = Vec2::new(0.618, 0.5);

/// A cord along a line on the jacket's left half.
pub(super) fn piping(jacket: &mut Part, skeleton: &Skeleton, line: &[Vec3], radius: f32) {
    let last = line.len() - 1;
    let rows: Vec<Vec<Vec3>> = (0..=last)
        .map(|i| {
            let along = (line[(i + 1).min(last)] - line[i.saturating_sub(1)]).normalize();
            let out = (line[i] - Vec3::new(0.0, line[i].y, -0.01)).normalize();
            let right = out.cross(along).normalize();
            let up = along.cross(right);
            ring_in(line[i], right * radius, up * radius, 4)
        })
        .collect();
    grid(jacket, &rows, true, |_, _| GOLD, |p| weights::torso(skeleton, p));
}

/// The left lapel, from the break of the front edge up under the fur: height, and share of the half's width that it takes.
const LAPEL: &[[f32; 2]] = &[
    [1.186, 0.05],
    [1.17, 0.11],
    [1.151, 0.168],
    [1.13, 0.184],
    [1.105, 0.153],
    [1.08, 0.098],
    [1.055, 0.036],
    [1.045, 0.008],
];

/// Adds the left lapel.
pub(super) fn lapel(jacket: &mut Part, skeleton: &Skeleton) {
    let rows: Vec<Vec<Vec3>> = LAPEL
        .iter()
        .map(|[y, wide]| {
            // Rolled at the front edge, lying flat outside; the last point is its thickness.
            [(0.0, 0.0012), (0.12, 0.0052), (0.6, 0.0046), (1.0, 0.0034), (1.0, 0.0)]
                .iter()
                .map(|(at, out)| body_point(*y, 1.0 - wide * at, OUT + out))
                .collect()
        })
        .collect();
    let edge: Vec<Vec3> = rows.iter().map(|row| row[3]).collect();
    let uv = |r: f32, c: f32| Vec2::new(0.3 + 0.1 * c, 0.06 + 0.2 * r);
    grid(jacket, &rows, false, uv, |p| weights::torso(skeleton, p));
    piping(jacket, skeleton, &edge, 0.0016);
}
