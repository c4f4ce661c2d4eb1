// Group 1: the character that is drawn.
import package::lib::bangs::{bangs_weight, esm_tap};

struct Character {
    // Axes of the face as the head is posed, character space, unit.
    face_left: vec3f,
    face_up: vec3f,
    face_forward: vec3f,
    // Rows of the map of the bangs from character space: u, v (downwards) and depth, each 0..1.
    bangs_row_u: vec4f,
    bangs_row_v: vec4f,
    bangs_row_depth: vec4f,
    // Per unit of depth, and in units of depth.
    bangs_hardness: f32,
    bangs_bias: f32,
    // Eyes through hair: opacity, metres, cosines between which it fades.
    through_opacity: f32,
    through_window: f32,
    through_fade: vec2f,
    // Middle of the head, character space.
    head: vec3f,
}

@group(1) @binding(0) var<uniform> character: Character;
@group(1) @binding(1) var bangs_map: texture_2d<f32>;

fn bangs_from_character(position: vec3f) -> vec3f {
    let p = vec4f(position, 1.0);
    return vec3f(dot(character.bangs_row_u, p), dot(character.bangs_row_v, p), dot(character.bangs_row_depth, p));
}

// Share of light that the bangs let through to a place of their map. What lies beyond its border is lit.
fn bangs_lit(at: vec3f) -> f32 {
    if any(at.xy <= vec2f(0.0)) || any(at.xy >= vec2f(1.0)) {
        return 1.0;
    }
    let side = i32(textureDimensions(bangs_map).x);
    let p = at.xy * f32(side) - 0.5;
    let first = vec2i(floor(p)) - 2;
    let f = fract(p);
    var lit = 0.0;
    for (var y = 0; y < 5; y++) {
        var row = 0.0;
        for (var x = 0; x < 5; x++) {
            // Texels at the border stand for what lies beyond.
            let texel = clamp(first + vec2i(x, y), vec2i(0), vec2i(side - 1));
            let depth = textureLoad(bangs_map, texel, 0).r;
            row += bangs_weight(x, f.x) * esm_tap(depth, at.z, character.bangs_hardness, character.bangs_bias);
        }
        lit += bangs_weight(y, f.y) * row;
    }
    return lit;
}
