// A painted highlight that moves.
import package::bind::actor::actors;
import package::bind::frame::frame;
import package::bind::shown::shown;
import package::bind::surface::{Border, Shaded, Surface};
import package::bind::uv::{UvTransform, texture_uv};
import package::bind::varying::Varying;
import package::bind::vertex::{Vertex, world_position, world_rotated};
import package::lib::highlight::{highlight_broken, highlight_fade, highlight_offset};
import package::material::{highlight_map, highlight_map_sampler, material};

struct Highlight {
    color: vec3f,
    strength: f32,
    second_color: vec3f,
    second_strength: f32,
    second_motion: f32,
    breakup: f32,
    in_shade: f32,
    facing: f32,
    // Movement along u, and along v by light and by view.
    turn_u: f32,
    light_v: f32,
    view_v: f32,
    map_uv: UvTransform,
}

fn highlight_vary(v: Vertex, out: ptr<function, Varying>) {
    let m = &material.highlight;
    let view = normalize(frame.eye - world_position(v, actors[v.actor].head));
    let forward = world_rotated(v, actors[v.actor].face_forward);
    let up = world_rotated(v, actors[v.actor].face_up);
    let offset = highlight_offset(view, frame.to_light, forward, up, m.turn_u, m.light_v, m.view_v);
    out.moved = vec3f(offset, highlight_fade(dot(view, forward), dot(view, frame.to_light), m.facing));
}

// Shares of both layers, moved.
fn highlight_layers(s: ptr<function, Surface>) -> vec2f {
    let m = &material.highlight;
    let moved = s.at.moved.xy;
    // The map is clamped at its border by its sampler.
    let at = texture_uv(s.uv, m.map_uv);
    var layers = textureSample(highlight_map, highlight_map_sampler, at + moved).rg;
    @if(highlight_apart) layers.y = textureSample(
        highlight_map, highlight_map_sampler, at + moved * vec2f(1.0, m.second_motion)
    ).g;
    @if(highlight_breakup) {
        let strand = textureSample(highlight_map, highlight_map_sampler, at).b;
        layers = vec2f(
            highlight_broken(layers.x, strand, m.breakup), highlight_broken(layers.y, strand, m.breakup)
        );
    }
    return layers;
}

fn highlight_shine(s: ptr<function, Surface>, l: ptr<function, Shaded>) {
    let m = &material.highlight;
    let layers = highlight_layers(s);
    let left = s.at.moved.z * mix(m.in_shade, 1.0, l.shading);
    @if(highlight_second) {
        let second = layers.y * m.second_strength * left;
        l.direct = mix(l.direct, m.second_color * l.light, second);
        @if(channel_highlight) shown = vec3f(second);
    }
    let first = layers.x * m.strength * left;
    l.direct = mix(l.direct, m.color * l.light, first);
    @if(channel_highlight) shown = max(shown, vec3f(first));
}

fn highlight_glow(s: ptr<function, Surface>, b: ptr<function, Border>) -> vec3f {
    let m = &material.highlight;
    let layers = highlight_layers(s);
    let left = s.at.moved.z * mix(m.in_shade, 1.0, b.shading);
    var light = m.color * (layers.x * m.strength * left);
    @if(highlight_second) light += m.second_color * (layers.y * m.second_strength * left);
    return light;
}
