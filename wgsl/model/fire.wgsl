// Fire: in its own light, and seen through.
import package::bind::frame::frame;
import package::bind::shown::shown;
import package::bind::surface::{Shaded, Surface, shaded_of};
import package::bind::uv::texture_uv;
import package::lib::fire::{fire_color, fire_cover, fire_heated, fire_noise, fire_shape, fire_sway};
import package::material::{fire_heat, fire_heat_sampler, material};

// Its colour and cover.
fn burning_shape(s: ptr<function, Surface>) -> vec4f {
    let m = &material.fire;
    var at = texture_uv(s.uv, m.heat_uv);
    let phase = fract(frame.time_s / m.period_s);
    let noise = fire_noise(at, phase, m.cells);
    at.x += fire_sway(at, phase, m.cells, m.sway);
    var shape = fire_shape(at);
    @if(fire_heat) shape = textureSample(fire_heat, fire_heat_sampler, at).r;
    let heat = fire_heated(shape, noise, m.turbulence);
    @if(channel_fire) shown = vec3f(heat);
    return vec4f(
        fire_color(heat, m.rim, m.body, m.heart, m.edges, m.softness), fire_cover(heat, m.erosion, m.softness)
    );
}

fn fire_model(s: ptr<function, Surface>) -> Shaded {
    var l = shaded_of(s);
    let shape = burning_shape(s);
    l.direct = shape.rgb;
    l.emission = vec3f(0.0);
    l.cover = shape.a;
    l.adds = material.fire.additive;
    return l;
}

// It blooms whole.
fn fire_emitted(s: ptr<function, Surface>) -> vec3f {
    let shape = burning_shape(s);
    return shape.rgb * shape.a;
}
