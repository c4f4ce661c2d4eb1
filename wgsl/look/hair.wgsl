// Numbers of strands, and which way they run; wgsl/model/hair.wgsl lights them.
import package::bind::surface::{Surface, bitangent};
import package::bind::uv::{UvTransform, texture_uv};
import package::lib::normal::normalize_or;
import package::material::{hair_flow_map, hair_flow_map_sampler, hair_shift_map, hair_shift_map_sampler, material};

struct Hair {
    natural: f32,
    shift_amount: f32,
    wrap: f32,
    occlusion: f32,
    occlusion_strength: u32,
    steps: u32,
    edge: f32,
    // Sine and cosine.
    turn: vec2f,
    highlight_color: vec3f,
    flow_map_uv: UvTransform,
    shift_map_uv: UvTransform,
    kajiya_kay_primary_color: vec3f,
    kajiya_kay_primary_exponent: f32,
    kajiya_kay_secondary_color: vec3f,
    kajiya_kay_secondary_exponent: f32,
    kajiya_kay_primary_shift: f32,
    kajiya_kay_secondary_shift: f32,
    kajiya_kay_smoothness: f32,
    kajiya_kay_gray_scale: f32,
    // Of the primary and the secondary highlight and of Blinn's.
    kajiya_kay_direct: vec3f,
    kajiya_kay_indirect: vec3f,
    // Longitudinal scattering of R, TT, TRT and the rest: one over the variances, and what each is multiplied by.
    fibre_sharp: vec4f,
    fibre_scales: vec4f,
    // Sines and cosines of the tilts by the scales.
    fibre_tilt_r: vec2f,
    fibre_tilt_tt: vec2f,
    fibre_tilt_trt: vec2f,
    fibre_of_base: f32,
    fibre_variation: f32,
    fibre_absorption: vec3f,
    fibre_scatter: f32,
    fibre_density: f32,
    fibre_packing: f32,
}

// Direction of the strands, world, unit, from root to tip.
fn strand_direction(s: ptr<function, Surface>) -> vec3f {
    var t = s.tangent;
    @if(hair_flow_map) {
        let flow = textureSample(
            hair_flow_map, hair_flow_map_sampler, texture_uv(s.uv, material.hair.flow_map_uv)
        ).xy * 2.0 - 1.0;
        t = s.tangent * flow.x + bitangent(s) * flow.y;
    }
    @if(hair_turned) t = t * material.hair.turn.y + cross(s.normal, t) * material.hair.turn.x;
    // Where nothing is known they hang down.
    return normalize_or(t, vec3f(0.0, -1.0, 0.0));
}

// How far highlights are moved along the strands here.
fn strand_shift(s: ptr<function, Surface>) -> f32 {
    var shift = 0.0;
    @if(hair_shift_map) {
        let found = textureSample(
            hair_shift_map, hair_shift_map_sampler, texture_uv(s.uv, material.hair.shift_map_uv)
        ).r;
        shift = (found - 0.5) * material.hair.shift_amount;
    }
    return shift;
}
