//! Geometry: primitives with their own, compact vertices, morph targets and skin influences.

use glam::Mat4;

use super::Role;

/// A named group of primitives that share morph targets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Name in the file; may be empty.
    pub name: String,
    /// Parts, one material each.
    pub primitives: Vec<Primitive>,
    /// Names of the morph targets (`extras.targetNames`); as many as every primitive has targets.
    pub morph_names: Vec<String>,
}

/// Triangles of one material. All per-vertex arrays that are present have the length of `positions`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Primitive {
    /// Index in [`Scene::materials`](super::Scene::materials).
    pub material: usize,
    /// What the part is on a character.
    pub role: Role,
    /// Triangle list; every value is below the number of vertices.
    pub indices: Vec<u32>,
    /// Positions in the space of the mesh node, metres.
    pub positions: Vec<[f32; 3]>,
    /// Unit shading normals; computed where the file has none.
    pub normals: Vec<[f32; 3]>,
    /// Unit tangents with the sign of the bitangent in w (MikkTSpace); empty where no normal map needs them.
    pub tangents: Vec<[f32; 4]>,
    /// UV sets that the material uses, at most two; glTF convention: v grows downwards.
    /// [`TextureRef::uv_set`](crate::material::TextureRef::uv_set) indexes this list.
    pub uvs: Vec<Vec<[f32; 2]>>,
    /// Vertex colours, linear RGBA; empty where the file has none.
    pub colors: Vec<[f32; 4]>,
    /// Skin influences; empty where the mesh is rigid.
    pub influences: Influences,
    /// Morph targets, as many as [`Mesh::morph_names`].
    pub morphs: Vec<MorphTarget>,
    /// Unit normals for the outline: angle-weighted mean over all faces of the mesh that meet at the position, so
    /// that hard edges do not split the hull.
    pub outline_normals: Vec<[f32; 3]>,
    /// Unit directions of hair from root to tip, in the space of `positions`, at rest (`_HAIR_TANGENT`); empty where the file has
    /// none.
    pub strands: Vec<[f32; 3]>,
    /// How far along its strip of hair each vertex lies: 0 at the root, 1 at the tip (`_ROOT_TIP`); empty where the file has none.
    pub root_tip: Vec<f32>,
    /// Number of the strip of hair that each vertex belongs to (`_STRIP_ID`); empty where the file has none.
    pub strip_ids: Vec<u32>,
}

/// Skin influences with the same number for each vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Influences {
    /// Influences a vertex: 0 (rigid), 4, 8, …
    pub per_vertex: usize,
    /// Indices in [`Skin::joints`], `per_vertex` for each vertex.
    pub joints: Vec<u16>,
    /// Weights, non-negative, summing to 1 for each vertex, heaviest first.
    pub weights: Vec<f32>,
}

/// Displacements of one morph target, only for the vertices that move.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MorphTarget {
    /// Moved vertices, strictly growing.
    pub vertices: Vec<u32>,
    /// Displacement of the position, metres; one for each entry of `vertices`.
    pub positions: Vec<[f32; 3]>,
    /// Displacement of the shading normal; one for each entry of `vertices`.
    pub normals: Vec<[f32; 3]>,
}

/// Joints that deform a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skin {
    /// Name in the file; may be empty.
    pub name: String,
    /// Indices in [`Scene::nodes`](super::Scene::nodes).
    pub joints: Vec<usize>,
    /// Matrices `joint_from_mesh` at bind time, one for each joint.
    pub joint_from_mesh: Vec<Mat4>,
}

impl Skin {
    /// What a joint moves by, for nodes at these places.
    pub(crate) fn matrix(&self, world_from_nodes: &[Mat4], joint: usize) -> Mat4 {
        let node = self.joints.get(joint).and_then(|n| world_from_nodes.get(*n)).copied().unwrap_or(Mat4::IDENTITY);
        node * self.joint_from_mesh.get(joint).copied().unwrap_or(Mat4::IDENTITY)
    }
}
