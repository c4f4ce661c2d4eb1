// What is drawn along contours that the prepass shows: light by depth, and lines.
import package::bind::frame::{distance_at, frame, frame_depth, surface_at};
import package::bind::lights::punctual_light;
import package::bind::material::{material, base_sampler, rim_width_texture};
import package::bind::options::SurfaceOptions;
import package::bind::texel::texture_uv;
import package::lib::depth_rim::{depth_rim_near, depth_rim_offset, depth_rim_resolved, depth_rim_side, depth_rim_step};
import package::lib::inner_lines::line_between;
import package::lib::light::luminance;

struct Rim {
    // Radiance, before the surface's own colour tints it.
    light: vec3f,
    // Share of a pixel, for the channel.
    share: f32,
}

// Light along the contour; `gi` is what arrives on its shaded side.
fn depth_rim(options: SurfaceOptions, pixel: vec3f, position: vec3f, normal: vec3f, uv: vec4f, gi: vec3f) -> Rim {
    let seen = (frame.view_from_world * vec4f(normal, 0.0)).xy;
    let height = f32(textureDimensions(frame_depth).y);
    var width = material.depth_rim_width;
    if options.rim_width {
        width *= textureSample(rim_width_texture, base_sampler, texture_uv(options, uv, material.rim_width_uv)).r;
    }
    let offset = depth_rim_offset(seen, width, height);
    let here = frame.near / max(pixel.z, 1e-12);
    // Two places a pixel apart soften the inner edge; a little less, since half a pixel lies between two centres.
    let half_px = offset * (0.49 / max(length(offset), 0.5));
    let near_step = distance_at(vec2i(floor(pixel.xy + offset - half_px))) - here;
    let far_step = distance_at(vec2i(floor(pixel.xy + offset + half_px))) - here;
    let threshold = material.depth_rim_threshold;
    let edge = 0.5 * (depth_rim_step(near_step, threshold) + depth_rim_step(far_step, threshold))
        * depth_rim_resolved(width, height) * depth_rim_near(here, material.depth_rim_fade);
    let lit_side = rim_side(normal, seen, frame.to_light);
    var contour = edge * lit_side;
    var rim = material.depth_rim_color * frame.light_color * contour;
    if options.rim_shade {
        let shaded = edge * (1.0 - lit_side);
        rim += material.depth_rim_shade * (frame.light_color * 0.5 + gi) * shaded;
        contour = max(contour, shaded * 0.5);
    }
    for (var i = 0u; i < frame.punctual_count; i++) {
        let arriving = punctual_light(i, position);
        let from_there = edge * rim_side(normal, seen, arriving.to_light) * material.depth_rim_punctual;
        rim += material.depth_rim_color * min(arriving.radiance, vec3f(1.0)) * from_there;
        contour = max(contour, from_there * saturate(luminance(arriving.radiance)));
    }
    return Rim(rim, contour);
}

// Share of a rim by the side of a light; `seen` is the normal as it is seen.
fn rim_side(normal: vec3f, seen: vec2f, to_light: vec3f) -> f32 {
    let light_seen = (frame.view_from_world * vec4f(to_light, 0.0)).xy;
    // 1e-12: a normal or a light towards the viewer has no direction there.
    let outwards = dot(seen, light_seen) * inverseSqrt(max(dot(seen, seen) * dot(light_seen, light_seen), 1e-12));
    return depth_rim_side(dot(normal, to_light), outwards, material.depth_rim_side);
}

// Share of a line at a pixel: eight places round it are compared with it.
fn inner_line(pixel: vec3f) -> f32 {
    let height = f32(textureDimensions(frame_depth).y);
    // A quarter of a pixel lies between the border and the middle of a pixel on the line, as a mean.
    let radius = max(material.line_width * height / 1024.0 * 0.5, 0.5) + 0.25;
    let own = surface_at(vec2i(pixel.xy));
    let here = frame.near / max(pixel.z, 1e-12);
    var different = 0.0;
    for (var i = 0; i < 8; i++) {
        let angle = f32(i) * 0.78539816;
        let at = vec2i(floor(pixel.xy + vec2f(cos(angle), sin(angle)) * radius));
        let other = surface_at(at);
        let step = abs(distance_at(at) - here);
        different += line_between(
            own.part, other.part, dot(own.normal, other.normal), step, material.line_steps, material.line_parts > 0.5
        );
    }
    // A line of less than a pixel is as much fainter.
    return saturate(different * 0.5) * saturate(material.line_width * height / 1024.0);
}
