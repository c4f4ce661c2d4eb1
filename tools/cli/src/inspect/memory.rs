//! What a model will take on the GPU: an estimate from sizes alone, so that no GPU is needed.

use hikage::material::{Encoding, Material};
use hikage::scene::{Image, Primitive, Scene};

/// For each image: how it is used, each way once. An image that is used both ways is uploaded twice.
pub(super) fn image_uses(scene: &Scene) -> Vec<Vec<Encoding>> {
    let mut uses = vec![Vec::new(); scene.images.len()];
    for (_, texture, how) in scene.materials.iter().flat_map(Material::textures) {
        if let Some(list) = scene.textures.get(texture).and_then(|t| uses.get_mut(t.image))
            && !list.contains(&how)
        {
            list.push(how);
        }
    }
    uses.iter_mut().for_each(|u| u.sort());
    uses
}

/// Bytes of an image as RGBA8 with all its mip levels.
pub(super) fn mipped_bytes(image: &Image) -> u64 {
    let (mut width, mut height) = (u64::from(image.width), u64::from(image.height));
    let mut total = 0;
    while width > 0 && height > 0 {
        total += width * height * 4;
        if width == 1 && height == 1 {
            break;
        }
        (width, height) = ((width / 2).max(1), (height / 2).max(1));
    }
    total
}

/// Bytes of vertices, indices, skin influences and morph targets, and of the deformed copy of every drawn mesh.
pub(super) fn geometry_bytes(scene: &Scene) -> u64 {
    let stored: u64 = scene.meshes.iter().flat_map(|m| &m.primitives).map(primitive_bytes).sum();
    let deformed: u64 = scene
        .mesh_nodes()
        .flat_map(|(_, mesh)| &mesh.primitives)
        // Position, normal and outline normal, 16 bytes each; the tangent where there is one.
        .map(|p| p.positions.len() as u64 * if p.tangents.is_empty() { 48 } else { 64 })
        .sum();
    stored + deformed
}

fn primitive_bytes(p: &Primitive) -> u64 {
    let floats = |arrays: usize, width: usize| (arrays * width * 4) as u64;
    floats(p.positions.len() + p.normals.len() + p.outline_normals.len(), 3)
        + floats(p.tangents.len() + p.colors.len(), 4)
        + p.uvs.iter().map(|set| floats(set.len(), 2)).sum::<u64>()
        + floats(p.indices.len(), 1)
        + (p.influences.joints.len() * 2 + p.influences.weights.len() * 4) as u64
        + p.morphs.iter().map(|m| floats(m.vertices.len(), 7)).sum::<u64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mips_take_a_third_more() {
        let image = |width, height| Image { width, height, ..Image::default() };
        assert_eq!(mipped_bytes(&image(4, 4)), (16 + 4 + 1) * 4);
        assert_eq!(mipped_bytes(&image(4, 1)), (4 + 2 + 1) * 4);
        assert_eq!(mipped_bytes(&image(0, 4)), 0);
    }
}
