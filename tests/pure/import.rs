//! What no shared model covers, as small files made here; each test checks the loaded values.

use glam::{Quat, Vec3};
use hikage::Error;
use hikage::material::{AlphaMode, Origin, OutlineWidth, Shading, Toon};
use hikage::scene::{AnimationValues, ColliderShape, ConstraintKind, HumanBone, Primitive, Role, Scene};
use serde_json::json;

use crate::gltf::{F32, Glb, I8, I16, U8, U16, U32, floats, picture, shorts, words};

fn first(scene: &Scene) -> &Primitive {
    &scene.meshes[0].primitives[0]
}

fn close(a: &[f32], b: &[f32], tolerance: f32) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance)
}

fn toon(scene: &Scene, material: usize) -> Toon {
    match scene.materials[material].shading {
        Shading::Toon(toon) => toon,
        Shading::Unlit => panic!("unlit"),
    }
}

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
fn extras_may_hold_anything_and_name_highlights() {
    let mut glb = Glb::triangle();
    let texture = glb.texture(&picture(image::ImageFormat::Png), "image/png");
    glb.push("materials", json!({"name": "skin"}));
    glb.primitive()["material"] = json!(0);
    let load = |glb: &Glb| glb.load().map(|scene| scene.materials[0].authored.highlight.map(|t| t.texture));
    for extras in [json!(5), json!("hikage"), json!([1]), json!({"hikage": 7}), json!({"hikage": {"rampRow": 3}})] {
        glb.json["materials"][0]["extras"] = extras.clone();
        assert_eq!(load(&glb).expect("extras are free"), None, "{extras}");
    }
    for key in ["highlightBand", "noseLipHighlight"] {
        glb.json["materials"][0]["extras"] = json!({"hikage": {key: {"index": texture}}});
        assert_eq!(load(&glb).expect("loads"), Some(texture), "{key}");
        glb.json["materials"][0]["extras"] = json!({"hikage": {key: {"index": 9}}});
        let error = load(&glb).expect_err("no such texture").to_string();
        assert!(error.contains(&format!("/materials/0/extras/hikage/{key}/index")), "{error}");
    }
}

