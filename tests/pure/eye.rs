//! Frames of eyes of the built-in character and of real models. Those lie in `../shared/real/models`, or in the folder that
//! `HIKAGE_REAL` names.

use std::path::{Path, PathBuf};

use glam::{Mat4, Vec3};
use hikage::eye::{EyeBone, EyeDimensions, EyeFrame};
use hikage::import::Limits;
use hikage::scene::{HumanBone, Primitive, Scene};

/// Primitives whose mesh has this in its name, with their node's matrix at rest, as a morph target leaves them.
fn parts(scene: &Scene, name: &str, morph: Option<&str>) -> Vec<(Primitive, Mat4)> {
    let rest = scene.rest_world_from_nodes();
    let mut found = Vec::new();
    for (node, mesh) in scene.mesh_nodes().filter(|(i, m)| m.name.contains(name) || scene.nodes[*i].name.contains(name))
    {
        let target = morph.and_then(|morph| mesh.morph_names.iter().position(|n| n == morph));
        for primitive in &mesh.primitives {
            let mut moved = primitive.clone();
            if let Some(target) = target.map(|t| &primitive.morphs[t]) {
                for (vertex, offset) in target.vertices.iter().zip(&target.positions) {
                    let p = &mut moved.positions[*vertex as usize];
                    *p = (Vec3::from(*p) + Vec3::from(*offset)).to_array();
                }
            }
            found.push((moved, rest[node]));
        }
    }
    assert!(!found.is_empty(), "no mesh {name}");
    found
}

fn frames(parts: &[(Primitive, Mat4)], bones: &[EyeBone]) -> Vec<EyeFrame> {
    let parts: Vec<(&Primitive, Mat4)> = parts.iter().map(|(p, rest)| (p, *rest)).collect();
    EyeFrame::of(&parts, bones).unwrap_or_else(|e| panic!("{e}"))
}

#[track_caller]
fn assert_near(found: Vec3, expected: Vec3, off: f32) {
    assert!(found.distance(expected) <= off, "{found}, expected {expected}");
}

/// The spherical set, with the bones of the file and without, as it rests and as its morph brings it forth.
#[test]
fn eyes_of_the_built_in_character_have_frames() {
    let scene =
        hikage::import::load_bytes("hikage.vrm", &hikage_character::file(), None, &Limits::default()).expect("loads");
    let rest = scene.rest_world_from_nodes();
    let bones = [HumanBone::LeftEye, HumanBone::RightEye].map(|bone| {
        let position = rest[scene.bone_node(bone).expect("an eye bone")].w_axis.truncate();
        EyeBone { position, forward: Vec3::Z, up: Vec3::Y }
    });
    for (morph, radius, z) in [(Some("eyeballs"), 0.0255, 0.0418), (None, 0.05 * 0.0255, 0.0118)] {
        let parts = parts(&scene, "Eyeball", morph);
        for bones in [&bones[..], &[]] {
            let found = frames(&parts, bones);
            assert_eq!(found.len(), 2);
            for (eye, x) in found.iter().zip([0.0365, -0.0365]) {
                println!("{eye:?}");
                assert_near(eye.centre, Vec3::new(x, 1.4115, z), 0.005 * radius);
                assert_near(eye.axis, Vec3::Z, 0.005);
                assert_near(eye.up, Vec3::Y, 0.005);
                assert!((eye.radius / radius - 1.0).abs() < 0.005, "{eye:?}");
            }
        }
    }
}

fn real(name: &str) -> Option<Scene> {
    let default = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/real");
    let path = std::env::var_os("HIKAGE_REAL").map_or(default, PathBuf::from).join("models").join(name);
    if !path.is_file() {
        eprintln!("NOT TESTED: no {}; set HIKAGE_REAL to the folder above its own", path.display());
        return None;
    }
    Some(hikage::import::load(&path).expect("loads"))
}

/// Cornea, iris and sclera apart, with the defaults' measures.
#[test]
fn an_eye_of_the_defaults_measures_has_its_frame() {
    let Some(scene) = real("eye_gen.glb") else { return };
    let parts = parts(&scene, "", None);
    let found = frames(&parts, &[]);
    println!("{found:?}");
    assert_eq!(found.len(), 1);
    assert_near(found[0].centre, Vec3::ZERO, 2e-6);
    assert_near(found[0].axis, Vec3::Z, 1e-4);
    assert!((found[0].radius - 0.012).abs() < 1e-6, "{found:?}");
    // Its iris lies where the measures say.
    let human = EyeDimensions::default();
    let to_eye = found[0].eye_from_mesh(&human);
    let iris = &parts.iter().find(|(p, _)| p.positions.iter().all(|p| p[2] == p[2].min(0.0099495))).expect("an iris").0;
    let worst = iris.positions.iter().map(|p| (to_eye.transform_point3(Vec3::from(*p)).z - human.iris_z_mm()).abs());
    assert!(worst.fold(0.0, f32::max) < 2e-3);
}

/// Two eyes in one mesh, each of an outer shell with a bulge and an inner ball with a dented iris, neither quite round, open
/// behind. The irises lie 0.6 mm below the middle of the balls, so that the axes are 2.4 degrees down.
#[test]
fn eyes_of_a_real_head_have_frames() {
    let Some(scene) = real("head_mh.glb") else { return };
    let found = frames(&parts(&scene, "eyes", None), &[]);
    println!("{found:?}");
    assert_eq!(found.len(), 2);
    for (eye, x) in found.iter().zip([0.0288, -0.0288]) {
        assert_near(eye.centre, Vec3::new(x, 1.4985, 0.1119), 4e-4);
        assert!((0.0152..0.0158).contains(&eye.radius), "{eye:?}");
        assert_near(eye.axis, Vec3::Z, 0.06);
    }
    let flip = Vec3::new(-1.0, 1.0, 1.0);
    assert_near(found[0].axis * flip, found[1].axis, 0.01);
}
