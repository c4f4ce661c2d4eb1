// What goes from vertex to fragment for a surface.
import package::bind::character::{bangs_from_character, character};
import package::bind::frame::frame;
import package::bind::material::material;
import package::bind::surface::{SurfaceInput, SurfaceOptions};
import package::bind::vertex::{VertexInput, bitangent_sign, world_direction, world_position, world_rotated};
import package::lib::highlight::{highlight_fade, highlight_offset};

struct Varying {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) uv: vec4f,
    @location(4) color: vec4f,
    @location(5) @interpolate(flat) face_light: vec3f,
    @location(6) bangs: vec3f,
    @location(7) @interpolate(flat) highlight: vec3f,
}

fn surface_varying(options: SurfaceOptions, v: VertexInput) -> Varying {
    let position = world_position(v, v.position);
    var tangent = vec4f(0.0);
    if options.normal_map {
        tangent = vec4f(world_direction(v, v.frame.y), bitangent_sign(v.frame.y));
    }
    var face_light = vec3f(0.0, 0.0, 1.0);
    if options.face_shadow {
        face_light = vec3f(
            dot(frame.to_light, world_rotated(v, character.face_left)),
            dot(frame.to_light, world_rotated(v, character.face_up)),
            dot(frame.to_light, world_rotated(v, character.face_forward)),
        );
    }
    var bangs = vec3f(0.0);
    if options.bangs_shadow {
        bangs = bangs_from_character(v.position);
    }
    var highlight = vec3f(0.0);
    if options.highlight {
        let view = normalize(frame.eye - world_position(v, character.head));
        let forward = world_rotated(v, character.face_forward);
        let up = world_rotated(v, character.face_up);
        let offset = highlight_offset(
            view, frame.to_light, forward, up, material.highlight_turn, material.highlight_light, material.highlight_view
        );
        let left = highlight_fade(dot(view, forward), dot(view, frame.to_light), material.highlight_facing);
        highlight = vec3f(offset, left);
    }
    return Varying(
        frame.clip_from_world * vec4f(position, 1.0), position, world_direction(v, v.frame.x), tangent, v.uv, v.color,
        face_light, bangs, highlight
    );
}

// A back face is seen with its normal turned (glTF doubleSided).
fn surface_input(in: Varying, front_facing: bool) -> SurfaceInput {
    let normal = select(-in.normal, in.normal, front_facing);
    return SurfaceInput(in.world_position, normal, in.tangent, in.uv, in.color, in.face_light, in.bangs, in.highlight);
}
