// Light of surfaces that bloom, in a picture of half the size.
import package::bind::options::surface_options;
import package::bind::surface::glow_surface;
import package::bind::varying::{Varying, surface_input, surface_varying};
import package::bind::vertex::VertexInput;

@vertex
fn vs_main(v: VertexInput) -> Varying {
    return surface_varying(surface_options(), v);
}

@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    return vec4f(max(glow_surface(surface_options(), surface_input(in, front_facing)), vec3f(0.0)), 1.0);
}
