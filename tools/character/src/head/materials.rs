//! Materials and textures of the head.

use std::collections::BTreeMap;

use super::{paint, paint_eyes};
use crate::model::{Alpha, Material, Model, Texture, srgb, srgba};

/// Adds them.
pub(super) fn add(model: &mut Model) {
    let texture = |name, paint| Texture { name, paint, repeat: false };
    model.textures.extend([
        texture("face", paint::face as fn() -> _),
        texture("face_outline", paint::outline_mask),
        texture("face_highlight", paint::highlight),
        texture("face_paint", paint::face_paint),
        texture("face_part_id", paint::part_id),
        texture("eye_iris", paint_eyes::iris),
        texture("eye_white", paint_eyes::eye_white),
        texture("eyelash_shadow", paint_eyes::lash_shadow),
        texture("eyelash", paint_eyes::lash),
        texture("mouth", paint_eyes::mouth),
    ]);
    model.materials.extend([
        Material {
            name: "Face",
            texture: Some("face"),
            shade: srgb(0xf3cac0),
            shade_texture: Some("face"),
            toony: 0.97,
            outline: 0.0009,
            outline_color: srgb(0x8c4a44),
            outline_mask: Some("face_outline"),
            extras: BTreeMap::from([
                ("noseLipHighlight", "face_highlight"),
                ("facePaint", "face_paint"),
                ("partId", "face_part_id"),
            ]),
            ..Material::default()
        },
        Material {
            name: "Mouth",
            texture: Some("mouth"),
            shade: srgb(0xf0d0d6),
            shade_texture: Some("mouth"),
            shift: 0.8,
            ..Material::default()
        },
        Material {
            name: "EyeWhite",
            texture: Some("eye_white"),
            shade: srgb(0xe4d6e6),
            shade_texture: Some("eye_white"),
            shift: 0.05,
            toony: 0.97,
            ..Material::default()
        },
        Material {
            name: "EyeIris",
            texture: Some("eye_iris"),
            shade: srgb(0xe0c8d0),
            shade_texture: Some("eye_iris"),
            shift: 0.3,
            ..Material::default()
        },
        Material {
            name: "EyelashShadow",
            texture: Some("eyelash_shadow"),
            shade: [0.92, 0.9, 0.95],
            shade_texture: Some("eyelash_shadow"),
            alpha: Alpha::Blend { depth_write: false, queue: -9 },
            ..Material::default()
        },
        Material { name: "EyeHighlight", shade: [0.92, 0.9, 0.95], shift: 1.0, ..Material::default() },
        Material {
            name: "Eyelash",
            texture: Some("eyelash"),
            shade: [0.72, 0.62, 0.7],
            shade_texture: Some("eyelash"),
            double_sided: true,
            ..Material::default()
        },
        // Dark hair, thinned by the skin below.
        Material { name: "Brow", color: srgba(0x7f73a8), shade: srgb(0x706092), ..Material::default() },
        Material { name: "EyeballSclera", color: srgba(0xfaf5f3), shade: srgb(0xdccbdc), ..Material::default() },
        Material {
            name: "EyeballIris",
            texture: Some("eye_iris"),
            shade: srgb(0xe0c8d0),
            shade_texture: Some("eye_iris"),
            shift: 0.3,
            ..Material::default()
        },
        Material {
            name: "EyeballCornea",
            color: [1.0, 1.0, 1.0, 0.015],
            shade: [0.92, 0.9, 0.95],
            alpha: Alpha::Blend { depth_write: false, queue: -8 },
            ..Material::default()
        },
    ]);
}
