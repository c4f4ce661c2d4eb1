// Lines inside of a shape, where two places of the picture belong to different surfaces.

// 1 where a line lies between them: parts (0 is the background, which outlines take care of), the cosine between their
// normals, and what they are apart in depth. `steps` are the least step in depth and the cosine below which a fold is one.
fn line_between(part: u32, other: u32, n_dot_n: f32, step_m: f32, steps: vec2f, by_part: bool) -> f32 {
    let is_inside = part != 0u && other != 0u;
    let differs = (by_part && part != other) || step_m > steps.x || n_dot_n < steps.y;
    return select(0.0, 1.0, is_inside && differs);
}
