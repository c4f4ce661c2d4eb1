//! What follows a bone, and where it stands at rest.

use std::collections::BTreeSet;

use glam::{Mat4, Vec3};

use super::{HumanBone, Primitive, Role, Scene};

/// Least share of a vertex that must follow the head for it to belong to the head.
const OF_HEAD: f32 = 0.9;

impl Scene {
    /// Node of a humanoid bone, or the first node with its plain name (`Head`, `mixamorig:Head`).
    pub(crate) fn joint_node(&self, bone: HumanBone, name: &str) -> Option<usize> {
        let plain = |n: &str| n.rsplit([':', '_', '.']).next().is_some_and(|last| last.eq_ignore_ascii_case(name));
        self.bone_node(bone).or_else(|| self.nodes.iter().position(|n| n.mesh.is_none() && plain(&n.name)))
    }

    /// Node of the head; `None` where nothing is known for one.
    pub(crate) fn head_node(&self) -> Option<usize> {
        self.joint_node(HumanBone::Head, "head")
    }

    /// A node and all below it.
    pub(crate) fn descendants(&self, root: usize) -> BTreeSet<usize> {
        let mut set = BTreeSet::from([root]);
        // Parents stand before their children.
        for (index, node) in self.nodes.iter().enumerate() {
            if node.parent.is_some_and(|p| set.contains(&p)) {
                set.insert(index);
            }
        }
        set
    }

    /// From the mesh of a node to the world at rest: any one joint takes a skin there.
    pub(crate) fn rest_placement(&self, world: &[Mat4], node: usize) -> Mat4 {
        let skin = self.nodes[node].skin.and_then(|s| self.skins.get(s));
        let joint = skin.and_then(|s| Some(*world.get(*s.joints.first()?)? * *s.joint_from_mesh.first()?));
        joint.unwrap_or_else(|| world.get(node).copied().unwrap_or_default())
    }

    /// Calls `change` with every part of hair and what takes it to the world at rest; a mesh under several nodes comes once,
    /// where the first of them places it.
    pub(crate) fn for_each_hair(&mut self, mut change: impl FnMut(&mut Primitive, Mat4)) {
        let world = self.rest_world_from_nodes();
        let mut done = BTreeSet::new();
        for node in 0..self.nodes.len() {
            let Some(mesh) = self.nodes[node].mesh.filter(|mesh| done.insert(*mesh)) else { continue };
            let matrix = self.rest_placement(&world, node);
            for part in self.meshes.get_mut(mesh).into_iter().flat_map(|m| &mut m.primitives) {
                if matches!(part.role, Role::Hair | Role::HairFront) {
                    change(part, matrix);
                }
            }
        }
    }

    /// How much of each vertex of a primitive under `node` follows a set of nodes. Range 0..1.
    pub(crate) fn shares(&self, node: usize, primitive: &Primitive, set: &BTreeSet<usize>) -> Vec<f32> {
        let skin = self.nodes[node].skin.and_then(|s| self.skins.get(s));
        let per_vertex = primitive.influences.per_vertex;
        let (Some(skin), true) = (skin, per_vertex > 0) else {
            return vec![f32::from(u8::from(set.contains(&node))); primitive.positions.len()];
        };
        let follows = |joint: &u16| skin.joints.get(usize::from(*joint)).is_some_and(|n| set.contains(n));
        let influences = &primitive.influences;
        let vertices = influences.joints.chunks(per_vertex).zip(influences.weights.chunks(per_vertex));
        let mut shares: Vec<f32> = vertices
            .map(|(joints, weights)| joints.iter().zip(weights).filter(|(j, _)| follows(j)).map(|(_, w)| w).sum())
            .collect();
        shares.resize(primitive.positions.len(), 0.0);
        shares
    }

    /// Box at rest, world space, round the vertices of faces that follow the head: a body in one piece with its face counts
    /// with its head only. `material` keeps to one of them. `None` without such a face, or where it is flat.
    pub(crate) fn face_box(&self, material: Option<usize>) -> Option<(Vec3, Vec3)> {
        let below = self.descendants(self.head_node()?);
        let world = self.rest_world_from_nodes();
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for (node, mesh) in self.mesh_nodes() {
            let is_face = |p: &&Primitive| p.role == Role::Face && material.is_none_or(|m| m == p.material);
            for primitive in mesh.primitives.iter().filter(is_face) {
                let matrix = self.rest_placement(&world, node);
                for (position, share) in primitive.positions.iter().zip(self.shares(node, primitive, &below)) {
                    if share > OF_HEAD {
                        let p = matrix.transform_point3(Vec3::from(*position));
                        (low, high) = (low.min(p), high.max(p));
                    }
                }
            }
        }
        let half = (high - low) * 0.5;
        (half.is_finite() && half.min_element() > 1e-4).then_some((low, high))
    }
}
