//! Scenes of hair: strands, and the cards of the same hairstyle.

use std::path::Path;

use glam::Vec3;
use hikage::material::{
    Alpha, AlphaMode, Base, Blending, CastShadow, FibreModel, Hair, Material, Shading, StrandDirection,
};
use hikage::scene::{Mesh, Node, Primitive, Scene, SelfShadow};
use serde::Deserialize;

use super::strands::Strands;
use super::{Reference, Shot};

/// The material of a reference.
#[derive(Deserialize)]
struct Fibres {
    beta_m: f32,
    beta_n: f32,
    #[serde(rename = "alphaDeg")]
    alpha_deg: f32,
    ior: f32,
    melanin: Melanin,
}

#[derive(Deserialize)]
struct Melanin {
    eumelanin: f32,
    pheomelanin: f32,
}

/// Whether a reference is one of these.
pub(super) fn is_scene(name: &str) -> bool {
    name.starts_with("hair_") && !name.starts_with("hair_sintel")
}

/// What is drawn of a reference: its cards, where a hairstyle has some, else its strands.
pub(super) fn shot(dir: &Path, of: &Reference) -> Result<Shot, String> {
    let fibres: Fibres = serde_json::from_value(of.material.clone()).map_err(|e| format!("material: {e}"))?;
    let is_single = of.bounces.max == 0;
    let models = dir.join("models");
    let name = of.model.trim_start_matches("strands_").trim_end_matches(".npz");
    let cards = cards(&models, name);
    let model = FibreModel {
        eumelanin: fibres.melanin.eumelanin,
        pheomelanin: fibres.melanin.pheomelanin,
        longitudinal: fibres.beta_m,
        azimuthal: fibres.beta_n,
        tilt_rad: fibres.alpha_deg.to_radians(),
        ior: fibres.ior,
        scatter: if is_single { 0.0 } else { 1.0 },
        variation: 0.0,
        ..FibreModel::default()
    };
    let mut scenes = Vec::new();
    scenes.extend(of.core.as_deref().map(|core| core_scene(&models, core)).transpose()?);
    let scale = if let Some(cards) = cards {
        let mut scene = hikage::import::load(cards).map_err(|e| e.to_string())?;
        for material in &mut scene.materials {
            // The strands of these references run along the texture of the cards.
            let direction = StrandDirection::UvV;
            material.hair = Some(Hair { fibre: model, direction, ..Hair::default() });
            material.normal_map = None;
            material.alpha = Alpha { mode: AlphaMode::Blend, blending: Blending::ThreePass, ..material.alpha };
            material.cast_shadow = Some(CastShadow::default());
        }
        scene.self_shadow = Some(SHADOW);
        scenes.push(scene);
        4
    } else {
        let strands = Strands::read(&models.join(&of.model))?;
        let mut ribbons = strands.ribbons(of.camera.eye.into());
        ribbons.outline_normals.clone_from(&ribbons.normals);
        // Strands of a single layer cast no shadow on each other.
        let fibre = FibreModel { density: 0.0, packing: 0.0, ..model };
        let material = Material {
            hair: Some(Hair { fibre, direction: StrandDirection::Auto, ..Hair::default() }),
            double_sided: true,
            cast_shadow: Some(CastShadow { casts: false, ..CastShadow::default() }),
            ..Material::default()
        };
        let mut scene = scene_of(ribbons, material);
        scene.self_shadow = of.core.is_some().then_some(SHADOW);
        scenes.push(scene);
        12
    };
    Ok(Shot::of(of, scenes, scale))
}

const SHADOW: SelfShadow = SelfShadow { side: 4096, soft_width_m: 0.002, bias_texels: 2.0 };

/// The cards of a hairstyle.
fn cards(models: &Path, name: &str) -> Option<std::path::PathBuf> {
    let listed = std::fs::read_dir(models).ok()?;
    let fits = |file: &std::path::PathBuf| {
        let stem = file.file_stem().and_then(|s| s.to_str()).unwrap_or_default();
        stem.starts_with("hair_") && stem.ends_with(&format!("_{name}"))
    };
    listed.filter_map(|entry| Some(entry.ok()?.path())).filter(fits).min()
}

/// What stands inside of the hair, black: a model, or a sphere of so many millimetres.
fn core_scene(models: &Path, core: &str) -> Result<Scene, String> {
    let black = Material {
        shading: Shading::Unlit,
        base: Base { color: [0.0, 0.0, 0.0, 1.0], texture: None },
        double_sided: true,
        cast_shadow: Some(CastShadow { casts: true, received: 0.0 }),
        ..Material::default()
    };
    let mut scene = if let Some(file) = core.split(',').next().filter(|f| f.ends_with(".glb")) {
        let mut scene = hikage::import::load(models.join(file)).map_err(|e| e.to_string())?;
        for material in &mut scene.materials {
            *material = Material { name: material.name.clone(), ..black.clone() };
        }
        scene
    } else {
        let words: Vec<&str> = core.split_whitespace().collect();
        let radius = words.iter().position(|w| *w == "mm").and_then(|at| words.get(at.checked_sub(1)?)?.parse().ok());
        let radius: f32 = radius.ok_or_else(|| format!("core {core:?}: expected a .glb or a sphere of so many mm"))?;
        scene_of(sphere(radius * 1e-3), black)
    };
    scene.self_shadow = Some(SHADOW);
    Ok(scene)
}

fn scene_of(primitive: Primitive, material: Material) -> Scene {
    Scene {
        nodes: vec![Node { mesh: Some(0), ..Node::default() }],
        meshes: vec![Mesh { primitives: vec![primitive], ..Mesh::default() }],
        materials: vec![material],
        ..Scene::default()
    }
}

/// A sphere of 64 by 32 quads round the origin.
fn sphere(radius: f32) -> Primitive {
    const AROUND: u32 = 64;
    const ALONG: u32 = 32;
    let mut made = Primitive::default();
    for y in 0..=ALONG {
        for x in 0..=AROUND {
            let (phi, theta) =
                (x as f32 / AROUND as f32 * std::f32::consts::TAU, y as f32 / ALONG as f32 * std::f32::consts::PI);
            let n = Vec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
            made.positions.push((n * radius).to_array());
            made.normals.push(n.to_array());
        }
    }
    for y in 0..ALONG {
        for x in 0..AROUND {
            let a = y * (AROUND + 1) + x;
            let b = a + AROUND + 1;
            made.indices.extend([a, a + 1, b, a + 1, b + 1, b]);
        }
    }
    made.outline_normals.clone_from(&made.normals);
    made
}
