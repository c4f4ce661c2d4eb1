// Blended surfaces; the output is premultiplied.
import package::bind::material::material;
import package::bind::options::surface_options;
import package::bind::surface::shade_surface;
import package::bind::vanish::dither_left;
import package::bind::varying::{Varying, surface_varying, surface_input};
import package::bind::vertex::VertexInput;
import package::lib::color::srgb_from_linear;

override ENCODE_SRGB: bool = false;

@vertex
fn vs_main(v: VertexInput) -> Varying {
    return surface_varying(surface_options(), v);
}

@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    let surface = shade_surface(surface_options(), surface_input(in, front_facing));
    var color = surface.rgb;
    if ENCODE_SRGB {
        color = srgb_from_linear(color);
    }
    var alpha = saturate(surface.a);
    if surface_options().dither_fade {
        alpha *= dither_left(in.world_position);
    }
    if surface_options().fire {
        // What it adds instead of covering leaves what is behind it.
        return vec4f(color * alpha, alpha * (1.0 - material.fire_additive));
    }
    return vec4f(color * alpha, alpha);
}
