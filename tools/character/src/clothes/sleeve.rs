//! The sleeves: rings from the armhole to the cuff, of which some are the crests and creases of folds. Folds lie along
//! rings, so that light breaks on them in one clean line.

use glam::{Vec2, Vec3};

use super::jacket::{COLUMNS, armhole};
use crate::body::weights;
use crate::loft::grid;
use crate::mesh::Part;
use crate::picture::smoothstep;
use crate::skeleton::Skeleton;

/// A ring: distance from the middle of the body, radius, fold.
type Ring = (f32, f32, Option<Fold>);

/// What a fold does to a ring: where round the arm it is strongest (degrees: 0 above, 90 in front, 180 below), over which
/// half angle, how far it stands out (crease: in), and how far the ring leans along the arm there.
#[derive(Clone, Copy)]
struct Fold {
    at: f32,
    reach: f32,
    high: f32,
    lean: f32,
}

const fn fold(at: f32, reach: f32, high: f32, lean: f32) -> Option<Fold> {
    Some(Fold { at, reach, high, lean })
}

/// Rings from the shoulder to the cuff.
const RINGS: &[Ring] = &[
    (0.139, 0.0535, fold(185.0, 80.0, -0.001, 0.0)),
    // The armpit: three folds that fan out from below, over front and back.
    (0.15, 0.0515, fold(150.0, 85.0, 0.0042, 0.008)),
    (0.158, 0.0492, fold(150.0, 85.0, -0.0035, 0.011)),
    (0.17, 0.0485, fold(205.0, 80.0, 0.0046, 0.01)),
    (0.178, 0.0468, fold(205.0, 80.0, -0.0034, 0.014)),
    (0.192, 0.0462, fold(140.0, 70.0, 0.004, 0.022)),
    (0.2, 0.0448, fold(140.0, 70.0, -0.0028, 0.026)),
    (0.232, 0.0432, None),
    // The elbow: folds lean to and fro round the bend, strongest in front.
    (0.266, 0.0414, fold(75.0, 100.0, 0.0056, 0.018)),
    (0.277, 0.04, fold(75.0, 100.0, -0.004, 0.014)),
    (0.296, 0.0404, fold(120.0, 110.0, 0.0068, -0.01)),
    (0.307, 0.0394, fold(120.0, 110.0, -0.0046, -0.014)),
    (0.324, 0.0402, fold(80.0, 115.0, 0.0076, 0.008)),
    (0.335, 0.0394, fold(80.0, 115.0, -0.0048, 0.004)),
    (0.354, 0.0406, fold(115.0, 105.0, 0.0066, -0.013)),
    (0.365, 0.0398, fold(115.0, 105.0, -0.0042, -0.018)),
    (0.384, 0.0408, None),
    (0.415, 0.0413, None),
    // Over the cuff the cloth gathers.
    (0.44, 0.0422, fold(30.0, 140.0, 0.0044, 0.007)),
    (0.449, 0.0394, fold(30.0, 140.0, -0.003, 0.006)),
    (0.459, 0.0406, fold(205.0, 150.0, 0.0048, 0.005)),
    (0.467, 0.0372, fold(205.0, 150.0, -0.0026, 0.004)),
    (0.482, 0.0302, None),
    (0.482, 0.028, None),
    (0.468, 0.0275, None),
];

/// Rings between armhole and sleeve.
const SHOULDER: [f32; 3] = [0.07, 0.34, 0.7];

/// Axis of the sleeve at a distance from the middle of the body: height and depth.
fn axis(x: f32) -> [f32; 2] {
    let y = 1.2105 + 0.0045 * smoothstep(0.135, 0.21, x);
    let z = -0.016 - 0.004 * smoothstep(0.2, 0.33, x) + 0.005 * smoothstep(0.35, 0.49, x);
    [y, z]
}

/// Share of a fold at an angle, 0..1.
fn share(fold: Fold, degrees: f32) -> f32 {
    let away = (degrees - fold.at + 540.0).rem_euclid(360.0) - 180.0;
    let near = (1.0 - away.abs() / fold.reach).max(0.0);
    near * near * (3.0 - 2.0 * near)
}

fn ring_point((x, radius, fold): Ring, angle: f32) -> Vec3 {
    let (mut x, mut radius) = (x, radius);
    if let Some(f) = fold {
        let near = share(f, angle.to_degrees());
        radius += f.high * near;
        x += f.lean * (near - 0.35);
    }
    let [y, z] = axis(x);
    Vec3::new(x, y + angle.cos() * radius, z + angle.sin() * radius)
}

/// Rows of the sleeve, with the armhole and the rings at the shoulder.
fn row_count() -> usize {
    1 + SHOULDER.len() + RINGS.len()
}

