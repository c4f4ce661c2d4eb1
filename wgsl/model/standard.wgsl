// A physical surface, metal or not.
import package::bind::environment::{environment_brdf, environment_irradiance, environment_radiance};
import package::bind::frame::frame;
import package::bind::lights::punctual_light;
import package::bind::shown::shown;
import package::bind::surface::{Shaded, Surface, border_of, shaded_of};
import package::bind::uv::texture_uv;
import package::lib::brdf::{LEAST_ALPHA, f0_of_ior, ggx_distribution, schlick, smith_visibility};
import package::material::{
    material, stage_shade, standard_map, standard_map_sampler, standard_occlusion, standard_occlusion_sampler,
};

// What of a surface all lights ask for.
struct Substance {
    // Colour of scattered light, and reflectance at normal incidence.
    diffuse: vec3f,
    f0: vec3f,
    alpha: f32,
    n_dot_v: f32,
    // What a mirror of this roughness loses in one bounce is given back in its colour.
    regained: vec3f,
}

// Radiance over the light of one direction.
fn standard_lobe(s: ptr<function, Surface>, m: Substance, to_light: vec3f) -> vec3f {
    let n_dot_l = saturate(dot(s.normal, to_light));
    let h = normalize(s.view + to_light);
    let n_dot_h = saturate(dot(s.normal, h));
    let f = schlick(m.f0, dot(s.view, h));
    // A light of strength 1 is an irradiance of pi.
    let d = ggx_distribution(n_dot_h, m.alpha) * 3.14159265;
    let mirrored = f * m.regained * (d * smith_visibility(n_dot_l, m.n_dot_v, m.alpha));
    return ((1.0 - f) * m.diffuse + mirrored) * n_dot_l;
}

// Light on a surface without tones: what of the key light arrives where it is `wanted`, by the looks that shade toon surfaces,
// and what comes from all around.
fn physical_light(s: ptr<function, Surface>, wanted: bool) -> Shaded {
    var l = shaded_of(s);
    var b = border_of(s);
    b.shade = s.lit;
    b.shading = f32(wanted);
    stage_shade(s, &b);
    l.shading = b.shading;
    l.own_lit = l.shading;
    l.gi = environment_irradiance(s.normal);
    return l;
}

fn standard_model(s: ptr<function, Surface>) -> Shaded {
    let numbers = &material.standard;
    var l = physical_light(s, s.n_dot_l > 0.0);
    var metallic = numbers.metallic;
    var roughness = numbers.roughness;
    var occlusion = 1.0;
    @if(standard_map) {
        let found = textureSample(standard_map, standard_map_sampler, texture_uv(s.uv, numbers.map_uv)).rgb;
        metallic *= found.b;
        roughness *= found.g;
        @if(standard_occlusion_in_map) occlusion = found.r;
    }
    @if(standard_occlusion && !standard_occlusion_in_map) occlusion = textureSample(
        standard_occlusion, standard_occlusion_sampler, texture_uv(s.uv, numbers.occlusion_uv)
    ).r;
    occlusion = mix(1.0, occlusion, numbers.occlusion_strength);
    var m: Substance;
    m.n_dot_v = max(dot(s.normal, s.view), 1e-3);
    m.alpha = max(roughness * roughness, LEAST_ALPHA);
    m.f0 = mix(vec3f(f0_of_ior(numbers.ior)), s.lit, metallic);
    m.diffuse = s.lit * (1.0 - metallic);
    let brdf = environment_brdf(m.n_dot_v, roughness);
    let once = brdf.x + brdf.y;
    m.regained = 1.0 + m.f0 * (1.0 / max(once, 1e-3) - 1.0);
    l.direct = standard_lobe(s, m, frame.to_light) * s.light * l.shading;
    @if(punctual) for (var i = 0u; i < frame.punctual_count; i++) {
        let arriving = punctual_light(i, s.at.world_position);
        l.direct += standard_lobe(s, m, arriving.to_light) * arriving.radiance;
    }
    let mirrored = m.f0 * brdf.x + brdf.y;
    let all = mirrored * m.regained;
    // What is not mirrored is scattered.
    l.ambient = (all * environment_radiance(reflect(-s.view, s.normal), roughness)
        + (1.0 - all) * m.diffuse * l.gi) * occlusion;
    @if(channel_standard) shown = vec3f(metallic, roughness, occlusion);
    return l;
}
