// Opaque and alpha-masked surfaces; with several samples a pixel the cut covers as many samples as it should.
import package::bind::options::surface_options;
import package::bind::surface::shade_surface;
import package::bind::vanish::dithered_samples;
import package::bind::varying::{Varying, surface_varying, surface_input};
import package::bind::vertex::VertexInput;
import package::lib::color::srgb_from_linear;

// The target does not encode sRGB by itself.
override ENCODE_SRGB: bool = false;

@vertex
fn vs_main(v: VertexInput) -> Varying {
    return surface_varying(surface_options(), v);
}

struct CoveredOutput {
    @location(0) color: vec4f,
    @builtin(sample_mask) samples: u32,
}

fn encoded(color: vec3f) -> vec4f {
    if ENCODE_SRGB {
        return vec4f(srgb_from_linear(color), 1.0);
    }
    return vec4f(color, 1.0);
}

@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    return encoded(shade_surface(surface_options(), surface_input(in, front_facing)).rgb);
}

// For ALPHA_COVERAGE and DITHER_SAMPLES, with four samples.
@fragment
fn fs_covered(in: Varying, @builtin(front_facing) front_facing: bool) -> CoveredOutput {
    let surface = shade_surface(surface_options(), surface_input(in, front_facing));
    var samples = 15u;
    if surface_options().alpha_coverage {
        samples = (1u << u32(round(surface.a * 4.0))) - 1u;
    }
    if surface_options().dither_samples {
        samples &= dithered_samples(in.clip_position.xy, in.world_position);
    }
    return CoveredOutput(encoded(surface.rgb), samples);
}
