//! Clothes: blouse, jacket with fur, pleated skirt.

mod fur;
mod jacket;
mod paint;
mod skirt;
mod sleeve;
mod trim;
mod tuft;

use crate::mesh::Part;
use crate::model::{Material, Model, Texture, srgb, srgba};

/// Adds the clothes.
pub fn add(model: &mut Model) {
    let skirt = skirt::build(model);
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
    let mut jacket = both(jacket, true);
    sleeve::raise_folds(&mut jacket);
    let mut blouse = jacket::blouse(skeleton);
    blouse.smooth_normals();
    let mut belt = skirt::belt(skeleton);
    belt.smooth_normals();
    let parts =
        [blouse, jacket, both(lining, true), fur::collar(skeleton), both(fur::cuff(skeleton), false), skirt, belt];
    model.parts.extend(parts);
    materials(model);
}

fn materials(model: &mut Model) {
    let texture = |name, paint| Texture { name, paint, repeat: false };
    model.textures.extend([
        texture("blouse", paint::blouse as fn() -> _),
        texture("jacket", paint::jacket),
        texture("jacket_part_id", paint::jacket_part_id),
        Texture { name: "fur", paint: paint::fur, repeat: true },
        Texture { name: "fur_normal", paint: paint::fur_normal, repeat: true },
        texture("skirt", paint::skirt),
        texture("skirt_outline", paint::skirt_outline),
        texture("skirt_part_id", paint::skirt_part_id),
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
    let fur = |name| Material {
        name,
        texture: Some("fur"),
        shade: srgb(0xcdbce0),
        shade_texture: Some("fur"),
        // Tufts are open below.
        double_sided: true,
        outline: 0.0007,
        outline_color: srgb(0x8378a6),
        // Hairs are dark at their roots; snow shines.
        emission: [0.06, 0.056, 0.07],
        substance: Some("fluff"),
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
        Material { extras: [("detailNormal", "fur_normal")].into(), ..fur("Jacket_Fur") },
        fur("Jacket_Cuff"),
        Material {
            outline_mask: Some("skirt_outline"),
            extras: [("partId", "skirt_part_id")].into(),
            part_ramps: &["Cloth_Blouse", "Skirt"],
            ..cloth("Skirt", "skirt", 0xbfb2da, 0x3a3054)
        },
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
