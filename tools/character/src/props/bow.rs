//! The bow at the collar: two loops that gather at the knot, two curved tails; the brooch covers the knot.

use glam::{Vec2, Vec3};

use super::before_chest;
use crate::body::weights;
use crate::loft::{grid, ring};
use crate::mesh::Part;
use crate::model::{Material, srgb};
use crate::picture::{Picture, rgb, smoothstep};
use crate::skeleton::Skeleton;

/// Height of the knot.
pub(super) const KNOT_Y: f32 = 1.2445;

/// The one strong colour that she wears.
pub(super) fn material() -> Material {
    Material {
        name: "Cloth_Bow",
        texture: Some("bow"),
        shade: srgb(0xa878b8),
        shade_texture: Some("bow"),
        outline: 0.0008,
        outline_color: srgb(0x3c0a1c),
        // Ribbons are seen from both sides.
        double_sided: true,
        ..Material::default()
    }
}

/// Ribbon: loops in the left half of the texture, tails in the right one; v runs along them from the knot.
pub(super) fn paint() -> Picture {
    let [cloth, light, fold, edge] = [0xbf2742, 0xd2384f, 0x8c1638, 0x7c1236].map(rgb);
    Picture::from_fn(512, 512, |uv| {
        let (tail, across) = (uv.x >= 0.5, (uv.x * 2.0).fract() * 2.0 - 1.0);
        let mut color = cloth;
        // Gathers run out of the knot and end in points; a tail has one.
        let gathers: &[(f32, f32, f32)] = if tail {
            &[(0.12, 0.55, 0.12), (-0.4, 0.3, 0.1)]
        } else {
            &[(-0.36, 0.36, 0.17), (0.04, 0.24, 0.15), (0.42, 0.33, 0.17)]
        };
        for (at, long, wide) in gathers {
            let t = (uv.y / long).min(1.0);
            let inside = wide * (1.0 - t) - (across - at * (1.0 + 0.25 * t)).abs();
            color = color.lerp(fold, smoothstep(-0.012, 0.012, inside) * smoothstep(1.0, 0.97, t));
        }
        // Light where the cloth turns over.
        let turn = if tail { 0.6 + 0.1 * across } else { 0.42 };
        let lens = 0.1 * (1.0 - (across / 0.8).powi(2)) - (uv.y - turn).abs();
        color = color.lerp(light, smoothstep(-0.006, 0.006, lens));
        // A woven edge.
        color = color.lerp(edge, smoothstep(0.025, 0.015, (across.abs() - 0.86).abs()));
        [color.x, color.y, color.z, 1.0]
    })
}

/// A loop from the knot out in front, round, and back behind: place from the knot, half width, depth of the gathers.
const LOOP: &[([f32; 3], f32, f32)] = &[
    ([0.004, 0.0, 0.0035], 0.006, 0.0030),
    ([0.011, 0.0008, 0.0072], 0.0092, 0.0036),
    ([0.019, 0.002, 0.0098], 0.0132, 0.003),
    ([0.028, 0.0032, 0.0102], 0.0168, 0.0018),
    ([0.0372, 0.0042, 0.0078], 0.0186, 0.0007),
    ([0.0436, 0.0048, 0.0032], 0.0188, 0.0),
    ([0.0455, 0.005, -0.0016], 0.0182, 0.0),
    ([0.0425, 0.0046, -0.0052], 0.017, 0.0),
    ([0.03, 0.003, -0.006], 0.0135, -0.0005),
    ([0.008, 0.0004, -0.003], 0.0065, -0.001),
];

/// A tail: height, place to the side, distance from the blouse, half width, twist.
const TAIL: &[[f32; 5]] = &[
    [1.239, 0.0035, 0.006, 0.0038, 0.1],
    [1.2305, 0.0072, 0.0085, 0.0058, -0.25],
    [1.2205, 0.0118, 0.0085, 0.008, -0.3],
    [1.2095, 0.0156, 0.0066, 0.0096, -0.05],
    [1.198, 0.0188, 0.0062, 0.0106, 0.3],
    [1.186, 0.0228, 0.0078, 0.0114, 0.38],
    [1.1745, 0.0282, 0.0092, 0.0121, 0.1],
    [1.164, 0.0345, 0.0092, 0.0128, -0.25],
];

/// Across a loop and across a tail, -1..1.
const ACROSS: [f32; 9] = [-1.0, -0.78, -0.5, -0.25, 0.0, 0.25, 0.5, 0.78, 1.0];

/// The bow.
pub(super) fn build(skeleton: &Skeleton) -> Part {
    let mut left = Part::new("Bow", "Cloth_Bow");
    let bone = |p: Vec3| weights::torso(skeleton, p.with_x(p.x * 0.4));
    let knot = before_chest(KNOT_Y, 0.006);
    let rows: Vec<Vec<Vec3>> = LOOP
        .iter()
        .map(|([x, y, z], half, gather)| {
            // Upwards; three gathers run together at the knot, edges lie back.
            let point = |s: f32| {
                let fold = gather * (s * 2.5 * std::f32::consts::PI).cos();
                Vec3::new(*x - 0.003 * s * s * (*x / 0.045), y + s * half, z + fold - 0.0022 * s * s * z.signum())
            };
            ACROSS.iter().map(|s| knot + point(*s)).collect()
        })
        .collect();
    grid(&mut left, &rows, false, |r, c| Vec2::new(0.002 + 0.496 * c, r), bone);
    let loops = left.vertices.len();

    let last = TAIL.len() - 1;
    let rows: Vec<Vec<Vec3>> = TAIL
        .iter()
        .enumerate()
        .map(|(i, [y, x, out, half, twist])| {
            let middle = before_chest(*y, *out).with_x(*x);
            let (s, c) = twist.sin_cos();
            let right = Vec3::new(c, 0.28, s).normalize();
            // Cut out like a swallow's tail; a fold runs down the middle.
            let notch = if i == last { 0.0115 } else { 0.0 };
            let point = |s: f32| middle + right * s * *half + Vec3::new(0.0, notch, 0.0016) * (1.0 - s.abs());
            ACROSS.iter().step_by(2).map(|s| point(*s)).collect()
        })
        .collect();
    grid(&mut left, &rows, false, |r, c| Vec2::new(0.502 + 0.496 * c, r), bone);
    left.smooth_normals();
    // Edges turn aside: outlines stand out there.
    for (i, v) in left.vertices.iter_mut().enumerate() {
        let across = (v.uv.x * 2.0).fract() * 2.0 - 1.0;
        if across.abs() > 0.95 {
            let aside = if i < loops { Vec3::Y } else { Vec3::X };
            v.normal = (v.normal + aside * across.signum()).normalize();
        }
    }
    let right = left.mirrored(skeleton);
    left.append(&right);

    let mut middle = Part::new("Bow", "Cloth_Bow");
    // Height over the knot, width, depth: the ribbon round the gathers.
    let rows: Vec<Vec<Vec3>> = [
        (0.0125, 0.0052, 0.003),
        (0.0118, 0.0082, 0.0068),
        (0.004, 0.0088, 0.0092),
        (-0.004, 0.0088, 0.0092),
        (-0.0118, 0.0082, 0.0068),
        (-0.0125, 0.0052, 0.003),
    ]
    .iter()
    .map(|(y, half, deep)| ring(knot + Vec3::Y * *y, *half, *deep, 0.003, 12))
    .collect();
    grid(&mut middle, &rows, true, |_, _| Vec2::new(0.25, 0.7), bone);
    middle.smooth_normals();
    left.append(&middle);
    left
}
