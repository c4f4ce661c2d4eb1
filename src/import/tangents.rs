//! Tangents by MikkTSpace, for materials with a normal map in files without tangents.
//!
//! MikkTSpace gives a tangent to each corner. Corners of one vertex are averaged, but a vertex on a seam where the texture
//! is mirrored is split in two, since a mean of opposite signs means nothing. Splitting every differing corner instead
//! would grow the mesh for differences that normal maps do not show.

#![allow(clippy::arithmetic_side_effects, reason = "float vectors cannot overflow; integers use checked methods")]

use bevy_mikktspace::{Geometry, TangentSpace};
use glam::{Vec3, Vec4};

/// Tangents, and the vertices that must be appended as copies of others.
#[derive(Debug, Default)]
pub(super) struct Tangents {
    /// For the old vertices and the copies after them.
    pub(super) tangents: Vec<[f32; 4]>,
    /// Old vertex of each copy.
    pub(super) copies: Vec<u32>,
}

struct Mesh<'a> {
    positions: &'a [[f32; 3]],
    normals: &'a [[f32; 3]],
    uvs: &'a [[f32; 2]],
    indices: &'a [u32],
    corners: Vec<Option<[f32; 4]>>,
}

impl Mesh<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.indices.get(face.saturating_mul(3).saturating_add(corner)).map_or(0, |i| *i as usize)
    }
}

impl Geometry for Mesh<'_> {
    fn num_faces(&self) -> usize {
        self.indices.len() / 3
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        self.positions.get(self.vertex(face, corner)).copied().unwrap_or_default()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        self.normals.get(self.vertex(face, corner)).copied().unwrap_or_default()
    }

    /// MikkTSpace counts v upwards, as normal maps do; glTF counts it downwards.
    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        let [u, v] = self.uvs.get(self.vertex(face, corner)).copied().unwrap_or_default();
        [u, 1.0 - v]
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        if let Some(slot) = self.corners.get_mut(face.saturating_mul(3).saturating_add(corner)) {
            *slot = space.map(|s| s.tangent_encoded());
        }
    }
}

/// Makes tangents; corners of split vertices are renumbered in `indices`.
pub(super) fn generate(
    positions: &[[f32; 3]],
    normals: &[[f32; 3]],
    uvs: &[[f32; 2]],
    indices: &mut [u32],
) -> Tangents {
    let corners = vec![None; indices.len()];
    let mut mesh = Mesh { positions, normals, uvs, indices, corners };
    if bevy_mikktspace::generate_tangents(&mut mesh).is_err() {
        return Tangents { tangents: repaired(vec![[0.0; 4]; positions.len()], normals), copies: Vec::new() };
    }
    let corners = mesh.corners;
    let mut sums = vec![[Vec3::ZERO; 2]; positions.len()];
    for (index, tangent) in indices.iter().zip(&corners) {
        let (Some(&[x, y, z, sign]), Some(sum)) = (tangent.as_ref(), sums.get_mut(*index as usize)) else { continue };
        let [plus, minus] = sum;
        *(if sign < 0.0 { minus } else { plus }) += Vec3::new(x, y, z);
    }
    let mut tangents = Vec::with_capacity(positions.len());
    let mut copies = Vec::new();
    let mut copy_of = vec![u32::MAX; positions.len()];
    for (vertex, ([plus, minus], slot)) in sums.iter().zip(&mut copy_of).enumerate() {
        let (has_plus, has_minus) = (*plus != Vec3::ZERO, *minus != Vec3::ZERO);
        tangents.push(
            if has_plus || !has_minus {
                plus.extend(1.0)
            } else {
                minus.extend(-1.0)
            }
            .to_array(),
        );
        if has_plus && has_minus {
            *slot = u32::try_from(positions.len().saturating_add(copies.len())).unwrap_or(u32::MAX);
            copies.push(u32::try_from(vertex).unwrap_or(u32::MAX));
        }
    }
    for copy in &copies {
        let [_, minus] = sums.get(*copy as usize).copied().unwrap_or_default();
        tangents.push(minus.extend(-1.0).to_array());
    }
    for (index, tangent) in indices.iter_mut().zip(&corners) {
        let copy = copy_of.get(*index as usize).copied().unwrap_or(u32::MAX);
        if copy != u32::MAX && tangent.is_some_and(|[.., sign]| sign < 0.0) {
            *index = copy;
        }
    }
    let mut all_normals = normals.to_vec();
    all_normals.extend(copies.iter().filter_map(|c| normals.get(*c as usize).copied()));
    Tangents { tangents: repaired(tangents, &all_normals), copies }
}

/// Unit tangents with a sign of 1 or -1; those without a direction get any that is square to the normal.
pub(super) fn repaired(mut tangents: Vec<[f32; 4]>, normals: &[[f32; 3]]) -> Vec<[f32; 4]> {
    for (tangent, normal) in tangents.iter_mut().zip(normals) {
        let given = Vec4::from_array(*tangent);
        let direction = super::normals::unit(given.truncate());
        let direction = direction
            .unwrap_or_else(|| Vec3::from_array(*normal).try_normalize().unwrap_or(Vec3::Z).any_orthonormal_vector());
        *tangent = direction.extend(if given.w < 0.0 { -1.0 } else { 1.0 }).to_array();
    }
    tangents
}
