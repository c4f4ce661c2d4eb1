// Light of surfaces that bloom, in a picture of half the size; the prepass knows what hides it.
import package::bind::frame::{distance_at, frame};
import package::bind::surface::{framed, surface_of};
import package::bind::varying::{Varying, surface_varying};
import package::bind::vertex::{VertexInput, vertex_of};
import package::look::glow::glow_border;
import package::material::{material, stage_emitted, stage_glow, stage_left, stage_vanish};

@vertex
fn vs_main(in: VertexInput) -> Varying {
    return surface_varying(vertex_of(in));
}

// Whether something stands before a place. Its pixel covers four of the prepass.
fn hidden(place: vec3f) -> bool {
    let first = vec2i(place.xy) * 2;
    let farthest = max(
        max(distance_at(first), distance_at(first + vec2i(1, 0))),
        max(distance_at(first + vec2i(0, 1)), distance_at(first + vec2i(1, 1)))
    );
    // The surface itself is among them, rounded otherwise.
    return frame.near / max(place.z, 1e-12) > farthest * 1.001;
}

// What of a surface blooms.
fn blooming(in: Varying, front_facing: bool) -> vec3f {
    stage_vanish(in);
    var s = surface_of(in, front_facing);
    var left = stage_left(in);
    @if(blend) left *= saturate(s.alpha);
    var light = stage_emitted(&s) * material.glow.emission;
    @if(lit) {
        framed(&s);
        var border = glow_border(&s);
        light += stage_glow(&s, &border) * frame.light_color * material.glow.highlight;
    }
    return light * left;
}

@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    let light = blooming(in, front_facing);
    if hidden(in.clip_position.xyz) {
        discard;
    }
    return vec4f(max(light, vec3f(0.0)), 1.0);
}
