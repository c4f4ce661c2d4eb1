// Group 2: one material, its numbers, its textures.

// Affine UV transform: uv' = (dot(row_u, (uv, 1)), dot(row_v, (uv, 1))); w of row_u is the UV set, 0 or 1.
struct UvTransform {
    row_u: vec4f,
    row_v: vec4f,
}

struct Material {
    base_color: vec4f,
    shade_color: vec3f,
    shift: f32,
    emission: vec3f,
    toony: f32,
    rim_color: vec3f,
    rim_fresnel_power: f32,
    matcap_color: vec3f,
    rim_lift: f32,
    outline_color: vec3f,
    // Metres, or share of the picture's height.
    outline_width: f32,
    shift_texture_scale: f32,
    gi_equalization: f32,
    rim_lighting_mix: f32,
    outline_lighting_mix: f32,
    scroll_per_s: vec2f,
    rotation_rad_per_s: f32,
    alpha_cutoff: f32,
    normal_scale: f32,
    // Angle over pi, and horizontal length of the direction to the light.
    face_softness: f32,
    face_overhead_fade: f32,
    // 1: thresholds are measured by the cosine of the angle.
    face_cosine: f32,
    // Heights of the light, radians, for which the maps of the stack are painted, growing.
    face_pitches: vec4f,
    face_pitch_count: u32,
    // Metres by which a card stands before its surface.
    layer_pull: f32,
    stay_lit: f32,
    transition_width: f32,
    transition_color: vec3f,
    transition_strength: f32,
    blush_color: vec3f,
    blush_strength: f32,
    line_color: vec3f,
    shadow_line_strength: f32,
    nose_line_yaw: vec2f,
    nose_line_strength: f32,
    // Pixels of a picture 1024 high, and metres.
    depth_rim_width: f32,
    depth_rim_color: vec3f,
    depth_rim_threshold: f32,
    depth_rim_side: vec2f,
    second_motion: f32,
    second_strength: f32,
    second_color: vec3f,
    highlight_breakup: f32,
    depth_rim_tint: f32,
    bangs_color: vec3f,
    bangs_strength: f32,
    bangs_edges: vec2f,
    highlight_in_shade: f32,
    highlight_facing: f32,
    highlight_color: vec3f,
    highlight_strength: f32,
    // Movement along u, and along v by light and by view.
    highlight_turn: f32,
    highlight_light: f32,
    highlight_view: f32,
    ramp_terminator: vec3f,
    // Middle of the material's row.
    ramp_v: f32,
    ramp_edges: vec4f,
    // Those of the parts.
    ramp_part_v: array<vec4f, 2>,
    // What turns hue and saturation of shade, for warm and for cool light.
    shade_shift_warm: mat3x3f,
    shade_shift_cool: mat3x3f,
    // Least and greatest luminance.
    light_bounds: vec2f,
    light_monochrome: f32,
    fur_softness: f32,
    fur_shares: vec3f,
    fur_normal_scale: f32,
    fur_terminator: vec2f,
    // Mip levels.
    fur_blur: f32,
    shadow_received: f32,
    outline_tint: vec3f,
    outline_gamma: f32,
    outline_bounds: vec2f,
    // Metres away from the viewer.
    outline_push: f32,
    outline_shift: mat3x3f,
    outline_parts: array<vec4f, 8>,
    base_uv: UvTransform,
    shade_uv: UvTransform,
    shift_uv: UvTransform,
    normal_uv: UvTransform,
    emission_uv: UvTransform,
    rim_mask_uv: UvTransform,
    outline_mask_uv: UvTransform,
    animation_mask_uv: UvTransform,
    highlight_uv: UvTransform,
    face_paint_uv: UvTransform,
    detail_color_uv: UvTransform,
    detail_normal_uv: UvTransform,
    part_ids_uv: UvTransform,
}

@group(2) @binding(0) var<uniform> material: Material;
@group(2) @binding(1) var base_texture: texture_2d<f32>;
@group(2) @binding(2) var base_sampler: sampler;
@group(2) @binding(3) var shade_texture: texture_2d<f32>;
@group(2) @binding(4) var shade_sampler: sampler;
@group(2) @binding(5) var shift_texture: texture_2d<f32>;
@group(2) @binding(6) var shift_sampler: sampler;
@group(2) @binding(7) var normal_texture: texture_2d<f32>;
@group(2) @binding(8) var normal_sampler: sampler;
@group(2) @binding(9) var emission_texture: texture_2d<f32>;
@group(2) @binding(10) var emission_sampler: sampler;
@group(2) @binding(11) var matcap_texture: texture_2d<f32>;
@group(2) @binding(12) var matcap_sampler: sampler;
@group(2) @binding(13) var rim_mask_texture: texture_2d<f32>;
@group(2) @binding(14) var rim_mask_sampler: sampler;
@group(2) @binding(15) var outline_mask_texture: texture_2d<f32>;
@group(2) @binding(16) var outline_mask_sampler: sampler;
@group(2) @binding(17) var animation_mask_texture: texture_2d<f32>;
@group(2) @binding(18) var animation_mask_sampler: sampler;
@group(2) @binding(19) var face_texture: texture_2d_array<f32>;
@group(2) @binding(20) var face_sampler: sampler;
@group(2) @binding(21) var highlight_texture: texture_2d<f32>;
@group(2) @binding(22) var highlight_sampler: sampler;
@group(2) @binding(23) var face_paint_texture: texture_2d<f32>;
@group(2) @binding(24) var face_paint_sampler: sampler;
@group(2) @binding(25) var detail_color_texture: texture_2d<f32>;
// Of the detail normals, too: metal has no more than 16 samplers.
@group(2) @binding(26) var detail_sampler: sampler;
@group(2) @binding(27) var detail_normal_texture: texture_2d<f32>;
@group(2) @binding(29) var ramp_warm_texture: texture_2d<f32>;
@group(2) @binding(31) var ramp_cool_texture: texture_2d<f32>;
@group(2) @binding(33) var part_ids_texture: texture_2d<f32>;
