// Painted highlights that move as a whole. Unit vectors in one common space: v to the viewer, l to the light, f the front
// of the face, u its up axis; v and l from the head, so that a highlight keeps its shape.

// Movement of the texture coordinates: along u by k_turn V.A with A = -(U x F), which grows as the head turns to the right
// of the picture; along v by k_light V.L + k_view V.F.
fn highlight_offset(v: vec3f, l: vec3f, f: vec3f, u: vec3f, k_turn: f32, k_light: f32, k_view: f32) -> vec2f {
    return vec2f(-k_turn * dot(v, cross(u, f)), k_light * dot(v, l) + k_view * dot(v, f));
}

// What is left of it: it fades where the light stands behind the head as it is seen, and where the head turns away below
// the cosine `facing`.
fn highlight_fade(v_dot_f: f32, v_dot_l: f32, facing: f32) -> f32 {
    return smoothstep(-0.6, 0.3, v_dot_l) * smoothstep(facing, facing + 0.35, v_dot_f);
}

// What strands leave of a layer: all of it at a breakup of 0; with more, only where the layer is above the strand.
fn highlight_broken(layer: f32, strand: f32, breakup: f32) -> f32 {
    return saturate((layer - breakup * strand) / max(1.0 - breakup, 1e-3));
}

// How far a card of light goes to the character's left and up, metres; directions to the viewer and the light by the axes of the
// face. What stands behind the head moves it no farther than what stands beside it.
fn card_shift(view: vec3f, to_light: vec3f, by_view: vec2f, by_light: vec2f, within: f32) -> vec2f {
    let shift = view.xy * by_view + to_light.xy * by_light;
    return shift * min(1.0, max(within, 0.0) / max(length(shift), 1e-9));
}
