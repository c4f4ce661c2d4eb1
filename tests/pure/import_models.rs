//! Every shared model loads. The folder is `../shared/models`, or the one that `HIKAGE_MODELS` names.

use std::path::{Path, PathBuf};

use hikage::material::Origin;
use hikage::scene::{Role, Scene};

fn folder() -> Option<PathBuf> {
    let default = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models");
    let folder = std::env::var_os("HIKAGE_MODELS").map_or(default, PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("NOT TESTED: no models in {}; set HIKAGE_MODELS to their folder", folder.display());
    None
}

fn models(folder: &Path, out: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> =
        std::fs::read_dir(folder).expect("a folder").map(|e| e.expect("an entry").path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            models(&path, out);
        } else if path.extension().is_some_and(|e| e == "vrm" || e == "glb") {
            out.push(path);
        }
    }
}

/// What the renderer relies on.
fn check(scene: &Scene) {
    assert!(scene.nodes.iter().enumerate().all(|(i, n)| n.parent.is_none_or(|p| p < i)), "parents come first");
    assert!(scene.textures.iter().all(|t| t.image < scene.images.len()));
    assert!(scene.images.iter().all(|i| i.pixels.len() == i.width as usize * i.height as usize * 4));
    for mesh in &scene.meshes {
        for p in &mesh.primitives {
            let n = p.positions.len();
            assert!(p.material < scene.materials.len());
            assert!(p.indices.iter().all(|i| (*i as usize) < n) && p.indices.len().is_multiple_of(3));
            assert_eq!((p.normals.len(), p.outline_normals.len(), p.morphs.len()), (n, n, mesh.morph_names.len()));
            assert!(p.tangents.is_empty() || p.tangents.len() == n);
            assert!(p.uvs.len() <= 2 && p.uvs.iter().all(|set| set.len() == n));
            assert_eq!(p.influences.joints.len(), n * p.influences.per_vertex);
            for normal in p.normals.iter().chain(&p.outline_normals) {
                assert!((glam::Vec3::from_array(*normal).length() - 1.0).abs() < 1e-3);
            }
            for weights in p.influences.weights.chunks(p.influences.per_vertex.max(1)) {
                assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-4);
            }
            if scene.materials[p.material].normal_map.is_some() {
                assert_eq!(p.tangents.len(), n);
            }
        }
    }
}

#[test]
fn every_shared_model_loads() {
    let Some(folder) = folder() else { return };
    let mut list = Vec::new();
    models(&folder, &mut list);
    assert!(!list.is_empty(), "no models in {}", folder.display());
    for path in list {
        let scene = hikage::import::load(&path).unwrap_or_else(|e| panic!("{e}"));
        check(&scene);
        assert!(scene.triangle_count() > 0, "{}", path.display());
    }
}

/// Files of movements, of several exporters.
#[test]
fn every_shared_movement_loads() {
    let Some(folder) = folder() else { return };
    let folders = [folder.clone(), folder.join("../motion/models")];
    let entries = folders.iter().filter_map(|f| std::fs::read_dir(f).ok()).flatten();
    let paths = entries.map(|e| e.expect("an entry").path());
    let list: Vec<PathBuf> = paths.filter(|p| p.extension().is_some_and(|e| e == "vrma")).collect();
    assert!(list.len() >= 2, "{list:?}");
    for path in list {
        let scene = hikage::import::load(&path).unwrap_or_else(|e| panic!("{e}"));
        let name = path.display();
        let rig = scene.animation_rig.as_ref().unwrap_or_else(|| panic!("{name}: no rig"));
        assert!(rig.bones.len() >= 17 && !scene.animations[0].channels.is_empty(), "{name}");
        assert!(scene.warnings.is_empty(), "{name}: {:?}", scene.warnings);
    }
}

type Triangle = [[f32; 3]; 3];

