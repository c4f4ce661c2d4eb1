//! Metal: the brooch, the belt's buckle, the pendant's cord, the setting of the hair-pin.

use glam::{Vec2, Vec3};

use super::bow::KNOT_Y;
use super::stone::{PIN, pin_frame};
use super::{CORD, STONE_STANDS, before_chest};
use crate::body::shape::torso;
use crate::loft::{grid, ring_in, row};
use crate::mesh::Part;
use crate::skeleton::{Skeleton, Weights, blend};

/// A surface of revolution: from the back to the front, (radius, height) along `right` × `up`. The texture is seen from
/// the front, over a disc of the largest radius.
pub(super) fn lathe(part: &mut Part, center: Vec3, [right, up]: [Vec3; 2], profile: &[[f32; 2]], bone: Weights) {
    const COLUMNS: usize = 36;
    let front = right.cross(up);
    let widest = profile.iter().map(|p| p[0]).fold(0.0, f32::max);
    let rows: Vec<Vec<Vec3>> =
        profile.iter().map(|[r, h]| ring_in(center + front * *h, right * *r, up * *r, COLUMNS)).collect();
    let first = part.vertices.len();
    let start = grid(part, &rows, true, Vec2::new, |_| bone);
    let columns = COLUMNS as u32 + 1;
    part.cap(&row(start, columns, 0, true), Vec2::ZERO, bone);
    part.cap(&row(start, columns, rows.len() as u32 - 1, false), Vec2::ZERO, bone);
    for v in &mut part.vertices[first..] {
        let d = v.position - center;
        v.uv = Vec2::new(0.5 + 0.49 * d.dot(right) / widest, 0.5 - 0.49 * d.dot(up) / widest);
    }
}

/// The brooch on the knot: a rim round a dome, as a sun behind a hill.
pub(super) fn brooch(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Brooch", "Metal_Brooch");
    let up = Vec3::new(0.0, 0.9, -0.44).normalize();
    let bone = skeleton.only("upperChest");
    // Its lines need room before the knot.
    let center = before_chest(KNOT_Y, 0.0165);
    let profile = [
        [0.006, -0.006],
        [0.0085, -0.002],
        [0.0106, -0.001],
        [0.0112, 0.0006],
        [0.0106, 0.0022],
        [0.0093, 0.0026],
        [0.0084, 0.0016],
        [0.0079, 0.0012],
        [0.0072, 0.0024],
        [0.0056, 0.0038],
        [0.0036, 0.0047],
        [0.0016, 0.0051],
    ];
    lathe(&mut part, center, [Vec3::X, up], &profile, bone);
    part.smooth_normals();
    part
}

/// A closed tube of round wire through points.
fn wire(part: &mut Part, points: &[Vec3], normal: Vec3, radius: f32, bone: Weights) {
    let n = points.len();
    let middle = points.iter().sum::<Vec3>() / n as f32;
    let mut rows: Vec<Vec<Vec3>> = (0..n)
        .map(|i| {
            let along = (points[(i + 1) % n] - points[(i + n - 1) % n]).normalize();
            let away = along.cross(normal).normalize();
            let away = if away.dot(points[i] - middle) < 0.0 {
                -away
            } else {
                away
            };
            ring_in(points[i], away * radius, normal * radius, 8)
        })
        .collect();
    rows.push(rows[0].clone());
    grid(part, &rows, true, Vec2::new, |_| bone);
}

