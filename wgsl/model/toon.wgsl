// Two tones with a border between them (MToon), or a painted ramp.
import package::bind::frame::frame;
import package::bind::lights::{ambient, punctual_light};
import package::bind::shown::shown;
import package::bind::surface::{Border, Shaded, Surface, border_of, shaded_of, taken_from_lamps};
import package::bind::uv::texture_uv;
import package::lib::light::{lamp_shade, luminance};
import package::lib::mtoon::{mtoon_direct, mtoon_gi, mtoon_shading};
import package::look::shade_ramp::ramp_color;
import package::look::skin::{skin_edge, skin_edge_angle};
import package::material::{material, stage_shade, toon_shift_texture, toon_shift_texture_sampler};

// Reach of the soft border: of the ramp, or of the transition.
fn soft_width() -> f32 {
    var width = 0.0;
    @if(transition) width = material.transition.width;
    @if(shade_ramp) width = material.shade_ramp.width;
    return width;
}

// Where light ends: on the normals, and then as looks have it.
fn toon_border(s: ptr<function, Surface>) -> Border {
    var b = border_of(s);
    var shift = material.toon.shift;
    @if(toon_shift_texture) shift += material.toon.shift_texture_scale * textureSample(
        toon_shift_texture, toon_shift_texture_sampler, texture_uv(s.uv, material.toon.shift_texture_uv)
    ).r;
    b.shading = mtoon_shading(s.n_dot_l, shift, material.toon.toony);
    b.shift = shift;
    @if(soft) b.soft = smoothstep(-soft_width(), soft_width(), s.n_dot_l + shift);
    @if(skin_edge) b.edge = clamp(asin(clamp(s.n_dot_l + shift, -1.0, 1.0)) / skin_edge_angle(s), -2.0, 2.0);
    stage_shade(s, &b);
    @if(channel_face_shadow && face_shadow) shown = vec3f(b.shading);
    @if(channel_face_shadow && !face_shadow) shown = vec3f(b.shading) * 0.25;
    return b;
}

// Light on a toon surface, for whatever its colour becomes.
fn toon_light(s: ptr<function, Surface>, b: ptr<function, Border>) -> Shaded {
    var l = shaded_of(s);
    l.lit = b.lit;
    l.shading = b.shading;
    l.own_lit = b.own_lit;
    l.gi = mtoon_gi(ambient(s.normal.y), frame.ambient_sky, frame.ambient_ground, material.toon.gi_equalization);
    return l;
}

fn toon_model(s: ptr<function, Surface>) -> Shaded {
    var b = toon_border(s);
    var l = toon_light(s, &b);
    l.ambient = l.gi * b.lit;
    @if(shade_ramp) {
        var ramped = ramp_color(s.uv, b.lit, b.shade, b.soft);
        @if(bangs_shadow || cast_shadow) ramped = mix(ramped, ramp_color(s.uv, b.lit, b.shade, 0.0), b.received);
        l.direct = ramped * s.light;
        @if(channel_shade_ramp) shown = vec3f(b.soft * (1.0 - b.received));
    }
    @if(!shade_ramp) l.direct = mtoon_direct(b.lit * b.tint, b.shade, b.shading, s.light) * b.bangs;
    @if(skin_edge) l.direct = skin_edge(s, &b, l.direct);
    @if(punctual) l.direct += light_of_lamps(s, &b);
    return l;
}

// What lamps add: each has a border of its own, and one shade at most.
fn light_of_lamps(s: ptr<function, Surface>, b: ptr<function, Border>) -> vec3f {
    var lit = vec3f(0.0);
    var shade = vec3f(0.0);
    let key = luminance(frame.light_color);
    @if(punctual) for (var i = 0u; i < frame.punctual_count; i++) {
        let arriving = punctual_light(i, s.at.world_position);
        let shading = mtoon_shading(dot(s.normal, arriving.to_light), b.shift, material.toon.toony);
        lit += arriving.radiance * shading;
        shade += arriving.radiance * ((1.0 - shading) * lamp_shade(luminance(arriving.radiance), key));
    }
    let all = lit + shade;
    let taken = taken_from_lamps(s, all) / max(all, vec3f(1e-6));
    var color = b.lit;
    @if(shade_ramp) color = ramp_color(s.uv, b.lit, b.shade, 1.0);
    return (color * lit + b.shade * shade) * taken;
}
