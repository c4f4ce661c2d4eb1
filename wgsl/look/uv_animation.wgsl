// Texture coordinates that move by themselves.
import package::bind::frame::frame;
import package::bind::uv::{UvTransform, texture_uv};
import package::lib::mtoon::mtoon_animate_uv;
import package::material::{material, uv_animation_mask, uv_animation_mask_sampler};

struct UvAnimation {
    scroll_u_per_s: f32,
    scroll_v_per_s: f32,
    rotation_rad_per_s: f32,
    mask_uv: UvTransform,
}

// Both UV sets moved by as much as `mask` says.
fn moved_uv(uv: vec4f, mask: f32) -> vec4f {
    let scroll = vec2f(material.uv_animation.scroll_u_per_s, material.uv_animation.scroll_v_per_s) * frame.time_s;
    let rotation = material.uv_animation.rotation_rad_per_s * frame.time_s;
    return vec4f(
        mtoon_animate_uv(uv.xy, scroll, rotation, mask), mtoon_animate_uv(uv.zw, scroll, rotation, mask)
    );
}

fn uv_animation_uv(uv: vec4f) -> vec4f {
    var mask = 1.0;
    @if(uv_animation_mask) mask = textureSample(
        uv_animation_mask, uv_animation_mask_sampler, texture_uv(uv, material.uv_animation.mask_uv)
    ).b;
    return moved_uv(uv, mask);
}

// The same in a vertex stage.
fn uv_animation_vertex_uv(uv: vec4f) -> vec4f {
    var mask = 1.0;
    @if(uv_animation_mask) mask = textureSampleLevel(
        uv_animation_mask, uv_animation_mask_sampler, texture_uv(uv, material.uv_animation.mask_uv), 0.0
    ).b;
    return moved_uv(uv, mask);
}
