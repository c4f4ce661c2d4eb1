// The shadow of a face from its threshold maps.
import package::bind::frame::frame;
import package::bind::shown::shown;
import package::bind::surface::{Border, Surface};
import package::bind::varying::{Varying, in_face_frame};
import package::bind::vertex::Vertex;
import package::lib::face_shadow::{
    face_back_share, face_light_angle, face_lit, face_masked, face_measure, face_shading, face_side, face_stack_place,
    face_turn,
};
import package::look::skin::{EDGE_MOST, skin_edge_reach};
import package::material::{face_shadow_map, face_shadow_map_sampler, material};
import package::model::toon::soft_width;

struct FaceShadow {
    // Heights of the light, radians, for which the maps of the stack are painted, growing.
    pitches: vec4f,
    pitch_count: u32,
    // Angle over pi, and horizontal length of the direction to the light.
    softness: f32,
    overhead_fade: f32,
    // 1: thresholds are measured by the cosine of the angle.
    cosine: f32,
}

fn face_shadow_vary(v: Vertex, out: ptr<function, Varying>) {
    let light = in_face_frame(v, frame.to_light);
    let angle = face_light_angle(light, material.face_shadow.overhead_fade);
    let pitch = asin(clamp(light.y, -1.0, 1.0));
    out.face_light = vec4f(light.x, pitch, angle, face_measure(angle, material.face_shadow.cosine));
}

fn face_shadow_shade(s: ptr<function, Surface>, b: ptr<function, Border>) {
    let m = &material.face_shadow;
    @if(!face_relief) let uv = s.at.uv.xy;
    @if(face_relief) let uv = s.at.uv.zw;
    let light_x = s.at.face_light.x;
    let angle = s.at.face_light.z;
    let measure = s.at.face_light.w;
    var place = vec2f(0.0);
    @if(face_stack) place = face_stack_place(s.at.face_light.y, m.pitches, m.pitch_count);
    var map = face_map_at(uv, 0, place);
    var tau = face_side(map.rg, light_x);
    var lit = face_lit(tau, measure, m.softness);
    @if(soft) var soft = face_lit(tau, measure, soft_width());
    @if(face_back) {
        let back = face_map_at(uv, i32(m.pitch_count), place);
        let share = face_back_share(angle);
        tau = face_side(back.rg, light_x);
        lit = mix(lit, face_lit(tau, measure, m.softness), share);
        @if(soft) soft = mix(soft, face_lit(tau, measure, soft_width()), share);
        map = vec4f(map.rg, mix(map.ba, back.ba, share));
    }
    @if(face_masks) {
        var layer = i32(m.pitch_count);
        @if(face_back) layer *= 2;
        let masks = textureSample(face_shadow_map, face_shadow_map_sampler, uv, layer);
        let side = face_side(masks.rg, light_x);
        let back = face_side(masks.ba, light_x);
        lit = face_masked(lit, side, back, angle);
        @if(soft) soft = face_masked(soft, side, back, angle);
    }
    let region = map.b;
    let strength = map.a;
    @if(channel_face_map) shown = map.rgb;
    b.of_face = 1.0 - region;
    // The map's region fades over the jaw, under which shade must be whole.
    b.of_body = saturate(4.0 - 4.0 * b.of_face);
    b.shading = face_shading(b.shading, lit, region, strength);
    @if(soft) b.soft = face_shading(b.soft, soft, region, strength);
    @if(skin_edge) b.edge = face_shading(b.edge, face_edge(uv, s.at.face_light, place), region, strength);
}

// How far the light would have to turn for the border of the maps to lie there, radians.
@if(skin_edge)
fn face_turn_at(uv: vec2f, light: vec4f, place: vec2f) -> f32 {
    let m = &material.face_shadow;
    var turn = face_turn(face_side(face_map_at(uv, 0, place).rg, light.x), light.z, m.cosine);
    @if(face_back) {
        let back = face_map_at(uv, i32(m.pitch_count), place);
        turn = mix(turn, face_turn(face_side(back.rg, light.x), light.z, m.cosine), face_back_share(light.z));
    }
    return turn;
}

// Place across the warm edge of skin: how far the border is, by how fast the light comes nearer over the surface. Where it does
// not there is none: a spot that is about to be lit has no edge yet.
@if(skin_edge)
fn face_edge(uv: vec2f, light: vec4f, place: vec2f) -> f32 {
    let half = vec2f(0.5 * skin_edge_reach()) / max(material.skin.metres_per_uv, vec2f(1e-6));
    let here = face_turn_at(uv, light, place);
    let to_border = -sign(here);
    let u = vec2f(half.x, 0.0);
    let v = vec2f(0.0, half.y);
    let left = (face_turn_at(uv - u, light, place) - here) * to_border;
    let right = (face_turn_at(uv + u, light, place) - here) * to_border;
    let up = (face_turn_at(uv - v, light, place) - here) * to_border;
    let down = (face_turn_at(uv + v, light, place) - here) * to_border;
    let nearer = 2.0 * length(max(vec2f(max(left, right), max(up, down)), vec2f(0.0)));
    return clamp(here / clamp(nearer, 1e-4, EDGE_MOST), -2.0, 2.0);
}

// The map of the stack for the light's height; its thresholds lie between those of the two nearest ones.
fn face_map_at(uv: vec2f, first: i32, place: vec2f) -> vec4f {
    let low = textureSample(face_shadow_map, face_shadow_map_sampler, uv, first + i32(place.x));
    @if(!face_stack) return low;
    @if(face_stack) let last = first + i32(material.face_shadow.pitch_count) - 1;
    @if(face_stack) let high = textureSample(
        face_shadow_map, face_shadow_map_sampler, uv, min(first + i32(place.x) + 1, last)
    );
    @if(face_stack) return mix(low, high, place.y);
}