#[test]
fn webp_loads_declared_and_undeclared() {
    for declared in [true, false] {
        let mut glb = Glb::triangle();
        let texture = glb.texture(&picture(image::ImageFormat::WebP), "image/webp");
        if declared {
            glb.json["textures"][texture] = json!({"extensions": {"EXT_texture_webp": {"source": 0}}});
            glb.json["extensionsUsed"] = json!(["EXT_texture_webp"]);
            glb.json["extensionsRequired"] = json!(["EXT_texture_webp"]);
        }
        glb.push("materials", json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": texture}}}));
        glb.primitive()["material"] = json!(0);
        let scene = glb.load().expect("loads");
        assert_eq!(scene.images[0].format, "webp");
        assert_eq!(scene.images[0].pixels, [255, 0, 0, 255, 0, 0, 255, 128]);
        assert_eq!(first(&scene).uvs, [[[0., 0.], [1., 0.], [0., 1.]]]);
    }
}

#[test]
fn sixteen_bit_png_is_down_converted() {
    let pixels: image::ImageBuffer<image::Rgba<u16>, _> =
        image::ImageBuffer::from_raw(1, 1, vec![0x1234u16, 0x8080, 0xFFFF, 0xFFFF]).expect("1 x 1");
    let mut file = std::io::Cursor::new(Vec::new());
    image::DynamicImage::from(pixels).write_to(&mut file, image::ImageFormat::Png).expect("encodes");
    let image = hikage::import::image::decode("x.png", file.get_ref(), &Default::default()).expect("decodes");
    assert_eq!((image.source_bits, image.pixels), (16, vec![0x12, 0x80, 0xFF, 0xFF]));
}

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
fn mask_and_z_writing_transparents_on_a_vrm_character() {
    let mut glb = Glb::triangle();
    glb.vrm1();
    let mtoon = |write: bool, queue: i32| {
        json!({"alphaMode": "BLEND", "extensions": {"VRMC_materials_mtoon": {
            "specVersion": "1.0", "transparentWithZWrite": write, "renderQueueOffsetNumber": queue, "shadeColorFactor": [0.5, 0.25, 0.125],
            "shadingToonyFactor": 0.75, "shadingShiftFactor": -0.25, "giEqualizationFactor": 0.5, "outlineWidthMode": "screenCoordinates",
            "outlineWidthFactor": 0.01, "outlineColorFactor": [1, 0, 0], "outlineLightingMixFactor": 0.5, "parametricRimColorFactor": [0, 1, 0],
            "parametricRimFresnelPowerFactor": 2, "parametricRimLiftFactor": 0.1, "rimLightingMixFactor": 0.25,
            "uvAnimationScrollXSpeedFactor": 1, "uvAnimationScrollYSpeedFactor": 2, "uvAnimationRotationSpeedFactor": 3
        }}})
    };
    glb.push("materials", mtoon(true, 4));
    glb.push("materials", mtoon(false, 4));
    glb.push("materials", mtoon(false, -40));
    glb.push("materials", json!({"alphaMode": "MASK", "alphaCutoff": 0.25, "extensions": {"VRMC_materials_mtoon": {"specVersion": "1.0"}}}));
    let scene = glb.load().expect("loads");
    let alpha: Vec<_> =
        scene.materials.iter().map(|m| (m.alpha.mode, m.alpha.write_depth, m.alpha.queue_offset)).collect();
    assert_eq!(
        alpha[..4],
        [
            (AlphaMode::Blend, true, 4),
            (AlphaMode::Blend, false, 0),
            (AlphaMode::Blend, false, -9),
            (AlphaMode::Mask, false, 0)
        ]
    );
    assert_eq!(scene.materials[3].alpha.cutoff, 0.25);
    assert_eq!(toon(&scene, 3), Toon::default(), "the specification's defaults");
    let material = &scene.materials[0];
    let shade = toon(&scene, 0);
    assert_eq!(
        (shade.shade_color, shade.toony, shade.shift, shade.gi_equalization),
        ([0.5, 0.25, 0.125], 0.75, -0.25, 0.5)
    );
    let outline = material.outline.expect("an outline");
    assert_eq!(
        (outline.width, outline.color, outline.lighting_mix),
        (OutlineWidth::Screen { height_ratio: 0.01 }, [1., 0., 0.], 0.5)
    );
    assert_eq!(
        (material.rim.color, material.rim.fresnel_power, material.rim.lift, material.rim.lighting_mix),
        ([0., 1., 0.], 2.0, 0.1, 0.25)
    );
    assert_eq!(
        (
            material.uv_animation.scroll_u_per_s,
            material.uv_animation.scroll_v_per_s,
            material.uv_animation.rotation_rad_per_s
        ),
        (1.0, 2.0, 3.0)
    );
    let character = scene.character.as_ref().expect("a character");
    assert_eq!((character.meta.name.as_str(), character.meta.authors.len()), ("Test", 2));
    assert_eq!(character.meta.permissions.get("allowRedistribution").map(String::as_str), Some("true"));
    assert_eq!(character.bones.len(), 15);
}

#[test]
fn node_constraints_load_and_circles_are_left_out() {
    let mut glb = Glb::triangle();
    let head = glb.vrm1();
    let constrain = |kind: &str, body: serde_json::Value| json!({"VRMC_node_constraint": {"specVersion": "1.0", "constraint": {kind: body}}});
    glb.json["nodes"][1]["extensions"] = constrain("roll", json!({"source": head, "rollAxis": "Y", "weight": 0.5}));
    glb.json["nodes"][2]["extensions"] = constrain("aim", json!({"source": head, "aimAxis": "NegativeZ"}));
    glb.json["nodes"][3]["extensions"] = constrain("rotation", json!({"source": head}));
    glb.json["nodes"][4]["extensions"] = constrain("rotation", json!({"source": 4}));
    glb.json["nodes"][5]["extensions"] = constrain("rotation", json!({"source": 6}));
    glb.json["nodes"][6]["extensions"] = constrain("rotation", json!({"source": 5}));
    glb.json["nodes"][7]["extensions"] = constrain("rotation", json!({"source": 5}));
    glb.json["nodes"][head]["rotation"] = json!([0, 1, 0, 0]);
    let scene = glb.load().expect("loads");
    let constraints = &scene.character.as_ref().expect("a character").constraints;
    let kinds: Vec<_> = constraints.iter().map(|c| (c.kind, c.weight)).collect();
    assert_eq!(
        kinds,
        [
            (ConstraintKind::Roll { axis: Vec3::Y }, 0.5),
            (ConstraintKind::Aim { axis: Vec3::NEG_Z }, 1.0),
            (ConstraintKind::Rotation, 1.0),
            (ConstraintKind::Rotation, 1.0)
        ]
    );
    assert_eq!(constraints[0].source_rest, Quat::from_xyzw(0., 1., 0., 0.));
    assert_eq!(scene.nodes[constraints[0].source].name, "head");
    assert_eq!(scene.warnings.len(), 2, "{:?}", scene.warnings);
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
fn uv_sets_are_renumbered_by_material() {
    let mut glb = Glb::triangle();
    glb.attribute("TEXCOORD_3", F32, "VEC2", &floats(&[0.5, 0.5, 0.5, 0.5, 0.25, 0.25]), 3, false);
    let texture = glb.texture(&picture(image::ImageFormat::Png), "image/png");
    glb.push(
        "materials",
        json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": texture, "texCoord": 3}}, "emissiveTexture": {"index": texture}}),
    );
    glb.push("materials", json!({"emissiveTexture": {"index": texture, "extensions": {"KHR_texture_transform": {"texCoord": 3, "offset": [0.5, 0], "scale": [2, 3], "rotation": 1}}}}));
    glb.primitive()["material"] = json!(0);
    let mut second = glb.primitive().clone();
    second["material"] = json!(1);
    glb.json["meshes"][0]["primitives"].as_array_mut().expect("primitives").push(second);
    let scene = glb.load().expect("loads");
    let [a, b] = &scene.meshes[0].primitives[..] else { panic!("two primitives") };
    assert_eq!((a.uvs.len(), b.uvs.len()), (2, 1));
    assert_eq!((a.uvs[0][1], a.uvs[1][1], b.uvs[0][2]), ([1., 0.], [0.5, 0.5], [0.25, 0.25]));
    assert_eq!(scene.materials[0].base.texture.expect("base").uv_set, 1);
    assert_eq!(scene.materials[0].emission.texture.expect("emission").uv_set, 0);
    let moved = scene.materials[1].emission.texture.expect("emission");
    assert_eq!(
        (moved.uv_set, moved.transform.offset, moved.transform.scale, moved.transform.rotation_rad),
        (0, [0.5, 0.], [2., 3.], 1.0)
    );
    assert_eq!(scene.images.len(), 1, "a shared image is decoded once");
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

/// A VRM 0.x character with one MToon material.
fn vrm0(properties: serde_json::Value) -> Glb {
    let mut glb = Glb::triangle();
    let texture = glb.texture(&picture(image::ImageFormat::Png), "image/png");
    glb.push("nodes", json!({"name": "hips", "children": [2]}));
    glb.push("nodes", json!({"name": "head", "translation": [0, 1, 0]}));
    glb.json["scenes"][0]["nodes"] = json!([0, 1]);
    for name in ["a", "b", "c"] {
        glb.push("materials", json!({"name": name}));
    }
    glb.json["extensions"]["VRM"] = json!({
        "meta": {"title": "Old", "author": "A", "licenseName": "CC0"},
        "humanoid": {"humanBones": [{"bone": "hips", "node": 1}, {"bone": "head", "node": 2}, {"bone": "leftThumbIntermediate", "node": 2}]},
        "materialProperties": properties,
        "blendShapeMaster": {"blendShapeGroups": [
            {"presetName": "joy", "name": "Joy", "isBinary": true, "binds": [{"mesh": 0, "index": 0, "weight": 50}],
             "materialValues": [{"materialName": "b", "propertyName": "_Color", "targetValue": [0.5, 0, 1, 0.5]},
                                {"materialName": "b", "propertyName": "_MainTex_ST", "targetValue": [0.5, 0.25, 0.1, 0.2]}]},
            {"presetName": "unknown", "name": "Wink"}]},
        "firstPerson": {"firstPersonBoneOffset": {"x": 1, "y": 2, "z": 3}, "lookAtTypeName": "Bone",
            "lookAtHorizontalInner": {"xRange": 90, "yRange": 10}, "meshAnnotations": [{"mesh": 0, "firstPersonFlag": "ThirdPersonOnly"}]},
        "secondaryAnimation": {
            "colliderGroups": [{"node": 2, "colliders": [{"offset": {"x": 0.1, "y": 0.2, "z": 0.3}, "radius": 0.5}]}],
            "boneGroups": [{"bones": [1], "colliderGroups": [0], "stiffiness": 2, "dragForce": 0.25, "gravityPower": 1, "hitRadius": 0.02,
                            "gravityDir": {"x": 1, "y": 0, "z": 0}, "center": -1}]}
    });
    let target = glb.accessor(F32, "VEC3", &floats(&[0.0, 0.1, 0.0].repeat(3)), 3, false);
    glb.primitive()["targets"] = json!([{"POSITION": target}]);
    assert_eq!(texture, 0);
    glb
}

#[test]
fn vrm0_materials_convert_by_the_migration_table() {
    let mtoon = |floats: serde_json::Value, vectors: serde_json::Value, textures: serde_json::Value, queue: i32| {
        json!({"shader": "VRM/MToon", "floatProperties": floats, "vectorProperties": vectors, "textureProperties": textures,
               "keywordMap": {"_ALPHABLEND_ON": queue > 0}, "renderQueue": queue})
    };
    let glb = vrm0(json!([
        mtoon(
            json!({"_ShadeShift": -0.2, "_ShadeToony": 0.8, "_IndirectLightIntensity": 0.25, "_OutlineWidthMode": 1, "_OutlineWidth": 0.5,
                   "_OutlineColorMode": 1, "_OutlineLightingMix": 0.75, "_RimLightingMix": 0.5, "_RimFresnelPower": 3, "_RimLift": 0.1,
                   "_UvAnimScrollX": 1, "_UvAnimScrollY": 2, "_UvAnimRotation": 0.5, "_CullMode": 0, "_BumpScale": 0.5}),
            json!({"_Color": [0.5, 1, 0, 0.5], "_ShadeColor": [0.5, 0, 0, 1], "_EmissionColor": [0.5, 2, 0, 1], "_RimColor": [0.5, 0, 0, 1],
                   "_OutlineColor": [0.5, 0, 0, 1], "_MainTex": [0.1, 0.2, 0.5, 0.25]}),
            json!({"_MainTex": 0, "_SphereAdd": 0, "_BumpMap": 0}),
            0
        ),
        mtoon(
            json!({"_OutlineWidthMode": 2, "_OutlineWidth": 0.5, "_OutlineLightingMix": 0.75, "_ZWrite": 0}),
            json!({}),
            json!({}),
            3000
        ),
        mtoon(json!({"_ZWrite": 0}), json!({}), json!({}), 3005),
    ]));
    let scene = glb.load().expect("loads");
    let half = 0.214_041_14;
    let material = &scene.materials[0];
    assert_eq!(material.origin, Origin::Mtoon0);
    assert!(close(&material.base.color, &[half, 1., 0., 0.5], 1e-6));
    let shade = toon(&scene, 0);
    assert!(close(&shade.shade_color, &[half, 0., 0.], 1e-6));
    // Band from -0.2 to lerp(1, -0.2, 0.8) = 0.04 in N·L.
    assert!((shade.shift - 0.08).abs() < 1e-6 && (shade.toony - 0.88).abs() < 1e-6, "{shade:?}");
    assert_eq!(shade.gi_equalization, 0.75);
    assert_eq!(shade.shade_texture, material.base.texture, "the lit texture stands in for a missing shade texture");
    assert!(
        close(&material.emission.color, &[half, 2f32.powf(2.2), 0.0], 1e-5),
        "emission is gamma-encoded in the file"
    );
    let outline = material.outline.expect("an outline");
    assert_eq!((outline.width, outline.lighting_mix), (OutlineWidth::World { metres: 0.005 }, 0.75));
    assert!(close(&outline.color, &[half, 0., 0.], 1e-6) && close(&material.rim.color, &[half, 0., 0.], 1e-6));
    assert_eq!((material.rim.fresnel_power, material.rim.lift, material.rim.lighting_mix), (3.0, 0.1, 0.5));
    let animation = material.uv_animation;
    assert_eq!((animation.scroll_u_per_s, animation.scroll_v_per_s), (1.0, -2.0));
    assert!((animation.rotation_rad_per_s - std::f32::consts::PI).abs() < 1e-6);
    let transform = material.base.texture.expect("a texture").transform;
    assert!(close(&transform.offset, &[0.1, 0.55], 1e-6) && transform.scale == [0.5, 0.25]);
    assert!(material.double_sided && material.matcap.is_some() && material.normal_map.is_some_and(|n| n.scale == 0.5));

    let outline = scene.materials[1].outline.expect("an outline");
    assert_eq!((outline.width, outline.lighting_mix), (OutlineWidth::Screen { height_ratio: 0.0025 }, 0.0));
    let queues: Vec<_> = scene.materials.iter().map(|m| (m.alpha.mode, m.alpha.queue_offset)).collect();
    assert_eq!(queues[..3], [(AlphaMode::Opaque, 0), (AlphaMode::Blend, -1), (AlphaMode::Blend, 0)]);
}

#[test]
fn vrm0_characters_are_turned_and_converted() {
    let scene = vrm0(json!([{"shader": "VRM/UnlitTexture", "vectorProperties": {"_Color": [1, 1, 1, 1]}}]))
        .load()
        .expect("loads");
    let world = scene.rest_world_from_nodes();
    let carrier = scene.nodes.iter().position(|n| n.mesh.is_some()).expect("a mesh node");
    let forward = world[carrier].transform_vector3(Vec3::NEG_Z);
    assert!(forward.abs_diff_eq(Vec3::Z, 1e-6), "{forward}");
    assert_eq!(scene.materials[0].shading, Shading::Unlit);
    let character = scene.character.as_ref().expect("a character");
    assert_eq!(character.vrm_version, "0.x");
    assert!(character.bones.contains_key(&HumanBone::LeftThumbProximal));
    let joy = &character.expressions[0];
    assert_eq!((joy.name.as_str(), joy.preset, joy.is_binary), ("happy", true, true));
    assert_eq!((joy.morphs[0].node, joy.morphs[0].weight), (carrier, 0.5));
    assert!(close(&joy.colors[0].value, &[0.214_041_14, 0., 1., 0.5], 1e-6));
    assert!(close(&joy.uv_transforms[0].offset, &[0.1, 0.55], 1e-6));
    assert_eq!((character.expressions[1].name.as_str(), character.expressions[1].preset), ("Wink", false));
    let look = character.look_at.expect("a gaze");
    assert_eq!((look.offset_from_head, look.uses_bones), (Vec3::new(1., 2., -3.), true));
    assert!((look.horizontal_inner.output_scale - 10f32.to_radians()).abs() < 1e-6);
    let ColliderShape::Sphere { offset, .. } = character.colliders[0].shape else { panic!("a sphere") };
    assert_eq!(offset, Vec3::new(0.1, 0.2, -0.3));
    let spring = &character.springs[0];
    let names: Vec<_> = spring.joints.iter().map(|j| scene.nodes[j.node].name.as_str()).collect();
    assert_eq!(names, ["hips", "head", "head (tail)"], "the imagined tail becomes a node");
    assert_eq!(
        (spring.joints[0].gravity_dir, spring.joints[0].stiffness, &spring.colliders[..]),
        (Vec3::NEG_X, 2.0, &[0][..])
    );
    assert!(scene.nodes.iter().enumerate().all(|(i, n)| n.parent.is_none_or(|p| p < i)), "parents come first");
}

#[test]
fn extended_colliders_win_over_their_fallback() {
    let mut glb = Glb::triangle();
    let head = glb.vrm1();
    glb.json["extensions"]["VRMC_springBone"] = json!({
        "colliders": [
            {"node": 1, "shape": {"sphere": {"radius": 9}}, "extensions": {"VRMC_springBone_extended_collider": {
                "specVersion": "1.0", "shape": {"plane": {"offset": [0, 1, 0], "normal": [0, 2, 0]}}}}},
            {"node": 1, "shape": {"capsule": {"offset": [1, 0, 0], "tail": [0, 1, 0], "radius": 0.5}}},
            {"node": 999, "shape": {"sphere": {}}}],
        "colliderGroups": [{"colliders": [1, 0, 2, 1]}],
        "springs": [{"name": "s", "joints": [{"node": head - 1, "stiffness": 2, "hitRadius": 0.5}, {"node": head}], "colliderGroups": [0], "center": 1},
                    {"joints": [{"node": head}, {"node": 1}]}]
    });
    let scene = glb.load().expect("loads");
    let character = scene.character.as_ref().expect("a character");
    assert_eq!(character.colliders[0].shape, ColliderShape::Plane { offset: Vec3::Y, normal: Vec3::Y });
    let capsule = ColliderShape::Capsule { offset: Vec3::X, tail: Vec3::Y, radius: 0.5, inside: false };
    assert_eq!(character.colliders[1].shape, capsule);
    assert_eq!(character.springs.len(), 1, "a joint of two springs belongs to the first");
    assert_eq!((&character.springs[0].colliders[..], character.springs[0].joints.len()), (&[0, 1][..], 2));
    assert_eq!(character.springs[0].joints[1].drag, 0.5);
}

#[test]
fn roles_follow_names_and_bones() {
    let mut glb = Glb::triangle();
    let head = glb.vrm1();
    glb.json["nodes"][head]["mesh"] = json!(0);
    glb.json["nodes"][0] = json!({});
    let names = [
        ("N00_000_00_FaceMouth_00_FACE (Instance)", Role::Mouth),
        ("N00_000_00_EyeIris_00_EYE", Role::Eye),
        ("N00_000_00_EyeWhite_00_EYE", Role::EyeWhite),
        ("N00_000_00_FaceBrow_00_FACE", Role::Brow),
        ("N00_000_00_FaceEyelash_00_FACE", Role::Lash),
        ("N00_000_00_Face_00_SKIN", Role::Face),
        ("N00_000_00_Body_00_SKIN", Role::Skin),
        ("N00_007_01_Tops_01_CLOTH", Role::Cloth),
        ("後ろ髪", Role::Hair),
        ("前髪", Role::HairFront),
        ("眼鏡", Role::Accessory),
        ("睫毛", Role::Lash),
        ("Mat_041", Role::Other),
    ];
    let template = glb.primitive().clone();
    let parts: Vec<_> = names
        .iter()
        .enumerate()
        .map(|(i, (name, _))| {
            glb.push("materials", json!({"name": name}));
            let mut part = template.clone();
            part["material"] = json!(i);
            part
        })
        .collect();
    glb.json["meshes"][0]["primitives"] = json!(parts);
    let scene = glb.load().expect("loads");
    for (primitive, (name, role)) in scene.meshes[0].primitives.iter().zip(names) {
        // The whole test mesh hangs on the head, so skin of the body counts as the face's.
        let role = if role == Role::Skin { Role::Face } else { role };
        assert_eq!(primitive.role, role, "{name}");
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
