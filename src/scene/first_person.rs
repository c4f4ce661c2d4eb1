//! Who sees what of a character (VRM 1.0, `firstPerson`).

use super::{FirstPerson, HumanBone, Influences, Primitive, Scene};

/// Who sees the parts of a node.
pub(crate) struct Sight {
    pub others: bool,
    pub own: bool,
    /// Joints of the head, where triangles that they move are before the character's own eyes.
    head: Vec<bool>,
}

impl Sight {
    pub fn of(scene: &Scene, in_head: &[bool], node: usize) -> Self {
        let of = scene
            .character
            .as_ref()
            .map_or(FirstPerson::Both, |c| c.first_person.get(&node).copied().unwrap_or_default());
        let auto = of == FirstPerson::Auto;
        let skin = scene.nodes[node].skin.and_then(|s| scene.skins.get(s)).filter(|_| auto);
        let is_head = |node: &usize| in_head.get(*node).copied().unwrap_or(false);
        let is_head_part = auto && skin.is_none() && is_head(&node);
        Self {
            others: of != FirstPerson::FirstPersonOnly,
            own: scene.character.is_some() && of != FirstPerson::ThirdPersonOnly && !is_head_part,
            head: skin.map_or_else(Vec::new, |skin| skin.joints.iter().map(is_head).collect()),
        }
    }

    /// Whether the head moves a vertex.
    pub fn is_of_head(&self, primitive: &Primitive, vertex: usize) -> bool {
        let Influences { per_vertex, joints, weights } = &primitive.influences;
        let at = vertex * per_vertex..(vertex + 1) * per_vertex;
        let moving = joints.get(at.clone()).unwrap_or_default().iter().zip(weights.get(at).unwrap_or_default());
        let is_head = |joint: &u16| self.head.get(usize::from(*joint)).copied().unwrap_or(false);
        moving.into_iter().any(|(joint, weight)| *weight > 0.0 && is_head(joint))
    }
}

impl Scene {
    /// Whether each node is the head, or below it; empty without a head.
    pub(crate) fn below_head(&self) -> Vec<bool> {
        let Some(head) = self.bone_node(HumanBone::Head) else { return Vec::new() };
        let mut below = vec![false; self.nodes.len()];
        for (i, node) in self.nodes.iter().enumerate() {
            // Parents stand before their children.
            below[i] = i == head || node.parent.is_some_and(|p| below[p]);
        }
        below
    }

    /// Triangles of a node that the character sees of itself in first person, and that others see.
    #[must_use]
    pub fn triangles_in_sight(&self, node: usize) -> [usize; 2] {
        let Some(mesh) = self.nodes.get(node).and_then(|n| self.meshes.get(n.mesh?)) else { return [0; 2] };
        let sight = Sight::of(self, &self.below_head(), node);
        let of_head = |p: &Primitive, t: &[u32]| t.iter().any(|v| sight.is_of_head(p, *v as usize));
        let own = |p: &Primitive| p.indices.chunks_exact(3).filter(|t| !of_head(p, t)).count();
        let count = |is_seen: bool, of: &dyn Fn(&Primitive) -> usize| {
            if is_seen {
                mesh.primitives.iter().map(of).sum()
            } else {
                0
            }
        };
        [count(sight.own, &own), count(sight.others, &|p| p.indices.len() / 3)]
    }
}
