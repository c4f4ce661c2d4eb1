// Light along the contour, by depth.
import package::bind::frame::{distance_at, distance_here, frame, frame_depth};
import package::bind::lights::punctual_light;
import package::bind::shown::shown;
import package::bind::surface::{Shaded, Surface};
import package::bind::uv::{UvTransform, texture_uv};
import package::lib::depth_rim::{
    depth_rim_near, depth_rim_offset, depth_rim_on, depth_rim_resolved, depth_rim_side, depth_rim_step,
};
import package::lib::light::luminance;
import package::material::{depth_rim_width_mask, depth_rim_width_mask_sampler, material};

struct DepthRim {
    color: vec3f,
    tint: f32,
    shade_color: vec3f,
    punctual: f32,
    light_side: vec2f,
    // Metres.
    fade_m: vec2f,
    // Pixels of a picture 1024 high, and metres.
    width_px: f32,
    threshold_m: f32,
    width_mask_uv: UvTransform,
}

fn depth_rim_contour(s: ptr<function, Surface>, l: ptr<function, Shaded>, color: vec3f) -> vec3f {
    let m = &material.depth_rim;
    let pixel = s.at.clip_position;
    let seen = (frame.view_from_world * vec4f(s.normal, 0.0)).xy;
    let height = f32(textureDimensions(frame_depth).y);
    var width = m.width_px;
    @if(depth_rim_width_mask) width *= textureSample(
        depth_rim_width_mask, depth_rim_width_mask_sampler, texture_uv(s.uv, m.width_mask_uv)
    ).r;
    let lit_side = rim_side(s.normal, seen, frame.to_light);
    // Its ends taper.
    @if(!depth_rim_shade && !punctual) width *= mix(0.5, 1.0, lit_side);
    let offset = depth_rim_offset(seen, width, height);
    let here = distance_here(pixel);
    // Two places a pixel apart soften the inner edge; a little less, since half a pixel lies between two centres.
    let half_px = offset * (0.49 / max(length(offset), 0.5));
    let near_step = distance_at(vec2i(floor(pixel.xy + offset - half_px))) - here;
    let far_step = distance_at(vec2i(floor(pixel.xy + offset + half_px))) - here;
    let edge = 0.5 * (depth_rim_step(near_step, m.threshold_m) + depth_rim_step(far_step, m.threshold_m))
        * depth_rim_resolved(width, height) * depth_rim_near(here, m.fade_m);
    var contour = edge * lit_side;
    var light = m.color * frame.light_color * contour;
    @if(depth_rim_shade) {
        let shaded = edge * (1.0 - lit_side);
        light += m.shade_color * (frame.light_color * 0.5 + l.gi) * shaded;
        contour = max(contour, shaded * 0.5);
    }
    @if(punctual) for (var i = 0u; i < frame.punctual_count; i++) {
        let arriving = punctual_light(i, s.at.world_position);
        let from_there = edge * rim_side(s.normal, seen, arriving.to_light) * m.punctual;
        light += m.color * min(arriving.radiance, vec3f(1.0)) * from_there;
        contour = max(contour, from_there * saturate(luminance(arriving.radiance)));
    }
    @if(channel_depth_rim) shown = vec3f(contour);
    return color + light * mix(vec3f(1.0), l.lit, m.tint) * depth_rim_on(luminance(l.lit));
}

// Share of a rim by the side of a light; `seen` is the normal as it is seen.
fn rim_side(normal: vec3f, seen: vec2f, to_light: vec3f) -> f32 {
    let light_seen = (frame.view_from_world * vec4f(to_light, 0.0)).xy;
    // 1e-12: a normal or a light towards the viewer has no direction there.
    let outwards = dot(seen, light_seen) * inverseSqrt(max(dot(seen, seen) * dot(light_seen, light_seen), 1e-12));
    return depth_rim_side(dot(normal, to_light), outwards, material.depth_rim.light_side);
}
