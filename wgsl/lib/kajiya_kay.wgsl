// Highlights of strands (Kajiya and Kay 1989; shifted as by Scheuermann 2004). Directions are unit; T points from root to tip.

// A strand tilted along its normal: the highlight moves by atan(shift) towards the tip. Without the normalisation its width
// would change, too.
fn shifted_strand(t: vec3f, n: vec3f, shift: f32) -> vec3f {
    let moved = t + n * shift;
    return moved * inverseSqrt(max(dot(moved, moved), 1e-12));
}

// Highlight round the half vector h. 1 - (T·H)² may come out below 0 by rounding.
fn strand_specular(t: vec3f, h: vec3f, exponent: f32) -> f32 {
    let t_dot_h = dot(t, h);
    // 1e-12: pow of 0 is left to no driver.
    return smoothstep(-1.0, 0.0, t_dot_h) * pow(max(1.0 - t_dot_h * t_dot_h, 1e-12), exponent * 0.5);
}

// Wrapped Lambert: light that comes round a volume of hair. wrap 0 is Lambert, 1/3 Scheuermann's lerp(0.25, 1, N·L), 1 half
// Lambert.
fn wrapped_lambert(n_dot_l: f32, wrap: f32) -> f32 {
    return saturate((n_dot_l + wrap) / (1.0 + wrap));
}
