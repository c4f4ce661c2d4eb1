// The least that a renderer can do: the same triangles with one texture and no light. Benches measure against it.
import package::bind::frame::frame;
import package::bind::material::{material, base_texture, base_sampler};
import package::bind::vertex::{VertexInput, world_position};

struct FloorVarying {
    @builtin(position) clip_position: vec4f,
    @location(0) uv: vec2f,
}

@vertex
fn vs_main(v: VertexInput) -> FloorVarying {
    return FloorVarying(frame.clip_from_world * vec4f(world_position(v, v.position), 1.0), v.uv.xy);
}

@fragment
fn fs_main(in: FloorVarying) -> @location(0) vec4f {
    return vec4f(textureSample(base_texture, base_sampler, in.uv).rgb * material.base_color.rgb, 1.0);
}
