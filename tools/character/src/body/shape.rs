//! Measures of the naked body: skin is built on them, clothes above them.

/// Heights and horizontal half-axes of the torso: y, half width, depth to the front and to the back of z = 0.
const TORSO: &[[f32; 4]] = &[
    [0.74, 0.118, 0.05, 0.07],
    [0.79, 0.142, 0.072, 0.1],
    [0.83, 0.146, 0.08, 0.106],
    [0.88, 0.136, 0.084, 0.092],
    [0.93, 0.111, 0.08, 0.072],
    [0.985, 0.093, 0.075, 0.062],
    [1.04, 0.101, 0.082, 0.07],
    [1.09, 0.116, 0.1, 0.08],
    [1.125, 0.121, 0.108, 0.084],
    [1.16, 0.123, 0.093, 0.085],
    [1.2, 0.116, 0.068, 0.08],
    [1.23, 0.082, 0.044, 0.07],
    [1.25, 0.05, 0.024, 0.062],
    [1.265, 0.043, 0.016, 0.06],
];

/// Distance from shoulder to fingertip, and radius: x, radius.
const ARM: &[[f32; 2]] = &[
    [0.1, 0.047],
    [0.14, 0.043],
    [0.2, 0.037],
    [0.27, 0.034],
    [0.332, 0.031],
    [0.38, 0.032],
    [0.45, 0.028],
    [0.51, 0.022],
    [0.545, 0.02],
];

/// Height, radius and depth of the axis (z) of a leg.
const LEG: &[[f32; 3]] = &[
    [0.03, 0.028, -0.022],
    [0.083, 0.03, -0.022],
    [0.13, 0.032, -0.02],
    [0.2, 0.04, -0.016],
    [0.29, 0.051, -0.012],
    [0.36, 0.052, -0.006],
    [0.42, 0.0445, 0.002],
    [0.46, 0.0448, 0.006],
    [0.52, 0.053, 0.006],
    [0.62, 0.066, 0.004],
    [0.72, 0.077, 0.001],
    [0.8, 0.083, -0.004],
    [0.86, 0.083, -0.008],
];

/// Half width, depth to the front and to the back of the torso at height `y`.
#[must_use]
pub fn torso(y: f32) -> [f32; 3] {
    table(TORSO, y)
}

/// Radius of the arm at distance `x` from the middle of the body.
#[must_use]
pub fn arm(x: f32) -> f32 {
    let [radius] = table(ARM, x);
    radius
}

/// Radius of a leg and depth of its axis at height `y`. The axis stands at x = 0.077, a little more at the hip.
#[must_use]
pub fn leg(y: f32) -> [f32; 2] {
    table(LEG, y)
}

/// Monotone smooth interpolation of a table by its first column; constant beyond its ends.
fn table<const N: usize, const M: usize>(rows: &[[f32; N]], x: f32) -> [f32; M] {
    let last = rows.len() - 1;
    let i = rows.iter().rposition(|r| r[0] <= x).unwrap_or(0).min(last - 1);
    let t = ((x - rows[i][0]) / (rows[i + 1][0] - rows[i][0])).clamp(0.0, 1.0);
    std::array::from_fn(|c| {
        let at = |k: usize| rows[k.min(last)][c + 1];
        let slope = |k: usize| {
            let (a, b) = (k.saturating_sub(1), (k + 1).min(last));
            (at(b) - at(a)) / (rows[b][0] - rows[a][0])
        };
        let h = rows[i + 1][0] - rows[i][0];
        let (t2, t3) = (t * t, t * t * t);
        (2.0 * t3 - 3.0 * t2 + 1.0) * at(i)
            + (t3 - 2.0 * t2 + t) * h * slope(i)
            + (3.0 * t2 - 2.0 * t3) * at(i + 1)
            + (t3 - t2) * h * slope(i + 1)
    })
}
