// Numbers of fire; wgsl/model/fire.wgsl shades it.
import package::bind::uv::UvTransform;

struct Fire {
    rim: vec3f,
    erosion: f32,
    body: vec3f,
    softness: f32,
    heart: vec3f,
    turbulence: f32,
    edges: vec2f,
    sway: f32,
    additive: f32,
    period_s: f32,
    cells: i32,
    heat_uv: UvTransform,
}
