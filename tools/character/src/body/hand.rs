//! The hands: a palm and five fingers on the bones.

use glam::{Vec2, Vec3};

use super::weights;
use crate::loft::{grid, ring_in, row};
use crate::mesh::Part;
use crate::picture::smoothstep;
use crate::skeleton::{Skeleton, blend};

/// Palm from the forearm to the knuckles: x, y, z of the middle, half thickness, half width.
const PALM: &[[f32; 5]] = &[
    [0.455, 1.215, -0.017, 0.0235, 0.0245],
    [0.487, 1.215, -0.0158, 0.0196, 0.021],
    [0.514, 1.215, -0.0147, 0.0152, 0.0172],
    [0.533, 1.215, -0.0138, 0.0134, 0.0164],
    [0.548, 1.2148, -0.0126, 0.0134, 0.0192],
    [0.565, 1.214, -0.0106, 0.0136, 0.0245],
    [0.585, 1.214, -0.0098, 0.0128, 0.0286],
    [0.603, 1.2145, -0.0098, 0.0114, 0.03],
    [0.616, 1.2148, -0.01, 0.0096, 0.0292],
    [0.6255, 1.215, -0.0102, 0.006, 0.0262],
];

/// Fingers: name, bones, radius at the root and at the tip, length of the last segment.
const FINGERS: &[(&str, [&str; 3], f32, f32, f32)] = &[
    ("Index", ["Proximal", "Intermediate", "Distal"], 0.0076, 0.0049, 0.0212),
    ("Middle", ["Proximal", "Intermediate", "Distal"], 0.0078, 0.005, 0.0226),
    ("Ring", ["Proximal", "Intermediate", "Distal"], 0.0074, 0.0048, 0.0212),
    ("Little", ["Proximal", "Intermediate", "Distal"], 0.0064, 0.0041, 0.0182),
    ("Thumb", ["Metacarpal", "Proximal", "Distal"], 0.0098, 0.0058, 0.0232),
];

/// The left hand with the wrist, up into the sleeve.
pub(super) fn left(skeleton: &Skeleton) -> Part {
    let mut part = Part::new("Skin", "Body_Skin");
    palm(&mut part, skeleton);
    for (i, finger) in FINGERS.iter().enumerate() {
        build_finger(&mut part, skeleton, i, *finger);
    }
    part
}

fn palm(part: &mut Part, skeleton: &Skeleton) {
    const COLUMNS: usize = 16;
    let rows: Vec<Vec<Vec3>> = PALM
        .iter()
        .map(|[x, y, z, thick, wide]| {
            // Flatter than an ellipse; knuckles stand in an arch; the ball of the thumb stands out in front and below.
            ring_in(Vec3::new(*x, *y, *z), Vec3::NEG_Z, Vec3::Y, COLUMNS)
                .into_iter()
                .map(|p| {
                    let d = p - Vec3::new(*x, *y, *z);
                    let square = |v: f32| v.signum() * v.abs().powf(0.8);
                    let ball = smoothstep(0.535, 0.565, *x) * smoothstep(0.615, 0.585, *x);
                    let low = smoothstep(0.1, 0.85, d.z) * smoothstep(0.45, -0.25, d.y) * ball;
                    let arch = 0.0034 * d.z * d.z * smoothstep(0.55, 0.6, *x);
                    let y = y + square(d.y) * thick - arch - 0.0048 * low;
                    Vec3::new(*x, y, z + square(d.z) * wide + 0.005 * low)
                })
                .collect()
        })
        .collect();
    let hand = skeleton.find("leftHand");
    let first = grid(
        part,
        &rows,
        true,
        |r, c| Vec2::new(0.02 + 0.46 * c, 0.52 + 0.4 * r),
        |p| {
            // The palm follows the hand; the knuckles a little the fingers.
            if p.x > 0.57 {
                blend(&[(hand, 1.0)])
            } else {
                weights::arm(skeleton, p)
            }
        },
    );
    let columns = COLUMNS as u32 + 1;
    part.cap(&row(first, columns, PALM.len() as u32 - 1, false), Vec2::new(0.25, 0.94), skeleton.only("leftHand"));
    part.cap(&row(first, columns, 0, true), Vec2::new(0.25, 0.5), weights::arm(skeleton, rows[0][0]));
}

