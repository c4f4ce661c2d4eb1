// Depth of what casts on the face, from the light of the bangs' shadow.
import package::bind::maps::{bangs_from_character, bangs_from_world};
import package::bind::varying::{Varying, with_attributes};
import package::bind::vertex::{VertexInput, vertex_of, world_position};
import package::material::stage_gone;

@vertex
fn vs_main(in: VertexInput) -> Varying {
    let v = vertex_of(in);
    var at = bangs_from_character(v.actor, v.position);
    if v.actor != v.extra {
        at = bangs_from_world(v.extra, world_position(v, v.position));
    }
    // What stands before the map's range casts from its front.
    at.z = max(at.z, 0.0);
    var out: Varying;
    out.clip_position = vec4f(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, at.z, 1.0);
    out.depth = at.z;
    with_attributes(v, &out);
    return out;
}

@fragment
fn fs_main(in: Varying) -> @location(0) vec4f {
    @if(cut) if stage_gone(in) {
        discard;
    }
    return vec4f(in.depth, 0.0, 0.0, 1.0);
}
