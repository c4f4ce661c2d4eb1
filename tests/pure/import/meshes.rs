//! Vertices, indices, joints, morph targets, normals and tangents.

use glam::Vec3;
use hikage::material::Origin;
use serde_json::json;

use super::{close, first};
use crate::gltf::{F32, Glb, U8, U16, U32, floats, picture, shorts, words};

#[test]
fn a_plain_triangle_has_a_toon_material_and_no_warnings() {
    let scene = Glb::triangle().load().expect("loads");
    let primitive = first(&scene);
    assert_eq!(primitive.positions, [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]]);
    assert_eq!(primitive.indices, [0, 1, 2]);
    assert_eq!(scene.materials[primitive.material].origin, Origin::Pbr);
    assert_eq!(primitive.uvs.len(), 1, "looks read texture coordinates without a texture, too");
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn only_used_vertices_are_kept() {
    let mut glb = Glb::new();
    let many: Vec<f32> = (0..300).map(|i| i as f32).collect();
    glb.attribute("POSITION", F32, "VEC3", &floats(&many), 100, false);
    let indices = glb.accessor(U16, "SCALAR", &shorts(&[90, 5, 40, 5, 90, 41]), 6, false);
    glb.primitive()["indices"] = json!(indices);
    glb.attribute("NORMAL", F32, "VEC3", &floats(&[0., 0., 1.].repeat(100)), 100, false);
    let scene = glb.load().expect("loads");
    let primitive = first(&scene);
    assert_eq!(primitive.positions.len(), 4);
    assert_eq!(primitive.positions[primitive.indices[0] as usize], [270., 271., 272.]);
    assert_eq!(primitive.positions[primitive.indices[5] as usize], [123., 124., 125.]);
}

#[test]
fn vertex_colours_get_an_alpha_and_white_ones_are_dropped() {
    let mut glb = Glb::triangle();
    glb.attribute("COLOR_0", U8, "VEC3", &[255, 0, 0, 0, 0, 51, 0, 0, 0, 255, 255, 0], 3, true);
    let view = glb.json["bufferViews"].as_array().expect("views").len() - 1;
    glb.json["bufferViews"][view]["byteStride"] = json!(4);
    let scene = glb.load().expect("loads");
    assert_eq!(first(&scene).colors, [[1., 0., 0., 1.], [0., 0.2, 0., 1.], [0., 1., 1., 1.]]);

    let mut glb = Glb::triangle();
    glb.attribute("COLOR_0", F32, "VEC4", &floats(&[1.0; 12]), 3, false);
    assert!(first(&glb.load().expect("loads")).colors.is_empty());

    // MToon ignores them.
    let mut glb = Glb::triangle();
    glb.attribute("COLOR_0", F32, "VEC4", &floats(&[0.5; 12]), 3, false);
    glb.primitive()["material"] = json!(0);
    glb.push("materials", json!({"extensions": {"VRMC_materials_mtoon": {"specVersion": "1.0"}}}));
    glb.json["extensionsUsed"] = json!(["VRMC_materials_mtoon"]);
    assert!(first(&glb.load().expect("loads")).colors.is_empty());
}

/// A triangle skinned to `joints` joints.
fn skinned(joints: usize, sets: &[([u8; 4], [f32; 4])]) -> Glb {
    let mut glb = Glb::triangle();
    for (set, (joint, weight)) in sets.iter().enumerate() {
        glb.attribute(&format!("JOINTS_{set}"), U8, "VEC4", &joint.repeat(3), 3, false);
        glb.attribute(&format!("WEIGHTS_{set}"), F32, "VEC4", &floats(&weight.repeat(3)), 3, false);
    }
    let nodes: Vec<usize> = (0..joints).map(|_| glb.push("nodes", json!({}))).collect();
    glb.push("skins", json!({"joints": nodes}));
    glb.json["nodes"][0]["skin"] = json!(0);
    glb
}

