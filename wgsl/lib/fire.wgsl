// Fire that noise eats away.
import package::lib::noise::value_noise;

// Two layers of noise that rise through a texture, 0..1; `phase` runs from 0 to 1 in a period, after which all is as before.
fn fire_noise(uv: vec2f, phase: f32, cells: i32) -> f32 {
    let c = f32(cells);
    // Each rises a whole number of its own periods: 2 * cells rows and 4 * cells rows.
    let low = value_noise(uv * vec2f(c, c) + vec2f(0.0, phase * 2.0 * c), vec2i(cells, 2 * cells), 11);
    let high = value_noise(uv * vec2f(2.0 * c, 2.0 * c) + vec2f(0.0, phase * 4.0 * c), vec2i(2 * cells, 4 * cells), 23);
    return low * 0.65 + high * 0.35;
}

// Heat of one tongue over 0..1: a drop with its tip above, 0 at the borders.
fn fire_shape(uv: vec2f) -> f32 {
    let up = 1.0 - saturate(uv.y);
    // Round below, from its widest place on pointed.
    let below = 1.0 - up / 0.26;
    let above = saturate((up - 0.26) / 0.74);
    let half_width = 0.42 * select((1.0 - above) * (1.0 + 0.9 * above), sqrt(max(1.0 - below * below, 0.0)), below > 0.0);
    let across = abs(uv.x - 0.5) / max(half_width, 1e-3);
    return saturate(1.3 - 1.3 * across) * (1.0 - 0.45 * up);
}

// Sideways movement of tongues: none at the foot (v = 1), most at the tip.
fn fire_sway(uv: vec2f, phase: f32, cells: i32, sway: f32) -> f32 {
    let up = 1.0 - saturate(uv.y);
    let rows = max(cells / 2, 1);
    let wave = value_noise(vec2f(0.5, uv.y * f32(rows) + phase * f32(2 * rows)), vec2i(1, 2 * rows), 37);
    return (wave - 0.5) * 2.0 * sway * up * up;
}

// Heat of a place from that of the drawn shape.
fn fire_heated(drawn: f32, noise: f32, turbulence: f32) -> f32 {
    return drawn * mix(1.0, saturate(noise * 1.5), turbulence);
}

// What is left of it.
fn fire_cover(heat: f32, erosion: f32, softness: f32) -> f32 {
    // The border moves from below 0 to above 1, so that it is whole at 0 and gone at 1.
    let edge = mix(-softness, 1.0 + softness, erosion);
    return smoothstep(edge - softness, edge + softness, heat);
}

// Colour by heat: rim, body, heart.
fn fire_color(heat: f32, rim: vec3f, body: vec3f, heart: vec3f, edges: vec2f, softness: f32) -> vec3f {
    let outer = mix(rim, body, smoothstep(edges.x - softness, edges.x + softness, heat));
    return mix(outer, heart, smoothstep(edges.y - softness, edges.y + softness, heat));
}
