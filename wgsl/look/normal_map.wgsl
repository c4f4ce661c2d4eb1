// Normals from a map.
import package::bind::surface::Surface;
import package::bind::uv::{UvTransform, texture_uv};
import package::lib::normal::{normal_from_map, normalize_or};
import package::material::{material, normal_map_texture, normal_map_texture_sampler};

struct NormalMap {
    scale: f32,
    texture_uv: UvTransform,
}

// Tangent along u with the sign of the bitangent (Mikkelsen 2010, by derivatives).
@if(strands_by_vertex)
fn texture_frame(n: vec3f, position: vec3f, uv: vec2f) -> vec4f {
    let px = dpdx(position);
    let py = dpdy(position);
    let ux = dpdx(uv);
    let uy = dpdy(uv);
    let across = cross(py, n);
    let down = cross(n, px);
    let t = across * ux.x + down * uy.x;
    let b = across * ux.y + down * uy.y;
    // v runs downwards in the texture.
    let tangent = normalize_or(t - n * dot(n, t), vec3f(1.0, 0.0, 0.0));
    return vec4f(tangent, select(1.0, -1.0, dot(cross(n, tangent), b) > 0.0));
}

// The normal without bumps of a mm and less, `bent` being by all of them; metres along u and v.
fn normal_map_smooth(bent: ptr<function, Surface>, metres_per_uv: vec2f) -> vec3f {
    let texels = vec2f(textureDimensions(normal_map_texture));
    let texel_mm = 1000.0 * max(metres_per_uv.x / texels.x, metres_per_uv.y / texels.y);
    // A whole one: half as many texels are read.
    let level = max(round(-log2(max(texel_mm, 1e-6))), 0.0);
    let normal = normalize(bent.at.normal);
    let at = texture_uv(bent.uv, material.normal_map.texture_uv);
    let found = textureSampleLevel(normal_map_texture, normal_map_texture_sampler, at, level).xyz;
    let geometric = select(normal, -normal, dot(normal, bent.view) < 0.0);
    return normal_from_map(found, material.normal_map.scale, geometric, bent.tangent, bent.at.tangent.w);
}

fn normal_map_bend(s: ptr<function, Surface>) {
    let bent = textureSample(
        normal_map_texture, normal_map_texture_sampler, texture_uv(s.uv, material.normal_map.texture_uv)
    ).xyz;
    // Where strands have taken the place of tangents, those of the texture come from its change over the picture.
    @if(strands_by_vertex) {
        let frame = texture_frame(s.normal, s.at.world_position, texture_uv(s.uv, material.normal_map.texture_uv));
        s.normal = normal_from_map(bent, material.normal_map.scale, s.normal, frame.xyz, frame.w);
    }
    @if(!strands_by_vertex) s.normal =
        normal_from_map(bent, material.normal_map.scale, s.normal, s.tangent, s.at.tangent.w);
}