/// The buckle of the belt: a round-cornered frame and its prong.
pub(super) fn belt_buckle(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("BeltBuckle", "Metal_Brooch");
    let bone = blend(&[(skeleton.find("hips"), 0.75), (skeleton.find("spine"), 0.25)]);
    let center = Vec3::new(0.0, 0.963, torso(0.963)[1] + 0.0172);
    let up = Vec3::new(0.0, 1.0, -0.28).normalize();
    let normal = Vec3::X.cross(up);
    // Clockwise from the upper left, corners cut twice: right × up points along the course.
    let (w, h, cut) = (0.0195, 0.0135, 0.005);
    let course = [
        [-w + cut, h],
        [0.0, h],
        [w - cut, h],
        [w, h - cut],
        [w, 0.0],
        [w, cut - h],
        [w - cut, -h],
        [0.0, -h],
        [cut - w, -h],
        [-w, cut - h],
        [-w, 0.0],
        [-w, h - cut],
    ];
    let points: Vec<Vec3> = course.iter().map(|[x, y]| center + Vec3::X * *x + up * *y).collect();
    wire(&mut part, &points, normal, 0.0024, bone);
    // The prong lies over the frame.
    let prong = |x: f32, lift: f32, r: f32| ring_in(center + Vec3::X * x + normal * lift, up * r, normal * r, 8);
    let rows = [
        prong(-0.0205, 0.001, 0.0019),
        prong(-0.0195, 0.003, 0.0021),
        prong(0.0, 0.0012, 0.0018),
        prong(0.0185, 0.003, 0.0016),
        prong(0.021, 0.0024, 0.0009),
    ];
    let first = grid(&mut part, &rows, true, Vec2::new, |_| bone);
    part.cap(&row(first, 9, 0, true), Vec2::ZERO, bone);
    part.cap(&row(first, 9, 4, false), Vec2::ZERO, bone);
    part.smooth_normals();
    part
}

/// The pendant's cord and the cap that holds the stone.
pub(super) fn cord(skeleton: &Skeleton, [upper, lower]: [usize; 2]) -> Part {
    let mut part = Part::new("PendantCord", "Metal_Brooch");
    let chest = skeleton.find("upperChest");
    let steps = 8;
    let rows: Vec<Vec<Vec3>> = (0..=steps)
        .map(|i| {
            let t = i as f32 / steps as f32;
            let y = CORD[0] + (CORD[1] + 0.0035 - CORD[0]) * t;
            // Links: thick and thin by turns.
            let r = if i % 2 == 0 { 0.0009 } else { 0.0014 };
            ring_in(before_chest(y, 0.006 + (STONE_STANDS - 0.006) * t), Vec3::X * r, Vec3::Z * r, 6)
        })
        .collect();
    let bone = |p: Vec3| {
        let t = ((CORD[0] - p.y) / (CORD[0] - CORD[1])).clamp(0.0, 1.0);
        blend(&[(chest, (1.0 - 4.0 * t).max(0.0)), (upper, (4.0 * t).min(1.0) * (1.0 - t)), (lower, t * t)])
    };
    let first = grid(&mut part, &rows, true, Vec2::new, bone);
    part.cap(&row(first, 7, 0, true), Vec2::ZERO, bone(rows[0][0]));
    part.cap(&row(first, 7, steps, false), Vec2::ZERO, blend(&[(lower, 1.0)]));
    let top = before_chest(CORD[1], STONE_STANDS);
    let profile = [[0.0058, -0.0042], [0.0062, -0.0034], [0.0052, -0.0012], [0.0032, 0.0012], [0.0014, 0.0034]];
    // Upwards: Z × X is Y.
    lathe(&mut part, top, [Vec3::Z, Vec3::X], &profile, blend(&[(lower, 1.0)]));
    part.smooth_normals();
    part
}

/// The setting of the hair-pin: a bar with a ring for the stone.
pub(super) fn pin(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("HairPin", "Metal_Pin");
    let bone = skeleton.only("head");
    let [right, up, front] = pin_frame();
    let bar = |x: f32, r: f32| ring_in(PIN + right * x - front * 0.0018, up * r, front * r * 0.7, 8);
    let rows = [bar(-0.023, 0.0008), bar(-0.021, 0.0022), bar(0.0, 0.0026), bar(0.021, 0.0022), bar(0.023, 0.0008)];
    let first = grid(&mut part, &rows, true, Vec2::new, |_| bone);
    part.cap(&row(first, 9, 0, true), Vec2::ZERO, bone);
    part.cap(&row(first, 9, 4, false), Vec2::ZERO, bone);
    let diamond: Vec<Vec3> = (0..16)
        .map(|i| {
            let (s, c) = crate::loft::turn(i, 16);
            PIN + right * s * 0.0118 + up * c * 0.0118
        })
        .collect();
    wire(&mut part, &diamond, front, 0.0017, bone);
    part.smooth_normals();
    part
}
