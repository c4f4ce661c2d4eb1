// Depth of what casts on the face, from the light of the bangs' shadow.
import package::bind::character::{bangs_from_character, bangs_from_world};
import package::bind::options::surface_options;
import package::bind::texel::surface_cut;
import package::bind::vertex::{VertexInput, world_position};

override ALPHA_TEST: bool = false;

struct BangsVarying {
    @builtin(position) clip_position: vec4f,
    @location(0) depth: f32,
    @location(1) uv: vec4f,
    @location(2) color: vec4f,
}

@vertex
fn vs_main(v: VertexInput) -> BangsVarying {
    var at = bangs_from_character(v.position);
    if v.instance > 0u {
        at = bangs_from_world(world_position(v, v.position));
    }
    // What stands before the map's range casts from its front.
    at.z = max(at.z, 0.0);
    return BangsVarying(vec4f(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, at.z, 1.0), at.z, v.uv, v.color);
}

@fragment
fn fs_main(in: BangsVarying) -> @location(0) vec4f {
    if ALPHA_TEST && surface_cut(surface_options(), in.uv, in.color) {
        discard;
    }
    return vec4f(in.depth, 0.0, 0.0, 1.0);
}
