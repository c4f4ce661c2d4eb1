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

// Pixels of a metre in a picture `height` high. `focal` is the cotangent of half the vertical field of view, `distance` is
// along the view. 1e-6: at the eye itself.
fn outline_px_per_m(focal: f32, distance: f32, height: f32) -> f32 {
    return 0.5 * height * focal / max(distance, 1e-6);
}

// Width in pixels, so that it covers no fewer and no more pixels of a picture 1024 high than `bounds` say.
fn outline_bounded(width_px: f32, height: f32, bounds: vec2f) -> f32 {
    let px = height / 1024.0;
    return clamp(width_px, bounds.x * px, max(bounds.x, bounds.y) * px);
}

// Least width of a line that is drawn, pixels: it would break into dots.
const OUTLINE_LEAST_PX: f32 = 1.0;

// What a width in pixels is multiplied by so that the line stays whole, and its cover, so that it is no darker for that.
// 1e-4: a line of no width stays hidden.
fn outline_resolved(width_px: f32) -> vec2f {
    let cover = min(width_px / OUTLINE_LEAST_PX, 1.0);
    return vec2f(select(0.0, 1.0 / max(cover, 1e-4), cover > 1e-4), cover);
}

// Colour of a line round a surface of a colour: its power, turned by `shift` in hue and saturation, times `tint`. 1e-6: pow
// of 0 is left to no driver.
fn outline_tinted(surface: vec3f, gamma: f32, shift: mat3x3f, tint: vec3f) -> vec3f {
    return max(shift * pow(max(surface, vec3f(1e-6)), vec3f(gamma)), vec3f(0.0)) * tint;
}
