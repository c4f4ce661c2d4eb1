//! CPU-side description of what is drawn: plain data, no GPU types, no file formats.
//!
//! Conventions: right-handed, +Y up, metres, radians; a character faces +Z. Quaternions are `(x, y, z, w)`.

mod animation;
mod backdrop;
mod bangs;
mod camera;
mod character;
mod check;
mod environment;
mod eyes_through;
mod first_person;
mod head;
mod light;
mod mesh;
pub(crate) mod painted;
mod pieces;
mod post;
mod pupils;
mod role;
mod self_shadow;
mod texture;

pub use animation::{Animation, AnimationChannel, AnimationRig, AnimationValues, Interpolation};
pub use backdrop::Backdrop;
pub use bangs::Bangs;
pub(crate) use camera::DepthRange;
pub use camera::{Camera, Framing};
pub use character::*;
pub use environment::{Environment, MAX_RADIANCE, Radiance};
pub use eyes_through::EyesThrough;
pub(crate) use first_person::Sight;
pub use light::{Ambient, DirectionalLight, Lights, MAX_PUNCTUAL_LIGHTS, PunctualLight, SpotCone};
pub use mesh::{Influences, Mesh, MorphTarget, Primitive, Skin};
pub(crate) use pieces::welded;
pub use post::{Antialias, Bloom, Post, ToneCurve};
pub use pupils::Pupils;
pub use role::Role;
pub use self_shadow::{MOST_SHADOWED, SelfShadow};
pub use texture::{Filter, Image, Sampler, Texture, Wrap};

use glam::{Mat4, Quat, Vec3};

use crate::material::Material;
use crate::sdf::FaceMap;

/// Everything that a file holds: nodes, meshes, materials, textures, and the character data of VRM.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Where it came from; shown by `hikage inspect`.
    pub source: Source,
    /// Nodes; every parent stands before its children.
    pub nodes: Vec<Node>,
    /// Meshes, referred to by [`Node::mesh`].
    pub meshes: Vec<Mesh>,
    /// Skins, referred to by [`Node::skin`].
    pub skins: Vec<Skin>,
    /// Materials, referred to by [`Primitive::material`]. Never empty where a primitive exists.
    pub materials: Vec<Material>,
    /// Textures: an image and how it is sampled.
    pub textures: Vec<Texture>,
    /// Decoded images; shared ones stand once.
    pub images: Vec<Image>,
    /// Threshold maps of faces, referred to by [`FaceShadow::map`](crate::material::FaceShadow::map).
    pub face_maps: Vec<FaceMap>,
    /// Animation clips stored in the file.
    pub animations: Vec<Animation>,
    /// What the nodes that clips move stand for, in a file of humanoid movements (VRMA). `None`: such a file it is not.
    pub animation_rig: Option<AnimationRig>,
    /// VRM data: bones, expressions, look-at, springs. `None` for a plain glTF file.
    pub character: Option<Character>,
    /// Lights that a look asks for; [`Stage::of`](crate::Stage::of) takes those of its first actor. `None`: the default ones.
    pub lights: Option<Lights>,
    /// Light of the shadow that bangs and others cast on the face. `None`: nothing does.
    pub bangs: Option<Bangs>,
    /// Shadow of characters on themselves. `None`: there is none.
    pub self_shadow: Option<SelfShadow>,
    /// Eyes and brows through hair. `None`: hair hides them.
    pub eyes_through: Option<EyesThrough>,
    /// Pupils that follow light and expressions. `None`: they are as wide as materials say.
    pub pupils: Option<Pupils>,
    /// What is done to the whole picture. `None`: nothing is.
    pub post: Option<Post>,
    /// What will look or work other than the author meant.
    pub warnings: Vec<Warning>,
}

/// Facts about the file that a [`Scene`] was read from.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Source {
    /// File name without its folder; empty for a scene built in code.
    pub file: String,
    /// The program that wrote the file (`asset.generator`).
    pub generator: String,
    /// glTF version, as `2.0`.
    pub gltf_version: String,
    /// Extensions that the file uses.
    pub extensions_used: Vec<String>,
    /// Extensions that the file requires.
    pub extensions_required: Vec<String>,
}

/// Something in the file that was repaired, skipped, or will look wrong.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Warning {
    /// JSON pointer of the element.
    pub pointer: String,
    /// What was found and what was done about it.
    pub message: String,
}

/// One node of the hierarchy.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Node {
    /// Name in the file; may be empty.
    pub name: String,
    /// Index of the parent in [`Scene::nodes`], always smaller than this node's own; `None` at the root.
    pub parent: Option<usize>,
    /// Transform relative to the parent at rest.
    pub transform: Transform,
    /// Index in [`Scene::meshes`].
    pub mesh: Option<usize>,
    /// Index in [`Scene::skins`]; only with a mesh.
    pub skin: Option<usize>,
    /// Weights of the mesh's morph targets at rest; as many as the mesh has targets.
    pub morph_weights: Vec<f32>,
}

/// Translation, rotation and scale, applied to a point in the order scale, rotation, translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// Translation, metres.
    pub translation: Vec3,
    /// Rotation, unit length.
    pub rotation: Quat,
    /// Scale; negative mirrors.
    pub scale: Vec3,
}

impl Default for Transform {
    fn default() -> Self {
        Self { translation: Vec3::ZERO, rotation: Quat::IDENTITY, scale: Vec3::ONE }
    }
}

impl Transform {
    /// The matrix that takes local points to the parent.
    #[must_use]
    pub fn matrix(&self) -> Mat4 {
        Mat4::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

impl Scene {
    /// Matrices `world_from_node` of every node for the given local transforms.
    ///
    /// `locals` has one entry a node; missing ones are taken from rest.
    #[must_use]
    pub fn world_from_nodes(&self, locals: &[Transform]) -> Vec<Mat4> {
        let mut world = Vec::with_capacity(self.nodes.len());
        self.world_from_nodes_into(locals, &mut world);
        world
    }

    /// [`Scene::world_from_nodes`] into a list that is used again.
    pub(crate) fn world_from_nodes_into(&self, locals: &[Transform], world: &mut Vec<Mat4>) {
        world.clear();
        for (index, node) in self.nodes.iter().enumerate() {
            let local = locals.get(index).unwrap_or(&node.transform).matrix();
            let parent = node.parent.and_then(|p| world.get(p).copied());
            world.push(parent.map_or(local, |parent| parent * local));
        }
    }

    /// Matrices `world_from_node` at rest.
    #[must_use]
    pub fn rest_world_from_nodes(&self) -> Vec<Mat4> {
        self.world_from_nodes(&[])
    }

    /// Triangles over all nodes that carry a mesh.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.mesh_nodes().flat_map(|(_, mesh)| &mesh.primitives).map(|p| p.indices.len() / 3).sum()
    }

    /// Nodes that carry a mesh, with it.
    pub fn mesh_nodes(&self) -> impl Iterator<Item = (usize, &Mesh)> {
        self.nodes.iter().enumerate().filter_map(|(i, n)| Some((i, self.meshes.get(n.mesh?)?)))
    }

    /// Node of a humanoid bone; `None` without VRM data or where the bone is missing.
    #[must_use]
    pub fn bone_node(&self, bone: HumanBone) -> Option<usize> {
        self.character.as_ref()?.bones.get(&bone).copied()
    }
}
