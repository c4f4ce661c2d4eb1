//! Nodes: one tree check, an order in which parents come first, and transforms. Walks are iterative: a hostile file may
//! nest a hundred thousand deep.

use glam::{Mat4, Quat, Vec3};

use crate::scene::{Node, Transform};

use super::fault::{Limits, Result, within};
use super::json::Json;
use super::warnings::Warnings;

/// The node tree in the order of [`Scene::nodes`](crate::scene::Scene::nodes).
#[derive(Debug)]
pub(super) struct Graph {
    pub(super) nodes: Vec<Node>,
    /// Index in `nodes` of each glTF node.
    pub(super) from_gltf: Vec<usize>,
    /// One past the last descendant of each node: subtrees are contiguous.
    subtree_end: Vec<usize>,
}

/// How many meshes, skins and cameras there are, for range checks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counts {
    pub(super) meshes: usize,
    pub(super) skins: usize,
    pub(super) cameras: usize,
}

impl Graph {
    /// Reads the nodes. `turn` adds a root that turns everything about +Y by half a turn.
    pub(super) fn read(
        root: &Json,
        counts: Counts,
        turn: bool,
        limits: &Limits,
        warnings: &mut Warnings,
    ) -> Result<Self> {
        let json = root.objects("nodes")?;
        within("/nodes", json.len() as u64, limits.nodes, "nodes")?;
        let (children, parents) = family(&json)?;
        let order = preorder(&json, &children, &parents)?;
        let shown = in_scene(root, &children, json.len())?;

        let mut nodes = Vec::with_capacity(json.len());
        if turn {
            let rotation = Quat::from_xyzw(0.0, 1.0, 0.0, 0.0);
            nodes.push(Node {
                name: "turned to +Z".into(),
                transform: Transform { rotation, ..Transform::default() },
                ..Node::default()
            });
        }
        let base = nodes.len();
        let mut from_gltf = vec![0usize; json.len()];
        for (position, &index) in order.iter().enumerate() {
            let slot = base.saturating_add(position);
            if let Some(entry) = from_gltf.get_mut(index) {
                *entry = slot;
            }
            let Some(json) = json.get(index) else { continue };
            let parent = parents.get(index).copied().flatten().and_then(|p| from_gltf.get(p).copied());
            let mut node = read_node(json, counts, warnings)?;
            node.parent = parent.or(turn.then_some(0));
            if !shown.get(index).copied().unwrap_or(false) {
                node.mesh = None;
                node.skin = None;
            }
            nodes.push(node);
        }
        let subtree_end = subtree_ends(&nodes);
        Ok(Self { nodes, from_gltf, subtree_end })
    }

    /// The scene's index of a glTF node.
    pub(super) fn node(&self, gltf: usize) -> Option<usize> {
        self.from_gltf.get(gltf).copied()
    }

    /// Reads the index of a glTF node leniently and turns it into the scene's.
    pub(super) fn maybe_node(&self, json: &Json, key: &str) -> Option<usize> {
        self.node(json.maybe_index(key, self.from_gltf.len())?)
    }

    /// Whether `below` is a descendant of `above`.
    pub(super) fn is_below(&self, above: usize, below: usize) -> bool {
        below > above && self.subtree_end.get(above).is_some_and(|end| below < *end)
    }
}

/// Children and parent of every node, checked to be a forest at the level of single links.
type Family = (Vec<Vec<usize>>, Vec<Option<usize>>);

fn family(json: &[Json]) -> Result<Family> {
    let mut parents: Vec<Option<usize>> = vec![None; json.len()];
    let mut children = Vec::with_capacity(json.len());
    for (index, node) in json.iter().enumerate() {
        let mut list = Vec::new();
        for child in node.array("children")? {
            let c = child.as_index(json.len(), "nodes")?;
            if let Some(slot) = parents.get_mut(c)
                && let Some(other) = slot.replace(index)
            {
                return Err(child.fault(format!("node {c} has two parents, {other} and {index}: expected a tree")));
            }
            list.push(c);
        }
        children.push(list);
    }
    Ok((children, parents))
}

fn preorder(json: &[Json], children: &[Vec<usize>], parents: &[Option<usize>]) -> Result<Vec<usize>> {
    let roots = (0..json.len()).rev().filter(|i| parents.get(*i).is_some_and(Option::is_none));
    let mut stack: Vec<usize> = roots.collect();
    let mut order = Vec::with_capacity(json.len());
    let mut seen = vec![false; json.len()];
    while let Some(index) = stack.pop() {
        order.push(index);
        if let Some(seen) = seen.get_mut(index) {
            *seen = true;
        }
        stack.extend(children.get(index).into_iter().flatten().rev());
    }
    // With one parent each, a node that no root reaches hangs on a cycle.
    match seen.iter().position(|s| !s).and_then(|i| json.get(i)) {
        Some(node) => Err(node.fault("the node is part of a cycle of children: expected a tree")),
        None => Ok(order),
    }
}

