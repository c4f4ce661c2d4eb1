//! Characters of VRM 1.0.

use glam::{Quat, Vec3};
use hikage::material::{AlphaMode, OutlineWidth, Toon};
use hikage::scene::{ColliderShape, ConstraintKind, Role};
use serde_json::json;

use super::toon;
use crate::gltf::Glb;

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
    assert_eq!(scene.warnings.len(), 3, "{:?}", scene.warnings);
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
    assert_eq!((&character.springs[0].colliders[..], character.springs[0].joints.len()), (&[1, 0][..], 2));
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
