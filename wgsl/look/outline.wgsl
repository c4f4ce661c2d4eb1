// Numbers of an outline; wgsl/pass/outline.wgsl draws it.
import package::bind::uv::UvTransform;

struct Outline {
    color: vec3f,
    // Metres, or share of the picture's height.
    width: f32,
    tint_factor: vec3f,
    tint_gamma: f32,
    clamp_px: vec2f,
    lighting_mix: f32,
    // Metres away from the viewer.
    push_m: f32,
    shift: mat3x3f,
    parts: array<vec4f, 8>,
    width_mask_uv: UvTransform,
    part_ids_uv: UvTransform,
    // 1 where the colour is that of the surface in shade, 0 where that in light.
    tint_from_shade: f32,
}
