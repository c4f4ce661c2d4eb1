//! What skin is shaded by of its shape.

use glam::{Mat4, Vec3};

use super::curvature::curvatures;
use super::occlusion::occlusions;
use super::shape::{Body, Shape};
use super::thickness::thicknesses;
use super::tree::Tree;
use crate::scene::Primitive;

/// Thickness from which on nothing comes through, metres of the world.
const THICKEST_M: f32 = 0.05;

/// Distance from which on surfaces hide no light from each other, metres of the world: a chin is less above the neck.
const HIDING_M: f32 = 0.1;

/// Curvature, 1/m, thickness, m, and occlusion, 0 to 1, at each vertex of parts with `character_from_mesh` at rest. Parts that touch
/// are one surface, and a part may lie behind another; `others` only hide light from them. Metres of the scene; `world_scale` is what
/// one stands for.
pub(crate) fn measured(
    parts: &[(&Primitive, Mat4)],
    others: &[(&Primitive, Mat4)],
    world_scale: f32,
) -> Vec<Vec<[f32; 3]>> {
    if parts.is_empty() {
        return Vec::new();
    }
    let metre = 1.0 / world_scale.max(1e-6);
    let placed: Vec<Placed> = parts.iter().map(Placed::new).collect();
    let bodies: Vec<_> = placed.iter().map(Placed::body).collect();
    let (shape, hiding) = rayon::join(|| Shape::new(&bodies), || hiding(others));
    let curvatures = curvatures(&shape.surface);
    let thicknesses = thicknesses(&shape, THICKEST_M * metre);
    let occlusions = occlusions(&shape, &hiding, HIDING_M * metre);
    let mut all = curvatures.into_iter().zip(thicknesses).zip(occlusions).map(|((k, t), o)| [k, t, o]);
    placed.iter().map(|part| all.by_ref().take(part.positions.len()).collect()).collect()
}

/// A part in character space.
struct Placed {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    indices: Vec<u32>,
}

impl Placed {
    fn new((primitive, rest): &(&Primitive, Mat4)) -> Self {
        let normals = rest.inverse().transpose();
        let turned = |n: &[f32; 3]| normals.transform_vector3(Vec3::from(*n)).normalize_or_zero();
        let mut indices = primitive.indices.clone();
        // A mirrored node turns its triangles inside out.
        if rest.determinant() < 0.0 {
            indices.as_chunks_mut::<3>().0.iter_mut().for_each(|corners| corners.swap(1, 2));
        }
        Self {
            positions: primitive.positions.iter().map(|p| rest.transform_point3(Vec3::from(*p))).collect(),
            normals: primitive.normals.iter().map(turned).collect(),
            indices,
        }
    }

    fn body(&self) -> Body<'_> {
        Body { positions: &self.positions, normals: &self.normals, indices: &self.indices }
    }
}

/// All triangles of parts.
fn hiding(parts: &[(&Primitive, Mat4)]) -> Tree {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for (primitive, rest) in parts {
        let first = positions.len() as u32;
        positions.extend(primitive.positions.iter().map(|p| rest.transform_point3(Vec3::from(*p)).to_array()));
        triangles.extend(primitive.indices.as_chunks::<3>().0.iter().map(|corners| corners.map(|c| first + c)));
    }
    Tree::new(&positions, &triangles)
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
        let found = measured(&[(&front, Mat4::IDENTITY), (&back, mirrored)], &[], 1.0);
        for (part, of) in [front, back].iter().zip(&found) {
            assert_eq!(part.positions.len(), of.len());
            let columns = 37;
            // Away from the open ends, the seam between the halves included.
            for [k, t, hidden] in &of[15 * columns..25 * columns] {
                assert!((k - 25.0).abs() < 1.5, "{k}");
                assert!((0.024..=0.04).contains(t), "{t}");
                assert_eq!(*hidden, 0.0);
            }
        }
        assert!(measured(&[], &[], 1.0).is_empty());
    }
}
