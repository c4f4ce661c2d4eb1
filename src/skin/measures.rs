//! What skin is shaded by of its shape.

use glam::{Mat4, Vec3};

use super::curvature::curvatures;
use super::thickness::{Body, thicknesses};
use crate::scene::Primitive;

/// Thickness from which on nothing comes through, metres of the world.
const THICKEST_M: f32 = 0.05;

/// Curvature, 1/m, and thickness, m, at each vertex of parts with `character_from_mesh` at rest. Parts that touch are one surface,
/// and a part may lie behind another. Metres of the scene; `world_scale` is what one stands for.
pub(crate) fn measured(parts: &[(&Primitive, Mat4)], world_scale: f32) -> Vec<Vec<[f32; 2]>> {
    if parts.is_empty() {
        return Vec::new();
    }
    let thickest = THICKEST_M / world_scale.max(1e-6);
    let placed: Vec<(Vec<Vec3>, Vec<Vec3>)> = parts.iter().map(|(primitive, rest)| placed(primitive, *rest)).collect();
    let bodies = placed.iter().zip(parts);
    let bodies: Vec<Body<'_>> = bodies
        .map(|((positions, normals), (primitive, _))| Body { positions, normals, indices: &primitive.indices })
        .collect();
    let mut bent = curvatures(&joined(parts, &placed)).into_iter();
    let thick = thicknesses(&bodies, thickest);
    thick.into_iter().map(|of| of.into_iter().zip(bent.by_ref()).map(|(t, k)| [k, t]).collect()).collect()
}

/// Positions and normals of a part, character space.
fn placed(primitive: &Primitive, rest: Mat4) -> (Vec<Vec3>, Vec<Vec3>) {
    let normals = rest.inverse().transpose();
    let turned = |n: &[f32; 3]| normals.transform_vector3(Vec3::from(*n)).normalize_or_zero();
    let positions = primitive.positions.iter().map(|p| rest.transform_point3(Vec3::from(*p)));
    (positions.collect(), primitive.normals.iter().map(turned).collect())
}

/// All parts as one mesh.
fn joined(parts: &[(&Primitive, Mat4)], placed: &[(Vec<Vec3>, Vec<Vec3>)]) -> Primitive {
    let mut all = Primitive::default();
    for ((primitive, rest), (positions, _)) in parts.iter().zip(placed) {
        let first = all.positions.len() as u32;
        all.positions.extend(positions.iter().map(Vec3::to_array));
        // A mirrored node turns its triangles inside out.
        let is_mirrored = rest.determinant() < 0.0;
        let turned = |t: &[u32]| {
            if is_mirrored {
                [t[0], t[2], t[1]]
            } else {
                [t[0], t[1], t[2]]
            }
        };
        all.indices.extend(primitive.indices.chunks_exact(3).flat_map(turned).map(|i| first + i));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of a cylinder about y of this radius, in its own units.
    fn strip(radius: f32, from_deg: u32, to_deg: u32) -> Primitive {
        let mut of = Primitive::default();
        for y in 0..=40u32 {
            for degree in (from_deg..=to_deg).step_by(5) {
                let (sin, cos) = (degree as f32).to_radians().sin_cos();
                of.positions.push([sin * radius, (y as f32 * 0.05 - 1.0) * radius, cos * radius]);
                of.normals.push([sin, 0.0, cos]);
            }
        }
        let columns = (to_deg - from_deg) / 5 + 1;
        for y in 0..40 {
            for x in 0..columns - 1 {
                let [a, b] = [y * columns + x, (y + 1) * columns + x];
                of.indices.extend([a, a + 1, b, b, a + 1, b + 1]);
            }
        }
        of
    }

    #[test]
    fn parts_are_one_surface_whatever_their_units_and_sides() {
        // A cylinder of 20 mm, one half in centimetres and mirrored.
        let (front, back) = (strip(0.02, 0, 180), strip(2.0, 0, 180));
        let mirrored = Mat4::from_scale(Vec3::new(-0.01, 0.01, 0.01));
        let found = measured(&[(&front, Mat4::IDENTITY), (&back, mirrored)], 1.0);
        for (part, of) in [front, back].iter().zip(&found) {
            assert_eq!(part.positions.len(), of.len());
            let columns = 37;
            // Away from the open ends, the seam between the halves included.
            for [k, t] in &of[15 * columns..25 * columns] {
                assert!((k - 25.0).abs() < 1.5, "{k}");
                assert!((0.024..=0.04).contains(t), "{t}");
            }
        }
        assert!(measured(&[], 1.0).is_empty());
    }
}
