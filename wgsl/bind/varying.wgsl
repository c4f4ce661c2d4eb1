// What goes from vertex to fragment for a surface.
import package::bind::character::{bangs_from_character, character, shadow_receiver};
import package::bind::frame::frame;
import package::bind::material::material;
import package::bind::options::{SurfaceOptions, has_tangents};
import package::bind::surface::SurfaceInput;
import package::bind::vertex::{VertexInput, bitangent_sign, world_direction, world_position, world_rotated};
import package::lib::eyes_through::pulled_depth;
import package::lib::face_shadow::{face_light_angle, face_measure};
import package::lib::highlight::{highlight_fade, highlight_offset};

struct Varying {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) uv: vec4f,
    @location(4) color: vec4f,
    @location(5) @interpolate(flat) face_light: vec4f,
    @location(6) bangs: vec3f,
    @location(7) @interpolate(flat) highlight: vec4f,
    @location(8) shadow: vec4f,
}

fn surface_varying(options: SurfaceOptions, v: VertexInput) -> Varying {
    let position = world_position(v, v.position);
    var tangent = vec4f(0.0);
    if has_tangents(options) {
        tangent = vec4f(world_direction(v, v.frame.y), bitangent_sign(v.frame.y));
    }
    var face_light = vec4f(0.0);
    if options.face_shadow {
        let light = in_face_frame(v, frame.to_light);
        let angle = face_light_angle(light, material.face_overhead_fade);
        let pitch = asin(clamp(light.y, -1.0, 1.0));
        face_light = vec4f(light.x, pitch, angle, face_measure(angle, material.face_cosine));
    }
    var highlight = vec4f(0.0);
    if options.face_paint {
        let view = in_face_frame(v, normalize(frame.eye - world_position(v, character.head)));
        // atan2(0, 0) is left to the driver.
        let yaw = atan2(abs(view.x), select(1e-6, view.z, abs(view.z) > 1e-6));
        let fade = material.nose_line_yaw;
        highlight.w = smoothstep(fade.x, max(fade.y, fade.x + 1e-4), yaw);
    }
    var bangs = vec3f(0.0);
    if options.bangs_shadow {
        bangs = bangs_from_character(v.position);
    }
    if options.highlight {
        let view = normalize(frame.eye - world_position(v, character.head));
        let forward = world_rotated(v, character.face_forward);
        let up = world_rotated(v, character.face_up);
        let offset = highlight_offset(
            view, frame.to_light, forward, up, material.highlight_turn, material.highlight_light, material.highlight_view
        );
        let left = highlight_fade(dot(view, forward), dot(view, frame.to_light), material.highlight_facing);
        highlight = vec4f(offset, left, highlight.w);
    }
    var clip = frame.clip_from_world * vec4f(position, 1.0);
    if options.layered {
        clip.z = pulled_depth(clip.z, clip.w, material.layer_pull);
    }
    let normal = world_direction(v, v.frame.x);
    var shadow = vec4f(0.0);
    if options.cast_shadow {
        shadow = shadow_receiver(v, position, normal);
    }
    return Varying(clip, position, normal, tangent, v.uv, v.color, face_light, bangs, highlight, shadow);
}

// A world direction by the axes of the face: to the character's left, up, forward.
fn in_face_frame(v: VertexInput, d: vec3f) -> vec3f {
    return vec3f(
        dot(d, world_rotated(v, character.face_left)),
        dot(d, world_rotated(v, character.face_up)),
        dot(d, world_rotated(v, character.face_forward)),
    );
}

// A back face is seen with its normal turned (glTF doubleSided).
fn surface_input(in: Varying, front_facing: bool) -> SurfaceInput {
    let normal = select(-in.normal, in.normal, front_facing);
    return SurfaceInput(
        in.clip_position.xyz, in.world_position, normal, in.tangent, in.uv, in.color, in.face_light, in.bangs, in.highlight,
        in.shadow
    );
}
