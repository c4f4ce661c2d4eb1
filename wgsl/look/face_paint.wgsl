// Blush and lines.
import package::bind::actor::actors;
import package::bind::frame::frame;
import package::bind::shown::shown;
import package::bind::surface::{Border, Surface};
import package::bind::uv::{UvTransform, texture_uv};
import package::bind::varying::{Varying, in_face_frame};
import package::bind::vertex::{Vertex, world_position};
import package::lib::face_paint::face_paint_factor;
import package::material::{face_paint_map, face_paint_map_sampler, material};

struct FacePaint {
    blush_color: vec3f,
    blush_strength: f32,
    line_color: vec3f,
    shadow_line_strength: f32,
    nose_line_yaw_rad: vec2f,
    nose_line_strength: f32,
    map_uv: UvTransform,
}

fn face_paint_vary(v: Vertex, out: ptr<function, Varying>) {
    let view = in_face_frame(v, normalize(frame.eye - world_position(v, actors[v.actor].head)));
    // atan2(0, 0) is left to the driver.
    let yaw = atan2(abs(view.x), select(1e-6, view.z, abs(view.z) > 1e-6));
    let fade = material.face_paint.nose_line_yaw_rad;
    out.nose = smoothstep(fade.x, max(fade.y, fade.x + 1e-4), yaw);
}

fn face_paint_shade(s: ptr<function, Surface>, b: ptr<function, Border>) {
    let m = &material.face_paint;
    let drawn = textureSample(face_paint_map, face_paint_map_sampler, texture_uv(s.uv, m.map_uv)).rgb;
    let paint = face_paint_factor(
        drawn, 1.0 - b.shading, s.at.nose * m.nose_line_strength, m.blush_color, m.blush_strength, m.line_color,
        m.shadow_line_strength
    );
    b.lit *= paint;
    b.shade *= paint;
    @if(channel_face_paint) shown = paint;
}
