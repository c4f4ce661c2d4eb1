// The least that a renderer can do: the same triangles with one texture and no light. Benches measure against it.
import package::bind::frame::frame;
import package::bind::varying::Varying;
import package::bind::vertex::{VertexInput, vertex_of, world_position};
import package::material::{base_texture, base_texture_sampler, material};

@vertex
fn vs_main(in: VertexInput) -> Varying {
    let v = vertex_of(in);
    var out: Varying;
    out.clip_position = frame.clip_from_world * vec4f(world_position(v, v.position), 1.0);
    out.uv = v.uv;
    return out;
}

@fragment
fn fs_main(in: Varying) -> @location(0) vec4f {
    var color = material.base.color.rgb;
    @if(base_texture) color *= textureSample(base_texture, base_texture_sampler, in.uv.xy).rgb;
    return vec4f(color, 1.0);
}
