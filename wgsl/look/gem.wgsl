// Numbers of a stone that is seen into; wgsl/model/gem.wgsl shades it.
import package::bind::uv::UvTransform;

struct Gem {
    color: vec3f,
    ior: f32,
    cloudiness: f32,
    // Depth of the body in texture coordinates.
    depth_uv: f32,
    layers: f32,
    caustic: f32,
    focus: f32,
    polish: f32,
}
