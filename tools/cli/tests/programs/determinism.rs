//! The same command writes the same bytes, however often it runs.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use serde_json::json;

use crate::gltf::{F32, Glb, U16, floats};

/// A toon ball with outline, rim and texture behind a blended triangle: everything whose order could vary.
fn model() -> Vec<u8> {
    const RINGS: u16 = 16;
    const SEGMENTS: u16 = 24;
    let (mut positions, mut uvs, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for ring in 0..=RINGS {
        for segment in 0..=SEGMENTS {
            let (u, v) = (f32::from(segment) / f32::from(SEGMENTS), f32::from(ring) / f32::from(RINGS));
            let ((sin, cos), (sin_polar, cos_polar)) =
                ((u * std::f32::consts::TAU).sin_cos(), (v * std::f32::consts::PI).sin_cos());
            positions.extend([sin * sin_polar, cos_polar, cos * sin_polar]);
            uvs.extend([u, v]);
            if ring < RINGS && segment < SEGMENTS {
                let a = ring * (SEGMENTS + 1) + segment;
                let below = a + SEGMENTS + 1;
                indices.extend([a, below, a + 1, a + 1, below, below + 1].map(u16::to_le_bytes).concat());
            }
        }
    }
    let mut glb = Glb::new();
    let vertices = uvs.len() / 2;
    glb.attribute("POSITION", F32, "VEC3", &floats(&positions), vertices, false);
    // Positions are their own normals on a ball of radius 1.
    glb.attribute("NORMAL", F32, "VEC3", &floats(&positions), vertices, false);
    glb.attribute("TEXCOORD_0", F32, "VEC2", &floats(&uvs), vertices, false);
    let count = indices.len() / 2;
    let ball = glb.accessor(U16, "SCALAR", &indices, count, false);
    glb.primitive()["indices"] = json!(ball);
    glb.primitive()["material"] = json!(0);
    let triangle = glb.accessor(F32, "VEC3", &floats(&[-1., -1., 1.5, 1., -1., 1.5, 0., 1., 1.5]), 3, false);
    let primitives = glb.json["meshes"][0]["primitives"].as_array_mut().expect("primitives");
    primitives.push(json!({"attributes": {"POSITION": triangle}, "material": 1}));

    let picture = hikage::scene::Image {
        width: 2,
        height: 1,
        pixels: vec![255, 90, 60, 255, 250, 240, 90, 255],
        ..Default::default()
    };
    let texture = glb.texture(&hikage::picture::encode_png(&picture).expect("PNG"), "image/png");
    glb.push(
        "materials",
        json!({
            "pbrMetallicRoughness": {"baseColorTexture": {"index": texture}},
            "extensions": {"VRMC_materials_mtoon": {
                "specVersion": "1.0", "shadeColorFactor": [0.3, 0.1, 0.4], "shadingToonyFactor": 0.6,
                "parametricRimColorFactor": [0.2, 0.4, 0.8],
                "outlineWidthMode": "worldCoordinates", "outlineWidthFactor": 0.03
            }}
        }),
    );
    glb.push(
        "materials",
        json!({
            "alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.5, 0.9, 0.4]}
        }),
    );
    glb.json["extensionsUsed"] = json!(["VRMC_materials_mtoon"]);
    glb.bytes()
}

#[test]
fn twenty_runs_write_the_same_bytes() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("determinism");
    fs::create_dir_all(&folder).expect("temporary folder");
    fs::write(folder.join("ball.glb"), model()).expect("model");
    let mut first = Vec::new();
    for run in 0..20 {
        let output = Command::new(env!("CARGO_BIN_EXE_hikage"))
            .args(["render", "ball.glb", "-o", "out.png", "--size", "128x128", "--view", "full"])
            .current_dir(&folder)
            .output()
            .expect("the program starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let bytes = fs::read(folder.join("out.png")).expect("picture");
        if run == 0 {
            let picture = hikage::picture::read_png(folder.join("out.png")).expect("PNG");
            let colors: std::collections::BTreeSet<&[u8]> = picture.pixels.chunks_exact(4).collect();
            assert!(colors.len() > 100, "the ball is not there: {} colours", colors.len());
            first = bytes;
        } else {
            assert!(bytes == first, "run {run} wrote other bytes than the first");
        }
    }
}
