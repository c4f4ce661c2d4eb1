// Where the textures of a material are read, and what of it is there.
import package::bind::frame::frame;
import package::bind::material::{
    UvTransform, material, base_texture, base_sampler, animation_mask_texture, animation_mask_sampler,
};
import package::bind::options::SurfaceOptions;
import package::bind::vanish::burning;
import package::lib::mtoon::mtoon_animate_uv;

// UVs of one texture: animation first, then KHR_texture_transform (MToon, "Compatibility with KHR_texture_transform").
fn texture_uv(options: SurfaceOptions, uv: vec4f, transform: UvTransform) -> vec2f {
    if !options.uv_transforms {
        return uv.xy;
    }
    let p = vec3f(select(uv.xy, uv.zw, transform.row_u.w > 0.5), 1.0);
    return vec2f(dot(transform.row_u.xyz, p), dot(transform.row_v.xyz, p));
}

// Both UV sets after the material's animation at the frame's time.
fn animated_uv(options: SurfaceOptions, uv: vec4f) -> vec4f {
    if !options.uv_animation {
        return uv;
    }
    var mask = 1.0;
    if options.uv_animation_mask {
        mask = textureSample(
            animation_mask_texture, animation_mask_sampler, texture_uv(options, uv, material.animation_mask_uv)
        ).b;
    }
    return moved_uv(uv, mask);
}

// Both UV sets moved by as much of the material's animation as `mask` says.
fn moved_uv(uv: vec4f, mask: f32) -> vec4f {
    let scroll = material.scroll_per_s * frame.time_s;
    let rotation = material.rotation_rad_per_s * frame.time_s;
    return vec4f(
        mtoon_animate_uv(uv.xy, scroll, rotation, mask), mtoon_animate_uv(uv.zw, scroll, rotation, mask)
    );
}

// What base colour and alpha are multiplied with: texture and vertex colour.
fn surface_texel(options: SurfaceOptions, color: vec4f, uv: vec4f) -> vec4f {
    var texel = vec4f(1.0);
    if options.base_texture {
        texel = textureSample(base_texture, base_sampler, texture_uv(options, uv, material.base_uv));
    }
    if options.vertex_color {
        texel *= color;
    }
    return texel;
}

// Whether nothing of the surface is there: cut out, or burnt.
fn surface_cut(options: SurfaceOptions, in_uv: vec4f, color: vec4f) -> bool {
    if options.dissolve && burning(in_uv.xy) < 0.0 {
        return true;
    }
    let texel = surface_texel(options, color, animated_uv(options, in_uv));
    return material.base_color.a * texel.a < material.alpha_cutoff;
}
