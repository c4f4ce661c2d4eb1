//! Primitives of the scene: triangles, and just the vertices that they use. Files often share one vertex buffer between
//! dozens of primitives; each element is fetched where it is used, never a whole accessor.

use std::collections::HashMap;

use glam::Vec3;

use crate::material::{Material, Origin};
use crate::scene::{Influences, MorphTarget, Primitive};

use super::accessor::Accessor;
use super::fault::{Fault, Limits, Result, within};
use super::primitive::{self, Source, Topology};
use super::warnings::Warnings;
use super::{normals, strands, tangents};

/// Running totals over the file.
#[derive(Debug, Default)]
pub(super) struct Budget {
    vertices: u64,
    indices: u64,
    bytes: u64,
}

impl Budget {
    /// Counts memory, or work of that order.
    pub(super) fn bytes(&mut self, pointer: &str, bytes: u64, limits: &Limits) -> Result<()> {
        self.bytes = self.bytes.saturating_add(bytes);
        within(pointer, self.bytes, limits.geometry_bytes, "bytes of geometry and animation")
    }
}

/// What building a primitive needs besides its source.
pub(super) struct Context<'a> {
    pub(super) accessors: &'a [Accessor<'a>],
    pub(super) materials: &'a [Material],
    pub(super) uv_sets: &'a [Vec<u32>],
    pub(super) limits: &'a Limits,
    /// Joints of the smallest skin that the mesh is used with.
    pub(super) joints: Option<usize>,
}

/// Builds a primitive; `None` where it has nothing to draw. `material` is left at 0 where the source has none.
pub(super) fn build(
    source: &Source,
    cx: &Context,
    budget: &mut Budget,
    warnings: &mut Warnings,
) -> Result<Option<Primitive>> {
    let Some(position) = source.position.and_then(|p| cx.accessors.get(p)) else {
        warnings.add(&source.pointer, "primitive without POSITION: skipped");
        return Ok(None);
    };
    if source.topology == Topology::None {
        warnings.add(&source.pointer, "points or lines: skipped");
        return Ok(None);
    }
    let corners = triangles(source, cx, position.count, budget, warnings)?;
    if corners.is_empty() {
        warnings.add(&source.pointer, "primitive without triangles: skipped");
        return Ok(None);
    }
    // Flat normals belong to a face, so no two faces can share a vertex.
    let (mut used, mut indices) = if source.normal.is_none() {
        unshared(corners)?
    } else {
        compact(&corners)
    };
    charge(source, cx, used.len(), indices.len(), budget)?;

    let positions = positions(position, &used)?;
    let mut primitive = Primitive { material: source.material.unwrap_or(0), ..Primitive::default() };
    primitive.normals = shading_normals(source, cx, &used, &positions, &indices, warnings);
    primitive.positions = positions;
    primitive.uvs = uvs(source, cx, &used, warnings);

    let material = source.material.and_then(|m| cx.materials.get(m));
    if let Some(map) = material.and_then(|m| m.normal_map) {
        if let Some(tangent) = source.tangent.and_then(|t| cx.accessors.get(t)) {
            primitive.tangents = tangents::repaired(tangent.floats(used.iter().copied()).0, &primitive.normals);
        } else if let Some(uv) = primitive.uvs.get(map.texture.uv_set as usize) {
            let made = tangents::generate(&primitive.positions, &primitive.normals, uv, &mut indices);
            // Vertices on a seam where the texture is mirrored exist once for each side.
            let copy = |list: &mut Vec<u32>| {
                list.extend(made.copies.iter().filter_map(|v| used.get(*v as usize).copied()).collect::<Vec<_>>())
            };
            let mut extended = used.clone();
            copy(&mut extended);
            for vertex in &made.copies {
                let v = *vertex as usize;
                primitive.positions.extend(primitive.positions.get(v).copied());
                primitive.normals.extend(primitive.normals.get(v).copied());
                for set in &mut primitive.uvs {
                    set.extend(set.get(v).copied());
                }
            }
            used = extended;
            primitive.tangents = made.tangents;
        }
    }
    // MToon, "Vertex Colors": ignored.
    if !material.is_some_and(|m| matches!(m.origin, Origin::Mtoon0 | Origin::Mtoon1)) {
        primitive.colors = colors(source, cx, &used);
    }
    strands::read(&mut primitive, source, cx.accessors, &used, warnings);
    primitive.influences = influences(source, cx, &used, warnings)?;
    primitive.morphs = morphs(source, cx, &used, budget, warnings)?;
    primitive.indices = indices;
    Ok(Some(primitive))
}

