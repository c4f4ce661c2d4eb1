// Light as painters cut it.

// Brightness cut into even bands; each edge is a ramp over a share of a band. No bands leave it as it is.
fn banded(x: f32, steps: u32, edge: f32) -> f32 {
    if steps == 0u {
        return x;
    }
    let n = f32(steps);
    let at = x * n;
    let half = 0.5 * max(edge, 1e-3);
    return (floor(at) + smoothstep(0.5 - half, 0.5 + half, fract(at))) / n;
}
