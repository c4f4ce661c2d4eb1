// Punctual lights.

// Luminance of linear sRGB primaries (Rec. 709).
fn luminance(color: vec3f) -> f32 {
    return dot(color, vec3f(0.2126, 0.7152, 0.0722));
}

// Attenuation of KHR_lights_punctual: inverse square, windowed to zero at `range` (0: no window). Distances in
// metres. 1e-4 m² keeps the value finite at the light itself.
fn distance_attenuation(distance_sq: f32, range: f32) -> f32 {
    let inverse_square = 1.0 / max(distance_sq, 1e-4);
    if range <= 0.0 {
        return inverse_square;
    }
    let ratio_sq = distance_sq / (range * range);
    let window = saturate(1.0 - ratio_sq * ratio_sq);
    return inverse_square * window;
}

// Spot cone of KHR_lights_punctual: (cos_angle * scale + offset)², clamped; scale 0 and offset 1 for a point light.
fn spot_attenuation(cos_angle: f32, scale: f32, offset: f32) -> f32 {
    let x = saturate(cos_angle * scale + offset);
    return x * x;
}

// How far a lamp shows the shade colour on the side that it does not light: as far as it outshines the key light, whose shade
// that is. 1e-6: no lamp is none.
fn lamp_shade(lamp: f32, key: f32) -> f32 {
    return saturate(1.0 - key / max(lamp, 1e-6));
}

// Light as a material takes it: its luminance between two bounds, and its colour as far as `monochrome` (0..1) leaves it.
// 1e-6: black light has no colour, its lower bound is grey.
fn light_response(light: vec3f, low: f32, high: f32, monochrome: f32) -> vec3f {
    let y = luminance(light);
    let bounded = clamp(y, low, max(low, high));
    let colored = select(vec3f(bounded), light * (bounded / max(y, 1e-6)), y > 1e-6);
    return mix(colored, vec3f(bounded), monochrome);
}