/// Corners of the triangles as indices of the accessors; triangles without area by index are left out.
fn triangles(
    source: &Source,
    cx: &Context,
    count: u64,
    budget: &mut Budget,
    warnings: &mut Warnings,
) -> Result<Vec<u32>> {
    let vertices = u32::try_from(count).map_err(|_| Fault::new(&source.pointer, "count of vertices is too large"))?;
    let accessor = source.indices.and_then(|i| cx.accessors.get(i));
    let corners = accessor.map_or(count, |a| a.count);
    let times = if source.topology == Topology::List { 1 } else { 3 };
    budget.indices = budget.indices.saturating_add(corners.saturating_mul(times));
    within(&source.pointer, budget.indices, cx.limits.indices, "triangle corners")?;
    let list: Vec<u32> = match accessor {
        None => (0..vertices).collect(),
        Some(accessor) => {
            let corners = u32::try_from(corners).map_err(|_| accessor.fault("count of indices is too large"))?;
            let list = accessor.unsigned::<1>(0..corners).into_flattened();
            if let Some(bad) = list.iter().find(|i| **i >= vertices) {
                return Err(accessor
                    .fault(format!("found vertex index {bad}, expected an index below the vertex count {vertices}")));
            }
            list
        }
    };
    let triple = |a: u32, b: u32, c: u32| (a != b && b != c && a != c).then_some([a, b, c]);
    let made: Vec<[u32; 3]> = match source.topology {
        Topology::List => {
            if !list.len().is_multiple_of(3) {
                warnings.add(&source.pointer, "number of indices is no multiple of 3: the rest is left out");
            }
            list.as_chunks::<3>().0.iter().filter_map(|&[a, b, c]| triple(a, b, c)).collect()
        }
        Topology::Strip => {
            let turn = |(i, w): (usize, &[u32])| match *w {
                [a, b, c] if i.is_multiple_of(2) => triple(a, b, c),
                [a, b, c] => triple(b, a, c),
                _ => None,
            };
            list.windows(3).enumerate().filter_map(turn).collect()
        }
        Topology::Fan => match list.split_first() {
            Some((&hub, rim)) => rim.windows(2).filter_map(|w| triple(hub, *w.first()?, *w.last()?)).collect(),
            None => Vec::new(),
        },
        Topology::None => Vec::new(),
    };
    Ok(made.into_flattened())
}

/// One vertex for each corner.
fn unshared(corners: Vec<u32>) -> Result<(Vec<u32>, Vec<u32>)> {
    let count = u32::try_from(corners.len()).map_err(|_| Fault::new("/meshes", "too many corners"))?;
    Ok((corners, (0..count).collect()))
}

/// The used vertices in ascending order, and the corners renumbered.
fn compact(corners: &[u32]) -> (Vec<u32>, Vec<u32>) {
    let span = corners.iter().max().map_or(0, |m| *m as usize).saturating_add(1);
    let number = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    // A table as long as the accessor would be wasteful where a few triangles use a large shared one.
    if span > corners.len().saturating_mul(8) {
        let mut used = corners.to_vec();
        used.sort_unstable();
        used.dedup();
        let table: HashMap<u32, u32> = used.iter().enumerate().map(|(new, old)| (*old, number(new))).collect();
        let indices = corners.iter().map(|c| table.get(c).copied().unwrap_or(0)).collect();
        return (used, indices);
    }
    let mut table = vec![u32::MAX; span];
    for corner in corners {
        if let Some(slot) = table.get_mut(*corner as usize) {
            *slot = 0;
        }
    }
    let mut used = Vec::new();
    for (old, slot) in table.iter_mut().enumerate().filter(|(_, slot)| **slot == 0) {
        *slot = number(used.len());
        used.push(number(old));
    }
    let indices = corners.iter().map(|c| table.get(*c as usize).copied().unwrap_or(0)).collect();
    (used, indices)
}

