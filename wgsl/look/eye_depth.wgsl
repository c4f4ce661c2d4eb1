// A drawn iris that has depth.
import package::bind::actor::actors;
import package::bind::eye::{eye_axes, of_eye};
import package::bind::frame::frame;
import package::bind::shown::shown;
import package::bind::surface::Surface;
import package::bind::uv::{UvTransform, texture_uv};
import package::bind::varying::Varying;
import package::bind::vertex::Vertex;
import package::lib::eye::{bowl_place, caustic_slope, cornea_refraction, pupil_place};
import package::lib::pupil::pupil_cover;
import package::material::{eye_depth_pupil_map, eye_depth_pupil_map_sampler, material};

struct EyeDepth {
    depth: f32,
    bulge: f32,
    ior: f32,
    rim: f32,
    pupil_drawn: f32,
    pupil_scale: f32,
    pupil_radius: f32,
    // 1 a disc, 2 a slit, 3 a heart, 4 a star.
    shape: f32,
    pupil_color: vec4f,
    below_color: vec3f,
    from_below: f32,
    follow_light: f32,
    pupil_map_uv: UvTransform,
    // Two for each eye: texture coordinates u and v by x, y and 1 of the box round its iris; half width over half height behind the
    // first.
    rows: array<vec4f, 8>,
}

// Place in the unit disc of the painted iris.
fn eye_depth_flat(s: ptr<function, Surface>) -> vec2f {
    return s.at.eye_place.xy / material.eye_depth.rim;
}

// The same of what is seen there, behind the cornea.
fn eye_depth_seen(s: ptr<function, Surface>) -> vec2f {
    let m = &material.eye_depth;
    let flat = eye_depth_flat(s);
    let aspect = eye_depth_rows(s)[0].w;
    let view = normalize(frame.eye - s.at.world_position) * eye_axes(s.at);
    // A drawn iris is mostly taller than wide: seen as a stretched round one.
    let ray = cornea_refraction(view, normalize(vec3f(flat * (*m).bulge, 1.0)), (*m).ior);
    return bowl_place(flat, ray * vec3f(1.0, aspect, 1.0), (*m).depth / (*m).rim);
}

fn eye_depth_vary(v: Vertex, out: ptr<function, Varying>) {
    let a = &actors[v.actor];
    out.pupil = material.eye_depth.pupil_scale * mix(1.0, 0.25 * (*a).pupil_mm, (*a).pupil_reflex) * (*a).pupil_scale;
}

fn eye_depth_rows(s: ptr<function, Surface>) -> mat2x4f {
    let m = &material.eye_depth;
    let number = s.at.eye_axes.x;
    return mat2x4f(
        of_eye(number, (*m).rows[0], (*m).rows[2], (*m).rows[4], (*m).rows[6]),
        of_eye(number, (*m).rows[1], (*m).rows[3], (*m).rows[5], (*m).rows[7])
    );
}

fn eye_depth_surface(s: ptr<function, Surface>) {
    let m = &material.eye_depth;
    let seen = eye_depth_seen(s);
    let inside = seen * (min(length(seen), 1.0) / max(length(seen), 1e-6));
    @if(!eye_depth_pupil && !eye_depth_pupil_map) let now = clamp((*m).pupil_drawn * s.at.pupil, 0.02, 0.95);
    // Under another pupil the painted one vanishes.
    @if(eye_depth_pupil || eye_depth_pupil_map) let now = 0.01;
    // No branch: beside a triangle software rasterizers would take the other way, and see a step.
    let scaled = select(vec2f(0.0), pupil_place(inside, (*m).pupil_drawn, now) - inside, (*m).pupil_drawn > 0.0);
    let step = vec3f((seen + scaled - eye_depth_flat(s)) * (*m).rim, 0.0);
    let rows = eye_depth_rows(s);
    s.uv += vec4f(dot(rows[0].xyz, step), dot(rows[1].xyz, step), 0.0, 0.0);
}

fn eye_depth_paint(s: ptr<function, Surface>) {
    let m = &material.eye_depth;
    let seen = eye_depth_seen(s);
    @if(eye_depth_below) {
        // Below, or opposite of the light; where that stands behind or straight ahead, below.
        let light = frame.to_light * eye_axes(s.at);
        let source = mix(vec2f(0.0, 1.0), light.xy, (*m).follow_light);
        let slope = caustic_slope(seen, source / max(length(source), 0.3), 1.0) - 1.0;
        let gathered = (*m).below_color * ((*m).from_below * smoothstep(0.05, 0.95, slope) * smoothstep(1.02, 0.9, length(seen)));
        s.lit *= 1.0 + gathered;
        s.shade *= 1.0 + gathered;
    }
    var cover = 0.0;
    @if(eye_depth_pupil) cover = pupil_cover(seen / max((*m).pupil_radius * s.at.pupil, 1e-3), u32((*m).shape));
    @if(eye_depth_pupil_map) {
        let q = seen / s.at.pupil;
        let at = vec2f(0.5 + 0.5 * q.x, 0.5 - 0.5 * q.y);
        cover = textureSample(eye_depth_pupil_map, eye_depth_pupil_map_sampler, texture_uv(vec4f(at, at), (*m).pupil_map_uv)).r
            * f32(max(abs(q.x), abs(q.y)) < 1.0);
    }
    cover *= (*m).pupil_color.a * smoothstep(1.0, 0.97, length(eye_depth_flat(s)));
    s.lit = mix(s.lit, (*m).pupil_color.rgb, cover);
    s.shade = mix(s.shade, (*m).pupil_color.rgb * 0.8, cover);
    @if(channel_eye_depth) shown = vec3f((seen - eye_depth_flat(s)) * 0.5 + 0.5, 0.5);
}
