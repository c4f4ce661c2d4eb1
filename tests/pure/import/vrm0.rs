//! Characters of VRM 0.x.

use glam::Vec3;
use hikage::material::{AlphaMode, Origin, OutlineWidth, Shading};
use hikage::scene::{ColliderShape, HumanBone};
use serde_json::json;

use super::{close, toon};
use crate::gltf::{F32, Glb, floats, picture};

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
    let look = character.look_at.as_ref().expect("a gaze");
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
