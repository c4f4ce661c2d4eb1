// Colours between shade and light from a ramp, by part; wgsl/model/toon.wgsl asks for them.
import package::bind::frame::frame;
import package::bind::uv::{UvTransform, texture_uv};
import package::lib::shade_ramp::{part_number, ramp_bands};
import package::material::{
    material, shade_ramp_cool, shade_ramp_part_ids, shade_ramp_warm, shade_ramp_warm_sampler,
};

struct ShadeRamp {
    terminator_color: vec3f,
    // Middle of the material's row.
    v: f32,
    edges: vec4f,
    // Those of the parts.
    part_v: array<vec4f, 2>,
    // What turns hue and saturation of shade, for warm and for cool light.
    shift_warm: mat3x3f,
    shift_cool: mat3x3f,
    part_ids_uv: UvTransform,
    width: f32,
}

// Lit colour at a place of the ramp between full shade (0) and full light (1).
fn ramp_color(uv: vec4f, lit: vec3f, shade: vec3f, place: f32) -> vec3f {
    @if(shade_ramp_maps) {
        var v = material.shade_ramp.v;
        @if(shade_ramp_part_ids) {
            // The texel itself: numbers are not filtered.
            let size = vec2f(textureDimensions(shade_ramp_part_ids));
            let at = fract(texture_uv(uv, material.shade_ramp.part_ids_uv));
            let part = part_number(textureLoad(shade_ramp_part_ids, vec2i(at * size), 0).r);
            if part >= 0 {
                v = material.shade_ramp.part_v[part / 4][part % 4];
            }
        }
        let at = vec2f(place, v);
        let warm = textureSampleLevel(shade_ramp_warm, shade_ramp_warm_sampler, at, 0.0).rgb;
        let cool = textureSampleLevel(shade_ramp_cool, shade_ramp_warm_sampler, at, 0.0).rgb;
        return lit * mix(warm, cool, frame.coolness);
    }
    @if(!shade_ramp_maps) {
        let m = &material.shade_ramp;
        var dark = shade;
        // Colours that a turn takes out of the gamut are cut.
        @if(shade_ramp_shift) dark = max(mix(m.shift_warm * shade, m.shift_cool * shade, frame.coolness), vec3f(0.0));
        return ramp_bands(lit, dark, lit * m.terminator_color, m.edges, place);
    }
}
