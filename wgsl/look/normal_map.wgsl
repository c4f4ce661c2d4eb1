// Normals from a map.
import package::bind::surface::Surface;
import package::bind::uv::{UvTransform, texture_uv};
import package::lib::normal::normal_from_map;
import package::material::{material, normal_map_texture, normal_map_texture_sampler};

struct NormalMap {
    scale: f32,
    texture_uv: UvTransform,
}

fn normal_map_bend(surface: Surface) -> Surface {
    var s = surface;
    let bent = textureSample(
        normal_map_texture, normal_map_texture_sampler, texture_uv(s.uv, material.normal_map.texture_uv)
    ).xyz;
    s.normal = normal_from_map(bent, material.normal_map.scale, s.normal, s.tangent, s.at.tangent.w);
    return s;
}
