// Spreads the light on skin over the picture: a disc of taps as far as its profile says, in mm of the surface (Golubev 2018).
import package::bind::picture::{PictureVarying, picture_varying};
import package::lib::skin::disc_weight;

struct ScatterNumbers {
    // At a distance of a metre.
    mm_per_px: f32,
    count: u32,
    unused: vec2u,
    // Place in a profile of d = 1, its radius, and 1/8 pi over the density of places there; of each pixel of two by two, whose mean is
    // as good as all of them.
    taps: array<array<vec4f, 40>, 4>,
}

@group(0) @binding(0) var<uniform> numbers: ScatterNumbers;
// Irradiance over pi; how far light of each colour goes, mm; distance along the view in metres, and number of the profile with half
// the cosine of the view.
@group(0) @binding(1) var irradiance: texture_2d<f32>;
@group(0) @binding(2) var scattering_distance: texture_2d<f32>;
@group(0) @binding(3) var skin_place: texture_2d<f32>;

// A pixel is the more of a surface, the more that is turned away; at its rim few pixels stand for much.
const LEAST_COSINE: f32 = 0.1;

@vertex
fn vs_main(@builtin(vertex_index) vertex: u32) -> PictureVarying {
    return picture_varying(vertex);
}

@fragment
fn fs_main(in: PictureVarying) -> @location(0) vec4f {
    let at = vec2i(in.position.xy);
    let last = vec2i(textureDimensions(irradiance)) - 1;
    let here = textureLoad(irradiance, at, 0).rgb;
    let d = textureLoad(scattering_distance, at, 0).rgb;
    let place = textureLoad(skin_place, at, 0).xy;
    let number = floor(place.y);
    let far = max(d.r, max(d.g, d.b));
    let mm_per_px = max(numbers.mm_per_px * place.x, 1e-6);
    // Where light stays within a pixel nothing is spread. A count of 0 rather than a branch: software rasterizers walk both sides
    // of branches, but leave loops early.
    let taps = select(numbers.count, 0u, number == 0.0 || far * 8.0 < mm_per_px);
    let pixel = (at.x & 1) + (at.y & 1) * 2;
    var sum = vec3f(0.0);
    var weights = vec3f(0.0);
    for (var i = 0u; i < taps; i++) {
        // Down to whole pixels: what reads two by two reads half a pixel beside.
        let unit = numbers.taps[pixel][i];
        let tap = unit.xyz * far;
        let seen = clamp(at + vec2i(floor(tap.xy / mm_per_px)), vec2i(0), last);
        let there = textureLoad(skin_place, seen, 0).xy;
        let deeper = (there.x - place.x) * 1000.0;
        let area = 1.0 / max(fract(there.y) * 2.0, LEAST_COSINE);
        // Of other skin, and from beyond its border, no light comes.
        let weight = disc_weight(tap.z, deeper, d, unit.w * far * far) * select(0.0, area, floor(there.y) == number);
        sum += textureLoad(irradiance, seen, 0).rgb * weight;
        weights += weight;
    }
    return vec4f(select(here, sum / max(weights, vec3f(1e-12)), weights > vec3f(1e-9)), place.x);
}
