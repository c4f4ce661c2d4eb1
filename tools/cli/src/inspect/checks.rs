//! What will look wrong though the file is sound: advice beside the warnings of the import.

use hikage::material::Encoding;
use hikage::material::{AlphaMode, Origin, Shading};
use hikage::scene::{Scene, Warning};

use super::memory::image_uses;

pub(super) fn advice(scene: &Scene) -> Vec<Warning> {
    let mut found = Vec::new();
    let mut say = |pointer: String, message: &str| found.push(Warning { pointer, message: message.into() });

    for (index, material) in scene.materials.iter().enumerate() {
        let pointer = format!("/materials/{index}");
        let is_mtoon = matches!(material.origin, Origin::Mtoon0 | Origin::Mtoon1);
        if let Shading::Toon(toon) = &material.shading {
            if is_mtoon && toon.shade_color == [0.0; 3] {
                say(pointer.clone(), "the shade colour is black: all that the light misses will be black");
            }
            let has_texture = material.base.texture.is_some();
            if is_mtoon && has_texture && toon.shade_texture.is_none() && toon.shade_color != [0.0; 3] {
                say(pointer.clone(), "has a base texture and no shade texture: its shade is one flat colour");
            }
        }
        if material.outline.is_some() && material.alpha.mode == AlphaMode::Blend && !material.alpha.write_depth {
            say(pointer, "outline on a transparent material that writes no depth: the line shows through it");
        }
    }
    for (index, uses) in image_uses(scene).iter().enumerate() {
        if uses.contains(&Encoding::Srgb) && uses.contains(&Encoding::Linear) {
            say(format!("/images/{index}"), "is used both as a colour and as data: one of the two is likely a mistake");
        }
        if uses.is_empty() {
            say(format!("/images/{index}"), "is used by no material");
        }
    }
    found
}
