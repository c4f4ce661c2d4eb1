// View-space normal and part id, one sample a pixel, for effects and channels that read them.
import package::bind::frame::frame;
import package::bind::options::surface_options;
import package::bind::surface::{animated_uv, surface_texel, texel_input};
import package::bind::material::material;
import package::bind::vertex::{VertexInput, world_direction, world_position};

// Cut where alpha is below the material's cutoff; blended materials count where they cover half.
override ALPHA_TEST: bool = false;

struct PrepassVarying {
    @builtin(position) clip_position: vec4f,
    @location(0) normal: vec3f,
    @location(1) uv: vec4f,
    @location(2) color: vec4f,
    @location(3) @interpolate(flat) part: u32,
}

struct PrepassOutput {
    // View-space normal, 0..1.
    @location(0) normal: vec4f,
    // Part index + 1; 0 is background.
    @location(1) part: u32,
}

@vertex
fn vs_main(v: VertexInput) -> PrepassVarying {
    let position = world_position(v, v.position);
    let normal = (frame.view_from_world * vec4f(world_direction(v, v.frame.x), 0.0)).xyz;
    return PrepassVarying(frame.clip_from_world * vec4f(position, 1.0), normal, v.uv, v.color, v.part);
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
    let texel = surface_texel(options, texel_input(in.uv, in.color), animated_uv(options, in.uv));
    return material.base_color.a * texel.a < material.alpha_cutoff;
}

@fragment
fn fs_main(in: PrepassVarying, @builtin(front_facing) front_facing: bool) -> PrepassOutput {
    if cut(in) {
        discard;
    }
    let normal = normalize(select(-in.normal, in.normal, front_facing));
    return PrepassOutput(vec4f(normal * 0.5 + 0.5, 1.0), in.part + 1u);
}

@fragment
fn fs_depth(in: PrepassVarying) {
    if cut(in) {
        discard;
    }
}
