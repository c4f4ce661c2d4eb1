// Group 1: the character that is drawn.
import package::bind::vertex::{VertexInput, world_position};
import package::lib::bangs::{BANGS_BLOCK, BANGS_TAPS, bangs_weight, esm_taps};
import package::lib::shadow::{shadow_edge, shadow_place};

struct Character {
    // Axes of the face as the head is posed, character space, unit.
    face_left: vec3f,
    face_up: vec3f,
    face_forward: vec3f,
    // Rows of the map of the bangs from character space: u, v (downwards) and depth, each 0..1.
    bangs_row_u: vec4f,
    bangs_row_v: vec4f,
    bangs_row_depth: vec4f,
    // The same from the world, for what belongs to other characters.
    bangs_world_row_u: vec4f,
    bangs_world_row_v: vec4f,
    bangs_world_row_depth: vec4f,
    // Per unit of depth, and in units of depth.
    bangs_hardness: f32,
    bangs_bias: f32,
    // Eyes through hair: opacity, metres, cosines between which it fades.
    through_opacity: f32,
    through_window: f32,
    // Angles of the view to the side and to above or below at which it begins to fade and has gone, radians.
    through_fade_yaw: vec2f,
    through_fade_pitch: vec2f,
    // Middle of the head, character space.
    head: vec3f,
    // Axes of the shadow map in the world, unit, and one over its width, metres.
    shadow_right: vec3f,
    shadow_scale: f32,
    shadow_up: vec3f,
    // Distance by which a receiver is moved along its normal, shares of the width.
    shadow_bias: f32,
    shadow_to_light: vec3f,
    // Distance between two taps, shares of the width.
    shadow_spread: f32,
    // Its middle, character space.
    shadow_middle: vec3f,
    // Characters that have a map.
    shadow_layers: u32,
}

@group(1) @binding(0) var<uniform> character: Character;
@group(1) @binding(1) var bangs_map: texture_2d_array<f32>;
// Nearest depth round each block of it.
@group(1) @binding(2) var bangs_near: texture_2d_array<f32>;
@group(1) @binding(3) var bangs_sampler: sampler;
@group(1) @binding(4) var shadow_map: texture_depth_2d_array;
@group(1) @binding(5) var shadow_sampler: sampler_comparison;

// Layers of the map: what casts on the face, and lids with lashes on the eyes.
const BANGS_LAYER: i32 = 0;
const LIDS_LAYER: i32 = 1;

fn bangs_from_character(position: vec3f) -> vec3f {
    let p = vec4f(position, 1.0);
    return vec3f(dot(character.bangs_row_u, p), dot(character.bangs_row_v, p), dot(character.bangs_row_depth, p));
}

fn bangs_from_world(position: vec3f) -> vec3f {
    let p = vec4f(position, 1.0);
    return vec3f(
        dot(character.bangs_world_row_u, p), dot(character.bangs_world_row_v, p), dot(character.bangs_world_row_depth, p)
    );
}

// Place of a point of the world in the shadow map of the character that a vertex belongs to. Instances scale evenly.
fn shadow_from_world(v: VertexInput, position: vec3f) -> vec3f {
    let d = position - world_position(v, character.shadow_middle);
    let scale = character.shadow_scale / length(v.world_row_x.xyz);
    return shadow_place(d, character.shadow_right, character.shadow_up, character.shadow_to_light, scale);
}

// The same for a receiver with its normal, which is moved towards the light; w is the layer.
fn shadow_receiver(v: VertexInput, position: vec3f, normal: vec3f) -> vec4f {
    let at = shadow_from_world(v, position);
    // Most where the surface lies along the light.
    let n_dot_l = dot(normal, character.shadow_to_light);
    let along = sqrt(saturate(1.0 - n_dot_l * n_dot_l));
    let moved = normal * along + character.shadow_to_light * 0.5;
    let by = shadow_place(moved, character.shadow_right, character.shadow_up, character.shadow_to_light, 1.0) - 0.5;
    return vec4f(at + by * character.shadow_bias, f32(v.instance));
}