#[test]
fn six_influences_are_sorted_and_sum_to_one() {
    let glb = skinned(8, &[([0, 1, 2, 3], [0.1, 0.4, 0.2, 0.1]), ([4, 5, 0, 0], [0.3, 0.9, 0.0, 0.0])]);
    let scene = glb.load().expect("loads");
    let influences = &first(&scene).influences;
    assert_eq!(influences.per_vertex, 8);
    assert_eq!(influences.joints[..8], [5, 1, 4, 2, 0, 3, 0, 0]);
    assert!(close(&influences.weights[..8], &[0.45, 0.2, 0.15, 0.1, 0.05, 0.05, 0.0, 0.0], 1e-6));
    assert!((influences.weights[8..16].iter().sum::<f32>() - 1.0).abs() < 1e-6);
}

#[test]
fn a_joint_out_of_range_matters_only_with_weight() {
    assert!(skinned(2, &[([0, 1, 200, 0], [0.5, 0.5, 0.0, 0.0])]).load().is_ok());
    let error = skinned(2, &[([0, 200, 0, 0], [0.5, 0.5, 0.0, 0.0])]).load().expect_err("joint 200 of 2").to_string();
    assert!(error.contains("joint index 200") && error.contains("/accessors/3"), "{error}");
}

#[test]
fn sparse_accessors_override_a_base_and_zeros() {
    let mut glb = Glb::triangle();
    let indices = glb.view(&[2]);
    let values = glb.view(&floats(&[5., 6., 7.]));
    let sparse =
        json!({"count": 1, "indices": {"bufferView": indices, "componentType": U8}, "values": {"bufferView": values}});
    glb.json["accessors"][0]["sparse"] = sparse.clone();
    let target = glb.push("accessors", json!({"componentType": F32, "type": "VEC3", "count": 3, "sparse": sparse}));
    glb.primitive()["targets"] = json!([{"POSITION": target}, {}]);
    glb.json["meshes"][0]["extras"] = json!({"targetNames": ["smile"]});
    glb.json["meshes"][0]["weights"] = json!([0.5, 0]);
    let scene = glb.load().expect("loads");
    let primitive = first(&scene);
    assert_eq!(primitive.positions[2], [5., 6., 7.]);
    assert_eq!(
        (primitive.morphs[0].vertices.as_slice(), primitive.morphs[0].positions.as_slice()),
        (&[2][..], &[[5., 6., 7.]][..])
    );
    assert!(primitive.morphs[1].vertices.is_empty());
    assert_eq!(scene.meshes[0].morph_names, ["smile", "1"]);
    assert_eq!(scene.nodes[0].morph_weights, [0.5, 0.0]);
}

#[test]
fn mirrored_scale_is_kept_and_winding_left_alone() {
    let mut glb = Glb::triangle();
    glb.json["nodes"][0]["scale"] = json!([-1, 1, 1]);
    let scene = glb.load().expect("loads");
    assert_eq!(scene.nodes[0].transform.scale, Vec3::new(-1., 1., 1.));
    assert_eq!(first(&scene).indices, [0, 1, 2]);
    glb.json["nodes"][0] = json!({"mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1]});
    let scene = glb.load().expect("loads");
    let matrix = scene.nodes[0].transform.matrix();
    assert!(matrix.determinant() < 0.0 && matrix.w_axis.x == 7.0);
}

#[test]
fn strips_and_fans_become_lists() {
    let mut glb = Glb::new();
    glb.attribute("POSITION", F32, "VEC3", &floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0.]), 4, false);
    glb.attribute("NORMAL", F32, "VEC3", &floats(&[0., 0., 1.].repeat(4)), 4, false);
    glb.primitive()["mode"] = json!(5);
    assert_eq!(first(&glb.load().expect("loads")).indices, [0, 1, 2, 2, 1, 3]);
    glb.primitive()["mode"] = json!(6);
    assert_eq!(first(&glb.load().expect("loads")).indices, [0, 1, 2, 0, 2, 3]);
    glb.primitive()["mode"] = json!(1);
    let scene = glb.load().expect("loads");
    assert!(scene.meshes[0].primitives.is_empty() && !scene.warnings.is_empty());
}

