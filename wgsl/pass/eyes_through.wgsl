// Eyes and brows over the hair that hangs before them.
import package::bind::character::character;
import package::bind::frame::frame;
import package::bind::options::{surface_options, CHANNEL_EYES_THROUGH};
import package::bind::surface::shade_surface;
import package::bind::varying::{Varying, in_face_frame, surface_varying, surface_input};
import package::bind::vertex::VertexInput;
import package::lib::color::srgb_from_linear;
import package::lib::eyes_through::{eyes_through_fade, pulled_depth};

override ENCODE_SRGB: bool = false;

// Varying, and how much is seen.
struct ThroughVarying {
    @builtin(position) clip_position: vec4f,
    @location(0) world_position: vec3f,
    @location(1) normal: vec3f,
    @location(2) tangent: vec4f,
    @location(3) uv: vec4f,
    @location(4) color: vec4f,
    @location(5) @interpolate(flat) face_light: vec4f,
    @location(6) bangs: vec3f,
    @location(7) @interpolate(flat) highlight: vec4f,
    @location(8) @interpolate(flat) opacity: f32,
}

@vertex
fn vs_main(v: VertexInput) -> ThroughVarying {
    let s = surface_varying(surface_options(), v);
    var clip = s.clip_position;
    clip.z = pulled_depth(clip.z, clip.w, character.through_window);
    let view = in_face_frame(v, normalize(frame.eye - s.world_position));
    let opacity = character.through_opacity
        * eyes_through_fade(view, character.through_fade_yaw, character.through_fade_pitch);
    return ThroughVarying(
        clip, s.world_position, s.normal, s.tangent, s.uv, s.color, s.face_light, s.bangs, s.highlight,
        opacity
    );
}

@fragment
fn fs_main(in: ThroughVarying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    let surface = Varying(
        in.clip_position, in.world_position, in.normal, in.tangent, in.uv, in.color, in.face_light, in.bangs,
        in.highlight, vec4f(0.0)
    );
    let options = surface_options();
    var color = shade_surface(options, surface_input(surface, front_facing)).rgb;
    if options.channel == CHANNEL_EYES_THROUGH {
        // Everything else is black: as bright as it is seen.
        color = vec3f(1.0);
    } else if options.channel != 0u {
        discard;
    }
    if ENCODE_SRGB {
        color = srgb_from_linear(color);
    }
    return vec4f(color * in.opacity, in.opacity);
}
