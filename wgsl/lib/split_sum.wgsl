// The table of what rough mirrors give back of light from all around.

// Entries along the cosine of the view, and along the roughness.
const SPLIT_SUM_SIDE: u32 = 32u;

// Place in the table. Entries stand closer towards grazing views.
fn split_sum_place(n_dot_v: f32, roughness: f32) -> vec2f {
    return vec2f(sqrt(saturate(n_dot_v)), saturate(roughness)) * f32(SPLIT_SUM_SIDE - 1u);
}
