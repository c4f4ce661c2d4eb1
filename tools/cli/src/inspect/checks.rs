//! What will look wrong though the file is sound: advice beside the warnings of the import.

use hikage::material::Encoding;
use hikage::material::{AlphaMode, Origin, Shading};
use hikage::scene::{Primitive, Role, Scene, Warning};

use super::memory::image_uses;

/// Share of the UV area that must be turned the other way before UVs count as mirrored.
const MIRRORED_SHARE: f64 = 0.25;

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
    for (mesh_index, mesh) in scene.meshes.iter().enumerate() {
        for (index, primitive) in mesh.primitives.iter().enumerate() {
            if primitive.role == Role::Face && mirrored_share(primitive) > MIRRORED_SHARE {
                say(
                    format!("/meshes/{mesh_index}/primitives/{index}"),
                    "the UVs of the face are mirrored: a face-shadow map cannot tell left from right",
                );
            }
        }
    }
    found
}

/// Share of the UV area that is wound the other way than the rest. Range 0..0.5.
fn mirrored_share(primitive: &Primitive) -> f64 {
    let Some(uvs) = primitive.uvs.first() else { return 0.0 };
    let (mut left, mut right) = (0f64, 0f64);
    for triangle in primitive.indices.chunks_exact(3) {
        let corner = |i: usize| uvs.get(triangle[i] as usize).map(|uv| uv.map(f64::from));
        let (Some(a), Some(b), Some(c)) = (corner(0), corner(1), corner(2)) else { continue };
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        *(if area > 0.0 { &mut left } else { &mut right }) += area.abs();
    }
    if left + right > 0.0 {
        left.min(right) / (left + right)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_face_turned_over_is_mirrored() {
        let right = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let both = [right.clone(), right.iter().map(|uv: &[f32; 2]| [-uv[0], uv[1]]).collect()].concat();
        let part = |uvs: Vec<[f32; 2]>| Primitive {
            indices: (0..uvs.len() as u32).collect(),
            uvs: vec![uvs],
            ..Primitive::default()
        };
        assert_eq!(mirrored_share(&part(right)), 0.0);
        assert_eq!(mirrored_share(&part(both)), 0.5);
    }
}
