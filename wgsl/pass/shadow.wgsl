// Depth of a character from the key light.
import package::bind::character::shadow_from_world;
import package::bind::options::surface_options;
import package::bind::texel::surface_cut;
import package::bind::vertex::{VertexInput, world_position};

override ALPHA_TEST: bool = false;

struct ShadowVarying {
    @builtin(position) clip_position: vec4f,
    @location(0) uv: vec4f,
    @location(1) color: vec4f,
}

@vertex
fn vs_main(v: VertexInput) -> ShadowVarying {
    let at = shadow_from_world(v, world_position(v, v.position));
    // What stands before the map's range casts from its front.
    return ShadowVarying(vec4f(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, max(at.z, 0.0), 1.0), v.uv, v.color);
}

@fragment
fn fs_main(in: ShadowVarying) {
    if ALPHA_TEST && surface_cut(surface_options(), in.uv, in.color) {
        discard;
    }
}
