//! A character's meshes as what is measured of them asks for.

use glam::Vec3;

use super::curvature::Surface;
use super::tree::Tree;

/// A mesh of a character at rest, in a space that all its meshes share.
pub(super) struct Body<'a> {
    /// Positions of the vertices, m.
    pub(super) positions: &'a [Vec3],
    /// Normals of the vertices, out of the body, of any length; as many as positions.
    pub(super) normals: &'a [Vec3],
    /// Triangle list.
    pub(super) indices: &'a [u32],
}

/// Bodies as one.
pub(super) struct Shape {
    /// Vertices of all bodies, in their order.
    pub(super) surface: Surface,
    /// Of each place of the surface: where it is, and the sum of its vertices' normals. Seams stay closed by it.
    pub(super) feet: Vec<(Vec3, Vec3)>,
    /// All triangles.
    pub(super) tree: Tree,
}

impl Shape {
    /// Triangles with a corner that their body lacks are left out.
    pub(super) fn new(bodies: &[Body<'_>]) -> Self {
        let mut positions = Vec::new();
        let mut triangles = Vec::new();
        for body in bodies {
            let first = positions.len() as u32;
            let within = |corners: &&[u32; 3]| corners.iter().all(|c| (*c as usize) < body.positions.len());
            let corners = body.indices.as_chunks::<3>().0.iter().filter(within);
            triangles.extend(corners.map(|corners| corners.map(|c| first + c)));
            positions.extend(body.positions.iter().map(Vec3::to_array));
        }
        let surface = Surface::new(&positions, &triangles);
        let mut feet = vec![(Vec3::ZERO, Vec3::ZERO); surface.len()];
        let normals =
            bodies.iter().flat_map(|b| (0..b.positions.len()).map(|v| b.normals.get(v).copied().unwrap_or_default()));
        for ((place, position), normal) in surface.places().iter().zip(&positions).zip(normals) {
            let (at, sum) = &mut feet[*place as usize];
            *at = Vec3::from_array(*position);
            *sum += normal.normalize_or_zero();
        }
        let tree = Tree::new(&positions, &triangles);
        Self { surface, feet, tree }
    }
}
