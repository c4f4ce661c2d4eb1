// Numbers of an outline; wgsl/pass/outline.wgsl draws it.
import package::bind::uv::UvTransform;

struct Outline {
    color: vec3f,
    // Metres, or share of the picture's height.
    width: f32,
    tint: vec3f,
    gamma: f32,
    bounds: vec2f,
    lighting_mix: f32,
    // Metres away from the viewer.
    push: f32,
    shift: mat3x3f,
    parts: array<vec4f, 8>,
    width_mask_uv: UvTransform,
    part_ids_uv: UvTransform,
}