fn v_of(row: f32) -> f32 {
    0.02 + 0.96 * row
}

/// Creases for the paint: points of each in the texture, with the depth of the fold there, 0..1.
pub(super) fn creases() -> Vec<Vec<(Vec2, f32)>> {
    let last = (row_count() - 1) as f32;
    let mut lines = Vec::new();
    for (i, (_, _, fold)) in RINGS.iter().enumerate() {
        let Some(f) = fold.filter(|f| f.high < -0.0015) else { continue };
        let v = v_of((1 + SHOULDER.len() + i) as f32 / last);
        // u grows with the angle from the back over the top to the front.
        let n = 48;
        let line: Vec<(Vec2, f32)> = (0..=n)
            .map(|k| {
                let c = k as f32 / n as f32;
                let degrees = -90.0 + 360.0 * c;
                (Vec2::new(0.66 + 0.32 * c, v), share(f, degrees) * f.high / -0.0044)
            })
            .collect();
        lines.push(line);
    }
    lines
}

/// Adds the left sleeve to the torso.
pub(super) fn add(jacket: &mut Part, skeleton: &Skeleton) {
    let hole = armhole();
    let n = hole.len();
    let loop_places: Vec<Vec3> = hole.iter().map(|(r, c)| jacket.vertices[r * COLUMNS + c].position).collect();
    // Where each column of the sleeve starts: at the angle that its vertex of the armhole stands at, evened out.
    let middle = Vec3::new(0.11, 1.205, -0.016);
    let angles: Vec<f32> = {
        let raw: Vec<f32> = loop_places.iter().map(|p| (p.z - middle.z).atan2(p.y - middle.y)).collect();
        // From the back over the top to the front: the angle grows.
        let mut grown = vec![raw[0]];
        for a in &raw[1..] {
            let mut next = *a;
            while next < grown[grown.len() - 1] - 1.0 {
                next += std::f32::consts::TAU;
            }
            grown.push(next);
        }
        (0..n).map(|i| 0.35 * grown[i] + 0.65 * (grown[0] + std::f32::consts::TAU * i as f32 / n as f32)).collect()
    };
    let ring_at = |ring: Ring| -> Vec<Vec3> { angles.iter().map(|a| ring_point(ring, *a)).collect() };
    let mut rows = vec![loop_places.clone()];
    let first_ring = ring_at(RINGS[0]);
    for (k, t) in SHOULDER.into_iter().enumerate() {
        // From the armhole outwards, a little full; the first ring is the edge that lies on the seam.
        rows.push(
            (0..n)
                .map(|i| {
                    let p = loop_places[i].lerp(first_ring[i], t);
                    let out = (p - Vec3::new(p.x, 1.205, -0.016)).normalize_or(Vec3::Y);
                    let seam = if k == 0 { 0.003 } else { 0.0 };
                    let full = 0.006 * (1.0 - (2.0 * t - 1.0).powi(2)) * smoothstep(-0.2, 0.6, out.y);
                    p + out * (full + seam)
                })
                .collect(),
        );
    }
    rows.extend(RINGS.iter().map(|r| ring_at(*r)));
    let first = grid(jacket, &rows, true, |r, c| Vec2::new(0.66 + 0.32 * c, v_of(r)), |p| weights::torso(skeleton, p));
    // Seen from outside the rows run to the right and advance towards the hand.
    let vote: f32 = jacket
        .triangles
        .iter()
        .filter(|t| t[0] >= first)
        .map(|t| {
            let [a, b, c] = t.map(|i| jacket.vertices[i as usize].position);
            let mid = (a + b + c) / 3.0;
            (b - a).cross(c - a).dot(mid - Vec3::new(mid.x, 1.213, -0.017))
        })
        .sum();
    if vote < 0.0 {
        jacket.triangles.iter_mut().filter(|t| t[0] >= first).for_each(|t| t.swap(1, 2));
    }
}

/// Lets the folds at both elbows catch more light and shade than their height gives, and those at the armpits less.
pub(super) fn raise_folds(jacket: &mut Part) {
    for v in jacket.vertices.iter_mut().filter(|v| v.uv.x > 0.65 && v.position.x.abs() > 0.145) {
        let [y, z] = axis(v.position.x.abs());
        let round = Vec3::new(0.0, v.position.y - y, v.position.z - z).normalize_or(Vec3::Y);
        // Those of the armpit are large: they would break the border of light into islands.
        let share = -0.35 + 1.45 * smoothstep(0.2, 0.27, v.position.x.abs());
        v.normal = (v.normal + (v.normal - round) * share).normalize_or(round);
    }
}
