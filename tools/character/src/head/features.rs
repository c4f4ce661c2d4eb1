//! Features of the face on the net: its profile as one drawn line, and how far each stretch of it reaches to the sides.

use std::sync::LazyLock;

use super::shape::{locate, net};

/// Height of the tip of the nose.
pub(super) const TIP_Y: f32 = 1.3702;

/// The profile: height and z of the middle of the face, from the forehead over a hollow bridge, the small raised tip of
/// the nose and the lips to the chin.
const PROFILE: &[[f32; 2]] = &[
    [1.468, 0.0828],
    [1.452, 0.0853],
    [1.438, 0.0836],
    [1.425, 0.0792],
    [1.412, 0.0757],
    [1.402, 0.0757],
    [1.392, 0.0783],
    [1.382, 0.0826],
    [1.3755, 0.0868],
    [1.372, 0.0887],
    [1.3695, 0.0889],
    [1.3667, 0.0875],
    [1.3635, 0.0854],
    [1.3598, 0.0842],
    [1.3548, 0.084],
    [1.3505, 0.0848],
    [1.3479, 0.0845],
    [1.3455, 0.0832],
    [1.3428, 0.0836],
    [1.3402, 0.0832],
    [1.3362, 0.081],
    [1.331, 0.08],
    [1.325, 0.0797],
    [1.3195, 0.0775],
    [1.3158, 0.0722],
];

/// How far the plane of the eyes lies behind the net, by height: a hollow that is as wide as the face.
const HOLLOW: &[[f32; 2]] = &[
    [1.458, 0.0],
    [1.444, -0.0012],
    [1.431, -0.0052],
    [1.418, -0.0078],
    [1.407, -0.0078],
    [1.396, -0.0055],
    [1.386, -0.0022],
    [1.376, 0.0],
];

/// Value at `y` of a smooth line through points that stand from above; level beyond its ends.
fn on_line(line: &[[f32; 2]], y: f32) -> f32 {
    let last = line.len() - 1;
    if y >= line[0][0] || y <= line[last][0] {
        return line[if y >= line[0][0] { 0 } else { last }][1];
    }
    let k = line.partition_point(|p| p[0] >= y).clamp(1, last) - 1;
    let slope = |i: usize| {
        let (a, b) = (line[i.saturating_sub(1)], line[(i + 1).min(last)]);
        (b[1] - a[1]) / (b[0] - a[0])
    };
    let ([y0, z0], [y1, z1]) = (line[k], line[k + 1]);
    let (h, t) = (y1 - y0, (y - y0) / (y1 - y0));
    let (t2, t3) = (t * t, t * t * t);
    (2.0 * t3 - 3.0 * t2 + 1.0) * z0
        + (t3 - 2.0 * t2 + t) * h * slope(k)
        + (3.0 * t2 - 2.0 * t3) * z1
        + (t3 - t2) * h * slope(k + 1)
}

/// Steps of the table below, metres.
const STEP: f32 = 0.0005;
const LOW: f32 = 1.31;

/// How far the profile stands before net and hollow, by height from [`LOW`].
static RIDGE: LazyLock<Vec<f32>> = LazyLock::new(|| {
    (0..=320)
        .map(|i| {
            let y = LOW + i as f32 * STEP;
            if y >= PROFILE[0][0] || y <= PROFILE[PROFILE.len() - 1][0] {
                return 0.0;
            }
            let at = locate(0.0, y);
            on_line(PROFILE, y) - net(at.x, at.y).z - on_line(HOLLOW, y)
        })
        .collect()
});

fn ridge(y: f32) -> f32 {
    let at = ((y - LOW) / STEP).clamp(0.0, RIDGE.len() as f32 - 1.001);
    let (i, t) = (at as usize, at.fract());
    RIDGE[i] + (RIDGE[i + 1] - RIDGE[i]) * t
}

/// Half width of what the profile raises, by height: a soft forehead, a narrow nose with wings, a muzzle, a small chin.
const WIDTH: &[[f32; 2]] = &[
    [1.45, 0.03],
    [1.425, 0.012],
    [1.408, 0.0062],
    [1.392, 0.005],
    [1.38, 0.0052],
    [1.3715, 0.0066],
    [1.367, 0.0064],
    [1.361, 0.0085],
    [1.354, 0.0125],
    [1.347, 0.014],
    [1.338, 0.0135],
    [1.328, 0.0125],
    [1.316, 0.011],
];

/// Smooth bump: 1 at the centre, 0.37 one radius away.
fn bump(x: f32, y: f32, center: [f32; 2], radii: [f32; 2]) -> f32 {
    let (dx, dy) = ((x - center[0]) / radii[0], (y - center[1]) / radii[1]);
    (-dx * dx - dy * dy).exp()
}

/// How far the features of the face stand out of the net towards +Z, metres.
#[must_use]
pub fn features(x: f32, y: f32) -> f32 {
    let x = x.abs();
    let beside = crate::picture::smoothstep(0.078, 0.026, x);
    let width = on_line(WIDTH, y);
    on_line(HOLLOW, y) * beside
        + ridge(y) * (-(x / width).powi(2)).exp()
        // The cheek is fullest below the outer corner of the eye.
        + 0.0034 * bump(x, y, [0.047, 1.377], [0.019, 0.0165])
}
