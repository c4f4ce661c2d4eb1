// Painted fur.
import package::bind::shown::shown;
import package::bind::surface::Surface;
import package::bind::uv::{UvTransform, texture_uv};
import package::lib::fur::{fur_color, fur_masks};
import package::lib::normal::normal_from_map;
import package::look::toon::shade_color;
import package::material::{
    base_texture, base_texture_sampler, fur_detail_detail_color, fur_detail_detail_color_sampler, fur_detail_detail_normal,
    fur_detail_detail_normal_sampler, material,
};

struct FurDetail {
    shares: vec3f,
    normal_scale: f32,
    terminator: vec2f,
    softness: f32,
    blur_levels: f32,
    detail_normal_uv: UvTransform,
    detail_color_uv: UvTransform,
}

fn fur_detail_bend(s: ptr<function, Surface>) {
    let at = texture_uv(s.uv, material.fur_detail.detail_normal_uv);
    let bent = textureSample(fur_detail_detail_normal, fur_detail_detail_normal_sampler, at).xyz;
    s.normal = normal_from_map(bent, material.fur_detail.normal_scale, s.normal, s.tangent, s.at.tangent.w);
}

fn fur_detail_paint(s: ptr<function, Surface>) {
    let m = &material.fur_detail;
    let fur = fur_masks(s.n_dot_l, m.terminator, m.softness);
    var flat_color = s.texel.rgb;
    var detail = s.texel.rgb;
    @if(fur_detail_detail_color) {
        detail = textureSample(
            fur_detail_detail_color, fur_detail_detail_color_sampler, texture_uv(s.uv, m.detail_color_uv)
        ).rgb;
        @if(vertex_color) detail *= s.at.color.rgb;
    }
    @if(base_texture && !fur_detail_detail_color) {
        let at = texture_uv(s.uv, material.base.texture_uv);
        flat_color = textureSampleBias(base_texture, base_texture_sampler, at, m.blur_levels).rgb;
        @if(vertex_color) flat_color *= s.at.color.rgb;
    }
    s.texel = vec4f(fur_color(fur, m.shares, flat_color, detail), s.texel.a);
    s.lit = material.base.color.rgb * s.texel.rgb;
    @if(toon) s.shade = shade_color(s);
    @if(channel_fur) shown = fur;
}
