//! What files say of strips of hair, in attributes of their own: `_HAIR_TANGENT`, `_ROOT_TIP`, `_STRIP_ID`.

use glam::Vec3;

use crate::scene::Primitive;

use super::accessor::Accessor;
use super::normals;
use super::primitive::Source;
use super::warnings::Warnings;

/// Reads them for the used vertices. What has a value that cannot be meant is left out whole: strips are then found from the
/// mesh.
pub(super) fn read(
    primitive: &mut Primitive,
    source: &Source,
    accessors: &[Accessor],
    used: &[u32],
    warnings: &mut Warnings,
) {
    let accessor = |index: Option<usize>| index.and_then(|i| accessors.get(i));
    let mut leave_out = |name: &str, why: &str| {
        warnings
            .add(&source.pointer, format!("{name} {why}: it is left out, and found from the mesh where it is needed"));
    };
    if let Some(accessor) = accessor(source.hair.tangent) {
        let (rows, bad) = accessor.floats::<3>(used.iter().copied());
        let unit: Option<Vec<[f32; 3]>> =
            rows.into_iter().map(|row| normals::unit(Vec3::from_array(row)).map(|unit| unit.to_array())).collect();
        match unit {
            Some(unit) if bad == 0 => primitive.strands = unit,
            _ => leave_out("_HAIR_TANGENT", "has vectors of length 0 or not finite"),
        }
    }
    if let Some(accessor) = accessor(source.hair.root_tip) {
        let (rows, bad) = accessor.normalized_floats::<1>(used.iter().copied());
        let list = rows.into_flattened();
        // A hair beyond comes from rounding.
        if bad == 0 && list.iter().all(|t| (-0.01..=1.01).contains(t)) {
            primitive.root_tip = list.into_iter().map(|t| t.clamp(0.0, 1.0)).collect();
        } else {
            leave_out("_ROOT_TIP", "has values that are not finite or not within 0 to 1");
        }
    }
    if let Some(accessor) = accessor(source.hair.strip_id) {
        let (rows, bad) = accessor.floats::<1>(used.iter().copied());
        let list = rows.into_flattened();
        // Floats count exactly up to 2^24.
        if bad == 0 && list.iter().all(|id| id.fract() == 0.0 && (0.0..=16_777_216.0).contains(id)) {
            primitive.strip_ids = list.into_iter().map(|id| id as u32).collect();
        } else {
            leave_out("_STRIP_ID", "has values that are no numbers of strips");
        }
    }
}