/// A unit cube with hard edges: 24 vertices.
fn cube() -> Glb {
    let (mut positions, mut normals, mut indices) = (Vec::new(), Vec::new(), Vec::new());
    for axis in 0..3 {
        for side in [-1.0f32, 1.0] {
            let base = positions.len() as u32 / 3;
            for (u, v) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                let mut p = [0.0f32; 3];
                (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, u * side, v);
                let mut n = [0.0f32; 3];
                n[axis] = side;
                positions.extend(p);
                normals.extend(n);
            }
            indices.extend([0, 1, 2, 0, 2, 3].map(|i| base + i));
        }
    }
    let mut glb = Glb::new();
    glb.attribute("POSITION", F32, "VEC3", &floats(&positions), 24, false);
    glb.attribute("NORMAL", F32, "VEC3", &floats(&normals), 24, false);
    let indices = glb.accessor(U32, "SCALAR", &words(&indices), 36, false);
    glb.primitive()["indices"] = json!(indices);
    glb
}

#[test]
fn outline_normals_of_a_hard_cube_point_to_its_corners() {
    let scene = cube().load().expect("loads");
    let primitive = first(&scene);
    assert_eq!(primitive.outline_normals.len(), 24);
    for (position, normal) in primitive.positions.iter().zip(&primitive.outline_normals) {
        let corner = Vec3::from_array(*position).normalize();
        assert!(
            close(normal, &corner.to_array(), 1e-6),
            "{position:?} {normal:?}: each face counts by its angle, not its triangles"
        );
    }
}

#[test]
fn missing_normals_are_flat() {
    let mut glb = cube();
    glb.primitive()["attributes"].as_object_mut().expect("attributes").remove("NORMAL");
    let scene = glb.load().expect("loads");
    let primitive = first(&scene);
    for corners in primitive.indices.chunks(3) {
        let [a, b, c] = [0, 1, 2].map(|i| Vec3::from_array(primitive.positions[corners[i] as usize]));
        let flat = (b - a).cross(c - a).normalize();
        for corner in corners {
            assert!(close(&primitive.normals[*corner as usize], &flat.to_array(), 1e-6));
        }
    }
}

#[test]
fn tangents_are_made_only_for_normal_maps_and_split_at_mirror_seams() {
    // Two triangles over a shared edge whose texture is mirrored there.
    let mut glb = Glb::new();
    glb.attribute("POSITION", F32, "VEC3", &floats(&[0., 0., 0., 0., 1., 0., 1., 0., 0., -1., 0., 0.]), 4, false);
    glb.attribute("NORMAL", F32, "VEC3", &floats(&[0., 0., 1.].repeat(4)), 4, false);
    glb.attribute("TEXCOORD_0", F32, "VEC2", &floats(&[0., 0., 0., 1., 1., 0., 1., 0.]), 4, false);
    let indices = glb.accessor(U8, "SCALAR", &[0, 2, 1, 0, 1, 3], 6, false);
    glb.primitive()["indices"] = json!(indices);
    let texture = glb.texture(&picture(image::ImageFormat::Png), "image/png");
    glb.push("materials", json!({"normalTexture": {"index": texture, "scale": 0.5}}));
    glb.push("materials", json!({"emissiveTexture": {"index": texture}}));
    glb.primitive()["material"] = json!(0);
    let scene = glb.load().expect("loads");
    let primitive = first(&scene);
    assert_eq!(primitive.positions.len(), 6, "the two vertices of the seam exist twice");
    for list in
        [primitive.normals.len(), primitive.tangents.len(), primitive.uvs[0].len(), primitive.outline_normals.len()]
    {
        assert_eq!(list, 6);
    }
    let right = primitive.tangents[primitive.indices[0] as usize];
    let left = primitive.tangents[primitive.indices[3] as usize];
    assert!(close(&right[..3], &[1., 0., 0.], 1e-5) && close(&left[..3], &[-1., 0., 0.], 1e-5), "{right:?} {left:?}");
    assert_eq!(right[3], -left[3]);
    glb.primitive()["material"] = json!(1);
    assert!(first(&glb.load().expect("loads")).tangents.is_empty());
}
