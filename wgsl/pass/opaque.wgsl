// Opaque and alpha-masked surfaces.
import package::bind::frame::frame;
import package::bind::options::surface_options;
import package::bind::surface::{SurfaceInput, shade_surface};
import package::bind::varying::{Varying, surface_varying, surface_input};
import package::bind::vertex::VertexInput;
import package::lib::color::srgb_from_linear;

// The target does not encode sRGB by itself.
override ENCODE_SRGB: bool = false;

@vertex
fn vs_main(v: VertexInput) -> Varying {
    return surface_varying(surface_options(), v);
}

@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    var color = shade_surface(surface_options(), surface_input(in, front_facing)).rgb;
    if ENCODE_SRGB {
        color = srgb_from_linear(color);
    }
    return vec4f(color, 1.0);
}
