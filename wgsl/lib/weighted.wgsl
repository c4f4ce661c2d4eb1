// Weighted blended transparency (McGuire and Bavoil 2013): layers in any order, the nearer ones weighing more.

// Place of a layer between the near side of a sphere (0) and its far side (1); all of them distances along the view, metres.
fn weighted_place(distance: f32, middle: f32, radius: f32) -> f32 {
    // 1e-6: a sphere without size.
    return saturate((distance - (middle - radius)) / max(2.0 * radius, 1e-6));
}

// Weight of a layer. The weights of the paper are made for whole scenes: over a head they differ by a third from front to back.
fn weighted_weight(alpha: f32, place: f32) -> f32 {
    return alpha * exp(6.0 * (1.0 - place));
}

// What weighs less because it belongs to one who is farther away than the nearest. e^-4: halves do not tell more apart.
fn weighted_nearness(nearest: f32, middle: f32) -> f32 {
    return max(pow(saturate(nearest / max(middle, 1e-6)), 8.0), exp(-4.0));
}

// What a layer adds to the sums of colour and alpha.
fn weighted_layer(color: vec3f, alpha: f32, weight: f32) -> vec4f {
    return vec4f(color, 1.0) * (alpha * weight);
}

// All layers together, from their sums and what they leave of what is behind: colour, straight, and alpha.
fn weighted_resolved(sums: vec4f, left: f32) -> vec4f {
    // 1e-7: the least that halves hold.
    return vec4f(sums.rgb / max(sums.a, 1e-7), 1.0 - left);
}
