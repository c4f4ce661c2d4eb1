//! Warnings about what will look wrong though nothing is broken.

use std::collections::{BTreeMap, BTreeSet};

use crate::material::Encoding;
use crate::scene::{Role, Scene};

use super::fault::quoted;
use super::warnings::Warnings;

/// Looks over the finished scene.
pub(super) fn check(scene: &Scene, warnings: &mut Warnings) {
    check_face_uvs(scene, warnings);
    check_texture_uses(scene, warnings);
    for (index, skin) in scene.skins.iter().enumerate() {
        if skin.joints.len() > 256 {
            warnings.add(
                format!("/skins/{index}"),
                format!("{} joints: fine here, over the limit of many engines", skin.joints.len()),
            );
        }
    }
    // A file of movements has nothing to draw.
    if scene.animation_rig.is_none() && scene.meshes.iter().all(|m| m.primitives.is_empty()) {
        warnings.add("/meshes", "nothing to draw: no mesh has triangles");
    }
}

/// Faces whose halves share texels cannot carry a face-shadow map or one-sided make-up.
#[allow(clippy::arithmetic_side_effects, reason = "float vectors cannot overflow")]
fn check_face_uvs(scene: &Scene, warnings: &mut Warnings) {
    for (index, mesh) in scene.meshes.iter().enumerate() {
        for (part, primitive) in mesh.primitives.iter().enumerate().filter(|(_, p)| p.role == Role::Face) {
            let Some(uv) = primitive.uvs.first() else { continue };
            let (mut positive, mut negative) = (0.0f64, 0.0f64);
            for corners in primitive.indices.as_chunks::<3>().0 {
                let [a, b, c] =
                    corners.map(|i| glam::Vec2::from_array(uv.get(i as usize).copied().unwrap_or_default()).as_dvec2());
                let area = (b - a).perp_dot(c - a);
                if area > 0.0 {
                    positive += area;
                } else if area.is_finite() {
                    negative -= area;
                }
            }
            if positive.min(negative) > 0.2 * (positive + negative) {
                warnings.add(
                    format!("/meshes/{index}/primitives/{part}"),
                    "face UVs are mirrored: left and right share texels, so a face-shadow map that is drawn over them cannot \
                     tell them apart; one that a look makes from the mesh can",
                );
            }
        }
    }
}

/// Images used as colour and as data, and data stored with JPEG's losses.
fn check_texture_uses(scene: &Scene, warnings: &mut Warnings) {
    let mut color: BTreeSet<usize> = BTreeSet::new();
    let mut data: BTreeMap<usize, usize> = BTreeMap::new();
    for (index, material) in scene.materials.iter().enumerate() {
        for (_, texture, encoding) in material.textures() {
            let Some(image) = scene.textures.get(texture).map(|t| t.image) else { continue };
            match encoding {
                Encoding::Srgb => {
                    color.insert(image);
                }
                Encoding::Linear => {
                    data.entry(image).or_insert(index);
                }
            }
        }
    }
    for (image, material) in data {
        let Some(picture) = scene.images.get(image) else { continue };
        let pointer = format!("/materials/{material}");
        if color.contains(&image) {
            warnings.add(
                &pointer,
                format!("image {} is used as colour (sRGB) and as mask or normal map (linear)", quoted(&picture.name)),
            );
        }
        if picture.format == "jpeg" {
            warnings.add(
                &pointer,
                format!("mask or normal map {} is a JPEG: expect blocks in the shading", quoted(&picture.name)),
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Mesh, Primitive};

    #[test]
    fn half_a_face_turned_over_is_mirrored() {
        let right = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let both = [right.clone(), right.iter().map(|uv: &[f32; 2]| [-uv[0], uv[1]]).collect()].concat();
        for (uvs, count) in [(right, 0), (both, 1)] {
            let face = Primitive {
                role: Role::Face,
                indices: (0..).take(uvs.len()).collect(),
                uvs: vec![uvs],
                ..Primitive::default()
            };
            let meshes = vec![Mesh { primitives: vec![face], ..Mesh::default() }];
            let mut warnings = Warnings::default();
            check_face_uvs(&Scene { meshes, ..Scene::default() }, &mut warnings);
            assert_eq!(warnings.finish().len(), count);
        }
    }
}
