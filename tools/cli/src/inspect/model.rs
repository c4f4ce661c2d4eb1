//! The facts about a model, gathered once for both the text and the JSON.

use hikage::material::Encoding;
use std::collections::BTreeMap;

use hikage::material::Material;
use hikage::scene::{Meta, Role, Scene, Source, Warning};
use hikage::sdf::{FaceStyle, Guide, Landmarks};
use serde::Serialize;

use super::memory::{geometry_bytes, image_uses, mipped_bytes};

/// Everything that `hikage inspect` says about a model.
#[derive(Serialize)]
pub(super) struct Summary<'a> {
    pub(super) kind: &'static str,
    #[serde(flatten)]
    pub(super) source: &'a Source,
    pub(super) bytes: u64,
    /// `0.x`, `1.0`, or null for a plain glTF file.
    pub(super) vrm_version: Option<&'a str>,
    pub(super) meta: Option<&'a Meta>,
    pub(super) nodes: usize,
    pub(super) vertices: usize,
    pub(super) triangles: usize,
    pub(super) meshes: Vec<MeshSummary<'a>>,
    pub(super) materials: Vec<MaterialSummary<'a>>,
    pub(super) textures: Vec<TextureSummary<'a>>,
    /// Joints of each skin.
    pub(super) skins: Vec<usize>,
    /// Humanoid bone to name of the node.
    pub(super) bones: BTreeMap<&'static str, &'a str>,
    pub(super) expressions: Vec<ExpressionSummary<'a>>,
    /// `bones`, `expressions` or null.
    pub(super) look_at: Option<&'static str>,
    /// What the anime look finds on each face, by the name of its material.
    pub(super) faces: BTreeMap<&'a str, Landmarks>,
    pub(super) springs: Vec<SpringSummary<'a>>,
    pub(super) colliders: usize,
    pub(super) constraints: usize,
    pub(super) animations: Vec<AnimationSummary<'a>>,
    /// What they move of any humanoid: in VRMA files.
    pub(super) moves: Option<MovesSummary<'a>>,
    pub(super) gpu_bytes_estimate: GpuBytes,
    pub(super) warnings: Vec<Warning>,
}

#[derive(Serialize)]
pub(super) struct MeshSummary<'a> {
    pub(super) name: &'a str,
    pub(super) morph_targets: &'a [String],
    pub(super) primitives: Vec<PrimitiveSummary>,
}

#[derive(Serialize)]
pub(super) struct PrimitiveSummary {
    pub(super) role: Role,
    pub(super) material: usize,
    pub(super) vertices: usize,
    pub(super) triangles: usize,
    pub(super) uv_sets: usize,
    pub(super) has_colors: bool,
    pub(super) influences: usize,
}

#[derive(Serialize)]
pub(super) struct MaterialSummary<'a> {
    pub(super) index: usize,
    pub(super) roles: Vec<Role>,
    /// What for and which texture.
    pub(super) textures_used: Vec<(String, usize)>,
    #[serde(flatten)]
    pub(super) material: &'a Material,
}

#[derive(Serialize)]
pub(super) struct TextureSummary<'a> {
    pub(super) name: &'a str,
    pub(super) format: &'a str,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) bits: u8,
    pub(super) uses: Vec<Encoding>,
    pub(super) gpu_bytes: u64,
}

#[derive(Serialize)]
pub(super) struct ExpressionSummary<'a> {
    pub(super) name: &'a str,
    pub(super) preset: bool,
    pub(super) binary: bool,
    pub(super) morphs: usize,
    pub(super) colors: usize,
    pub(super) uv_transforms: usize,
}

#[derive(Serialize)]
pub(super) struct SpringSummary<'a> {
    pub(super) name: &'a str,
    pub(super) joints: usize,
    pub(super) colliders: usize,
}

#[derive(Serialize)]
pub(super) struct AnimationSummary<'a> {
    pub(super) name: &'a str,
    pub(super) channels: usize,
    pub(super) seconds: f32,
}

#[derive(Serialize)]
pub(super) struct MovesSummary<'a> {
    pub(super) bones: Vec<&'static str>,
    pub(super) expressions: Vec<&'a str>,
    pub(super) gaze: bool,
}

#[derive(Serialize)]
pub(super) struct GpuBytes {
    pub(super) textures: u64,
    pub(super) geometry: u64,
}