/// Counts vertices and memory before anything is read.
fn charge(source: &Source, cx: &Context, vertices: usize, indices: usize, budget: &mut Budget) -> Result<()> {
    budget.vertices = budget.vertices.saturating_add(vertices as u64);
    within(&source.pointer, budget.vertices, cx.limits.vertices, "vertices")?;
    // Position, two normals, tangent, colour and two UV sets; six bytes an influence; what is said of strips of hair.
    let primitive::Hair { tangent, root_tip, strip_id } = source.hair;
    let hair = [(tangent, 12u64), (root_tip, 4), (strip_id, 4)];
    let hair: u64 = hair.into_iter().filter(|(accessor, _)| accessor.is_some()).map(|(_, bytes)| bytes).sum();
    let each = 84u64.saturating_add((source.influences.len() as u64).saturating_mul(24)).saturating_add(hair);
    let bytes = each.saturating_mul(vertices as u64).saturating_add((indices as u64).saturating_mul(4));
    budget.bytes(&source.pointer, bytes, cx.limits)
}

fn positions(accessor: &Accessor, used: &[u32]) -> Result<Vec<[f32; 3]>> {
    let (rows, bad) = accessor.floats(used.iter().copied());
    if bad > 0 {
        return Err(accessor.fault(format!("position: found {bad} NaN or infinite values, expected finite ones")));
    }
    Ok(rows)
}

fn shading_normals(
    source: &Source,
    cx: &Context,
    used: &[u32],
    positions: &[[f32; 3]],
    indices: &[u32],
    warnings: &mut Warnings,
) -> Vec<[f32; 3]> {
    let Some(accessor) = source.normal.and_then(|n| cx.accessors.get(n)) else {
        return normals::flat(positions, indices);
    };
    let mut list: Vec<[f32; 3]> = accessor.floats(used.iter().copied()).0;
    let mut repaired = None;
    for (vertex, normal) in list.iter_mut().enumerate() {
        match normals::unit(Vec3::from_array(*normal)) {
            Some(unit) => *normal = unit.to_array(),
            None => {
                let smooth = repaired.get_or_insert_with(|| normals::smooth(positions, indices));
                *normal = smooth.get(vertex).copied().unwrap_or([0.0, 0.0, 1.0]);
            }
        }
    }
    if repaired.is_some() {
        warnings.add(&source.pointer, "normals of length 0 or not finite: replaced by smooth normals");
    }
    list
}

fn uvs(source: &Source, cx: &Context, used: &[u32], warnings: &mut Warnings) -> Vec<Vec<[f32; 2]>> {
    let mut sets = source.material.and_then(|m| cx.uv_sets.get(m)).map_or(&[][..], Vec::as_slice);
    if sets.is_empty() && source.uvs.contains_key(&0) {
        // Looks read the coordinates of a surface without a texture, too: strands, sparks, what burns.
        sets = &[0];
    }
    sets.iter()
        .map(|set| match source.uvs.get(set).and_then(|a| cx.accessors.get(*a)) {
            Some(accessor) => {
                let (rows, bad) = accessor.floats(used.iter().copied());
                if bad > 0 {
                    warnings.add(&source.pointer, "UVs that are not finite: replaced by 0");
                }
                rows
            }
            None => {
                warnings.add(
                    &source.pointer,
                    format!("TEXCOORD_{set} is missing, but the material's textures need it: zeros are used"),
                );
                vec![[0.0; 2]; used.len()]
            }
        })
        .collect()
}

fn colors(source: &Source, cx: &Context, used: &[u32]) -> Vec<[f32; 4]> {
    let Some(accessor) = source.color.and_then(|c| cx.accessors.get(c)) else { return Vec::new() };
    let mut rows: Vec<[f32; 4]> = accessor.floats(used.iter().copied()).0;
    if accessor.kind == "VEC3" {
        for [.., alpha] in &mut rows {
            *alpha = 1.0;
        }
    }
    // White changes nothing and is what many exporters write.
    if rows.iter().all(|c| *c == [1.0; 4]) {
        Vec::new()
    } else {
        rows
    }
}

