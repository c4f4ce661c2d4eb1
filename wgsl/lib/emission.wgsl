// Light of a surface's own that swells and ebbs.

// Share of the light at `phase` of a period, 0..1: 1 at its beginning, `low` in its middle.
fn blink(phase: f32, low: f32, sharpness: f32) -> f32 {
    let wave = 0.5 + 0.5 * cos(6.2831853 * phase);
    let width = mix(0.5, 0.02, sharpness);
    return mix(low, 1.0, smoothstep(0.5 - width, 0.5 + width, wave));
}
