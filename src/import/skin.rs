//! Skins.

use glam::Mat4;

use crate::scene::Skin;

use super::accessor::{Accessor, Component};
use super::fault::{Limits, Result, within};
use super::graph::Graph;
use super::json::Json;
use super::warnings::Warnings;

/// Reads all skins.
pub(super) fn read_all(
    root: &Json,
    accessors: &[Accessor],
    graph: &Graph,
    limits: &Limits,
    warnings: &mut Warnings,
) -> Result<Vec<Skin>> {
    root.objects("skins")?.iter().map(|json| read(json, accessors, graph, limits, warnings)).collect()
}

fn read(json: &Json, accessors: &[Accessor], graph: &Graph, limits: &Limits, warnings: &mut Warnings) -> Result<Skin> {
    let nodes = graph.from_gltf.len();
    let list = json.need("joints")?.items()?;
    within(json.pointer(), list.len() as u64, limits.joints, "joints")?;
    let mut joints = Vec::with_capacity(list.len());
    for joint in &list {
        joints.push(graph.node(joint.as_index(nodes, "nodes")?).ok_or_else(|| joint.fault("joint node is missing"))?);
    }
    json.index("skeleton", nodes, "nodes")?;
    let mut joint_from_mesh = vec![Mat4::IDENTITY; joints.len()];
    if let Some(accessor) =
        json.index("inverseBindMatrices", accessors.len(), "accessors")?.and_then(|i| accessors.get(i))
    {
        accessor.expect("inverseBindMatrices", &["MAT4"], &[Component::F32], json.pointer())?;
        if accessor.count < joints.len() as u64 {
            return Err(accessor.fault(format!(
                "inverse bind matrices: found count {}, expected {} as joints of the skin",
                accessor.count,
                joints.len()
            )));
        }
        let count = u32::try_from(joints.len()).unwrap_or(0);
        let (rows, bad) = accessor.floats::<16>(0..count);
        if bad > 0 {
            return Err(accessor
                .fault(format!("inverse bind matrices: found {bad} NaN or infinite values, expected finite ones")));
        }
        for (slot, row) in joint_from_mesh.iter_mut().zip(rows) {
            *slot = Mat4::from_cols_array(&row);
        }
        if joint_from_mesh.iter().any(|m| m.determinant() == 0.0) {
            warnings
                .add(json.pointer(), "inverse bind matrices without an inverse: the vertices of these joints collapse");
        }
    }
    Ok(Skin { name: json.name()?, joints, joint_from_mesh })
}
