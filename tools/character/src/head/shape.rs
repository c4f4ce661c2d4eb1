//! Shape of the head as a smooth surface: a net of control rows from the crown to the neck. Landmarks that other parts rely on stand here too.

use std::f32::consts::PI;
use std::sync::LazyLock;

use glam::{Vec2, Vec3};

/// Centre of the ellipsoid that the head follows above the brows and at the back.
pub const SKULL_CENTER: Vec3 = Vec3::new(0.0, 1.442, -0.012);
/// Its radii, metres.
pub const SKULL_RADII: Vec3 = Vec3::new(0.083, 0.108, 0.098);
/// Height of the chin.
pub const CHIN_Y: f32 = 1.315;
/// Height of the middle of the eyes.
pub const EYE_Y: f32 = 1.412;
/// Height of the brows.
pub const BROW_Y: f32 = 1.45;
/// Height of the hairline above the forehead.
pub const HAIRLINE_Y: f32 = 1.497;
/// Middle of the left ear; it stands 12 mm out from the skull and is 50 mm tall.
pub const EAR: Vec3 = Vec3::new(0.083, 1.4, -0.018);

/// Point of the skull's ellipsoid in this direction from its centre, moved outwards by `lift` metres.
#[must_use]
pub fn skull(direction: Vec3, lift: f32) -> Vec3 {
    let d = direction.normalize_or(Vec3::Y);
    let on = d / (d / SKULL_RADII).length();
    SKULL_CENTER + on + (on / (SKULL_RADII * SKULL_RADII)).normalize() * lift
}

/// Columns of the net, from the middle of the face (0) round the left ear (5) to the middle of the back (8).
const COLUMNS: usize = 9;
/// Angle of each column in a planar row, degrees.
const ANGLES: [f32; COLUMNS] = [0.0, 12.0, 27.0, 45.0, 66.0, 90.0, 118.0, 148.0, 180.0];

/// Planar rows: height, half width, z of front and back, squareness of the front (2 is an ellipse).
const PLANAR: &[[f32; 5]] = &[
    [1.5455, 0.021, 0.0135, -0.038, 2.0],
    [1.535, 0.042, 0.038, -0.062, 2.0],
    [1.518, 0.0589, 0.0576, -0.0816, 2.05],
    [1.497, 0.0714, 0.0724, -0.0964, 2.12],
    [1.475, 0.079, 0.0813, -0.1053, 2.25],
    [1.45, 0.0825, 0.0855, -0.1097, 2.35],
    [1.43, 0.082, 0.0845, -0.1093, 2.4],
    [1.41, 0.0802, 0.0828, -0.106, 2.4],
    [1.39, 0.0772, 0.0826, -0.1, 2.35],
];

