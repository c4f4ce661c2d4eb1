//! From a file to a [`Scene`]: glTF 2.0, GLB, VRM 0.x, VRM 1.0 and VRMA.
//!
//! Input is not trusted. Every size is checked against the bytes at hand before it is used, every index before it is
//! followed, files are opened only below the model's folder, and walks over the node graph are iterative. Order of work:
//! split the container, check all references, resolve what is used, read it.
//!
//! Errors name the file, the place in it as a JSON pointer, what was found and what was expected. Faults that only make
//! the picture worse become [`Scene::warnings`].

#![deny(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::arithmetic_side_effects
)]

mod accessor;
mod animation;
mod buffers;
mod checks;
mod container;
mod fault;
mod files;
mod geometry;
mod graph;
mod head_parts;
pub mod image;
mod json;
mod material;
mod meshopt;
mod mtoon;
mod mtoon0;
mod normals;
mod pbr;
mod primitive;
mod radiance;
mod role;
mod skin;
mod spring;
mod strands;
mod tangents;
mod texture;
mod vrm0;
mod vrm1;
mod vrma;
mod warnings;

use std::path::Path;

use crate::Result;
use crate::material::{Material, Origin};
use crate::scene::{Character, Mesh, Node, Scene, Source};

pub use fault::Limits;
use fault::{Fault, quoted};
use json::Json;
pub use radiance::load_radiance;
use warnings::Warnings;

/// Extensions that are read. A file that requires any other is refused.
const SUPPORTED: [&str; 15] = [
    "VRM",
    "VRMC_vrm",
    "VRMC_materials_mtoon",
    "VRMC_materials_hdr_emissiveMultiplier",
    "VRMC_springBone",
    "VRMC_springBone_extended_collider",
    "VRMC_node_constraint",
    "VRMC_vrm_animation",
    "KHR_materials_ior",
    "KHR_materials_unlit",
    "KHR_materials_emissive_strength",
    "KHR_texture_transform",
    "KHR_mesh_quantization",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
];

/// Loads a model with the default [`Limits`].
///
/// Where nothing is known for a face, face and hair of the head are told apart by pieces and colours: they become parts of their
/// own, with copies of their material.
///
/// # Errors
/// The file cannot be read, is malformed, requires an unsupported extension, or is over a limit.
pub fn load(path: impl AsRef<Path>) -> Result<Scene> {
    load_with(path, &Limits::default())
}

/// Loads a model.
///
/// # Errors
/// The file cannot be read, is malformed, requires an unsupported extension, or is over a limit.
pub fn load_with(path: impl AsRef<Path>, limits: &Limits) -> Result<Scene> {
    let path = path.as_ref();
    let name = path.display().to_string();
    let bytes = image::read(path, limits)?;
    let folder = path.parent().map(|p| if p.as_os_str().is_empty() { Path::new(".") } else { p });
    load_bytes(&name, &bytes, folder, limits)
}

/// Loads a model from memory. `name` stands in errors and in [`Source::file`]; `folder` is where files that the model
/// refers to are looked up, none where it may not refer to any.
///
/// # Errors
/// The bytes are malformed, require an unsupported extension, or are over a limit.
pub fn load_bytes(name: &str, bytes: &[u8], folder: Option<&Path>, limits: &Limits) -> Result<Scene> {
    let mut scene = read(bytes, folder, limits).map_err(|fault| fault.into_error(name))?;
    scene.source.file =
        Path::new(name).file_name().map_or_else(|| name.to_owned(), |f| f.to_string_lossy().into_owned());
    Ok(scene)
}

