// Blended surfaces in any order: sums of their colours by weight, and what they leave of what is behind.
import package::bind::actor::actors;
import package::bind::frame::{distance_here, frame, in_target};
import package::bind::surface::drawn;
import package::bind::varying::{Varying, surface_varying};
import package::bind::vertex::{VertexInput, vertex_of, world_position};
import package::lib::weighted::{weighted_layer, weighted_nearness, weighted_place, weighted_weight};
import package::material::{material, stage_left};

struct WeightedSums {
    // Linear colour and alpha, times weight.
    @location(0) sums: vec4f,
    // Product of what each leaves: blended as such.
    @location(1) covers: vec4f,
}

// Keeps weights within what halves hold: 0.05 to 20 instead of 1 to 403.
const WEIGHT_SCALE = 0.049787068;
// Brighter light would overflow the sums of a dozen layers.
const BRIGHTEST_WEIGHTED = 200.0;

@vertex
fn vs_main(in: VertexInput) -> Varying {
    let v = vertex_of(in);
    var out = surface_varying(v);
    out.clip_position = in_target(out.clip_position);
    // The distance along the view is w of a perspective.
    let middle = (frame.clip_from_world * vec4f(world_position(v, actors[v.actor].weigh_middle), 1.0)).w;
    out.weigh = vec3f(middle, actors[v.actor].weigh_radius, weighted_nearness(frame.nearest_weighed, middle));
    return out;
}

@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> WeightedSums {
    let d = drawn(in, front_facing);
    let alpha = saturate(d.alpha) * stage_left(in);
    if alpha < material.base.least_alpha {
        discard;
    }
    // What the core has drawn.
    @if(has_core) if alpha >= material.base.alpha_cutoff {
        discard;
    }
    let place = weighted_place(distance_here(in.clip_position), in.weigh.x, in.weigh.y);
    let weight = weighted_weight(alpha, place) * in.weigh.z * WEIGHT_SCALE;
    return WeightedSums(weighted_layer(clamp(d.color, vec3f(0.0), vec3f(BRIGHTEST_WEIGHTED)), alpha, weight), vec4f(alpha));
}
