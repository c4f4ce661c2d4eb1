// Maps of shadows: those of the bangs on faces, and those of the key light.
import package::bind::actor::actors;
import package::bind::vertex::Vertex;
import package::lib::bangs::{BANGS_BLOCK, BANGS_TAPS, bangs_grazed, bangs_weight, esm_taps};
import package::lib::shadow::{shadow_edge, shadow_filtered, shadow_moved, shadow_place, shadow_reach};

@group(1) @binding(2) var bangs_map: texture_2d_array<f32>;
// Nearest depth round each block of it.
@group(1) @binding(3) var bangs_near: texture_2d_array<f32>;
@group(1) @binding(4) var bangs_sampler: sampler;
@group(1) @binding(5) var shadow_map: texture_depth_2d_array;
@group(1) @binding(6) var shadow_sampler: sampler_comparison;

// Maps of an actor: what casts on the face, and lids with lashes on the eyes.
const BANGS_LAYER: i32 = 0;
const LIDS_LAYER: i32 = 1;

// Place of a point of an actor, character space, in the map of its own bangs.
fn bangs_from_character(actor: u32, position: vec3f) -> vec3f {
    let a = &actors[actor];
    let p = vec4f(position, 1.0);
    return vec3f(dot(a.bangs_row_u, p), dot(a.bangs_row_v, p), dot(a.bangs_row_depth, p));
}

// The same of a point of the world.
fn bangs_from_world(actor: u32, position: vec3f) -> vec3f {
    let a = &actors[actor];
    let p = vec4f(position, 1.0);
    return vec3f(dot(a.bangs_world_row_u, p), dot(a.bangs_world_row_v, p), dot(a.bangs_world_row_depth, p));
}

// By how much depth a receiver with this unit normal, world space, is moved towards the light of the map.
fn bangs_nearer(actor: u32, normal: vec3f) -> f32 {
    let away = actors[actor].bangs_world_row_depth.xyz;
    return bangs_grazed(-dot(normal, away) / max(length(away), 1e-6));
}

// Place of a point of the world in the shadow map of an actor.
fn shadow_from_world(actor: u32, position: vec3f) -> vec3f {
    let a = &actors[actor];
    return shadow_place(position - a.shadow_middle, a.shadow_right, a.shadow_up, a.shadow_to_light, a.shadow_scale);
}

// The same for a receiver with its normal, which is moved towards the light; w is the layer.
fn shadow_receiver(v: Vertex, position: vec3f, normal: vec3f) -> vec4f {
    let a = &actors[v.actor];
    let at = shadow_from_world(v.actor, position);
    let by = shadow_moved(normal, a.shadow_right, a.shadow_up, a.shadow_to_light);
    return vec4f(at + by * a.shadow_bias, a.shadow_layer);
}

// Share of the key light that arrives there. What lies beyond the map is lit, and so is what the caller does not need
// (`wanted`).
fn shadow_lit(actor: u32, at: vec4f, wanted: bool) -> f32 {
    return shadow_drawn(actor, at, shadow_soft(actor, at, wanted));
}

// The same by what its map has: near or far, the edge is soft over two pixels.
fn shadow_drawn(actor: u32, at: vec4f, soft: f32) -> f32 {
    @if(skin_penumbra) return min(soft, actors[actor].key_light);
    @if(!skin_penumbra) {
        // By how the place moves: what the map has is not known beside the last pixel of a surface.
        let size = f32(textureDimensions(shadow_map).x);
        let texels_per_px = size * sqrt(0.5) * length(vec4f(dpdx(at.xy), dpdy(at.xy)));
        let width = clamp(2.0 * texels_per_px / shadow_reach(actors[actor].shadow_spread * size), 0.08, 0.7);
        return min(shadow_edge(soft, width), actors[actor].key_light);
    }
}

// Share of light that the shadow map lets through there, with an edge as wide as it is filtered.
fn shadow_soft(actor: u32, at: vec4f, wanted: bool) -> f32 {
    let layer = i32(round(at.w));
    let spread = actors[actor].shadow_spread;
    let is_outside = any(at.xy <= vec2f(0.0)) || any(at.xy >= vec2f(1.0)) || layer < 0;
    return shadow_filtered(shadow_map, shadow_sampler, at.xyz, layer, spread, wanted && !is_outside);
}

