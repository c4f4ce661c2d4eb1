// Eyes and brows over the hair that hangs before them.
import package::bind::actor::actors;
import package::bind::frame::{frame, in_target};
import package::bind::surface::{drawn, encoded};
import package::bind::varying::{Varying, in_face_frame, surface_varying};
import package::bind::vertex::{VertexInput, vertex_of, world_position};
import package::lib::eyes_through::{eyes_through_fade, pulled_depth};
import package::lib::light::luminance;

@vertex
fn vs_main(in: VertexInput) -> Varying {
    let v = vertex_of(in);
    var out = surface_varying(v);
    out.clip_position.z = pulled_depth(out.clip_position.z, out.clip_position.w, actors[v.actor].through_window);
    out.clip_position = in_target(out.clip_position);
    let view = in_face_frame(v, normalize(frame.eye - world_position(v, v.position)));
    out.opacity = actors[v.actor].through_opacity
        * eyes_through_fade(view, actors[v.actor].through_fade_yaw, actors[v.actor].through_fade_pitch);
    return out;
}

@fragment
fn fs_main(in: Varying, @builtin(front_facing) front_facing: bool) -> @location(0) vec4f {
    var color = drawn(in, front_facing).color;
    // What is nearly black darkens hair instead of colouring it: on black hair it is not seen.
    let colours = smoothstep(0.0, 0.06, luminance(color));
    let opacity = in.opacity * mix(0.6, 1.0, colours);
    color *= colours;
    // Everything else is black: as bright as it is seen.
    @if(channel_eyes_through) color = vec3f(1.0);
    @if(channel && !channel_eyes_through) discard;
    return vec4f(encoded(color) * opacity, opacity);
}
