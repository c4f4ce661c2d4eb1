// Grains that flash one by one.
import package::lib::noise::cell_hash;

// Light of the grains of one level at a place given in its cells; h_x, h_y, h_n are H along the surface and the normal.
fn sparkle_level(at: vec2f, level: i32, h: vec3f, spread: f32, cos_size: f32) -> f32 {
    let cell = vec2i(floor(at));
    let random = cell_hash(vec3i(cell, level));
    let lean = cell_hash(vec3i(cell.yx, level + 57)).xy * 2.0 - 1.0;
    let normal = normalize(vec3f(lean * spread, 1.0));
    let shine = smoothstep(cos_size, mix(cos_size, 1.0, 0.6), dot(normal, h));
    // A grain is a dot of a third of its cell, somewhere in it.
    let middle = 0.5 + (random.xy - 0.5) * 0.5;
    let dot_share = 1.0 - smoothstep(0.12, 0.3, distance(fract(at), middle));
    return shine * dot_share * (0.4 + 0.6 * random.z);
}

// Light of all grains: two levels, between which it fades so that grains stay as far apart on the picture as
// `cell_px` says. `uv_per_px` is what the texture coordinates change by in a pixel.
fn sparkle(uv: vec2f, uv_per_px: f32, cell_px: f32, h: vec3f, spread: f32, cos_size: f32) -> f32 {
    let scale = log2(max(uv_per_px * cell_px, 1e-7));
    let level = floor(scale);
    let fine = sparkle_level(uv * exp2(-level), i32(level), h, spread, cos_size);
    let coarse = sparkle_level(uv * exp2(-level - 1.0), i32(level) + 1, h, spread, cos_size);
    return mix(fine, coarse, scale - level);
}
