//! Clothes: blouse, jacket with fur, pleated skirt.

mod fur;
mod jacket;
mod paint;
mod skirt;
mod tuft;

use crate::mesh::Part;
use crate::model::{Alpha, Material, Model, Texture, srgb, srgba};

/// Adds the clothes.
pub fn add(model: &mut Model) {
    let mut skirt = skirt::build(model);
    skirt.smooth_normals();
    let skeleton = &model.skeleton;
    let both = |mut left: Part, smooth: bool| {
        let right = left.mirrored(skeleton);
        left.append(&right);
        if smooth {
            // Over the seam in the middle of the back too.
            left.smooth_normals();
        }
        left
    };
    let [jacket, lining] = jacket::left(skeleton);
    let mut blouse = jacket::blouse(skeleton);
    blouse.smooth_normals();
    let mut belt = skirt::belt(skeleton);
    belt.smooth_normals();
    let parts = [
        blouse,
        both(jacket, true),
        both(lining, true),
        fur::collar(skeleton),
        both(fur::cuff(skeleton), false),
        skirt,
        belt,
    ];
    model.parts.extend(parts);
    materials(model);
}

fn materials(model: &mut Model) {
    let texture = |name, paint| Texture { name, paint, repeat: false };
    model.textures.extend([
        texture("blouse", paint::blouse as fn() -> _),
        texture("jacket", paint::jacket),
        texture("jacket_part_id", paint::jacket_part_id),
        texture("fur", paint::fur),
        texture("fur_normal", paint::fur_normal),
        texture("skirt", paint::skirt),
        texture("skirt_outline", paint::skirt_outline),
    ]);
    let cloth = |name, texture, shade, line| Material {
        name,
        texture: Some(texture),
        shade: srgb(shade),
        shade_texture: Some(texture),
        outline: 0.001,
        outline_color: srgb(line),
        ..Material::default()
    };
    let fur = Material {
        name: "Jacket_Fur",
        texture: Some("fur"),
        shade: srgb(0xcdbce0),
        shade_texture: Some("fur"),
        alpha: Alpha::Mask(0.5),
        // Tufts are cards.
        double_sided: true,
        extras: [("detailNormal", "fur_normal")].into(),
        ..Material::default()
    };
    model.materials.extend([
        cloth("Cloth_Blouse", "blouse", 0xc2bde6, 0x4a4674),
        Material {
            extras: [("partId", "jacket_part_id")].into(),
            part_ramps: &["Jacket", "Metal", "Metal"],
            ..cloth("Jacket", "jacket", 0x9a88c8, 0x14142c)
        },
        Material { name: "Jacket_Lining", color: srgba(0xe8a33d), shade: srgb(0xb0603a), ..Material::default() },
        fur,
        Material {
            name: "Jacket_Cuff",
            color: srgba(0xf6f0fa),
            shade: srgb(0xc6b6dc),
            outline: 0.001,
            outline_color: srgb(0x6d6488),
            substance: Some("fluff"),
            ..Material::default()
        },
        Material { outline_mask: Some("skirt_outline"), ..cloth("Skirt", "skirt", 0xb09cd8, 0x171228) },
        Material {
            name: "Cloth_Belt",
            color: srgba(0x5d4238),
            shade: srgb(0x33232e),
            outline: 0.0008,
            outline_color: srgb(0x21131a),
            ..Material::default()
        },
    ]);
}
