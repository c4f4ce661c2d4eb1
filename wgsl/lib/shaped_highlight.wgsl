// Highlights with a drawn shape (Anjyo and Hiramitsu 2003). X and Y lie along the surface; every operator is the identity
// at 0.

// H moved, squashed along X, and split along both.
fn highlight_moved(h: vec3f, x: vec3f, y: vec3f, translate: vec2f, squash: f32, split: vec2f) -> vec3f {
    let moved = normalize(h + translate.x * x + translate.y * y);
    let squashed = normalize(moved - squash * dot(moved, x) * x);
    return normalize(squashed - split.x * sign(dot(squashed, x)) * x - split.y * sign(dot(squashed, y)) * y);
}

// Distance from the middle of the highlight, as the sine of the angle between H and the normal: round at a square of 0,
// that of a square at 1.
fn highlight_distance(a: f32, b: f32, square: f32) -> f32 {
    return mix(length(vec2f(a, b)), max(abs(a), abs(b)), square);
}

// Share of a pixel inside a shape whose border is `size` away; `footprint` is what the distance changes by in a pixel.
fn highlight_inside(distance: f32, size: f32, footprint: f32) -> f32 {
    return saturate((size - distance) / max(footprint, 1e-5) + 0.5);
}

// H for brushed metal: its part along the brush counts less, which stretches the highlight across.
fn highlight_brushed(a: f32, b: f32, anisotropy: f32) -> vec2f {
    return vec2f(a * (1.0 - 0.95 * anisotropy), b);
}
