// Blended surfaces; the output is premultiplied.
import package::bind::frame::in_target;
import package::bind::surface::{drawn, encoded};
import package::bind::varying::{Varying, surface_varying};
import package::bind::vertex::{VertexInput, vertex_of};
import package::material::stage_left;

@vertex
fn vs_main(in: VertexInput) -> Varying {
    var out = surface_varying(vertex_of(in));
    out.clip_position = in_target(out.clip_position);
    return out;
}

@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    let d = drawn(in, front_facing);
    let alpha = saturate(d.alpha) * stage_left(in);
    // What it adds instead of covering leaves what is behind it.
    return vec4f(encoded(d.color) * alpha, alpha * (1.0 - d.adds));
}
