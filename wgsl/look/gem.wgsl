// Numbers of a stone that is seen into; wgsl/model/gem.wgsl shades it.
import package::bind::uv::UvTransform;

struct Gem {
    color: vec3f,
    ior: f32,
    cloudiness: f32,
    // Depth of the body in texture coordinates.
    depth_m: f32,
    uv_per_m: f32,
    layers: u32,
    caustic: f32,
    caustic_focus: f32,
    polish: f32,
}
