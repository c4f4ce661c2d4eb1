// Fluff: shells of a coat of short hair, from the root outwards, blended over each other.
import package::bind::frame::{frame, in_target};
import package::bind::pixel::{Pixel, pixel};
import package::bind::surface::{drawn, encoded};
import package::bind::varying::{Varying, surface_varying};
import package::bind::vertex::{VertexInput, vertex_of};
import package::lib::fluff::{FLUFF_CLUMP, fluff_clump, fluff_cover, fluff_shells, fluff_strand, fluff_wind};
import package::material::{material, stage_samples};

@vertex
fn vs_main(in: VertexInput) -> Varying {
    let v = vertex_of(in);
    let m = &material.fluff;
    var out = surface_varying(v);
    // In the middles of the steps: the skin itself is drawn already.
    out.level = (f32(v.extra) + 0.5) / fluff_shells(m.length_m, frame.px_per_m, f32(m.shells));
    let phase = fract(frame.time_s / m.wind_period_s);
    let bend = out.level * out.level;
    out.world_position = out.world_position + out.normal * m.length_m * out.level - vec3f(0.0, m.gravity_m * bend, 0.0)
        + fluff_wind(out.world_position, phase) * m.wind_m * bend;
    out.clip_position = in_target(frame.clip_from_world * vec4f(out.world_position, 1.0));
    return out;
}

@fragment
fn fs_main(in: Varying) -> Pixel {
    return pixel(shell(in), stage_samples(in));
}

fn shell(in: Varying) -> vec4f {
    let m = &material.fluff;
    let at = in.uv.xy * m.density;
    let clump = fluff_clump(at);
    // Tips of a clump come together.
    let strand = fluff_strand(at - clump.to_middle * (0.6 * in.level * in.level));
    let height = strand.w * mix(1.0, 0.9, saturate(length(clump.to_middle) / FLUFF_CLUMP));
    let normal = normalize(in.normal);
    // Seen from the side shells are slices: their tips thin out.
    let facing = saturate(dot(normal, normalize(frame.eye - in.world_position)));
    let cover = fluff_cover(height, in.level, m.softness) * mix(1.0, 0.75 + 0.25 * smoothstep(0.0, 0.5, facing), in.level);
    var place = in;
    // Clumps catch the light each in its own way, their strands a little: its border has their shape.
    place.normal = normal + (clump.lean + strand.xyz * 0.2) * m.ruffle;
    var color = drawn(place, true).color * mix(m.root_light, 1.0, in.level);
    @if(channel_fluff) color = vec3f(in.level);
    return vec4f(encoded(color) * cover, cover);
}
