//! What skin is shaded by of its shape.

use glam::{Mat4, Vec3};

use super::curvature::curvatures;
use super::occlusion::occlusions;
use super::shape::{Body, Shape};
use super::thickness::thicknesses;
use super::tree::Tree;
use crate::scene::{MorphTarget, Primitive};

/// Thickness from which on nothing comes through, metres of the world.
const THICKEST_M: f32 = 0.05;

/// Distance from which on surfaces hide no light from each other, metres of the world: a chin is less above the neck.
const HIDING_M: f32 = 0.1;

/// A part as it stands at rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part<'a> {
    pub primitive: &'a Primitive,
    pub character_from_mesh: Mat4,
    /// Of its morph targets.
    pub morph_weights: &'a [f32],
}

/// Curvature, 1/m, thickness, m, and occlusion, 0 to 1, at each vertex of parts. Parts that touch are one surface, and a part may
/// lie behind another; `others` only hide light from them. Metres of the scene; `world_scale` is what one stands for.
pub(crate) fn measured(parts: &[Part<'_>], others: &[Part<'_>], world_scale: f32) -> Vec<Vec<[f32; 3]>> {
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

impl Part<'_> {
    /// Morph targets that are there at rest.
    fn morphs(&self) -> impl Iterator<Item = (&MorphTarget, f32)> {
        let weights = self.morph_weights.iter().copied();
        self.primitive.morphs.iter().zip(weights).filter(|(_, weight)| *weight != 0.0)
    }

    /// Its vertices with those, in character space.
    pub(crate) fn positions(&self) -> Vec<Vec3> {
        let mut all: Vec<Vec3> = self.primitive.positions.iter().copied().map(Vec3::from).collect();
        for (morph, weight) in self.morphs() {
            for (vertex, by) in morph.vertices.iter().zip(&morph.positions) {
                all[*vertex as usize] += Vec3::from(*by) * weight;
            }
        }
        all.into_iter().map(|p| self.character_from_mesh.transform_point3(p)).collect()
    }
}

/// A part in character space.
struct Placed {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    indices: Vec<u32>,
}

impl Placed {
    fn new(part: &Part<'_>) -> Self {
        let Part { primitive, character_from_mesh: rest, .. } = part;
        let turning = rest.inverse().transpose();
        let mut normals: Vec<Vec3> = primitive.normals.iter().copied().map(Vec3::from).collect();
        for (morph, weight) in part.morphs() {
            for (vertex, by) in morph.vertices.iter().zip(&morph.normals) {
                normals[*vertex as usize] += Vec3::from(*by) * weight;
            }
        }
        let mut indices = primitive.indices.clone();
        // A mirrored node turns its triangles inside out.
        if rest.determinant() < 0.0 {
            indices.as_chunks_mut::<3>().0.iter_mut().for_each(|corners| corners.swap(1, 2));
        }
        Self {
            positions: part.positions(),
            normals: normals.into_iter().map(|n| turning.transform_vector3(n).normalize_or_zero()).collect(),
            indices,
        }
    }

    fn body(&self) -> Body<'_> {
        Body { positions: &self.positions, normals: &self.normals, indices: &self.indices }
    }
}

/// All triangles of parts.
fn hiding(parts: &[Part<'_>]) -> Tree {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for part in parts {
        let first = positions.len() as u32;
        positions.extend(part.positions().into_iter().map(|p| p.to_array()));
        triangles.extend(part.primitive.indices.as_chunks::<3>().0.iter().map(|corners| corners.map(|c| first + c)));
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
        let part = |primitive, character_from_mesh| Part { primitive, character_from_mesh, morph_weights: &[] };
        let found = measured(&[part(&front, Mat4::IDENTITY), part(&back, mirrored)], &[], 1.0);
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

    #[test]
    fn morphs_of_the_rest_pose_have_a_part_in_the_shape() {
        // A cylinder of 20 mm that a morph makes one of 40 mm.
        let mut of = strip(0.02, 0, 360);
        let vertices = 0..of.positions.len() as u32;
        let positions = of.positions.iter().map(|[x, _, z]| [*x, 0.0, *z]).collect();
        let normals = vec![[0.0; 3]; of.positions.len()];
        of.morphs = vec![MorphTarget { vertices: vertices.collect(), positions, normals }];
        for (weight, curvature) in [(0.0, 25.0), (0.5, 16.667), (1.0, 12.5)] {
            let part = Part { primitive: &of, character_from_mesh: Mat4::IDENTITY, morph_weights: &[weight] };
            let found = measured(&[part], &[], 1.0);
            for [k, ..] in &found[0][73 * 15..73 * 25] {
                assert!((k / curvature - 1.0).abs() < 0.06, "{weight}: {k}, expected {curvature}");
            }
        }
    }
}
