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
