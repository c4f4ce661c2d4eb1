// Spreads the light on skin over the picture: a disc of taps as far as its profile says, in mm of the surface (Golubev 2018).
import package::bind::picture::{PictureVarying, picture_varying};
import package::bind::skin_light::{phase_of, reach_at, skin_light, skin_light_at};
import package::lib::skin::disc_weight;
import package::lib::skin_light::BY_DISC;

struct DiscNumbers {
    // At a distance of a metre.
    mm_per_px: f32,
    count: u32,
    unused: vec2u,
    // Place in a profile of d = 1, its radius, and 1/8 pi over the density of places there; of each pixel of two by two, whose mean
    // is as good as all of them.
    taps: array<array<vec4f, 40>, 4>,
}

@group(0) @binding(0) var<uniform> numbers: DiscNumbers;

// A pixel is the more of a surface, the more that is turned away; at its rim few pixels stand for much.
const LEAST_COSINE: f32 = 0.1;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> PictureVarying {
    return picture_varying(vertex);
}

@fragment
fn fs_main(in: PictureVarying) -> @location(0) vec4f {
    let at = vec2i(in.position.xy);
    let here = skin_light_at(at);
    // What lines have spread stays.
    if here.profile < BY_DISC {
        discard;
    }
    let last = vec2i(textureDimensions(skin_light)) - 1;
    let reach = reach_at(at, here, numbers.mm_per_px);
    // Where light stays within a pixel nothing is spread. A count of 0 rather than a branch: software rasterizers walk both sides
    // of branches, but leave loops early.
    let taps = select(numbers.count, 0u, here.profile < BY_DISC || reach.far * 8.0 < reach.mm_per_px);
    let phase = phase_of(at);
    var sum = vec3f(0.0);
    var weights = vec3f(0.0);
    for (var i = 0u; i < taps; i++) {
        // Down to whole pixels: what reads two by two reads half a pixel beside.
        let unit = numbers.taps[phase][i];
        let tap = unit.xyz * reach.far;
        let there = skin_light_at(clamp(at + vec2i(floor(tap.xy / reach.mm_per_px)), vec2i(0), last));
        let deeper = (there.distance - here.distance) * 1000.0;
        let area = 1.0 / max(there.cosine, LEAST_COSINE);
        // Of other skin, and from beyond its border, no light comes.
        let is_same = there.profile == here.profile;
        let weight = disc_weight(tap.z, deeper, reach.distance, unit.w * reach.far * reach.far) * select(0.0, area, is_same);
        sum += there.light * weight;
        weights += weight;
    }
    return vec4f(select(here.light, sum / max(weights, vec3f(1e-12)), weights > vec3f(1e-9)), here.distance);
}
