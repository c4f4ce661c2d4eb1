// Group 2: one material, its numbers, its textures.

// Affine UV transform: uv' = (dot(row_u, (uv, 1)), dot(row_v, (uv, 1))); w of row_u is the UV set, 0 or 1.
struct UvTransform {
    row_u: vec4f,
    row_v: vec4f,
}

struct DecalPlace {
    // Rows from texture coordinates to 0..1 over the decal; w of row_v: 1 multiplies.
    row_u: vec4f,
    row_v: vec4f,
    // Left, top, width, height.
    sheet: vec4f,
    color: vec4f,
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
    dissolve_border: f32,
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
    shaped_color: vec3f,
    shaped_strength: f32,
    shaped_move: vec2f,
    shaped_split: vec2f,
    // Cosine and sine.
    shaped_turn: vec2f,
    shaped_squash: f32,
    // Sine of the half angle.
    shaped_size: f32,
    shaped_square: f32,
    shaped_in_shade: f32,
    shaped_anisotropy: f32,
    // One over the width of the map.
    shaped_map_scale: f32,
    matcap_mix: f32,
    sparkle_px: f32,
    sparkle_spread: f32,
    sparkle_cos: f32,
    sparkle_color: vec3f,
    gem_ior: f32,
    gem_color: vec3f,
    gem_cloudiness: f32,
    // Depth of the body in texture coordinates.
    gem_depth_uv: f32,
    gem_layers: f32,
    gem_caustic: f32,
    gem_focus: f32,
    gem_polish: f32,
    diamond_bounces: u32,
    diamond_facets: f32,
    diamond_brilliance: f32,
    diamond_color: vec3f,
    fire_erosion: f32,
    diamond_ior: vec3f,
    fire_softness: f32,
    fire_rim: vec3f,
    fire_turbulence: f32,
    fire_body: vec3f,
    fire_sway: f32,
    fire_heart: vec3f,
    fire_additive: f32,
    fire_edges: vec2f,
    fire_period: f32,
    fire_cells: i32,
    emission_scroll: vec2f,
    blink_low: f32,
    blink_sharpness: f32,
    blink_period: f32,
    dissolve_amount: f32,
    dissolve_cells: vec2i,
    dissolve_color: vec3f,
    dither_opacity: f32,
    dither_near: vec2f,
    stocking_cover: f32,
    // UV set, 0 or 1.
    decal_set: f32,
    stocking_color: vec3f,
    decal_count: u32,
    decals: array<DecalPlace, 4>,
    depth_rim_shade: vec3f,
    depth_rim_punctual: f32,
    // Metres.
    depth_rim_fade: vec2f,
    fluff_shells: f32,
    fluff_length: f32,
    fluff_density: f32,
    fluff_softness: f32,
    fluff_gravity: f32,
    fluff_wind: f32,
    fluff_period: f32,
    fluff_root: f32,
    // Share of the colour that glows.
    glow: f32,
    glow_highlight: f32,
    line_tint: vec3f,
    // Pixels of a picture 1024 high.
    line_width: f32,
    // Metres, and cosine.
    line_steps: vec2f,
    line_parts: f32,
    fluff_ruffle: f32,
    rim_width_uv: UvTransform,
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
// Read by the sampler of the base texture.
@group(2) @binding(35) var decal_texture: texture_2d<f32>;
@group(2) @binding(37) var rim_width_texture: texture_2d<f32>;
