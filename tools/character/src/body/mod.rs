//! The body: skin where it shows, stockings, boots, and the colliders of the swinging parts.

mod boot;
mod hand;
mod leg;
mod paint;
pub mod shape;
pub mod weights;

use glam::Vec3;

use crate::mesh::Part;
use crate::model::{Collider, Material, Model, Texture, srgb, srgba};

/// Adds body, stockings and boots.
pub fn add(model: &mut Model) {
    let skeleton = &model.skeleton;
    let both = |mut left: Part| {
        left.smooth_normals();
        let right = left.mirrored(skeleton);
        left.append(&right);
        left
    };
    let mut skin = hand::left(skeleton);
    skin.append(&leg::thigh(skeleton));
    let mut shorts = leg::shorts(skeleton);
    shorts.smooth_normals();
    let parts =
        [both(skin), both(leg::stocking(skeleton)), both(boot::build(skeleton)), both(boot::buckles(skeleton)), shorts];
    model.parts.extend(parts);
    materials(model);
    colliders(model);
}

fn materials(model: &mut Model) {
    let texture = |name, paint| Texture { name, paint, repeat: false };
    model.textures.extend([
        texture("body_skin", paint::skin as fn() -> _),
        texture("stocking", paint::stocking),
        texture("boots", paint::boots),
        texture("metal_matcap", paint::metal_matcap),
    ]);
    model.materials.extend([
        Material {
            name: "Body_Skin",
            texture: Some("body_skin"),
            shade: srgb(0xf3cac0),
            shade_texture: Some("body_skin"),
            toony: 0.97,
            outline: 0.0009,
            outline_color: srgb(0x8c4a44),
            ..Material::default()
        },
        Material {
            name: "Stocking",
            texture: Some("stocking"),
            shade: srgb(0x9c8ac8),
            shade_texture: Some("stocking"),
            outline: 0.0009,
            outline_color: srgb(0x17101f),
            rim: Some((srgb(0x6b5a86), 5.0, 0.0)),
            substance: Some("stocking"),
            ..Material::default()
        },
        Material {
            name: "Boots",
            texture: Some("boots"),
            shade: srgb(0x9a80ac),
            shade_texture: Some("boots"),
            outline: 0.001,
            outline_color: srgb(0x21131a),
            ..Material::default()
        },
        Material {
            name: "Metal_Buckle",
            color: srgba(0x8c5a22),
            shade: srgb(0x4e2b1e),
            matcap: Some(("metal_matcap", [0.8; 3])),
            outline: 0.0006,
            outline_color: srgb(0x2e180f),
            extras: [("highlightShape", "metal_highlight")].into(),
            substance: Some("metal"),
            ..Material::default()
        },
        Material { name: "Cloth_Shorts", color: srgba(0x3a3346), shade: srgb(0x241d36), ..Material::default() },
    ]);
}

fn colliders(model: &mut Model) {
    let skeleton = &model.skeleton;
    let mut list = Vec::new();
    let mut capsule = |group, bone: &str, from: Vec3, to: Vec3, radius| {
        let origin = skeleton.place(bone);
        list.push(Collider {
            group,
            bone: skeleton.find(bone),
            offset: from - origin,
            tail: Some(to - origin),
            radius,
        });
    };
    capsule("body", "upperChest", Vec3::new(-0.05, 1.17, -0.01), Vec3::new(0.05, 1.17, -0.01), 0.095);
    // The bust, on which the pendant lies.
    capsule("body", "upperChest", Vec3::new(-0.045, 1.12, 0.012), Vec3::new(0.045, 1.12, 0.012), 0.094);
    capsule("body", "spine", Vec3::new(0.0, 0.96, 0.005), Vec3::new(0.0, 1.07, 0.005), 0.085);
    capsule("body", "hips", Vec3::new(-0.05, 0.84, -0.012), Vec3::new(0.05, 0.84, -0.012), 0.095);
    for (side, sign) in [("left", 1.0), ("right", -1.0)] {
        let at = |x: f32, y: f32, z: f32| Vec3::new(x * sign, y, z);
        capsule("body", &format!("{side}UpperArm"), at(0.12, 1.215, -0.016), at(0.32, 1.215, -0.02), 0.042);
        capsule("legs", &format!("{side}UpperLeg"), at(0.079, 0.8, -0.003), at(0.078, 0.5, 0.006), 0.07);
    }
    model.colliders.extend(list);
}
