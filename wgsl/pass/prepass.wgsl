// Depth of all surfaces, one sample a pixel, and normal and part of the nearest, for effects and channels that read them.
import package::bind::frame::frame;
import package::bind::varying::{Varying, with_attributes};
import package::bind::vertex::{VertexInput, vertex_of, world_direction, world_position};
import package::lib::normal::octahedral_from_unit;
import package::material::stage_gone;

@vertex
fn vs_main(in: VertexInput) -> Varying {
    let v = vertex_of(in);
    var out: Varying;
    let position = world_position(v, v.position);
    out.clip_position = frame.clip_from_world * vec4f(position, 1.0);
    @if(world) out.world_position = position;
    @if(normal) out.normal = world_direction(v, v.frame.x);
    // Strips of hair have the bits above.
    @if(part) out.part = v.part & 0xffffu;
    with_attributes(v, &out);
    return out;
}

// World normal as an octahedral pair, and part index + 1; 0 is background.
@if(part)
@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> @location(0) vec2u {
    if stage_gone(in) {
        discard;
    }
    let normal = normalize(select(-in.normal, in.normal, front_facing));
    return vec2u(pack2x16snorm(octahedral_from_unit(normal)), in.part + 1u);
}

@if(cut && !part)
@fragment
fn fs_main(in: Varying) {
    if stage_gone(in) {
        discard;
    }
}