pub(super) fn summarize(scene: &Scene, bytes: u64) -> Summary<'_> {
    let character = scene.character.as_ref();
    let node_name = |node: usize| scene.nodes.get(node).map_or("", |n| n.name.as_str());
    let uses = image_uses(scene);
    let textures: Vec<_> = scene
        .images
        .iter()
        .zip(uses)
        .map(|(image, uses)| TextureSummary {
            name: &image.name,
            format: image.format,
            width: image.width,
            height: image.height,
            bits: image.source_bits,
            gpu_bytes: mipped_bytes(image) * uses.len() as u64,
            uses,
        })
        .collect();
    let mut warnings = scene.warnings.clone();
    warnings.extend(super::checks::advice(scene));

    Summary {
        kind: "model",
        source: &scene.source,
        bytes,
        vrm_version: character.map(|c| c.vrm_version.as_str()),
        meta: character.map(|c| &c.meta),
        nodes: scene.nodes.len(),
        vertices: scene.meshes.iter().flat_map(|m| &m.primitives).map(|p| p.positions.len()).sum(),
        triangles: scene.triangle_count(),
        meshes: meshes(scene),
        materials: materials(scene),
        skins: scene.skins.iter().map(|s| s.joints.len()).collect(),
        bones: character.iter().flat_map(|c| &c.bones).map(|(bone, node)| (bone.name(), node_name(*node))).collect(),
        expressions: character
            .iter()
            .flat_map(|c| &c.expressions)
            .map(|e| ExpressionSummary {
                name: &e.name,
                preset: e.preset,
                binary: e.is_binary,
                morphs: e.morphs.len(),
                colors: e.colors.len(),
                uv_transforms: e.uv_transforms.len(),
            })
            .collect(),
        look_at: character.and_then(|c| c.look_at.as_ref()).map(|l| if l.uses_bones { "bones" } else { "expressions" }),
        faces: faces(scene),
        springs: character
            .iter()
            .flat_map(|c| &c.springs)
            .map(|s| SpringSummary { name: &s.name, joints: s.joints.len(), colliders: s.colliders.len() })
            .collect(),
        colliders: character.map_or(0, |c| c.colliders.len()),
        constraints: character.map_or(0, |c| c.constraints.len()),
        animations: scene
            .animations
            .iter()
            .map(|a| AnimationSummary {
                name: &a.name,
                channels: a.channels.len(),
                seconds: a.channels.iter().filter_map(|c| c.times.last()).fold(0.0, |end, t| end.max(*t)),
            })
            .collect(),
        moves: scene.animation_rig.as_ref().map(|rig| MovesSummary {
            bones: rig.bones.keys().map(|bone| bone.name()).collect(),
            expressions: rig.expressions.iter().map(|(name, _)| name.as_str()).collect(),
            gaze: rig.look_at.is_some(),
        }),
        gpu_bytes_estimate: GpuBytes {
            textures: textures.iter().map(|t| t.gpu_bytes).sum(),
            geometry: geometry_bytes(scene),
        },
        textures,
        warnings,
    }
}

/// What is found on the face of each material that has one.
fn faces(scene: &Scene) -> BTreeMap<&str, Landmarks> {
    let of_face = |index: usize| {
        let mut parts = scene.meshes.iter().flat_map(|m| &m.primitives);
        parts.any(|p| p.role == Role::Face && p.material == index)
    };
    let materials = scene.materials.iter().enumerate().filter(|(index, _)| of_face(*index));
    materials
        .filter_map(|(index, m)| Some((m.name.as_str(), *Guide::new(scene, index, FaceStyle::default())?.landmarks()?)))
        .collect()
}

fn meshes(scene: &Scene) -> Vec<MeshSummary<'_>> {
    let primitive = |p: &hikage::scene::Primitive| PrimitiveSummary {
        role: p.role,
        material: p.material,
        vertices: p.positions.len(),
        triangles: p.indices.len() / 3,
        uv_sets: p.uvs.len(),
        has_colors: !p.colors.is_empty(),
        influences: p.influences.per_vertex,
    };
    scene
        .meshes
        .iter()
        .map(|m| MeshSummary {
            name: &m.name,
            morph_targets: &m.morph_names,
            primitives: m.primitives.iter().map(primitive).collect(),
        })
        .collect()
}

fn materials(scene: &Scene) -> Vec<MaterialSummary<'_>> {
    let roles = |index: usize| {
        let parts = scene.meshes.iter().flat_map(|m| &m.primitives);
        let mut roles: Vec<Role> = parts.filter(|p| p.material == index).map(|p| p.role).collect();
        roles.sort();
        roles.dedup();
        roles
    };
    scene
        .materials
        .iter()
        .enumerate()
        .map(|(index, material)| MaterialSummary {
            index,
            roles: roles(index),
            textures_used: material.textures().into_iter().map(|(what, texture, _)| (what, texture)).collect(),
            material,
        })
        .collect()
}
