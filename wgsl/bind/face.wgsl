// The shadow of a face from its threshold maps.
import package::bind::material::{material, face_texture, face_sampler};
import package::lib::face_shadow::{face_back_share, face_lit, face_masked, face_side, face_stack_place};

// Parts of a map.
struct FaceOptions {
    stack: bool,
    back: bool,
    masks: bool,
}

// Light on a face by its map: with its own border and with that of the transition, share of normal shading, strength.
struct FaceLight {
    lit: f32,
    soft: f32,
    region: f32,
    strength: f32,
}

fn face_shading_at(options: FaceOptions, uv: vec2f, light: vec4f) -> FaceLight {
    let light_x = light.x;
    let angle = light.z;
    let measure = light.w;
    var place = vec2f(0.0);
    if options.stack {
        place = face_stack_place(light.y, material.face_pitches, material.face_pitch_count);
    }
    var map = face_map_at(options, uv, 0, place);
    var tau = face_side(map.rg, light_x);
    var lit = face_lit(tau, measure, material.face_softness);
    var soft = face_lit(tau, measure, material.transition_width);
    if options.back {
        let back = face_map_at(options, uv, i32(material.face_pitch_count), place);
        let share = face_back_share(angle);
        tau = face_side(back.rg, light_x);
        lit = mix(lit, face_lit(tau, measure, material.face_softness), share);
        soft = mix(soft, face_lit(tau, measure, material.transition_width), share);
        map = vec4f(map.rg, mix(map.ba, back.ba, share));
    }
    if options.masks {
        let layer = i32(material.face_pitch_count) * select(1, 2, options.back);
        let masks = textureSample(face_texture, face_sampler, uv, layer);
        let side = face_side(masks.rg, light_x);
        let back = face_side(masks.ba, light_x);
        lit = face_masked(lit, side, back, angle);
        soft = face_masked(soft, side, back, angle);
    }
    return FaceLight(lit, soft, map.b, map.a);
}

// The map of the stack for the light's height; its thresholds lie between those of the two nearest ones.
fn face_map_at(options: FaceOptions, uv: vec2f, first: i32, place: vec2f) -> vec4f {
    let low = textureSample(face_texture, face_sampler, uv, first + i32(place.x));
    if !options.stack {
        return low;
    }
    let last = first + i32(material.face_pitch_count) - 1;
    let high = textureSample(face_texture, face_sampler, uv, min(first + i32(place.x) + 1, last));
    return mix(low, high, place.y);
}
