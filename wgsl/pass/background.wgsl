// The environment behind everything.
import package::bind::environment::in_environment;
import package::bind::frame::{environment_sampler, frame};
import package::bind::picture::{PictureVarying, picture_varying};
import package::bind::surface::encoded;

@group(1) @binding(0) var radiance: texture_2d<f32>;

struct BackgroundVarying {
    @builtin(position) position: vec4f,
    // World; only its direction counts.
    @location(0) direction: vec3f,
}

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> BackgroundVarying {
    let position = picture_varying(vertex).position;
    // The direction that the rows of x, y and w of clip_from_world lead to this place of the picture.
    let m = transpose(frame.clip_from_world);
    let across = cross(m[1].xyz, m[3].xyz);
    let down = cross(m[3].xyz, m[0].xyz);
    let ahead = cross(m[0].xyz, m[1].xyz);
    return BackgroundVarying(position, (across * position.x + down * position.y + ahead) / dot(m[3].xyz, ahead));
}

@fragment
fn fs_main(in: BackgroundVarying) -> @location(0) vec4f {
    let d = in_environment(normalize(in.direction));
    let uv = vec2f(atan2(d.x, -d.z) / 6.2831853 + 0.5, acos(clamp(d.y, -1.0, 1.0)) / 3.14159265);
    let seen = textureSampleLevel(radiance, environment_sampler, uv, 0.0).rgb * frame.environment_strength;
    return vec4f(encoded(seen), 1.0);
}