/// The gltf crate reads the same triangles at the same places: an independent reader of good files. Heads that are divided
/// into face and hair have them in another order.
#[test]
fn geometry_agrees_with_the_gltf_crate() {
    let Some(folder) = folder() else { return };
    let mut list = Vec::new();
    models(&folder, &mut list);
    for path in list {
        let name = path.display();
        let ours = hikage::import::load(&path).unwrap_or_else(|e| panic!("{e}"));
        let bytes = std::fs::read(&path).expect("a file");
        let theirs = gltf::Gltf::from_slice_without_validation(&bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
        let blob = theirs.blob.as_deref().expect("a binary chunk");
        assert_eq!(ours.meshes.len(), theirs.meshes().count(), "{name}");
        for (mesh, their_mesh) in ours.meshes.iter().zip(theirs.meshes()) {
            let ours = mesh.primitives.iter().map(|part| -> Vec<Triangle> {
                let triangles = part.indices.as_chunks::<3>().0;
                triangles.iter().map(|t| t.map(|i| part.positions[i as usize])).collect()
            });
            let theirs = their_mesh.primitives().map(|their_part| -> Vec<Triangle> {
                let reader = their_part.reader(|_| Some(blob));
                let positions: Vec<[f32; 3]> = reader.read_positions().expect("positions").collect();
                let corners: Vec<u32> = match reader.read_indices() {
                    Some(indices) => indices.into_u32().collect(),
                    None => (0..positions.len() as u32).collect(),
                };
                let proper = |t: &&[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[0] != t[2];
                let triangles = corners.as_chunks::<3>().0.iter().filter(proper);
                triangles.map(|t| t.map(|i| positions[i as usize])).collect()
            });
            let (mut ours, mut theirs): (Vec<_>, Vec<_>) = (ours.collect(), theirs.collect());
            if ours.len() != theirs.len() {
                for parts in [&mut ours, &mut theirs] {
                    let mut all = parts.concat();
                    all.sort_by_key(|t| t.map(|p| p.map(f32::to_bits)));
                    *parts = vec![all];
                }
            }
            assert!(ours == theirs, "{name}: {}", mesh.name);
        }
    }
}

/// Role of the part with this mesh and material.
fn role(scene: &Scene, mesh: &str, material: &str) -> Role {
    let mesh = scene.meshes.iter().find(|m| m.name == mesh).expect("the mesh");
    let found = mesh.primitives.iter().find(|p| scene.materials[p.material].name == material);
    found.expect("the material").role
}

#[test]
fn seed_san_has_the_roles_that_a_person_sees() {
    let Some(path) = folder().map(|f| f.join("Seed-san_rebuilt.vrm")).filter(|p| p.is_file()) else { return };
    let scene = hikage::import::load(path).expect("loads");
    for (mesh, material, expected) in [
        ("hair", "newhair", Role::HairFront),
        ("hair_tail", "newhair", Role::Hair),
        ("head", "body_bake", Role::Face),
        ("head", "eye", Role::Eye),
        ("wear", "body_bake", Role::Skin),
        ("wear", "huku_bake", Role::Cloth),
        ("wear", "robo_face", Role::Accessory),
    ] {
        assert_eq!(role(&scene, mesh, material), expected, "{mesh} {material}");
    }
    let character = scene.character.as_ref().expect("a character");
    assert_eq!((character.bones.len(), character.expressions.len(), character.springs.len()), (51, 18, 9));
}

#[test]
fn godette_is_turned_and_emission_is_decoded_from_gamma() {
    let Some(folder) = folder() else { return };
    let path = folder.join("Godette_vrm_v4.vrm");
    if path.is_file() {
        let scene = hikage::import::load(path).expect("loads");
        assert_eq!(role(&scene, "FaceMesh", "Face"), Role::Face);
        let world = scene.rest_world_from_nodes();
        let toes =
            scene.bone_node(hikage::scene::HumanBone::LeftToes).or(scene.bone_node(hikage::scene::HumanBone::LeftFoot));
        let left = world[toes.expect("a foot")].w_axis.x;
        assert!(left > 0.0, "the left foot of a character that faces +Z is at +X, found {left}");
        let names: Vec<&str> = scene.images.iter().map(|image| image.name.as_str()).collect();
        assert_eq!(names.len(), 4, "{names:?}");
        assert!(!names.contains(&"godette_thumbnail"), "the thumbnail is not decoded: {names:?}");
    }
    let path = folder.join("EmissionMigration_v0.107.0.vrm");
    if path.is_file() {
        let scene = hikage::import::load(path).expect("loads");
        let emission =
            |name: &str| scene.materials.iter().find(|m| m.name == name).map(|m| (m.origin, m.emission.color));
        assert_eq!(emission("MToon_Emission_2.0"), Some((Origin::Mtoon0, [2f32.powf(2.2); 3])));
        assert!(emission("Standard_Emission_2.0").is_some_and(|(_, [r, ..])| (r - 4.594_794).abs() < 1e-5));
    }
}
