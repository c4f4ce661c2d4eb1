// Numbers of a physical surface; wgsl/model/standard.wgsl shades it.
import package::bind::uv::UvTransform;

struct Standard {
    metallic: f32,
    roughness: f32,
    occlusion_strength: f32,
    ior: f32,
    map_uv: UvTransform,
    occlusion_uv: UvTransform,
}
