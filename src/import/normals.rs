//! Normals that the file lacks: flat ones, smooth ones, and those of the outline.

#![allow(clippy::arithmetic_side_effects, reason = "float vectors cannot overflow; integers use checked methods")]

use std::collections::HashMap;

use glam::{DVec3, Vec3};

use crate::scene::Primitive;

/// The unit vector, if the vector has a direction.
pub(super) fn unit(v: Vec3) -> Option<Vec3> {
    let v = v.as_dvec3();
    let length = v.length();
    (length > 1e-12 && length.is_finite()).then(|| (v / length).as_vec3())
}

fn point(positions: &[[f32; 3]], index: u32) -> DVec3 {
    Vec3::from_array(positions.get(index as usize).copied().unwrap_or_default()).as_dvec3()
}

/// Corners of the triangles with their points.
fn faces<'a>(positions: &'a [[f32; 3]], indices: &'a [u32]) -> impl Iterator<Item = ([u32; 3], [DVec3; 3])> + 'a {
    indices.as_chunks::<3>().0.iter().map(|corners| (*corners, corners.map(|c| point(positions, c))))
}

/// The unit normal of a triangle; `None` where it has no area.
fn face_normal([a, b, c]: [DVec3; 3]) -> Option<DVec3> {
    (b - a).cross(c - a).try_normalize()
}

/// Calls `add` with each corner and the face normal weighted by the angle at that corner.
///
/// Weighting by angle makes the result independent of how a flat polygon was cut into triangles.
fn angle_weighted(positions: &[[f32; 3]], indices: &[u32], mut add: impl FnMut(u32, DVec3)) {
    for (corners, points) in faces(positions, indices) {
        let Some(normal) = face_normal(points) else { continue };
        let [a, b, c] = points;
        let [i, j, k] = corners;
        for (corner, at, to, from) in [(i, a, b, c), (j, b, c, a), (k, c, a, b)] {
            if let (Some(u), Some(v)) = ((to - at).try_normalize(), (from - at).try_normalize()) {
                add(corner, normal * u.dot(v).clamp(-1.0, 1.0).acos());
            }
        }
    }
}

/// Face normals at the corners; every corner has its own vertex.
pub(super) fn flat(positions: &[[f32; 3]], indices: &[u32]) -> Vec<[f32; 3]> {
    let mut out = vec![[0.0, 0.0, 1.0]; positions.len()];
    for (corners, points) in faces(positions, indices) {
        let normal = face_normal(points).unwrap_or(DVec3::Z).as_vec3().to_array();
        for corner in corners {
            if let Some(slot) = out.get_mut(corner as usize) {
                *slot = normal;
            }
        }
    }
    out
}

/// Angle-weighted normals of the vertices, as they are shared by index.
pub(super) fn smooth(positions: &[[f32; 3]], indices: &[u32]) -> Vec<[f32; 3]> {
    let mut sums = vec![DVec3::ZERO; positions.len()];
    angle_weighted(positions, indices, |corner, normal| {
        if let Some(sum) = sums.get_mut(corner as usize) {
            *sum += normal;
        }
    });
    sums.into_iter().map(|s| s.try_normalize().unwrap_or(DVec3::Z).as_vec3().to_array()).collect()
}

/// A position as a key: bit patterns, with -0 and 0 the same.
fn key(position: [f32; 3]) -> [u32; 3] {
    position.map(|v| (v + 0.0).to_bits())
}

/// Fills the outline normals of a mesh: the mean over all faces that meet at a position, whatever primitive, UV seam,
/// hard edge or skin weight parts them, so that the hull stays closed.
pub(super) fn fill_outline(primitives: &mut [Primitive]) {
    let mut sums: HashMap<[u32; 3], DVec3> = HashMap::new();
    for primitive in primitives.iter() {
        angle_weighted(&primitive.positions, &primitive.indices, |corner, normal| {
            if let Some(position) = primitive.positions.get(corner as usize) {
                *sums.entry(key(*position)).or_default() += normal;
            }
        });
    }
    for primitive in primitives {
        let normals = primitive.positions.iter().zip(&primitive.normals).map(|(position, shading)| {
            // Two-sided sheets modelled as two layers cancel out: each layer keeps its own normal then.
            let sum = sums.get(&key(*position)).copied().unwrap_or_default();
            if sum.length() > 1e-3 {
                sum.normalize().as_vec3().to_array()
            } else {
                *shading
            }
        });
        primitive.outline_normals = normals.collect();
    }
}
