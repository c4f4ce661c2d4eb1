// Surfaces that burn away, and that fade without blending.
import package::lib::noise::cell_hash;

// When a place burns, 0..1; `at` in cells of the noise, `height` over the feet in shares of the character's, below 0 where it
// has none.
fn dissolve_time(at: vec3f, height: f32) -> f32 {
    let noise = dissolve_noise(at) * 0.72 + dissolve_noise(at * 3.0 + 17.0) * 0.28;
    return select(mix(noise, saturate(height), 0.75), noise, height < 0.0);
}

// Smooth noise of 0..1 over a lattice of unit cells.
fn dissolve_noise(at: vec3f) -> f32 {
    let first = vec3i(floor(at));
    let f = fract(at);
    let t = f * f * (3.0 - 2.0 * f);
    var sum = 0.0;
    for (var i = 0; i < 8; i++) {
        let corner = vec3i(i & 1, (i >> 1u) & 1, i >> 2u);
        let share = mix(1.0 - t, t, vec3f(corner));
        sum += cell_hash(first + corner).x * share.x * share.y * share.z;
    }
    return sum;
}

// Distance of a place from the border: gone below 0, glowing up to 1, as it was above. Nothing burns at an amount of 0, and
// nothing is left at 1.
fn dissolve_place(time: f32, amount: f32, border: f32) -> f32 {
    let edge = amount * (1.0 + border) - border;
    return (time - edge) / max(border, 1e-4);
}

// Blue noise of 16 x 16 pixels, four of a row in a number, the first in its lowest byte; each quarter has all of 0..63.
const BLUE_NOISE: array<u32, 64> = array<u32, 64>(
    0x3d380933u, 0x1029190cu, 0x04381633u, 0x19273622u, 0x20111b24u, 0x1c023a14u, 0x1325082du, 0x3c071c2cu,
    0x28062c01u, 0x0d35082fu, 0x3b301f3du, 0x12340c02u, 0x16363e0bu, 0x27211a03u, 0x1b0f0118u, 0x212e1728u,
    0x230e1e15u, 0x31122b3bu, 0x0929370bu, 0x3a05233fu, 0x32053026u, 0x04390f1du, 0x14321d24u, 0x1a350e2fu,
    0x172a1307u, 0x1f34000au, 0x20063e15u, 0x002a1e39u, 0x3f22373cu, 0x2d18252eu, 0x26102b0du, 0x31110a03u,
    0x11020d1fu, 0x3b050f37u, 0x1b380133u, 0x1a243b2cu, 0x26192f28u, 0x0b1a2a1eu, 0x32082113u, 0x0535160du,
    0x333c0814u, 0x36243d09u, 0x142a1927u, 0x3a0b2e22u, 0x172c2234u, 0x00153003u, 0x023f2f09u, 0x00291d39u,
    0x38100c1cu, 0x3a0e1b23u, 0x23361120u, 0x17100712u, 0x2b013e2eu, 0x272d3f0au, 0x18061c31u, 0x253c3028u,
    0x1d162007u, 0x18061235u, 0x342b3d0cu, 0x37031f0au, 0x04312913u, 0x39213225u, 0x0f1e2604u, 0x0e2d153eu,
);

// Threshold of a pixel, 0..1: even over 8 x 8, and without a pattern that is seen.
fn dither_threshold(pixel: vec2u) -> f32 {
    let at = pixel % 16u;
    // A constant cannot be indexed by what is not.
    var noise = BLUE_NOISE;
    let four = noise[at.y * 4u + at.x / 4u];
    return (f32((four >> (8u * (at.x % 4u))) & 255u) + 0.5) / 64.0;
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
