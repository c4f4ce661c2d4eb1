// Colour in shade; wgsl/model/toon.wgsl shades with it.
import package::bind::surface::Surface;
import package::bind::uv::{UvTransform, surface_texel, texture_uv};
import package::bind::varying::Varying;
import package::material::{material, toon_shade_texture, toon_shade_texture_sampler};

struct Toon {
    shade_color: vec3f,
    shift: f32,
    shift_texture_scale: f32,
    toony: f32,
    gi_equalization: f32,
    shade_texture_uv: UvTransform,
    shift_texture_uv: UvTransform,
}

fn shade_color(s: ptr<function, Surface>) -> vec3f {
    var shade = material.toon.shade_color;
    @if(shade_is_base) shade *= s.texel.rgb;
    @if(toon_shade_texture && !shade_is_base) shade *= surface_texel(
        toon_shade_texture, toon_shade_texture_sampler, texture_uv(s.uv, material.toon.shade_texture_uv)
    ).rgb;
    @if(vertex_color && !shade_is_base) shade *= s.at.color.rgb;
    return shade;
}

fn toon_surface(s: ptr<function, Surface>) {
    s.shade = shade_color(s);
}
