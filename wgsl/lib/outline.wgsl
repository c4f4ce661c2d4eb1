// Where the hull of an outline stands on screen.
import package::lib::normal::normalize_or;

// Moves a clip-space vertex by `height_ratio` of the picture's height along its projected normal: the same width at any
// distance, field of view and aspect (width over height). A normal along the view does not move.
fn outline_clip(clip: vec4f, normal_clip: vec2f, height_ratio: f32, aspect: f32) -> vec4f {
    // Direction in pixels.
    let direction = normalize_or(vec3f(normal_clip.x * aspect, normal_clip.y, 0.0), vec3f(0.0)).xy;
    let offset = direction * 2.0 * height_ratio * clip.w;
    return clip + vec4f(offset.x / aspect, offset.y, 0.0, 0.0);
}

// Width in the world, metres, so that it covers no fewer and no more pixels of a picture 1024 high than `bounds` say.
// `focal` is the cotangent of half the vertical field of view, `distance` is along the view. 1e-6: at the eye itself.
fn outline_bounded(width_m: f32, focal: f32, distance: f32, bounds: vec2f) -> f32 {
    let px_per_m = 512.0 * focal / max(distance, 1e-6);
    return clamp(width_m * px_per_m, bounds.x, max(bounds.x, bounds.y)) / px_per_m;
}

// Colour of a line round a surface of a colour: its power, turned by `shift` in hue and saturation, times `tint`. 1e-6: pow
// of 0 is left to no driver.
fn outline_tinted(surface: vec3f, gamma: f32, shift: mat3x3f, tint: vec3f) -> vec3f {
    return max(shift * pow(max(surface, vec3f(1e-6)), vec3f(gamma)), vec3f(0.0)) * tint;
}
