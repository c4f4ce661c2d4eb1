// The picture with what it was before: means over time, where the same surface was seen there.
import package::bind::picture::{PictureVarying, picture_varying};
import package::lib::temporal::{
    clipped_to_box, pressed, rgb_from_ycocg, spline_weights, unpressed, ycocg_from_rgb,
};

struct TemporalNumbers {
    // Without jitter: this picture's, and the last one's.
    world_from_clip: mat4x4f,
    clip_before: mat4x4f,
    eye: vec3f,
    // Depth is near / distance.
    near: f32,
    size_px: vec2f,
    // Height of the ground; `has_ground` is 1 where there is one.
    ground_y: f32,
    has_ground: f32,
    // How far the camera has moved, metres.
    eye_moved: f32,
    // 1 where actors have come or gone.
    has_others: f32,
    // 1 where there is a last picture.
    is_continued: f32,
}

@group(0) @binding(0) var<uniform> temporal: TemporalNumbers;
@group(0) @binding(1) var picture: texture_2d<f32>;
@group(0) @binding(2) var velocity: texture_2d<f32>;
@group(0) @binding(3) var depth: texture_depth_2d;
@group(0) @binding(4) var history: texture_2d<f32>;
// Of the last picture: 1 / distance, how many pictures each pixel is the mean of, the mean square by which these differ, and
// 1 / distance of the nearest surface about it.
@group(0) @binding(5) var past: texture_2d<f32>;
@group(0) @binding(6) var history_sampler: sampler;

// Most pictures in a mean, of what stands still and of what moves: each move softens it, and contours do not move as their
// surfaces do.
const MOST: f32 = 24.0;
const MOST_MOVING: f32 = 4.0;

struct Resolved {
    @location(0) color: vec4f,
    @location(1) past: vec4f,
}

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> PictureVarying {
    return picture_varying(vertex);
}

// Movement of what has no surface: the ground, or what is infinitely far.
fn background_velocity(place: vec2f) -> vec2f {
    let ndc = (place / temporal.size_px * 2.0 - 1.0) * vec2f(1.0, -1.0);
    let ray = (temporal.world_from_clip * vec4f(ndc, 0.0, 1.0)).xyz;
    let along = (temporal.ground_y - temporal.eye.y) / select(ray.y, 1e-9, abs(ray.y) < 1e-9);
    let hits = temporal.has_ground > 0.5 && along > 0.0;
    let at = select(vec4f(ray, 0.0), vec4f(temporal.eye + ray * along, 1.0), hits);
    let before = temporal.clip_before * at;
    let moved = place - (before.xy / max(before.w, 1e-9) * vec2f(0.5, -0.5) + 0.5) * temporal.size_px;
    // Rounding is no movement.
    return select(moved, vec2f(0.0), all(abs(moved) < vec2f(1.0 / 256.0)));
}

// The history between its texels, as sharp as it is.
fn history_at(place: vec2f) -> vec4f {
    let first = floor(place - 0.5) + 0.5;
    let x = spline_weights(place.x - first.x);
    let y = spline_weights(place.y - first.y);
    // The middle two texels of each axis are one filtered read.
    let wx = vec3f(x.x, x.y + x.z, x.w);
    let wy = vec3f(y.x, y.y + y.z, y.w);
    let at_x = vec3f(first.x - 1.0, first.x + x.z / wx.y, first.x + 2.0) / temporal.size_px.x;
    let at_y = vec3f(first.y - 1.0, first.y + y.z / wy.y, first.y + 2.0) / temporal.size_px.y;
    // Corners weigh next to nothing.
    var sum = wx.y * wy.x * textureSampleLevel(history, history_sampler, vec2f(at_x.y, at_y.x), 0.0);
    sum += wx.x * wy.y * textureSampleLevel(history, history_sampler, vec2f(at_x.x, at_y.y), 0.0);
    sum += wx.y * wy.y * textureSampleLevel(history, history_sampler, vec2f(at_x.y, at_y.y), 0.0);
    sum += wx.z * wy.y * textureSampleLevel(history, history_sampler, vec2f(at_x.z, at_y.y), 0.0);
    sum += wx.y * wy.z * textureSampleLevel(history, history_sampler, vec2f(at_x.y, at_y.z), 0.0);
    let weight = wx.y * (wy.x + wy.y + wy.z) + wy.y * (wx.x + wx.z);
    // Splines overshoot.
    let found = max(sum / weight, vec4f(0.0));
    return vec4f(found.rgb, min(found.a, 1.0));
}

