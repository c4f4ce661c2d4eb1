//! Ornaments: a bow with a brooch, the belt's buckle, an amber pendant, a diamond hair-pin, a flame.

mod bow;
mod flame;
mod metal;
mod paint;
mod stone;

use glam::Vec3;

use crate::body::shape::torso;
use crate::model::{Alpha, Material, Model, Spring, Texture, srgb, srgba};

/// Point before the blouse at height `y`, this far from the cloth.
fn before_chest(y: f32, out: f32) -> Vec3 {
    Vec3::new(0.0, y, torso(y)[1] + 0.0036 + out)
}

/// Adds the ornaments.
pub fn add(model: &mut Model) {
    let pendant = pendant_chain(model);
    let skeleton = &model.skeleton;
    let parts = [
        bow::build(skeleton),
        metal::brooch(skeleton),
        metal::belt_buckle(skeleton),
        metal::cord(skeleton, pendant),
        stone::amber(pendant),
        metal::pin(skeleton),
        stone::diamond(skeleton),
        flame::build(skeleton),
    ];
    model.parts.extend(parts);
    materials(model);
    model.expressions.push(flame::expression());
}

/// Bones of the pendant: where the cord leaves the bow, the stone, its end.
fn pendant_chain(model: &mut Model) -> [usize; 2] {
    let chest = model.skeleton.find("upperChest");
    let first = model.skeleton.add("Pendant_0", chest, before_chest(CORD[0], 0.006));
    let second = model.skeleton.add("Pendant_1", first, before_chest(CORD[1], STONE_STANDS));
    let end = model.skeleton.add("Pendant_2", second, before_chest(CORD[1], STONE_STANDS) - Vec3::Y * 0.03);
    model.springs.push(Spring {
        name: "Pendant".to_owned(),
        joints: vec![first, second, end],
        // The cord leaves the bow along the slope of the bust: more weight would draw the stone into it.
        stiffness: [1.4; 2],
        drag: 0.25,
        gravity: 0.2,
        radius: 0.012,
        colliders: vec!["body"],
    });
    [first, second]
}

/// Heights of the cord's upper end and of the stone.
const CORD: [f32; 2] = [1.232, 1.168];

/// Distance of the stone's axis from the chest: its lines need room behind it.
const STONE_STANDS: f32 = 0.019;

fn materials(model: &mut Model) {
    let texture = |name, paint| Texture { name, paint, repeat: false };
    model.textures.extend([
        texture("bow", bow::paint as fn() -> _),
        texture("metal_highlight", paint::metal_highlight),
        texture("amber", paint::amber),
        texture("amber_matcap", paint::amber_matcap),
        texture("diamond_matcap", paint::diamond_matcap),
        texture("flame", paint::flame),
        texture("flame_heat", paint::flame_heat),
        Texture { name: "amber_inclusions", paint: paint::amber_inclusions, repeat: true },
    ]);
    let metal = |name, color, shade, line, gloss| Material {
        name,
        color: srgba(color),
        shade: srgb(shade),
        matcap: Some(("metal_matcap", gloss)),
        outline: 0.0006,
        outline_color: srgb(line),
        extras: [("highlightShape", "metal_highlight")].into(),
        substance: Some("metal"),
        ..Material::default()
    };
    model.materials.extend([
        bow::material(),
        metal("Metal_Brooch", 0x8c5a22, 0x4e2b1e, 0x2e180f, [0.8; 3]),
        metal("Metal_Pin", 0x6c7590, 0x3f4462, 0x23243c, [0.42, 0.56, 0.95]),
        Material {
            name: "Accessory_Amber",
            texture: Some("amber"),
            shade: srgb(0xd89a78),
            shade_texture: Some("amber"),
            matcap: Some(("amber_matcap", [0.9; 3])),
            outline: 0.0006,
            outline_color: srgb(0x5a2410),
            extras: [("inclusions", "amber_inclusions")].into(),
            substance: Some("amber"),
            ..Material::default()
        },
        Material {
            name: "Accessory_Diamond",
            color: srgba(0x9fb6d8),
            shade: srgb(0x7186b8),
            matcap: Some(("diamond_matcap", [0.85; 3])),
            outline: 0.0005,
            outline_color: srgb(0x39406e),
            substance: Some("diamond"),
            ..Material::default()
        },
        Material {
            name: "Accessory_Flame",
            texture: Some("flame"),
            shade: [0.98, 0.96, 0.94],
            shade_texture: Some("flame"),
            shift: 1.0,
            emission: [0.35, 0.3, 0.25],
            emission_texture: Some("flame"),
            alpha: Alpha::Blend { depth_write: false, queue: 3 },
            double_sided: true,
            extras: [("heat", "flame_heat")].into(),
            substance: Some("fire"),
            ..Material::default()
        },
    ]);
}
