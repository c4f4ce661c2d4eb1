// Surfaces that burn away, and that fade without blending.
import package::lib::noise::value_noise;

// When a place burns, 0..1.
fn dissolve_time(uv: vec2f, cells: vec2i) -> f32 {
    let at = uv * vec2f(cells);
    let coarse = value_noise(at, cells, 5);
    let fine = value_noise(at * 3.0, cells * 3, 7);
    return coarse * 0.72 + fine * 0.28;
}

// Distance of a place from the border: gone below 0, glowing up to 1, as it was above. Nothing burns at an amount of 0, and
// nothing is left at 1.
fn dissolve_place(time: f32, amount: f32, border: f32) -> f32 {
    let edge = amount * (1.0 + border) - border;
    return (time - edge) / max(border, 1e-4);
}

// Threshold of a pixel in the even pattern of 8 x 8 (Bayer), 0..1.
fn dither_threshold(pixel: vec2u) -> f32 {
    let x = pixel.x ^ pixel.y;
    let y = pixel.y;
    let bits = ((x & 1u) << 5u) | ((y & 1u) << 4u) | ((x & 2u) << 2u) | ((y & 2u) << 1u) | ((x & 4u) >> 1u) | ((y & 4u) >> 2u);
    return (f32(bits) + 0.5) / 64.0;
}

// Which of a pixel's four samples are there where `left` is left of a surface, 0..1, as bits: a quarter more of them each
// time that the pattern's threshold allows. The first one turns with the pixel, so that no sample is left out more than
// the others.
fn dither_samples(left: f32, pixel: vec2u) -> u32 {
    let count = u32(floor(4.0 * saturate(left) + 1.0 - dither_threshold(pixel)));
    let bits = (1u << min(count, 4u)) - 1u;
    let turn = (pixel.x + 2u * pixel.y) % 4u;
    return ((bits << turn) | (bits >> (4u - turn))) & 15u;
}