@fragment
fn fs_main(in: PictureVarying) -> Resolved {
    let pixel = vec2i(in.position.xy);
    let last = vec2i(temporal.size_px) - 1;
    let here = textureLoad(depth, pixel, 0);

    // Colours and depths about the pixel, and the nearest surface there: edges move with it.
    var sum = vec4f(0.0);
    var squares = vec4f(0.0);
    var nearest = 0.0;
    var farthest = 1e9;
    var mover = pixel;
    var drawn = vec4f(0.0);
    for (var i = 0; i < 9; i++) {
        let at = clamp(pixel + vec2i(i % 3, i / 3) - 1, vec2i(0), last);
        let color = pressed(textureLoad(picture, at, 0));
        drawn = select(drawn, color, i == 4);
        let c = ycocg_from_rgb(color);
        sum += c;
        squares += c * c;
        let d = textureLoad(depth, at, 0);
        farthest = min(farthest, d);
        mover = select(mover, at, d > nearest);
        nearest = max(nearest, d);
    }
    // Lines round a shape are wider than one pixel.
    var wide = nearest;
    var wide_farthest = farthest;
    for (var i = 0; i < 8; i++) {
        let step = vec2i(array(-2, 0, 2, 2, 2, 0, -2, -2)[i], array(-2, -2, -2, 0, 2, 2, 2, 0)[i]);
        let at = clamp(pixel + step, vec2i(0), last);
        let d = textureLoad(depth, at, 0);
        mover = select(mover, at, d > wide);
        wide = max(wide, d);
        wide_farthest = min(wide_farthest, d);
    }
    // A surface moves as it does here: its nearest place about the pixel would always lead it the same way.
    var moved = textureLoad(velocity, select(pixel, mover, wide > here * 1.01), 0).xy;
    if wide == 0.0 {
        moved = background_velocity(in.position.xy);
    }

    let from_place = in.position.xy - moved;
    let known = textureLoad(past, clamp(vec2i(floor(from_place)), vec2i(0), last), 0);
    let is_inside = all(from_place >= vec2f(0.0)) && all(from_place <= temporal.size_px);
    // Something else was seen there: nearer, or farther, than anything about the pixel now. What stands still is uncovered by
    // nothing, and noise has holes.
    let has_others = temporal.has_others > 0.5;
    let is_still = all(abs(moved) < vec2f(0.1)) && !has_others;
    let low = select(farthest, wide_farthest, is_still) / temporal.near;
    let high = select(nearest, wide, is_still) / temporal.near;
    // One that moves may be at another distance by a twentieth.
    let is_same = known.x >= low * (0.95 - temporal.eye_moved * low) && known.x <= high * (1.05 + temporal.eye_moved * high);
    let around = wide / temporal.near;
    let is_same_around = known.w >= around * 0.95 && known.w <= around * 1.05;
    let is_known = temporal.is_continued > 0.5 && is_inside && ((is_same && (is_same_around || !has_others)) || (is_still && is_same_around));

    let mean = sum / 9.0;
    let spread = sqrt(max(squares / 9.0 - mean * mean, vec4f(0.0)));
    // Where all stands still, and nothing nearer has gone, the history may be as far away as pictures have been from each other:
    // fine noise and lines that are now here, now there would never come to their mean. Elsewhere it would be a ghost.
    let has_stayed = is_still && known.w * 0.95 <= around;
    let half = max(spread * select(1.25, 2.0, has_stayed), vec4f(select(0.0, sqrt(known.z), has_stayed)));
    let now = ycocg_from_rgb(drawn);
    let before = clipped_to_box(ycocg_from_rgb(pressed(history_at(from_place))), mean, half);
    let count = select(0.0, min(known.y, mix(MOST, MOST_MOVING, saturate(length(moved) * 8.0)) - 1.0), is_known);
    let kept = count / (count + 1.0);
    let off = (now - before) * (now - before);
    let differs = mix(max(max(off.x, off.y), max(off.z, off.w)), known.z, kept) * select(0.0, 1.0, is_known && has_stayed);
    let color = unpressed(max(rgb_from_ycocg(mix(now, before, kept)), vec4f(0.0)));
    return Resolved(vec4f(color.rgb, min(color.a, 1.0)), vec4f(here, 0.0, 0.0, wide) / temporal.near + vec4f(0.0, count + 1.0, differs, 0.0));
}
