// Light along the contour, where the picture is farther beside a surface.

// Offset to the place that is compared, pixels: along the normal as it is seen, `width` of a picture 1024 high. 1e-6: a
// normal towards the viewer has no direction.
fn depth_rim_offset(normal_view: vec2f, width: f32, height: f32) -> vec2f {
    let d = normal_view * inverseSqrt(max(dot(normal_view, normal_view), 1e-12));
    return vec2f(d.x, -d.y) * width * height / 1024.0;
}

// Share of the rim by the step in depth: none up to the threshold, full a quarter above.
fn depth_rim_step(step_m: f32, threshold_m: f32) -> f32 {
    let t = max(threshold_m, 1e-5);
    return saturate((step_m - t) / (0.25 * t));
}

// Share of the rim by the side of the light; `side` are values of N.L between which it fades in. `outwards` is the cosine
// between the contour's direction and the light's as they are seen: a lock whose shaded side borders on nothing has none.
fn depth_rim_side(n_dot_l: f32, outwards: f32, side: vec2f) -> f32 {
    return smoothstep(side.x, max(side.y, side.x + 1e-4), min(n_dot_l, outwards));
}

// Share that is left in small pictures: a rim of less than a pixel and a half would break into dots.
fn depth_rim_resolved(width: f32, height: f32) -> f32 {
    return saturate(width * height / 1024.0 - 0.5);
}

// Share that is left at a distance between those at which it begins to fade and has gone, metres.
fn depth_rim_near(distance: f32, fade: vec2f) -> f32 {
    return 1.0 - smoothstep(fade.x, max(fade.y, fade.x + 1e-4), distance);
}

// Share of the rim that a surface of this luminance shows in full light: a quarter on black, on which it would be chalk.
fn depth_rim_on(luminance: f32) -> f32 {
    return mix(0.25, 1.0, smoothstep(0.0, 0.1, luminance));
}
