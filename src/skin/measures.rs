//! What skin is shaded by of its shape.

use glam::{Mat4, Vec3};
use rayon::prelude::*;

use super::curvature::curvatures;
use super::thickness::{Body, thicknesses};
use crate::scene::Primitive;

/// Thickness from which on nothing comes through, m.
const THICKEST_M: f32 = 0.05;

/// Curvature, 1/m, and thickness, m, at each vertex of parts with `character_from_mesh` at rest; a part lies behind another.
pub(crate) fn measured(parts: &[(&Primitive, Mat4)]) -> Vec<Vec<[f32; 2]>> {
    let placed = |(primitive, rest): &(&Primitive, Mat4)| -> (Vec<Vec3>, Vec<Vec3>) {
        let normals = rest.inverse().transpose();
        let turned = |n: &[f32; 3]| normals.transform_vector3(Vec3::from(*n)).normalize_or_zero();
        let positions = primitive.positions.iter().map(|p| rest.transform_point3(Vec3::from(*p)));
        (positions.collect(), primitive.normals.iter().map(turned).collect())
    };
    let placed: Vec<_> = parts.iter().map(placed).collect();
    let bodies: Vec<Body<'_>> = placed
        .iter()
        .zip(parts)
        .map(|((positions, normals), (primitive, _))| Body { positions, normals, indices: &primitive.indices })
        .collect();
    let thick = thicknesses(&bodies, THICKEST_M);
    let scale = |rest: &Mat4| rest.determinant().abs().cbrt().max(1e-9);
    let both = |((primitive, rest), thick): (&(&Primitive, Mat4), Vec<f32>)| {
        let bent = curvatures(primitive).into_iter().map(|k| k / scale(rest));
        bent.zip(thick).map(|(k, t)| [k, t]).collect()
    };
    parts.par_iter().zip(thick).map(both).collect()
}
