// Fluff: shells of a coat of short hair, from the root outwards, blended over each other.
import package::bind::frame::frame;
import package::bind::material::material;
import package::bind::options::{surface_options, CHANNEL_FLUFF};
import package::bind::surface::shade_surface;
import package::bind::vanish::dithered_samples;
import package::bind::varying::{Varying, surface_input, surface_varying};
import package::bind::vertex::VertexInput;
import package::lib::color::srgb_from_linear;
import package::lib::fluff::{fluff_cover, fluff_shells, fluff_strand, fluff_wind};

override ENCODE_SRGB: bool = false;

struct FluffVarying {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) uv: vec4f,
    @location(4) color: vec4f,
    @location(5) @interpolate(flat) face_light: vec4f,
    @location(6) bangs: vec3f,
    @location(7) @interpolate(flat) highlight: vec4f,
    @location(8) shadow: vec4f,
    // Height above the root, share of the length.
    @location(9) @interpolate(flat) level: f32,
}

@vertex
fn vs_main(vertex: VertexInput) -> FluffVarying {
    var v = vertex;
    // Copies of the instances follow each other, one for each shell.
    let shell = f32(v.instance / frame.instances);
    v.instance = v.instance % frame.instances;
    let out = surface_varying(surface_options(), v);
    let level = shell / fluff_shells(material.fluff_length, frame.px_per_m, material.fluff_shells);
    let phase = fract(frame.time_s / material.fluff_period);
    let bend = level * level;
    let position = out.world_position + out.normal * material.fluff_length * level
        - vec3f(0.0, material.fluff_gravity * bend, 0.0)
        + fluff_wind(out.world_position, phase) * material.fluff_wind * bend;
    return FluffVarying(
        frame.clip_from_world * vec4f(position, 1.0), position, out.normal, out.tangent, out.uv, out.color, out.face_light,
        out.bangs, out.highlight, out.shadow, level
    );
}

struct DitheredOutput {
    @location(0) color: vec4f,
    @builtin(sample_mask) samples: u32,
}

@fragment
fn fs_main(in: FluffVarying) -> @location(0) vec4f {
    return shell(in);
}

// For DITHER_SAMPLES.
@fragment
fn fs_dithered(in: FluffVarying) -> DitheredOutput {
    return DitheredOutput(shell(in), dithered_samples(in.clip_position.xy, in.world_position));
}

fn shell(in: FluffVarying) -> vec4f {
    let strand = fluff_strand(in.uv.xy * material.fluff_density);
    let cover = fluff_cover(strand.w, in.level, material.fluff_softness);
    // Strands catch the light each in its own way: its border has their shape.
    let normal = normalize(in.normal) + strand.xyz * material.fluff_ruffle;
    let place = Varying(
        in.clip_position, in.world_position, normal, in.tangent, in.uv, in.color, in.face_light, in.bangs, in.highlight,
        in.shadow
    );
    let surface = shade_surface(surface_options(), surface_input(place, true));
    var color = surface.rgb * mix(material.fluff_root, 1.0, in.level);
    if surface_options().channel == CHANNEL_FLUFF {
        color = vec3f(in.level);
    }
    if ENCODE_SRGB {
        color = srgb_from_linear(color);
    }
    return vec4f(color * cover, cover);
}
