// Opaque and alpha-masked surfaces; with several samples a pixel the cut covers as many samples as it should.
import package::bind::surface::{drawn, encoded};
import package::bind::varying::{Varying, surface_varying};
import package::bind::vertex::VertexInput;
import package::material::stage_samples;

@vertex
fn vs_main(v: VertexInput) -> Varying {
    return surface_varying(v);
}

@if(!covered)
@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    return vec4f(encoded(drawn(in, front_facing).color), 1.0);
}

@if(covered)
struct CoveredOutput {
    @location(0) color: vec4f,
    @builtin(sample_mask) samples: u32,
}

@if(covered)
@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> CoveredOutput {
    let d = drawn(in, front_facing);
    var samples = 15u;
    @if(alpha_coverage) samples = (1u << u32(round(d.alpha * 4.0))) - 1u;
    samples &= stage_samples(in);
    return CoveredOutput(vec4f(encoded(d.color), 1.0), samples);
}
