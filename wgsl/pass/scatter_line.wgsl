// Spreads the light on skin along rows and then along columns of the picture, by the line spread of its profile in mm of the
// surface: on flat skin an edge of light is exact whichever way it runs along them (Jimenez et al. 2015 spread by a slice).
import package::bind::picture::{PictureVarying, picture_varying};
import package::bind::skin_light::{phase_of, reach_at, skin_light, skin_light_at};
import package::lib::skin::{line_beyond, line_rate};
import package::lib::skin_light::{BY_DISC, SkinLight, skin_light_packed};

struct LineNumbers {
    // At a distance of a metre.
    mm_per_px: f32,
    // To each side.
    count: u32,
    unused: vec2u,
    // Distance of each tap in a profile of d = 1, of each pixel of two by two, whose mean is as good as all of them.
    taps: array<vec4f, 10>,
}

@group(0) @binding(0) var<uniform> numbers: LineNumbers;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> PictureVarying {
    return picture_varying(vertex);
}

// What reads two by two pixels reads so far beside the first of them.
const BESIDE_PX: f32 = 0.5;

// Light that comes to half a pixel before a texel along a line; `phase` counts pixels of two by two.
fn spread_along(at: vec2i, here: SkinLight, step: vec2i, phase: u32) -> vec3f {
    let last = vec2i(textureDimensions(skin_light)) - 1;
    let reach = reach_at(at, here, numbers.mm_per_px);
    // Where light stays within a pixel nothing is spread. A count of 0 rather than a branch: software rasterizers walk both sides
    // of branches, but leave loops early.
    let count = select(0u, numbers.count, here.profile < BY_DISC && reach.far * 8.0 >= reach.mm_per_px);
    let rate = line_rate(reach.distance);
    let pixels_per_mm = 1.0 / reach.mm_per_px;
    var sum = here.light;
    for (var side = 0u; side < 2u; side++) {
        // To the other side the pixels of two by two change places.
        let own = select(phase, 3u - phase, side == 1u);
        let onward = select(1.0, -1.0, side == 1u);
        // Each tap has the light of its cell, which begins half way from the last one: what comes from beyond that differs by the
        // difference of the two. Where there is none of this skin the last one goes on.
        var light = here.light;
        var way = BESIDE_PX * onward * reach.mm_per_px;
        for (var i = 0u; i < count; i++) {
            let pixels = max(round(numbers.taps[i][own] * reach.far * pixels_per_mm), 1.0);
            let there = skin_light_at(clamp(at + step * i32(onward * pixels), vec2i(0), last));
            let is_same = there.profile == here.profile;
            let deeper = select(0.0, there.distance - here.distance, is_same) * 1000.0;
            let way_there = max(length(vec2f((pixels + BESIDE_PX * onward) * reach.mm_per_px, deeper)), way);
            let next = select(light, there.light, is_same);
            sum += (next - light) * (line_beyond((way + way_there) * 0.5, rate) * 0.5);
            light = next;
            way = way_there;
        }
    }
    return sum;
}

@fragment
fn fs_across(in: PictureVarying) -> @location(0) vec4u {
    let at = vec2i(in.position.xy);
    var here = skin_light_at(at);
    here.light = spread_along(at, here, vec2i(1, 0), phase_of(at));
    return skin_light_packed(here);
}

@fragment
fn fs_down(in: PictureVarying) -> @location(0) vec4f {
    let at = vec2i(in.position.xy);
    let here = skin_light_at(at);
    return vec4f(spread_along(at, here, vec2i(0, 1), phase_of(at.yx)), here.distance);
}