/// Marks the nodes of the scene that is shown; all where the file has no scenes.
fn in_scene(root: &Json, children: &[Vec<usize>], count: usize) -> Result<Vec<bool>> {
    let scenes = root.objects("scenes")?;
    let chosen = root.index("scene", scenes.len(), "scenes")?.unwrap_or(0);
    let mut shown = vec![scenes.is_empty(); count];
    for (index, scene) in scenes.iter().enumerate() {
        for node in scene.array("nodes")? {
            let mut stack = vec![node.as_index(count, "nodes")?];
            while let Some(n) = stack.pop().filter(|_| index == chosen) {
                if let Some(slot) = shown.get_mut(n)
                    && !*slot
                {
                    *slot = true;
                    stack.extend(children.get(n).into_iter().flatten());
                }
            }
        }
    }
    Ok(shown)
}

fn subtree_ends(nodes: &[Node]) -> Vec<usize> {
    let mut ends: Vec<usize> = (1..=nodes.len()).collect();
    for (index, node) in nodes.iter().enumerate().rev() {
        let end = ends.get(index).copied().unwrap_or(0);
        if let Some(slot) = node.parent.and_then(|p| ends.get_mut(p)) {
            *slot = end.max(*slot);
        }
    }
    ends
}

fn read_node(json: &Json, counts: Counts, warnings: &mut Warnings) -> Result<Node> {
    let mesh = json.index("mesh", counts.meshes, "meshes")?;
    let skin = json.index("skin", counts.skins, "skins")?.filter(|_| mesh.is_some());
    json.index("camera", counts.cameras, "cameras")?;
    let mut morph_weights = Vec::new();
    for weight in json.array("weights")? {
        morph_weights.push(weight.as_f32()?);
    }
    Ok(Node { name: json.name()?, parent: None, transform: read_transform(json, warnings)?, mesh, skin, morph_weights })
}

fn read_transform(json: &Json, warnings: &mut Warnings) -> Result<Transform> {
    let translation = json.floats("translation")?;
    let rotation = json.floats("rotation")?;
    let scale = json.floats("scale")?;
    if let Some(matrix) = json.floats::<16>("matrix")? {
        if translation.is_some() || rotation.is_some() || scale.is_some() {
            return Err(
                json.fault("found a matrix together with translation, rotation or scale, expected one or the other")
            );
        }
        return Ok(decompose(&Mat4::from_cols_array(&matrix), json, warnings));
    }
    let rotation = rotation.map_or(Quat::IDENTITY, Quat::from_array);
    let unit = rotation.as_dquat();
    let unit = if unit.length_squared() > 0.0 {
        unit.normalize().as_quat()
    } else {
        Quat::IDENTITY
    };
    if (rotation.length_squared() - 1.0).abs() > 0.01 {
        warnings.add(json.pointer(), "rotation is not of unit length: normalised");
    }
    Ok(Transform {
        translation: translation.map_or(Vec3::ZERO, Vec3::from_array),
        rotation: unit,
        scale: scale.map_or(Vec3::ONE, Vec3::from_array),
    })
}

/// Splits a matrix into translation, rotation and scale; shear is dropped with a warning.
fn decompose(matrix: &Mat4, json: &Json, warnings: &mut Warnings) -> Transform {
    let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
    let regular = matrix.determinant().is_normal() && rotation.is_finite() && scale.is_finite();
    if !regular {
        warnings.add(json.pointer(), "matrix is singular: its rotation is ignored");
        let length = |v: glam::Vec4| Some(v.truncate().length()).filter(|l| l.is_finite()).unwrap_or(0.0);
        let scale = Vec3::new(length(matrix.x_axis), length(matrix.y_axis), length(matrix.z_axis));
        return Transform { translation: matrix.w_axis.truncate(), rotation: Quat::IDENTITY, scale };
    }
    let again = Mat4::from_scale_rotation_translation(scale, rotation, translation);
    if !again.abs_diff_eq(*matrix, 1e-3 * scale.abs().max_element().max(1e-6)) {
        warnings.add(json.pointer(), "matrix shears or projects: only translation, rotation and scale are kept");
    }
    Transform { translation, rotation: rotation.normalize(), scale }
}
