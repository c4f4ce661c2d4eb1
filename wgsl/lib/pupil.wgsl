// Shapes of drawn pupils, each within the unit disc: signed distances or what stands for them, negative inside.

// A slit, upright: two arcs that meet above and below.
fn slit_distance(q: vec2f) -> f32 {
    // Circles of radius r about (±d, 0), which meet at (0, ±1) and leave 0.34 between them.
    let r = 1.64;
    let d = 1.3;
    return max(length(q - vec2f(d, 0.0)), length(q + vec2f(d, 0.0))) - r;
}

// A heart, its point below: a square that stands on a corner, with half a disc on each of its upper sides.
fn heart_distance(q: vec2f) -> f32 {
    let half_size = 0.82;
    let p = vec2f(abs(q.x), q.y + 0.08);
    let square = (p.x + abs(p.y) - half_size) * 0.70710678;
    let side = length(p - 0.5 * half_size) - half_size * 0.70710678;
    return min(square, side);
}

// A star of five points, one of them above.
fn star_distance(q: vec2f) -> f32 {
    let sector = 1.25663706;
    let turn = atan2(q.x, q.y);
    let folded = abs(turn - sector * round(turn / sector));
    let p = length(q) * vec2f(sin(folded), cos(folded));
    // From the point (0, 1) to the notch between two points.
    let notch = 0.5 * vec2f(0.58778525, 0.80901699);
    let edge = notch - vec2f(0.0, 1.0);
    let outward = normalize(vec2f(-edge.y, edge.x)) * -1.0;
    return -dot(p - vec2f(0.0, 1.0), outward);
}

// Share of a pupil at a place in its unit disc: 1 a disc, 2 a slit, 3 a heart, 4 a star.
fn pupil_cover(q: vec2f, shape: u32) -> f32 {
    let d = select(
        select(length(q) - 1.0, slit_distance(q), shape == 2u),
        select(heart_distance(q), star_distance(q), shape == 4u),
        shape > 2u
    );
    let px = clamp(0.7 * fwidth(d), 1e-4, 0.5);
    return 1.0 - smoothstep(-px, px, d);
}
