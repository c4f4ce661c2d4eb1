// Colours between shade and light from a ramp, by part.
import package::bind::frame::frame;
import package::bind::material::{material, face_sampler, part_ids_texture, ramp_cool_texture, ramp_warm_texture};
import package::bind::options::SurfaceOptions;
import package::bind::texel::texture_uv;
import package::lib::shade_ramp::ramp_bands;

// Number of the part at a place, from 0 on; -1 where the map knows none. The texel itself: numbers are not filtered.
fn part_at(options: SurfaceOptions, uv: vec4f) -> i32 {
    let size = vec2f(textureDimensions(part_ids_texture));
    let at = fract(texture_uv(options, uv, material.part_ids_uv));
    let part = i32(textureLoad(part_ids_texture, vec2i(at * size), 0).r * 255.0 + 0.5) - 1;
    return select(-1, part, part < 8);
}

// Lit colour at a place of the ramp between full shade (0) and full light (1).
fn ramp_color(options: SurfaceOptions, uv: vec4f, lit: vec3f, shade: vec3f, place: f32) -> vec3f {
    if options.ramp_maps {
        var v = material.ramp_v;
        if options.ramp_parts {
            let part = part_at(options, uv);
            if part >= 0 {
                v = material.ramp_part_v[part / 4][part % 4];
            }
        }
        let at = vec2f(place, v);
        let warm = textureSampleLevel(ramp_warm_texture, face_sampler, at, 0.0).rgb;
        let cool = textureSampleLevel(ramp_cool_texture, face_sampler, at, 0.0).rgb;
        return lit * mix(warm, cool, frame.coolness);
    }
    var dark = shade;
    if options.shade_shift {
        // Colours that a turn takes out of the gamut are cut.
        dark = max(mix(material.shade_shift_warm * shade, material.shade_shift_cool * shade, frame.coolness), vec3f(0.0));
    }
    return ramp_bands(lit, dark, lit * material.ramp_terminator, material.ramp_edges, place);
}