/// Rows that are bent: cheeks to jaw, jaw edge, under the jaw. One point a column.
const BENT: &[[[f32; 3]; COLUMNS]] = &[
    [
        [0.0, 1.368, 0.0822],
        [0.018, 1.3682, 0.08],
        [0.0386, 1.37, 0.0712],
        [0.0564, 1.375, 0.0555],
        [0.0694, 1.3812, 0.0265],
        [0.0745, 1.3845, -0.012],
        [0.0663, 1.3845, -0.0562],
        [0.0402, 1.3805, -0.087],
        [0.0, 1.378, -0.0975],
    ],
    [
        [0.0, 1.348, 0.0806],
        [0.0178, 1.3485, 0.0778],
        [0.0392, 1.352, 0.0682],
        [0.0584, 1.3595, 0.051],
        [0.0685, 1.3698, 0.0235],
        [0.0708, 1.375, -0.012],
        [0.0634, 1.375, -0.0535],
        [0.0388, 1.369, -0.082],
        [0.0, 1.366, -0.0925],
    ],
    [
        [0.0, 1.3285, 0.0778],
        [0.0132, 1.3298, 0.0746],
        [0.0312, 1.3355, 0.0638],
        [0.0525, 1.3462, 0.0462],
        [0.064, 1.3585, 0.0208],
        [0.0676, 1.3672, -0.012],
        [0.0608, 1.368, -0.0508],
        [0.0379, 1.36, -0.0775],
        [0.0, 1.3555, -0.0868],
    ],
    [
        [0.0, 1.3158, 0.0722],
        [0.0099, 1.3172, 0.0695],
        [0.0234, 1.324, 0.059],
        [0.0402, 1.336, 0.0415],
        [0.0568, 1.3485, 0.0175],
        [0.0632, 1.3585, -0.0125],
        [0.057, 1.36, -0.048],
        [0.036, 1.352, -0.0725],
        [0.0, 1.3465, -0.0815],
    ],
    [
        [0.0, 1.3128, 0.0615],
        [0.009, 1.314, 0.0595],
        [0.0211, 1.3205, 0.0508],
        [0.0375, 1.331, 0.0352],
        [0.0508, 1.3432, 0.0135],
        [0.0574, 1.3525, -0.0135],
        [0.0523, 1.3535, -0.0455],
        [0.0333, 1.346, -0.068],
        [0.0, 1.341, -0.076],
    ],
    [
        [0.0, 1.3125, 0.034],
        [0.0098, 1.3132, 0.0328],
        [0.0215, 1.3165, 0.027],
        [0.0326, 1.3235, 0.0165],
        [0.042, 1.3325, -0.0005],
        [0.0472, 1.3395, -0.0195],
        [0.0437, 1.34, -0.0435],
        [0.0289, 1.3335, -0.062],
        [0.0, 1.3295, -0.0685],
    ],
];

/// Neck: height at the front, at the back, radius, z of its axis.
const NECK: &[[f32; 4]] = &[
    [1.304, 1.316, 0.0316, -0.023],
    [1.288, 1.292, 0.0303, -0.0235],
    [1.265, 1.265, 0.0296, -0.0235],
    [1.24, 1.24, 0.032, -0.023],
    [1.212, 1.212, 0.0392, -0.0225],
];

/// Row of the net that runs along the edge of the jaw.
pub const JAW_ROW: f32 = (PLANAR.len() + 3) as f32;
/// Row of the hairline.
pub const HAIRLINE_ROW: f32 = 3.0;
/// Last row of the net.
pub const LAST_ROW: f32 = (PLANAR.len() + BENT.len() + NECK.len() - 1) as f32;

/// Control points by row and column.
static NET: LazyLock<Vec<[Vec3; COLUMNS]>> = LazyLock::new(|| {
    let planar = PLANAR.iter().map(|[y, width, front, back, square]| {
        ANGLES.map(|degrees| {
            let (s, c) = (degrees * PI / 180.0).sin_cos();
            let middle = SKULL_CENTER.z;
            let power = if c > 0.0 { 2.0 / square } else { 1.0 };
            let reach = if c > 0.0 { front - middle } else { middle - back };
            Vec3::new(width * s.max(0.0).powf(power), *y, middle + reach * c.abs().powf(power) * c.signum())
        })
    });
    let bent = BENT.iter().map(|row| row.map(Vec3::from_array));
    let neck = NECK.iter().map(|[front, back, radius, z]| {
        ANGLES.map(|degrees| {
            let (s, c) = (degrees * PI / 180.0).sin_cos();
            let y = front + (back - front) * (1.0 - c) * 0.5;
            Vec3::new(radius * 1.04 * s.max(0.0), y, z + radius * c)
        })
    });
    planar.chain(bent).chain(neck).collect()
});

/// Cubic Hermite between `b` and `c` with slopes from the neighbours; `h` are the lengths of the three spans.
fn hermite(p: [Vec3; 4], h: [f32; 3], t: f32) -> Vec3 {
    let slope = |a: Vec3, b: Vec3, c: Vec3, h0: f32, h1: f32| ((b - a) / h0 * h1 + (c - b) / h1 * h0) / (h0 + h1);
    let (m1, m2) = (slope(p[0], p[1], p[2], h[0], h[1]), slope(p[1], p[2], p[3], h[1], h[2]));
    let (t2, t3) = (t * t, t * t * t);
    (2.0 * t3 - 3.0 * t2 + 1.0) * p[1]
        + (t3 - 2.0 * t2 + t) * h[1] * m1
        + (3.0 * t2 - 2.0 * t3) * p[2]
        + (t3 - t2) * h[1] * m2
}

