// Painted fur: which strokes show where.

// Shares of light, terminator and shade by N.L; they sum to 1. `ends` of the terminator grow, `softness` is at most half of
// what lies between them.
fn fur_masks(n_dot_l: f32, ends: vec2f, softness: f32) -> vec3f {
    let lit = smoothstep(ends.y - softness, ends.y + softness, n_dot_l);
    let back = 1.0 - smoothstep(ends.x - softness, ends.x + softness, n_dot_l);
    return vec3f(lit, 1.0 - lit - back, back);
}

// Between the flat colour and that with all strokes; `shares` belong to light, terminator and shade.
fn fur_color(masks: vec3f, shares: vec3f, flat_color: vec3f, detail: vec3f) -> vec3f {
    return mix(flat_color, detail, dot(masks, shares));
}
