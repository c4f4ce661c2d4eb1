// Thin knit over skin.

// Share of the skin that is covered where it is seen at N.V, if `cover` of it is face on.
fn stocking_cover(cover: f32, n_dot_v: f32) -> f32 {
    return 1.0 - pow(max(1.0 - cover, 1e-4), 1.0 / clamp(n_dot_v, 0.05, 1.0));
}
