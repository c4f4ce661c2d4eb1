// How far each pixel of a surface has moved since the last picture, pixels to the right and down, jitter left out.
import package::bind::frame::frame;
import package::bind::past::position_before;
import package::bind::varying::{Varying, with_attributes};
import package::bind::vertex::{VertexInput, vertex_of, world_position};
import package::material::stage_gone;

@vertex
fn vs_main(in: VertexInput) -> Varying {
    let v = vertex_of(in);
    var out: Varying;
    let position = world_position(v, v.position);
    out.clip_position = frame.clip_from_world * vec4f(position, 1.0);
    out.world_position = position;
    out.before = (frame.clip_before * vec4f(position_before(in), 1.0)).xyw;
    with_attributes(v, &out);
    return out;
}

@fragment
fn fs_main(in: Varying) -> @location(0) vec2f {
    if stage_gone(in) {
        discard;
    }
    // Both places are projected from what is interpolated: whatever the rasterizer rounds is no movement.
    let now = (frame.clip_from_world * vec4f(in.world_position, 1.0)).xyw;
    return clamp(pixel(now) - frame.jitter_px - pixel(in.before), vec2f(-3e4), vec2f(3e4));
}

// What was behind the viewer was in no picture.
fn pixel(clip: vec3f) -> vec2f {
    return (clip.xy / max(clip.z, 1e-6) * vec2f(0.5, -0.5) + 0.5) * frame.size_px;
}