fn read(bytes: &[u8], folder: Option<&Path>, limits: &Limits) -> fault::Result<Scene> {
    let container = container::split(bytes, limits)?;
    let root = Json::root(&container.json)?;
    let mut warnings = Warnings::default();
    let source = read_source(&root, &mut warnings)?;
    let buffers = buffers::Buffers::load(&root, container.bin, folder, limits)?;
    let views = buffers.views(&root, limits)?;
    let accessors = accessor::read_all(&root, &views, limits)?;

    let vrm1 = root.extension("VRMC_vrm")?;
    let mut vrm0 = root.extension("VRM")?;
    if vrm1.is_some() && vrm0.is_some() {
        warnings.add("/extensions", "file holds VRM 0.x and 1.0: 1.0 is used");
        vrm0 = None;
    }
    let mesh_json = root.objects("meshes")?;
    let counts = graph::Counts {
        meshes: mesh_json.len(),
        skins: root.objects("skins")?.len(),
        cameras: root.objects("cameras")?.len(),
    };
    // VRM 0.x characters face -Z; a turned root keeps bones, colliders and animation consistent.
    let graph = graph::Graph::read(&root, counts, vrm0.is_some(), limits, &mut warnings)?;
    let skins = skin::read_all(&root, &accessors, &graph, limits, &mut warnings)?;
    let mut textures = texture::Textures::read(&root, views.len())?;
    let materials = material::read_all(&root, vrm0.as_ref(), &mut textures, &mut warnings)?;

    let mut budget = geometry::Budget::default();
    let mut scene = Scene { source, skins, ..Scene::default() };
    let mut needs_default = false;
    let users = nodes_of_meshes(&graph.nodes, mesh_json.len());
    for (json, users) in mesh_json.iter().zip(&users) {
        let skins = users.iter().filter_map(|n| scene.skins.get(graph.nodes.get(*n)?.skin?));
        let joints = skins.map(|s| s.joints.len()).min();
        let cx = geometry::Context {
            accessors: &accessors,
            materials: &materials.list,
            uv_sets: &materials.uv_sets,
            limits,
            joints,
        };
        scene.meshes.push(read_mesh(json, &cx, &mut budget, &mut needs_default, &mut warnings)?);
    }
    scene.materials = materials.list;
    if needs_default {
        scene.materials.push(Material { name: "default".into(), origin: Origin::Pbr, ..default_material() });
    }
    let cx = animation::Context { accessors: &accessors, graph: &graph, meshes: &scene.meshes, limits };
    scene.animation_rig = vrma::read(&root, &graph, &mut warnings);
    scene.animations = animation::read_all(&root, &cx, &mut budget, &mut warnings)?;
    scene.nodes = graph.nodes.clone();
    fill_morph_weights(&mut scene, &mesh_json, &mut budget, limits, &mut warnings)?;
    scene.character = read_character(&root, vrm1, vrm0, &graph, &mut scene, limits, &mut warnings)?;
    scene.images = textures.decode(&views, folder, limits, &mut warnings)?;
    scene.textures = textures.textures;
    role::assign(&mut scene);
    head_parts::divide(&mut scene);
    checks::check(&scene, &mut warnings);
    scene.warnings = warnings.finish();
    Ok(scene)
}

/// Nodes that carry each mesh.
fn nodes_of_meshes(nodes: &[Node], meshes: usize) -> Vec<Vec<usize>> {
    let mut users = vec![Vec::new(); meshes];
    for (index, node) in nodes.iter().enumerate() {
        if let Some(list) = node.mesh.and_then(|m| users.get_mut(m)) {
            list.push(index);
        }
    }
    users
}

/// Checks versions and extensions.
fn read_source(root: &Json, warnings: &mut Warnings) -> fault::Result<Source> {
    let asset = root.object("asset")?.ok_or_else(|| Fault::new("/asset", "asset is missing"))?;
    let version = asset.need("version")?.as_str()?;
    let major = |v: &str| v.split_once('.').map(|(major, _)| major == "2");
    if major(version) != Some(true) {
        return Err(asset.fault(format!("found version {}, expected 2.0", quoted(version))));
    }
    if let Some(least) = asset.str("minVersion")?
        && least != "2.0"
    {
        return Err(asset.fault(format!("found minVersion {}, expected at most 2.0", quoted(least))));
    }
    let names = |key: &str| -> fault::Result<Vec<String>> {
        root.array(key)?.iter().map(|n| Ok(n.as_str()?.to_owned())).collect()
    };
    let (used, required) = (names("extensionsUsed")?, names("extensionsRequired")?);
    if let Some(unknown) = required.iter().find(|n| !SUPPORTED.contains(&n.as_str())) {
        return Err(Fault::new(
            "/extensionsRequired",
            format!("the file requires the extension {}, which is not supported", quoted(unknown)),
        ));
    }
    let ignored: Vec<String> = used.iter().filter(|n| !SUPPORTED.contains(&n.as_str())).map(|n| quoted(n)).collect();
    if !ignored.is_empty() {
        warnings.add("/extensionsUsed", format!("extensions that are not read: {}", ignored.join(", ")));
    }
    Ok(Source {
        file: String::new(),
        generator: asset.text("generator").chars().take(1000).collect(),
        gltf_version: version.to_owned(),
        extensions_used: used,
        extensions_required: required,
    })
}

