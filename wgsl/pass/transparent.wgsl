// Blended surfaces, or the opaque part of one; the output is premultiplied.
import package::bind::frame::in_target;
import package::bind::surface::{drawn, encoded};
import package::bind::varying::{Varying, surface_varying};
import package::bind::vertex::{VertexInput, vertex_of};
import package::material::{material, stage_left};

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
    @if(core) {
        if alpha < material.base.alpha_cutoff {
            discard;
        }
        return vec4f(encoded(d.color), 1.0);
    }
    @if(layered) if alpha < material.base.least_alpha {
        discard;
    }
    // What the core has drawn.
    @if(has_core) if alpha >= material.base.alpha_cutoff {
        discard;
    }
    // What it adds instead of covering leaves what is behind it.
    return vec4f(encoded(d.color) * alpha, alpha * (1.0 - d.adds));
}