fn influences(source: &Source, cx: &Context, used: &[u32], warnings: &mut Warnings) -> Result<Influences> {
    let (Some(joint_count), false) = (cx.joints, source.influences.is_empty()) else {
        return Ok(Influences::default());
    };
    let mut vertices: Vec<Vec<(u16, f32)>> = vec![Vec::new(); used.len()];
    let mut odd = false;
    for &(joints, weights) in &source.influences {
        let (Some(joints), Some(weights)) = (cx.accessors.get(joints), cx.accessors.get(weights)) else { continue };
        let (weight_rows, bad) = weights.normalized_floats::<4>(used.iter().copied());
        odd |= bad > 0;
        for ((vertex, joint_row), weight_row) in
            vertices.iter_mut().zip(joints.unsigned::<4>(used.iter().copied())).zip(weight_rows)
        {
            for (joint, weight) in joint_row.into_iter().zip(weight_row) {
                odd |= weight < 0.0;
                if weight <= 0.0 {
                    continue;
                }
                let index = u16::try_from(joint).ok().filter(|j| usize::from(*j) < joint_count);
                let index = index.ok_or_else(|| joints.fault(format!("found joint index {joint}, expected an index below {joint_count}, the number of joints of the skin")))?;
                vertex.push((index, weight));
            }
        }
    }
    let mut most = 0usize;
    for vertex in &mut vertices {
        // Stable, so that equal weights keep the order of the file.
        vertex.sort_by(|a, b| b.1.total_cmp(&a.1));
        let sum: f32 = vertex.iter().map(|(_, w)| w).sum();
        if sum > 0.0 && sum.is_finite() {
            for (_, weight) in vertex.iter_mut() {
                *weight /= sum;
            }
        } else {
            odd = true;
            vertex.clear();
            vertex.push((0, 1.0));
        }
        most = most.max(vertex.len());
    }
    if odd {
        warnings.add(&source.pointer, "skin weights that are negative, not finite or sum to 0: repaired");
    }
    let per_vertex = most.next_multiple_of(4);
    let mut out = Influences { per_vertex, joints: Vec::new(), weights: Vec::new() };
    let total = per_vertex.saturating_mul(vertices.len());
    out.joints.reserve_exact(total);
    out.weights.reserve_exact(total);
    for vertex in vertices {
        let padded = vertex.into_iter().chain(std::iter::repeat((0, 0.0))).take(per_vertex);
        for (joint, weight) in padded {
            out.joints.push(joint);
            out.weights.push(weight);
        }
    }
    Ok(out)
}

fn morphs(
    source: &Source,
    cx: &Context,
    used: &[u32],
    budget: &mut Budget,
    warnings: &mut Warnings,
) -> Result<Vec<MorphTarget>> {
    let mut out = Vec::with_capacity(source.targets.len());
    for target in &source.targets {
        let position = target.position.and_then(|a| cx.accessors.get(a));
        let normal = target.normal.and_then(|a| cx.accessors.get(a));
        // Accessors that are all zero cost nothing however often they are used.
        let [position, normal] = [position, normal].map(|a| a.filter(|a| !a.is_zero()));
        let mut morph = MorphTarget::default();
        if position.is_some() || normal.is_some() {
            budget.bytes(&source.pointer, used.len() as u64, cx.limits)?;
            let mut read = |accessor: Option<&Accessor>| match accessor {
                Some(accessor) => {
                    let (rows, bad) = accessor.floats::<3>(used.iter().copied());
                    if bad > 0 {
                        warnings.add(&source.pointer, "morph target values that are not finite: replaced by 0");
                    }
                    rows
                }
                None => Vec::new(),
            };
            let (positions, normals) = (read(position), read(normal));
            for vertex in 0..used.len() {
                let p = positions.get(vertex).copied().unwrap_or_default();
                let n = normals.get(vertex).copied().unwrap_or_default();
                if p != [0.0; 3] || n != [0.0; 3] {
                    morph.vertices.push(u32::try_from(vertex).unwrap_or(u32::MAX));
                    morph.positions.push(p);
                    morph.normals.push(n);
                }
            }
            budget.bytes(&source.pointer, (morph.vertices.len() as u64).saturating_mul(28), cx.limits)?;
        }
        out.push(morph);
    }
    Ok(out)
}
