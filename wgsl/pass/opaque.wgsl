// Opaque and alpha-masked surfaces; with several samples a pixel the cut covers as many samples as it should.
import package::bind::frame::in_target;
import package::bind::pixel::{Pixel, pixel};
import package::bind::surface::{drawn, encoded};
import package::bind::varying::{Varying, surface_varying};
import package::bind::vertex::{VertexInput, vertex_of};
import package::lib::hashed_alpha::hashed_samples;
import package::material::stage_samples;

@vertex
fn vs_main(in: VertexInput) -> Varying {
    var out = surface_varying(vertex_of(in));
    out.clip_position = in_target(out.clip_position);
    return out;
}

@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> Pixel {
    let d = drawn(in, front_facing);
    var samples = 15u;
    @if(alpha_coverage && alpha_hashed) samples = hashed_samples(u32(round(d.alpha * 4.0)), in.clip_position);
    @if(alpha_coverage && !alpha_hashed) samples = (1u << u32(round(d.alpha * 4.0))) - 1u;
    return pixel(vec4f(encoded(d.color), 1.0), samples & stage_samples(in));
}
