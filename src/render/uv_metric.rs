//! How large texture coordinates are on a surface.

use glam::{Vec2, Vec3};

use crate::material::Material;
use crate::scene::{Primitive, Scene};

/// Metres along a unit of u and of v on the surfaces of each material at rest: the mean over the texture, so that linings and
/// borders with hardly a place of their own there do not count; 1 where they span nothing. Only materials that ask are
/// measured.
pub(crate) fn metres_per_uv(scene: &Scene) -> Vec<[f32; 2]> {
    let mut sums = vec![[0.0f64; 3]; scene.materials.len()];
    let asks = |material: usize| scene.materials.get(material).is_some_and(measures);
    if (0..sums.len()).any(asks) {
        let rest = scene.rest_world_from_nodes();
        for (node, mesh) in scene.mesh_nodes() {
            for part in mesh.primitives.iter().filter(|p| asks(p.material)) {
                let position =
                    |i: u32| part.positions.get(i as usize).map(|p| rest[node].transform_vector3(Vec3::from(*p)));
                let uv = |i: u32| part.uvs.first().and_then(|set| set.get(i as usize)).copied().map(Vec2::from);
                for t in part.indices.chunks_exact(3) {
                    let ([Some(a), Some(b), Some(c)], [Some(ua), Some(ub), Some(uc)]) =
                        ([0, 1, 2].map(|k| position(t[k])), [0, 1, 2].map(|k| uv(t[k])))
                    else {
                        continue;
                    };
                    let (e, f, x, y) = (b - a, c - a, ub - ua, uc - ua);
                    let area_uv = x.perp_dot(y);
                    if area_uv.abs() < 1e-12 {
                        continue;
                    }
                    let along_u = f64::from(((e * y.y - f * x.y) / area_uv).length());
                    let along_v = f64::from(((f * x.x - e * y.x) / area_uv).length());
                    if along_u.is_finite() && along_v.is_finite() {
                        let (sum, weight) = (&mut sums[part.material], f64::from(area_uv.abs()));
                        *sum = [sum[0] + along_u * weight, sum[1] + along_v * weight, sum[2] + weight];
                    }
                }
            }
        }
    }
    let mean = |[u, v, weight]: [f64; 3]| {
        if weight > 0.0 {
            [(u / weight) as f32, (v / weight) as f32]
        } else {
            [1.0; 2]
        }
    };
    sums.into_iter().map(mean).collect()
}

/// Least texture coordinates of the first set on the surfaces of each material, and how far the others go beyond them;
/// nowhere where there are none. Only of materials whose light is spread over them.
pub(crate) fn uv_boxes(scene: &Scene) -> Vec<[[f32; 2]; 2]> {
    let parts =
        |material: usize| scene.meshes.iter().flat_map(|m| &m.primitives).filter(move |p| p.material == material);
    let box_of = |(material, of): (usize, &Material)| {
        let asks = of.scatters_over_uv();
        boxed(parts(material).filter(|_| asks).flat_map(|p| p.uvs.first().into_iter().flatten()))
    };
    scene.materials.iter().enumerate().map(box_of).collect()
}

/// The same of a part.
pub(crate) fn uv_box(part: &Primitive) -> [[f32; 2]; 2] {
    boxed(part.uvs.first().into_iter().flatten())
}

fn boxed<'a>(uvs: impl Iterator<Item = &'a [f32; 2]>) -> [[f32; 2]; 2] {
    let within = |(low, high): (Vec2, Vec2), uv: Vec2| (low.min(uv), high.max(uv));
    let finite = uvs.copied().map(Vec2::from).filter(|uv| uv.is_finite());
    let (low, high) = finite.fold((Vec2::INFINITY, Vec2::NEG_INFINITY), within);
    let extent = high - low;
    if extent.is_finite() {
        [low, extent]
    } else {
        [Vec2::ZERO; 2]
    }
    .map(|v| v.to_array())
}

/// Whether a material is measured.
fn measures(material: &Material) -> bool {
    material.is_hashed() || material.skin.is_some()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Material, Skin};
    use crate::scene::{Mesh, Node};

    #[test]
    fn a_strip_is_as_long_and_wide_as_its_texture_says() {
        let part = Primitive {
            positions: vec![[0.0; 3], [0.02, 0.0, 0.0], [0.02, 0.5, 0.0], [0.0, 0.5, 0.0]],
            uvs: vec![vec![[0.0, 1.0], [0.25, 1.0], [0.25, 0.0], [0.0, 0.0]]],
            indices: vec![0, 1, 2, 0, 2, 3],
            ..Primitive::default()
        };
        let mut scene = Scene {
            materials: vec![Material { skin: Some(Skin::default()), ..Material::default() }],
            meshes: vec![Mesh { primitives: vec![part], ..Mesh::default() }],
            nodes: vec![Node { mesh: Some(0), ..Node::default() }],
            ..Scene::default()
        };
        let [u, v] = metres_per_uv(&scene)[0];
        assert!((u - 0.08).abs() < 1e-6 && (v - 0.5).abs() < 1e-6, "{u} {v}");
        scene.materials[0].skin = None;
        assert_eq!(metres_per_uv(&scene), [[1.0; 2]]);
    }
}