fn read_mesh(
    json: &Json,
    cx: &geometry::Context,
    budget: &mut geometry::Budget,
    needs_default: &mut bool,
    warnings: &mut Warnings,
) -> fault::Result<Mesh> {
    let sources = primitive::read(json, cx.accessors, cx.materials.len(), cx.limits, warnings)?;
    let mut mesh = Mesh { name: json.name()?, ..Mesh::default() };
    for source in &sources {
        if let Some(mut primitive) = geometry::build(source, cx, budget, warnings)? {
            if source.material.is_none() {
                primitive.material = cx.materials.len();
                *needs_default = true;
            }
            mesh.primitives.push(primitive);
        }
    }
    normals::fill_outline(&mut mesh.primitives);
    let targets = sources.first().map_or(0, |s| s.targets.len());
    let mut names = json.at("extras").list("targetNames");
    if names.is_empty() {
        let first = json.list("primitives").into_iter().next();
        names = first.map(|p| p.at("extras").list("targetNames")).unwrap_or_default();
    }
    let name = |i: usize| {
        names.get(i).and_then(|n| n.as_str().ok()).map_or_else(|| i.to_string(), |n| n.chars().take(1000).collect())
    };
    mesh.morph_names = (0..targets).map(name).collect();
    Ok(mesh)
}

/// The material of primitives that name none.
fn default_material() -> Material {
    let mut material = Material::default();
    if let crate::material::Shading::Toon(toon) = &mut material.shading {
        toon.shade_color = [0.5; 3];
    }
    material
}

/// Weights at rest: the node's, else the mesh's, else 0.
fn fill_morph_weights(
    scene: &mut Scene,
    meshes: &[Json],
    budget: &mut geometry::Budget,
    limits: &Limits,
    warnings: &mut Warnings,
) -> fault::Result<()> {
    let mut defaults = Vec::with_capacity(meshes.len());
    for mesh in meshes {
        let weights = mesh.array("weights")?.iter().map(Json::as_f32).collect::<fault::Result<Vec<f32>>>()?;
        defaults.push(weights);
    }
    for node in &mut scene.nodes {
        let Some(mesh) = node.mesh else {
            node.morph_weights.clear();
            continue;
        };
        let targets = scene.meshes.get(mesh).map_or(0, |m| m.morph_names.len());
        budget.bytes("/nodes", (targets as u64).saturating_mul(4), limits)?;
        if node.morph_weights.is_empty() {
            node.morph_weights = defaults.get(mesh).cloned().unwrap_or_default();
        }
        if !node.morph_weights.is_empty() && node.morph_weights.len() != targets {
            warnings.add(
                format!("/meshes/{mesh}"),
                format!("a node has another number of morph weights than the mesh has targets ({targets})"),
            );
        }
        node.morph_weights.resize(targets, 0.0);
    }
    Ok(())
}

fn read_character(
    root: &Json,
    vrm1: Option<Json>,
    vrm0: Option<Json>,
    graph: &graph::Graph,
    scene: &mut Scene,
    limits: &Limits,
    warnings: &mut Warnings,
) -> fault::Result<Option<Character>> {
    let targets: Vec<usize> = scene.meshes.iter().map(|m| m.morph_names.len()).collect();
    let materials: Vec<String> = root.objects("materials")?.iter().map(Json::name).collect::<fault::Result<_>>()?;
    let users = nodes_of_meshes(&graph.nodes, targets.len());
    let cx = vrm1::Context { graph, targets: &targets, users: &users, materials: &materials, made: &scene.materials };
    if let Some(ext) = vrm1 {
        let mut character = vrm1::read(&ext, &cx, warnings);
        if let Some(springs) = root.extension("VRMC_springBone")? {
            spring::read(&springs, graph, &mut character, limits, warnings);
        }
        character.constraints = spring::read_constraints(&root.objects("nodes")?, graph, warnings);
        return Ok(Some(character));
    }
    if let Some(ext) = vrm0 {
        let mut character = vrm0::read(&ext, &cx, limits, warnings);
        vrm0::read_springs(&ext, &cx, &mut scene.nodes, &mut character, limits, warnings);
        return Ok(Some(character));
    }
    Ok(None)
}
