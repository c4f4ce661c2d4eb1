// Rim of MToon, with the matcap.
import package::bind::surface::{Shaded, Surface};
import package::bind::uv::{UvTransform, texture_uv};
import package::lib::mtoon::{mtoon_parametric_rim, mtoon_rim};
import package::material::{material, rim_mask, rim_mask_sampler};

struct Rim {
    color: vec3f,
    fresnel_power: f32,
    lift: f32,
    lighting_mix: f32,
    mask_uv: UvTransform,
}

fn rim_contour(s: ptr<function, Surface>, l: ptr<function, Shaded>, color: vec3f) -> vec3f {
    let m = &material.rim;
    var parametric = vec3f(0.0);
    @if(rim_color) parametric = m.color * mtoon_parametric_rim(dot(s.normal, s.view), m.lift, m.fresnel_power);
    var mask = vec3f(1.0);
    @if(rim_mask) mask = textureSample(rim_mask, rim_mask_sampler, texture_uv(s.uv, m.mask_uv)).rgb;
    return color + mtoon_rim(l.matcap, parametric, mask, l.light + l.gi, m.lighting_mix);
}