fn across(row: &[Vec3; COLUMNS], column: f32) -> Vec3 {
    let last = COLUMNS as isize - 1;
    let i = (column.floor() as isize).clamp(0, last - 1);
    let at = |k: isize| {
        let mirror = if k < 0 {
            -k
        } else if k > last {
            2 * last - k
        } else {
            k
        };
        let p = row[mirror as usize];
        if mirror == k { p } else { Vec3::new(-p.x, p.y, p.z) }
    };
    let p = [at(i - 1), at(i), at(i + 1), at(i + 2)];
    let h = [p[0].distance(p[1]), p[1].distance(p[2]), p[2].distance(p[3])].map(|h| h.max(1e-5));
    hermite(p, h, column - i as f32)
}

/// Point of the net, without the features of the face. `column` 0..8 on the left half, `row` 0..[`LAST_ROW`].
#[must_use]
pub fn net(column: f32, row: f32) -> Vec3 {
    let rows = &*NET;
    let last = rows.len() as isize - 1;
    let i = (row.floor() as isize).clamp(0, last - 1);
    let at = |k: isize| across(&rows[k.clamp(0, last) as usize], column);
    let mut p = [at(i - 1), at(i), at(i + 1), at(i + 2)];
    if i == 0 {
        // The rows go on beyond the crown, so that it is round.
        p[0] = p[1] + (p[1] - p[2]) * 0.6 + Vec3::Y * 0.004;
    }
    if i == last - 1 {
        p[3] = p[2] * 2.0 - p[1];
    }
    let h = [p[0].distance(p[1]), p[1].distance(p[2]), p[2].distance(p[3])].map(|h| h.max(1e-5));
    hermite(p, h, row - i as f32)
}

/// Column and row of the net's point with this x (not negative) and y on the front of the head.
#[must_use]
pub fn locate(x: f32, y: f32) -> Vec2 {
    let target = Vec2::new(x, y);
    let mut at = Vec2::new((x / 0.02).clamp(0.0, 4.5), ((1.5 - y) / 0.02 + 3.0).clamp(1.0, JAW_ROW));
    for _ in 0..24 {
        let p = net(at.x, at.y);
        let error = target - p.truncate();
        if error.length() < 1e-7 {
            break;
        }
        const STEP: f32 = 2e-3;
        let dx = (net(at.x + STEP, at.y) - p).truncate() / STEP;
        let dy = (net(at.x, at.y + STEP) - p).truncate() / STEP;
        let determinant = dx.x * dy.y - dx.y * dy.x;
        let step = Vec2::new(error.x * dy.y - error.y * dy.x, dx.x * error.y - dx.y * error.x) / determinant;
        at += step.clamp(Vec2::splat(-0.7), Vec2::splat(0.7));
        at = at.clamp(Vec2::new(0.0, 0.5), Vec2::new(6.0, JAW_ROW + 1.5));
    }
    at
}

/// Point of the face at this x and y, with its features.
#[must_use]
pub fn front(x: f32, y: f32) -> Vec3 {
    let at = locate(x.abs(), y);
    let mut p = net(at.x, at.y);
    p.z += super::features::features(p.x, p.y);
    Vec3::new(x, y, p.z)
}

/// Normal of the smooth proxy of the face: an ellipsoid, so that the border of light and shade is one calm curve.
#[must_use]
pub fn proxy_normal(p: Vec3) -> Vec3 {
    let from = p - Vec3::new(0.0, 1.405, -0.03);
    (from / Vec3::new(0.088, 0.13, 0.112).powf(2.0)).normalize()
}