// Share of light that arrives there. What lies beyond the map is lit, and so is what the caller does not need (`wanted`).
fn shadow_lit(at: vec4f, wanted: bool) -> f32 {
    let layer = u32(at.w + 0.5);
    let is_outside = any(at.xy <= vec2f(0.0)) || any(at.xy >= vec2f(1.0)) || layer >= character.shadow_layers;
    // A count of 0 rather than a branch: software rasterizers walk both sides of branches, but leave loops early.
    let corners = select(4, 0, is_outside || !wanted);
    var lit = select(0.0, 4.0, corners == 0);
    for (var i = 0; i < corners; i++) {
        let offset = vec2f(f32(i % 2), f32(i / 2)) * 2.0 - 1.0;
        lit += textureSampleCompareLevel(
            shadow_map, shadow_sampler, at.xy + offset * character.shadow_spread, layer, at.z
        );
    }
    // Where the corners agree, so does what lies between: most of a picture.
    let agree = lit == 0.0 || lit == 4.0;
    let others = select(5, 0, agree);
    for (var i = 0; i < others; i++) {
        // The middle of the three rows, then of the columns.
        let offset = select(vec2f(f32(i) - 1.0, 0.0), vec2f(0.0, f32(i - 3) * 2.0 - 1.0), i >= 3);
        lit += textureSampleCompareLevel(
            shadow_map, shadow_sampler, at.xy + offset * character.shadow_spread, layer, at.z
        );
    }
    return shadow_edge(lit / select(9.0, 4.0, agree));
}

// Share of light that a layer lets through to a place of the map. What lies beyond its border is lit, and so is what the
// caller does not need (`wanted`).
fn bangs_lit(at: vec3f, layer: i32, wanted: bool) -> f32 {
    let side = i32(textureDimensions(bangs_map).x);
    let block = clamp(vec2i(at.xy * f32(side)) / BANGS_BLOCK, vec2i(0), vec2i(textureDimensions(bangs_near)) - 1);
    let nearest = textureLoad(bangs_near, block, layer, 0).r;
    let is_outside = any(at.xy <= vec2f(0.0)) || any(at.xy >= vec2f(1.0));
    // Where nothing hangs before it every tap would let all light through. A count of 0 rather than a branch: software
    // rasterizers walk both sides of branches, but leave loops early.
    let is_lit = is_outside || nearest + character.bangs_bias >= at.z;
    let taps = select(BANGS_TAPS * BANGS_TAPS / 4, 0, is_lit || !wanted);
    let p = at.xy * f32(side) - 0.5;
    let first = vec2i(floor(p)) - 1;
    let f = fract(p);
    var lit = select(0.0, 1.0, taps == 0);
    for (var i = 0; i < taps; i++) {
        // Four texels about a corner: (0, 1), (1, 1), (1, 0), (0, 0). Those at the border stand for what lies beyond.
        let x = i % (BANGS_TAPS / 2) * 2;
        let y = i / (BANGS_TAPS / 2) * 2;
        let corner = (vec2f(first + vec2i(x, y)) + 1.0) / f32(side);
        let depth = textureGather(0, bangs_map, bangs_sampler, corner, layer);
        let tap = esm_taps(depth, at.z, character.bangs_hardness, character.bangs_bias);
        let across = vec2f(bangs_weight(x, f.x), bangs_weight(x + 1, f.x));
        lit += bangs_weight(y, f.y) * dot(across, tap.wz) + bangs_weight(y + 1, f.y) * dot(across, tap.xy);
    }
    // What the map does not reach is lit, without a seam at its border.
    let border = min(min(at.x, 1.0 - at.x), min(at.y, 1.0 - at.y));
    return mix(1.0, lit, smoothstep(0.0, 0.1, border));
}
