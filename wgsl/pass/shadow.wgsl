// Depth of a character from the key light.
import package::bind::maps::shadow_from_world;
import package::bind::varying::{Varying, with_attributes};
import package::bind::vertex::{VertexInput, vertex_of, world_position};
import package::material::stage_gone;

@vertex
fn vs_main(in: VertexInput) -> Varying {
    let v = vertex_of(in);
    let at = shadow_from_world(v.extra, world_position(v, v.position));
    var out: Varying;
    // What stands before the map's range casts from its front.
    out.clip_position = vec4f(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, max(at.z, 0.0), 1.0);
    with_attributes(v, &out);
    return out;
}

@if(cut)
@fragment
fn fs_main(in: Varying) {
    if stage_gone(in) {
        discard;
    }
}