fn build_finger(part: &mut Part, skeleton: &Skeleton, index: usize, finger: (&str, [&str; 3], f32, f32, f32)) {
    const COLUMNS: usize = 8;
    let (name, joints, root, end, last) = finger;
    let bones = joints.map(|j| skeleton.find(&format!("left{name}{j}")));
    let hand = skeleton.find("leftHand");
    let mut places = bones.map(|b| skeleton.bones[b].position).to_vec();
    let way = (places[2] - places[1]).normalize();
    // The tip bends down a little, that of the little finger outwards; the root lies inside the palm.
    let outwards = if name == "Little" {
        Vec3::NEG_Z * 0.12
    } else {
        Vec3::ZERO
    };
    places.push(places[2] + (way - Vec3::Y * 0.1 + outwards).normalize() * last);
    let first_way = (places[1] - places[0]).normalize();
    if name != "Thumb" {
        places[0] -= first_way * 0.001;
    }
    places.insert(0, places[0] - first_way * if name == "Thumb" { 0.014 } else { 0.016 });
    let mut lengths = vec![0.0];
    for pair in places.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + pair[0].distance(pair[1]));
    }
    let total = lengths[4];
    let point = |s: f32| {
        let i = lengths.iter().rposition(|l| *l <= s).unwrap_or(0).min(3);
        places[i].lerp(places[i + 1], (s - lengths[i]) / (lengths[i + 1] - lengths[i]))
    };
    // Rings stand close at the joints, so that a bent finger keeps its thickness.
    let mut stations = vec![0.0, lengths[1] + 0.006];
    for joint in 2..4 {
        stations.push((lengths[joint - 1] + lengths[joint]) * 0.5 + if joint == 2 { 0.005 } else { 0.0 });
        stations.extend([-0.0055, 0.0, 0.0055].map(|d| lengths[joint] + d));
    }
    stations.extend([total - 0.0115, total - 0.006, total - 0.0022]);
    let rows: Vec<Vec<Vec3>> = stations
        .iter()
        .map(|s| {
            let p = point(*s);
            let way = (point((s + 0.004).min(total)) - point((s - 0.004).max(0.0))).normalize();
            let up = (Vec3::Y - way * way.y).normalize();
            let right = up.cross(way);
            let t = s / total;
            let left = total - s;
            let mut radius = (root + (end - root) * t) * (left / 0.0085).min(1.0).powf(0.62);
            // It grows out of the palm.
            radius *= 0.6 + 0.4 * smoothstep(0.0, if name == "Thumb" { 0.022 } else { lengths[1] + 0.004 }, *s);
            let knuckle: f32 = lengths[2..4].iter().map(|j| (-((s - j) / 0.0055).powi(2)).exp()).sum();
            ring_in(Vec3::ZERO, Vec3::X, Vec3::Y, COLUMNS)
                .into_iter()
                .map(|d| {
                    // Bones above, pads below: joints are thick on the back and pinched on the palm.
                    let square = |v: f32| v.signum() * v.abs().powf(0.86);
                    let pad = if d.y < 0.0 {
                        0.98 - 0.16 * knuckle
                    } else {
                        0.86 + 0.1 * knuckle
                    };
                    p + (right * square(d.x) * (1.0 + 0.05 * knuckle) + up * square(d.y) * pad) * radius
                })
                .collect()
        })
        .collect();
    let u = 0.52 + 0.092 * index as f32;
    let weight = |p: Vec3| {
        // Distance along the finger decides.
        let s = (0..=200)
            .map(|i| total * i as f32 / 200.0)
            .min_by(|a, b| point(*a).distance(p).total_cmp(&point(*b).distance(p)))
            .unwrap_or(0.0);
        let soft = |joint: usize| smoothstep(lengths[joint] - 0.0065, lengths[joint] + 0.0065, s);
        let (a, b, c) = (if name == "Thumb" { 1.0 } else { soft(1) }, soft(2), soft(3));
        blend(&[(hand, 1.0 - a), (bones[0], a * (1.0 - b)), (bones[1], a * b * (1.0 - c)), (bones[2], a * b * c)])
    };
    let v_of = |r: f32| 0.54 + 0.38 * stations[(r * (stations.len() - 1) as f32).round() as usize] / total;
    let first = grid(part, &rows, true, |r, c| Vec2::new(u + 0.084 * c, v_of(r)), weight);
    let columns = COLUMNS as u32 + 1;
    let end_row = rows.len() as u32 - 1;
    let tip = weight(places[4]);
    part.cap(&row(first, columns, end_row, false), Vec2::new(u + 0.042, 0.93), tip);
    part.cap(&row(first, columns, 0, true), Vec2::new(u + 0.042, 0.53), weight(places[0]));
}
