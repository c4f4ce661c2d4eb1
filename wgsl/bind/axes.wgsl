// The frame in which a surface is shaded.
import package::bind::material::{
    material, detail_normal_texture, detail_sampler, normal_texture, normal_sampler,
};
import package::bind::options::{SurfaceOptions, has_tangents};
import package::bind::texel::texture_uv;
import package::lib::normal::{normal_from_map, normalize_or};

struct SurfaceAxes {
    // World, unit; bent by the normal map.
    normal: vec3f,
    // World, unit, along u; zero where nothing asks for it.
    tangent: vec3f,
}

// Of the normal and tangent of a fragment, not unit.
fn surface_axes(options: SurfaceOptions, n: vec3f, t: vec4f, uv: vec4f) -> SurfaceAxes {
    let normal = normalize(n);
    var tangent = vec3f(0.0);
    if has_tangents(options) {
        tangent = normalize_or(t.xyz - normal * dot(normal, t.xyz), vec3f(0.0));
    }
    if !options.normal_map && !options.fur_detail {
        return SurfaceAxes(normal, tangent);
    }
    var bent: vec3f;
    var scale = material.normal_scale;
    if options.fur_detail {
        let at = texture_uv(options, uv, material.detail_normal_uv);
        bent = textureSample(detail_normal_texture, detail_sampler, at).xyz;
        scale = material.fur_normal_scale;
    } else {
        bent = textureSample(normal_texture, normal_sampler, texture_uv(options, uv, material.normal_uv)).xyz;
    }
    return SurfaceAxes(normal_from_map(bent, scale, normal, tangent, t.w), tangent);
}
