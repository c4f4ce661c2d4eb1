//! Packed and quantised data.

use glam::Quat;
use hikage::scene::AnimationValues;
use serde_json::json;

use super::{close, first};
use crate::gltf::{F32, Glb, I8, I16, U8, U16, floats, picture, shorts};

/// Replaces the view of an accessor by meshopt data whose uncompressed buffer has no bytes.
fn compress(glb: &mut Glb, accessor: usize, packed: &[u8], mode: &str, filter: &str, count: usize, stride: usize) {
    let source = glb.view(packed);
    let source = glb.json["bufferViews"][source].clone();
    if glb.json["buffers"].as_array().expect("buffers").len() < 2 {
        let fallback = json!({"byteLength": 1000, "extensions": {"EXT_meshopt_compression": {"fallback": true}}});
        glb.push("buffers", fallback);
        glb.json["extensionsUsed"] = json!(["EXT_meshopt_compression", "KHR_mesh_quantization"]);
        glb.json["extensionsRequired"] = json!(["EXT_meshopt_compression", "KHR_mesh_quantization"]);
    }
    let view = glb.json["accessors"][accessor]["bufferView"].as_u64().expect("a view") as usize;
    glb.json["bufferViews"][view] = json!({
        "buffer": 1, "byteLength": count * stride, "byteStride": stride,
        "extensions": {"EXT_meshopt_compression": {
            "buffer": 0, "byteOffset": source["byteOffset"], "byteLength": source["byteLength"],
            "byteStride": stride, "count": count, "mode": mode, "filter": filter
        }}
    });
    if mode != "ATTRIBUTES" {
        glb.json["bufferViews"][view].as_object_mut().expect("a view").remove("byteStride");
    }
}

#[test]
fn meshopt_vertices_filters_and_indices_decode() {
    let mut glb = Glb::new();
    let positions: [[f32; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1.5, 0.25]];
    glb.attribute("POSITION", F32, "VEC3", &[0; 48], 4, false);
    let packed = meshopt::encode_filter_exp(&positions, 20, meshopt::EncodeExpMode::Separate);
    let packed = meshopt::encode_vertex_buffer(&packed).expect("encodes");
    compress(&mut glb, 0, &packed, "ATTRIBUTES", "EXPONENTIAL", 4, 12);

    let normals = [[0.0f32, 0.0, 1.0, 0.0], [0.6, 0.0, 0.8, 0.0], [-0.6, 0.8, 0.0, 0.0], [0.0, 0.0, -1.0, 0.0]];
    glb.attribute("NORMAL", I8, "VEC3", &[0; 16], 4, true);
    let oct: Vec<[i8; 4]> = meshopt::encode_filter_oct(&normals, 8);
    compress(&mut glb, 1, &meshopt::encode_vertex_buffer(&oct).expect("encodes"), "ATTRIBUTES", "OCTAHEDRAL", 4, 4);

    let indices = glb.accessor(U16, "SCALAR", &[0; 12], 6, false);
    glb.primitive()["indices"] = json!(indices);
    let triangles = meshopt::encode_index_buffer(&[0, 1, 2, 0, 2, 3], 4).expect("encodes");
    compress(&mut glb, indices, &triangles, "TRIANGLES", "NONE", 6, 2);
    let scene = glb.load().expect("loads");
    let primitive = first(&scene);
    assert_eq!(primitive.indices, [0, 1, 2, 0, 2, 3]);
    for (got, want) in primitive.positions.iter().zip(&positions) {
        assert!(close(got, want, 1e-5), "{got:?} {want:?}");
    }
    for (got, want) in primitive.normals.iter().zip(&normals) {
        assert!(close(got, &want[..3], 0.02), "{got:?} {want:?}");
    }

    let sequence = meshopt::encode_index_sequence(&[0, 1, 2, 0, 2, 3], 4).expect("encodes");
    compress(&mut glb, indices, &sequence, "INDICES", "NONE", 6, 2);
    assert_eq!(first(&glb.load().expect("loads")).indices, [0, 1, 2, 0, 2, 3]);

    // Corrupt data is an error that says so, not a crash.
    compress(&mut glb, indices, &sequence[..3], "INDICES", "NONE", 6, 2);
    let error = glb.load().expect_err("corrupt").to_string();
    assert!(error.contains("/bufferViews/4/extensions/EXT_meshopt_compression"), "{error}");
}

#[test]
fn meshopt_quaternions_decode() {
    let turn = Quat::from_rotation_y(1.0);
    let mut glb = Glb::triangle();
    let times = glb.accessor(F32, "SCALAR", &floats(&[0.0]), 1, false);
    let values = glb.accessor(I16, "VEC4", &[0; 8], 1, true);
    let packed = meshopt::encode_filter_quat(&[turn.to_array()], 16);
    compress(
        &mut glb,
        values,
        &meshopt::encode_vertex_buffer(&packed).expect("encodes"),
        "ATTRIBUTES",
        "QUATERNION",
        1,
        8,
    );
    glb.push(
        "animations",
        json!({"samplers": [{"input": times, "output": values}], "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}]}),
    );
    let scene = glb.load().expect("loads");
    let AnimationValues::Rotation(rows) = &scene.animations[0].channels[0].values else { panic!("no rotation") };
    let got = Quat::from_array(rows[0]);
    assert!(got.dot(turn).abs() > 0.9999, "{got:?} {turn:?}");
}

#[test]
fn quantised_attributes_are_scaled() {
    let mut glb = Glb::new();
    glb.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    // Rows of three shorts are padded to 8 bytes.
    let positions = shorts(&[0, 0, 0, 0, 32767, 0, 0, 0, 0, -32767, 0, 0]);
    glb.attribute("POSITION", I16, "VEC3", &positions, 3, true);
    glb.json["bufferViews"][0]["byteStride"] = json!(8);
    glb.attribute("NORMAL", I8, "VEC3", &[0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0], 3, true);
    glb.json["bufferViews"][1]["byteStride"] = json!(4);
    glb.attribute("TEXCOORD_0", U8, "VEC2", &[0, 255, 0, 0, 51, 0, 0, 0, 0, 0, 0, 0], 3, true);
    glb.json["bufferViews"][2]["byteStride"] = json!(4);
    let texture = glb.texture(&picture(image::ImageFormat::Png), "image/png");
    glb.push("materials", json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": texture}}}));
    glb.primitive()["material"] = json!(0);
    let scene = glb.load().expect("loads");
    let primitive = first(&scene);
    assert_eq!(primitive.positions, [[0., 0., 0.], [1., 0., 0.], [0., -1., 0.]]);
    assert_eq!(primitive.normals, [[0., 0., 1.]; 3]);
    assert_eq!(primitive.uvs[0], [[0., 1.], [0.2, 0.], [0., 0.]]);
}
