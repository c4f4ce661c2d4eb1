// A painted backdrop: a gradient, a glow and lights out of focus. Colours are mixed as they are seen, sRGB-encoded.
import package::lib::noise::cell_hash;

// How much a round light of one radius covers at a distance from its middle, both as shares of the picture's height: even,
// with a brighter rim, as a lens draws what it does not focus on.
fn disc_cover(distance: f32, radius: f32, soft: f32) -> f32 {
    let inside = 1.0 - smoothstep(radius - soft, radius + soft, distance);
    return inside * (0.72 + 0.28 * smoothstep(0.55, 0.95, distance / radius));
}

// Lays light over a colour; it never grows beyond white.
fn screened(color: vec3f, light: vec3f) -> vec3f {
    return color + light * (1.0 - color);
}

// Three colours from top to bottom without a crease in the middle.
fn backdrop_gradient(top: vec3f, middle: vec3f, bottom: vec3f, y: f32) -> vec3f {
    return mix(mix(top, middle, smoothstep(0.0, 1.0, saturate(y * 2.0))), bottom, smoothstep(0.5, 1.0, y));
}

// Lights out of focus; `p` is a place and `wide` the width, in heights of the picture.
fn backdrop_discs(p: vec2f, wide: f32, color: vec3f, count: u32, radius: f32, seed: u32) -> vec3f {
    var light = vec3f(0.0);
    for (var i = 0u; i < count; i++) {
        let at = cell_hash(vec3i(i32(i), i32(seed), 1)).xyz;
        let kind = cell_hash(vec3i(i32(i), i32(seed), 2)).xyz;
        // Spread evenly (Roberts 2018, R2), then moved a little; some lie across the edges.
        let even = fract(vec2f(0.5 + f32(seed) * 0.37) + f32(i) * vec2f(0.7548777, 0.5698403));
        let middle = ((even + (at.xy - 0.5) * 0.18) * 1.16 - 0.08) * vec2f(wide, 1.0);
        let share = 0.25 + 0.75 * kind.x * kind.x;
        // Larger ones are farther out of focus: softer and fainter.
        let cover = disc_cover(distance(p, middle), radius * share, radius * 0.03 + 0.0012);
        let warmth = (kind.y - 0.5) * 0.7;
        light += cover * (0.14 + 0.46 * kind.z * (1.1 - share)) * (color * vec3f(1.0 + warmth, 1.0, 1.0 - warmth));
    }
    return light;
}

// Linear from sRGB-encoded.
fn linear_from_seen(seen: vec3f) -> vec3f {
    let c = saturate(seen);
    return select(pow((c + 0.055) / 1.055, vec3f(2.4)), c / 12.92, c <= vec3f(0.04045));
}

// Noise of at most a step of 8 bits, which hides the steps of a gradient.
fn backdrop_dither(pixel: vec2i) -> vec3f {
    return (cell_hash(vec3i(pixel, 3)) + cell_hash(vec3i(pixel, 4)) - 1.0) / 255.0;
}
