// Normal and part of the nearest surface, one sample a pixel, for effects and channels that read them.
import package::bind::frame::frame;
import package::bind::options::surface_options;
import package::bind::texel::surface_cut;
import package::bind::vanish::dither_left;
import package::bind::vertex::{VertexInput, world_direction, world_position};
import package::lib::normal::octahedral_from_unit;

// Cut where alpha is below the material's cutoff; blended and fading materials count where they cover half.
override ALPHA_TEST: bool = false;

struct PrepassVarying {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec4f,
    @location(3) color: vec4f,
    @location(4) @interpolate(flat) part: u32,
}


@vertex
fn vs_main(v: VertexInput) -> PrepassVarying {
    let position = world_position(v, v.position);
    let clip = frame.clip_from_world * vec4f(position, 1.0);
    return PrepassVarying(clip, position, world_direction(v, v.frame.x), v.uv, v.color, v.part);
}

@vertex
fn vs_depth(v: VertexInput) -> @builtin(position) vec4f {
    return frame.clip_from_world * vec4f(world_position(v, v.position), 1.0);
}

fn cut(in: PrepassVarying) -> bool {
    if !ALPHA_TEST {
        return false;
    }
    let options = surface_options();
    if options.dither_fade && dither_left(in.world_position) < 0.5 {
        return true;
    }
    return surface_cut(options, in.uv, in.color);
}

// World normal as an octahedral pair, and part index + 1; 0 is background.
@fragment
fn fs_main(in: PrepassVarying, @builtin(front_facing) front_facing: bool) -> @location(0) vec2u {
    if cut(in) {
        discard;
    }
    let normal = normalize(select(-in.normal, in.normal, front_facing));
    return vec2u(pack2x16snorm(octahedral_from_unit(normal)), in.part + 1u);
}

@fragment
fn fs_depth(in: PrepassVarying) {
    if cut(in) {
        discard;
    }
}
