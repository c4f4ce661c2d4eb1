// Strips of hair.

// Light that is left in a strip, for three strengths: t is 0 at its root and 1 at its tip.
fn strip_occlusion(t: f32, strengths: vec3f) -> vec3f {
    return exp(-strengths * (1.0 - t));
}

// How far along its strip a vertex lies, from the 16 bits in its colour: these are linear in red and green, so that it may be
// interpolated.
fn strip_place(color: vec4f) -> f32 {
    return (color.r * 65280.0 + color.g * 255.0) / 65535.0;
}

// A colour for the number of a strip: golden steps round the circle of hues.
fn strip_hue(number: u32) -> vec3f {
    let hue = fract(f32(number) * 0.61803399);
    let share = abs(fract(hue + vec3f(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0;
    return mix(vec3f(0.25), vec3f(1.0), saturate(share));
}
