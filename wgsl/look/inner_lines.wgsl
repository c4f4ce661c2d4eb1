// Lines where depth, normal or part change.
import package::bind::frame::{distance_at, distance_here, frame_depth, surface_at};
import package::bind::shown::shown;
import package::bind::surface::{Shaded, Surface};
import package::lib::inner_lines::line_between;
import package::material::material;

struct InnerLines {
    color: vec3f,
    // Pixels of a picture 1024 high.
    width_px: f32,
    // Metres, and cosine.
    steps: vec2f,
    parts: f32,
}

// Share of a line at a pixel: eight places round it are compared with it.
fn inner_line(pixel: vec4f) -> f32 {
    let m = &material.inner_lines;
    let height = f32(textureDimensions(frame_depth).y);
    // A quarter of a pixel lies between the border and the middle of a pixel on the line, as a mean.
    let radius = max(m.width_px * height / 1024.0 * 0.5, 0.5) + 0.25;
    let own = surface_at(vec2i(pixel.xy));
    let here = distance_here(pixel);
    var different = 0.0;
    for (var i = 0; i < 8; i++) {
        let angle = f32(i) * 0.78539816;
        let at = vec2i(floor(pixel.xy + vec2f(cos(angle), sin(angle)) * radius));
        let other = surface_at(at);
        let step = abs(distance_at(at) - here);
        different += line_between(
            own.part, other.part, dot(own.normal, other.normal), step, m.steps, m.parts > 0.5
        );
    }
    // A line of less than a pixel is as much fainter.
    return saturate(different * 0.5) * saturate(m.width_px * height / 1024.0);
}

fn inner_lines_contour(s: ptr<function, Surface>, l: ptr<function, Shaded>, color: vec3f) -> vec3f {
    let line = inner_line(s.at.clip_position);
    @if(channel_inner_lines) shown = vec3f(line);
    // It darkens what is there: a line never glows.
    return color * mix(vec3f(1.0), material.inner_lines.color, line);
}
