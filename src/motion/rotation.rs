//! Rotations and directions in plain arithmetic: every sum in one order, and trigonometry from one library, so that motion has
//! the same bits on every machine and at every level of optimisation.

use glam::{Quat, Vec3};

/// Cosine from which on two rotations are mixed in a straight line: an arc that short is one.
const STRAIGHT: f32 = 1.0 - 1e-6;

/// `a` after `b`.
pub(crate) fn mul(a: Quat, b: Quat) -> Quat {
    Quat::from_xyzw(
        a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
        a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
        a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
        a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
    )
}

/// The other way round.
pub(crate) fn inverse(q: Quat) -> Quat {
    Quat::from_xyzw(-q.x, -q.y, -q.z, q.w)
}

/// A direction, turned.
pub(crate) fn turn(q: Quat, v: Vec3) -> Vec3 {
    let (x, y, z) = (q.x, q.y, q.z);
    let tx = 2.0 * (y * v.z - z * v.y);
    let ty = 2.0 * (z * v.x - x * v.z);
    let tz = 2.0 * (x * v.y - y * v.x);
    Vec3::new(
        v.x + q.w * tx + (y * tz - z * ty),
        v.y + q.w * ty + (z * tx - x * tz),
        v.z + q.w * tz + (x * ty - y * tx),
    )
}

pub(crate) fn dot(a: Vec3, b: Vec3) -> f32 {
    a.x * b.x + a.y * b.y + a.z * b.z
}

pub(crate) fn length(v: Vec3) -> f32 {
    dot(v, v).sqrt()
}

fn dot4(a: Quat, b: Quat) -> f32 {
    a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w
}

/// The same of unit length; the identity where there is none.
pub(crate) fn unit(q: Quat) -> Quat {
    let length = dot4(q, q).sqrt();
    if !(length > 1e-20 && length < f32::MAX) {
        return Quat::IDENTITY;
    }
    Quat::from_xyzw(q.x / length, q.y / length, q.z / length, q.w / length)
}

/// A direction of length 1; `None` where it has none.
pub(crate) fn direction(v: Vec3) -> Option<Vec3> {
    let length = length(v);
    (length > 1e-12 && length < f32::MAX).then(|| Vec3::new(v.x / length, v.y / length, v.z / length))
}

/// Both, each times its share.
fn sum(a: Quat, share_a: f32, b: Quat, share_b: f32) -> Quat {
    Quat::from_xyzw(
        a.x * share_a + b.x * share_b,
        a.y * share_a + b.y * share_b,
        a.z * share_a + b.z * share_b,
        a.w * share_a + b.w * share_b,
    )
}

/// From `a` (0) to `b` (1) along the shorter arc, at an even speed; beyond both where `t` is. Exactly `a` and `b` at the ends.
pub(crate) fn slerp(a: Quat, b: Quat, t: f32) -> Quat {
    if t == 0.0 {
        return a;
    }
    if t == 1.0 {
        return b;
    }
    let cosine = dot4(a, b);
    let (b, cosine) = if cosine < 0.0 {
        (Quat::from_xyzw(-b.x, -b.y, -b.z, -b.w), -cosine)
    } else {
        (b, cosine)
    };
    if cosine > STRAIGHT {
        return unit(sum(a, 1.0 - t, b, t));
    }
    // Half the angle from chords: exact for small ones, where the arc cosine is not.
    let (apart, together) = (sum(a, 1.0, b, -1.0), sum(a, 1.0, b, 1.0));
    let angle = 2.0 * libm::atan2f(dot4(apart, apart).sqrt(), dot4(together, together).sqrt());
    let (of_a, of_b) = (libm::sinf((1.0 - t) * angle), libm::sinf(t * angle));
    unit(sum(a, of_a, b, of_b))
}

/// From `a` (0) to `b` (1) in a straight line; exactly these at the ends.
pub(crate) fn mix(a: Vec3, b: Vec3, t: f32) -> Vec3 {
    let u = 1.0 - t;
    Vec3::new(a.x * u + b.x * t, a.y * u + b.y * t, a.z * u + b.z * t)
}

/// By an angle, radians, about an axis of length 1.
pub(crate) fn about(axis: Vec3, angle: f32) -> Quat {
    let (sin, cos) = libm::sincosf(0.5 * angle);
    Quat::from_xyzw(axis.x * sin, axis.y * sin, axis.z * sin, cos)
}

/// The least rotation that takes one unit direction to another. Half a turn goes about the axis that is nearest to square
/// with `from`.
pub(crate) fn between(from: Vec3, to: Vec3) -> Quat {
    let cosine = dot(from, to);
    if cosine > -1.0 + 1e-6 {
        let axis = cross(from, to);
        return unit(Quat::from_xyzw(axis.x, axis.y, axis.z, 1.0 + cosine));
    }
    let (x, y, z) = (from.x.abs(), from.y.abs(), from.z.abs());
    let other = if x <= y && x <= z {
        Vec3::X
    } else if y <= z {
        Vec3::Y
    } else {
        Vec3::Z
    };
    let axis = direction(cross(from, other)).unwrap_or(Vec3::X);
    Quat::from_xyzw(axis.x, axis.y, axis.z, 0.0)
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    Vec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Directions and rotations all over.
    fn some() -> Vec<Quat> {
        let numbers = [-0.9f32, -0.3, 0.1, 0.7];
        let all = numbers.iter().flat_map(|x| numbers.iter().map(move |y| (*x, *y)));
        all.flat_map(|(x, y)| numbers.map(|z| unit(Quat::from_xyzw(x, y, z, x - y * z)))).collect()
    }

    #[test]
    fn agrees_with_the_library_of_vectors() {
        for a in some() {
            for b in some() {
                assert!(mul(a, b).abs_diff_eq(a * b, 1e-6));
                let v = Vec3::new(b.x, b.y - 1.0, b.w);
                assert!(turn(a, v).abs_diff_eq(a * v, 1e-5));
                for t in [0.0, 0.25, 0.5, 1.0] {
                    let (mine, theirs) = (slerp(a, b, t), a.slerp(b, t));
                    assert!(mine.dot(theirs).abs() > 1.0 - 1e-5, "{a} {b} {t}");
                }
            }
        }
    }

    #[test]
    fn ends_are_exact_and_the_arc_is_the_shorter_one() {
        for a in some() {
            for b in some() {
                assert_eq!((slerp(a, b, 0.0), slerp(a, b, 1.0)), (a, b));
                let half = slerp(a, -b, 0.5);
                assert!(half.dot(a).abs() >= std::f32::consts::FRAC_1_SQRT_2 - 1e-3, "{a} {b}");
            }
        }
    }

    #[test]
    fn opposite_directions_have_a_rotation_between_them() {
        for from in [Vec3::X, Vec3::NEG_Y, Vec3::Z, Vec3::new(0.6, -0.8, 0.0)] {
            assert!(turn(between(from, -from), from).abs_diff_eq(-from, 1e-6));
            assert_eq!(between(from, from), Quat::IDENTITY);
        }
    }
}
