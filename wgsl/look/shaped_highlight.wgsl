// A highlight with a drawn shape, and what polished metal mirrors.
import package::bind::frame::frame;
import package::bind::shown::shown;
import package::bind::surface::{Border, Shaded, Surface};
import package::bind::uv::UvTransform;
import package::lib::shaped_highlight::{
    highlight_brushed, highlight_distance, highlight_inside, highlight_moved,
};
import package::material::{material, shaped_highlight_map, shaped_highlight_map_sampler};

struct ShapedHighlight {
    color: vec3f,
    strength: f32,
    translate: vec2f,
    split: vec2f,
    // Cosine and sine.
    turn: vec2f,
    squash: f32,
    // Sine of the half angle.
    size_sin: f32,
    square: f32,
    in_shade: f32,
    anisotropy: f32,
    // One over the width of the map.
    map_scale: f32,
    matcap_mix: f32,
}

// Share of the highlight.
fn shaped_share(s: ptr<function, Surface>) -> f32 {
    let m = &material.shaped_highlight;
    let n = s.normal;
    var axis = vec3f(frame.view_from_world[0].x, frame.view_from_world[1].x, frame.view_from_world[2].x);
    @if(shaped_brushed) axis = s.tangent;
    // 1e-4: an axis along the normal has no direction on the surface.
    let level = normalize(axis - n * dot(n, axis) + vec3f(0.0, 1e-4, 0.0));
    let upright = cross(n, level);
    let x = level * m.turn.x + upright * m.turn.y;
    let y = upright * m.turn.x - level * m.turn.y;
    let half_way = normalize(frame.to_light + s.view);
    let h = highlight_moved(half_way, x, y, m.translate, m.squash, m.split);
    var at = vec2f(dot(h, x), dot(h, y));
    @if(shaped_brushed) at = highlight_brushed(at.x, at.y, m.anisotropy);
    var share: f32;
    @if(shaped_highlight_map) {
        let uv = 0.5 + at * vec2f(m.map_scale, -m.map_scale);
        let drawn = textureSample(shaped_highlight_map, shaped_highlight_map_sampler, uv).r;
        let inside = all(uv > vec2f(0.0)) && all(uv < vec2f(1.0));
        share = select(0.0, drawn, inside);
    }
    @if(!shaped_highlight_map) {
        let away = highlight_distance(at.x, at.y, m.square);
        share = highlight_inside(away, m.size_sin, fwidth(away));
    }
    // Where the surface looks along the brush it has no direction.
    @if(shaped_brushed) share *= smoothstep(0.25, 0.6, length(axis - n * dot(n, axis)));
    return select(0.0, share, dot(h, n) > 0.0);
}

fn shaped_highlight_shine(s: ptr<function, Surface>, l: ptr<function, Shaded>) {
    let m = &material.shaped_highlight;
    @if(matcap) {
        // Metal tints what it mirrors.
        let tinted = l.lit / max(max(l.lit.r, l.lit.g), max(l.lit.b, 1e-3));
        l.direct = mix(l.direct, l.matcap * tinted * l.light * mix(0.6, 1.0, l.shading), m.matcap_mix);
        l.matcap *= 1.0 - m.matcap_mix;
    }
    let share = shaped_share(s) * (mix(m.in_shade, 1.0, l.shading) * m.strength);
    l.direct = mix(l.direct, m.color * l.light, share);
    @if(channel_highlight) shown = max(shown, vec3f(share));
}

fn shaped_highlight_glow(s: ptr<function, Surface>, b: ptr<function, Border>) -> vec3f {
    let m = &material.shaped_highlight;
    return m.color * (shaped_share(s) * (mix(m.in_shade, 1.0, b.shading) * m.strength));
}