// How far behind the nearest surface a place of its shadow map lies, metres, between four texels.
fn shadow_depth(actor: u32, at: vec4f) -> f32 {
    let layer = i32(round(at.w));
    let size = vec2i(textureDimensions(shadow_map));
    let p = at.xy * vec2f(size) - 0.5;
    let f = fract(p);
    var four: vec4f;
    for (var i = 0; i < 4; i++) {
        let texel = clamp(vec2i(floor(p)) + vec2i(i % 2, i / 2), vec2i(0), size - 1);
        four[i] = max(at.z - textureLoad(shadow_map, texel, max(layer, 0), 0), 0.0);
    }
    let is_outside = any(at.xy <= vec2f(0.0)) || any(at.xy >= vec2f(1.0)) || layer < 0;
    let mean = mix(mix(four.x, four.y, f.x), mix(four.z, four.w, f.x), f.y);
    return select(mean / actors[actor].shadow_scale, 0.0, is_outside);
}

// How far light has come through a character to a place of its shadow map, metres: the mean of four by four places over twice
// the width of a shadow's edge.
fn shadow_thickness(actor: u32, at: vec4f) -> f32 {
    let layer = i32(round(at.w));
    let size = vec2i(textureDimensions(shadow_map));
    let step = max(actors[actor].shadow_spread * f32(size.x) * 0.5, 1.0);
    let first = at.xy * vec2f(size) - 1.5 * step;
    var sum = 0.0;
    for (var i = 0; i < 16; i++) {
        let texel = clamp(vec2i(first + vec2f(f32(i % 4), f32(i / 4)) * step), vec2i(0), size - 1);
        sum += max(at.z - textureLoad(shadow_map, texel, max(layer, 0), 0), 0.0);
    }
    let is_outside = any(at.xy <= vec2f(0.0)) || any(at.xy >= vec2f(1.0)) || layer < 0;
    return select(sum / 16.0 / actors[actor].shadow_scale, 0.0, is_outside);
}

// Share of light that a layer lets through to a place of the map. What lies beyond its border is lit, and so is what the
// caller does not need (`wanted`).
fn bangs_lit(actor: u32, at: vec3f, kind: i32, wanted: bool) -> f32 {
    let layer = i32(actors[actor].bangs_layer) + kind;
    let hardness = actors[actor].bangs_hardness;
    let bias = actors[actor].bangs_bias;
    let side = actors[actor].bangs_side;
    let origin = vec2i(actors[actor].bangs_origin);
    let last_block = vec2i(i32(side) - 1) / BANGS_BLOCK;
    let block = origin / BANGS_BLOCK + clamp(vec2i(at.xy * side) / BANGS_BLOCK, vec2i(0), last_block);
    let nearest = textureLoad(bangs_near, block, layer, 0).r;
    let is_outside = any(at.xy <= vec2f(0.0)) || any(at.xy >= vec2f(1.0));
    // Where nothing hangs before it every tap would let all light through. A count of 0 rather than a branch: software
    // rasterizers walk both sides of branches, but leave loops early.
    let is_lit = is_outside || nearest + bias >= at.z;
    let taps = select(BANGS_TAPS * BANGS_TAPS / 4, 0, is_lit || !wanted);
    let p = at.xy * side - 0.5;
    let first = vec2i(floor(p)) - 1 + origin;
    let size = vec2f(textureDimensions(bangs_map));
    let f = fract(p);
    var lit = select(0.0, 1.0, taps == 0);
    for (var i = 0; i < taps; i++) {
        // Four texels about a corner: (0, 1), (1, 1), (1, 0), (0, 0). Those at the border stand for what lies beyond.
        let x = i % (BANGS_TAPS / 2) * 2;
        let y = i / (BANGS_TAPS / 2) * 2;
        let corner = (vec2f(first + vec2i(x, y)) + 1.0) / size;
        let depth = textureGather(0, bangs_map, bangs_sampler, corner, layer);
        let tap = esm_taps(depth, at.z, hardness, bias);
        let across = vec2f(bangs_weight(x, f.x), bangs_weight(x + 1, f.x));
        lit += bangs_weight(y, f.y) * dot(across, tap.wz) + bangs_weight(y + 1, f.y) * dot(across, tap.xy);
    }
    // What the map does not reach is lit, without a seam at its border.
    let border = min(min(at.x, 1.0 - at.x), min(at.y, 1.0 - at.y));
    return mix(1.0, lit, smoothstep(0.0, 0.1, border));
}
