//! What no shared model covers, as small files made here; each test checks the loaded values.

mod compression;
mod materials;
mod meshes;
mod motion;
mod vrm0;
mod vrm1;

use hikage::Error;
use hikage::material::{Shading, Toon};
use hikage::scene::{Primitive, Scene};
use serde_json::json;

use crate::gltf::Glb;

fn first(scene: &Scene) -> &Primitive {
    &scene.meshes[0].primitives[0]
}

fn close(a: &[f32], b: &[f32], tolerance: f32) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
}

fn toon(scene: &Scene, material: usize) -> Toon {
    match scene.materials[material].shading {
        Shading::Toon(toon) => toon,
        Shading::Standard(_) | Shading::Unlit => panic!("not toon"),
    }
}

#[test]
fn errors_name_the_place_and_both_values() {
    let mut glb = Glb::triangle();
    glb.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    let error = glb.load().expect_err("draco").to_string();
    assert!(error.contains("test.glb: /extensionsRequired") && error.contains("KHR_draco_mesh_compression"), "{error}");

    let mut glb = Glb::triangle();
    glb.json["accessors"][0]["count"] = json!(4_000_000_000u64);
    assert!(matches!(glb.load(), Err(Error::Limit { unit, .. }) if unit.contains("count")));

    let mut glb = Glb::triangle();
    glb.primitive()["attributes"]["NORMAL"] = json!(77);
    let Err(Error::Input { pointer, message, .. }) = glb.load() else { panic!("expected an input error") };
    assert_eq!(pointer, "/meshes/0/primitives/0/attributes/NORMAL");
    assert!(message.contains("77") && message.contains('3'), "{message}");

    let mut glb = Glb::triangle();
    glb.json["nodes"][0]["name"] = json!(format!("\u{1b}[31m{}", "x".repeat(1_000_000)));
    glb.json["materials"] = json!([{"alphaMode": "\u{1b}[31m".to_owned() + &"y".repeat(100_000)}]);
    let error = glb.load().expect_err("alpha mode").to_string();
    assert!(error.len() < 600 && !error.contains('\u{1b}'), "{error}");
}
