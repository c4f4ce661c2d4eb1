// Noise for cuts that stand for transparency: it lies on the surface, and its grains are as large as a pixel at any distance
// (Wyman and McGuire 2017, "Hashed Alpha Testing").
import package::lib::noise::cell_hash;

// Share of a mixture of two even numbers of 0..1 that is below x; `a` is the lesser share of the two in the mixture.
fn mixture_share(x: f32, a: f32) -> f32 {
    // 1e-4: where one of them is nearly alone, so is its own share.
    let least = max(a, 1e-4);
    let steep = 2.0 * least * (1.0 - least);
    let middle = (x - 0.5 * least) / (1.0 - least);
    let y = 1.0 - x;
    return select(select(middle, 1.0 - y * y / steep, x > 1.0 - least), x * x / steep, x < least);
}

// Threshold of a place of a surface, above 0 and up to 1: all of them are as frequent. `at` is the place along the surface,
// metres; `number` that of the picture: over many pictures a place has all thresholds in turn.
fn hashed_threshold(at: vec2f, pixel: vec2f, number: u32) -> f32 {
    let wide = max(length(dpdx(at)), length(dpdy(at)));
    // Two sizes of grains, each a power of two, between which the size of a pixel lies. 1e-7 m: nobody is seen as near.
    let octave = -log2(max(wide, 1e-7));
    let coarse = floor(octave);
    let share = octave - coarse;
    let a = cell_hash(vec3i(vec2i(floor(at * exp2(coarse))), i32(coarse))).x;
    let b = cell_hash(vec3i(vec2i(floor(at * exp2(coarse + 1.0))), i32(coarse) + 1)).x;
    let on_surface = mixture_share(mix(a, b, share), min(share, 1.0 - share));
    // What has no place in its texture has noise that lies on the picture.
    let on_picture = cell_hash(vec3i(vec2i(pixel), 0)).x;
    // Steps of the golden ratio, in 32 bits.
    let step = f32((number * 2654435769u) >> 8u) / 16777216.0;
    return 1.0 - fract(select(on_surface, on_picture, wide == 0.0) + step);
}

// How many of four samples a surface covers, so that all pixels together cover `alpha`.
fn hashed_count(alpha: f32, threshold: f32) -> f32 {
    return floor(4.0 * saturate(alpha) + 1.0 - threshold);
}

// So many of four samples, as bits; which ones is another thing for surfaces behind each other.
fn hashed_samples(count: u32, place: vec4f) -> u32 {
    let bits = (1u << min(count, 4u)) - 1u;
    let turn = u32(cell_hash(vec3i(vec2i(place.xy), bitcast<i32>(place.z))).x * 4.0);
    return ((bits << turn) | (bits >> (4u - turn))) & 15u;
}
