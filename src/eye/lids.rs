//! Where the lids leave an eye open, found from what stands round it.

use glam::{DMat3, DVec3, Vec3};

use crate::skin::Tree;

/// The edges of both lids at rest, as parabolas over the longitude: elevation, radians, is `[0] + [1] l + [2] l²`. Longitude to the
/// character's left and elevation are those of directions from the middle of the ball in character space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lids {
    /// Of the upper lid.
    pub upper: [f32; 3],
    /// Of the lower lid.
    pub lower: [f32; 3],
}

/// What is farther from the middle of a ball than this hides it from nobody, radii; and from where on things lie over it.
pub(super) const NEAR: f32 = 2.0;
const OVER: f32 = 0.9;
/// Directions that are tried, degrees.
const FARTHEST: i32 = 66;
const LONGITUDES: usize = 6;
const ELEVATIONS: usize = 2;
/// Longitudes that must have an upper and a lower lid.
const LEAST: usize = 4;

/// The lids round a ball that looks along `axis`; `None` where there are none.
pub(super) fn lids(hiding: &Tree, centre: Vec3, radius: f32, axis: Vec3) -> Option<Lids> {
    let is_open = |longitude: f32, elevation: f32| {
        let (sin_l, cos_l) = longitude.sin_cos();
        let (sin_e, cos_e) = elevation.sin_cos();
        let way = Vec3::new(sin_l * cos_e, sin_e, cos_l * cos_e);
        hiding.first_hit(centre + way * (OVER * radius), way, (NEAR - OVER) * radius).is_none()
    };
    let ahead = axis.y.clamp(-1.0, 1.0).asin().to_degrees() as i32;
    let mut edges: Vec<[f32; 3]> = Vec::new();
    for longitude in (-FARTHEST..=FARTHEST).step_by(LONGITUDES) {
        let l = (longitude as f32).to_radians();
        let open = |degrees: &i32| is_open(l, (*degrees as f32).to_radians());
        let Some(start) = [0, 8, -8, 16, -16].map(|d| ahead + d).into_iter().find(open) else { continue };
        let up = (start..=FARTHEST).step_by(ELEVATIONS).find(|d| !open(d));
        let down = (-FARTHEST..=start).rev().step_by(ELEVATIONS).find(|d| !open(d));
        if let (Some(up), Some(down)) = (up, down) {
            edges.push([l, (up as f32 - 1.0).to_radians(), (down as f32 + 1.0).to_radians()]);
        }
    }
    if edges.len() < LEAST {
        return None;
    }
    let fit = |of: usize| parabola(edges.iter().map(|e| [f64::from(e[0]), f64::from(e[of])]));
    Some(Lids { upper: fit(1)?, lower: fit(2)? })
}

/// Least squares of a parabola.
fn parabola(points: impl Iterator<Item = [f64; 2]>) -> Option<[f32; 3]> {
    let (mut normal, mut right) = (DMat3::ZERO, DVec3::ZERO);
    for [x, y] in points {
        let row = DVec3::new(1.0, x, x * x);
        normal += DMat3::from_cols(row * row.x, row * row.y, row * row.z);
        right += row * y;
    }
    (normal.determinant().abs() > 1e-9).then(|| (normal.inverse() * right).as_vec3().to_array())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A shell of this radius about a place, open where `is_open` says.
    fn shell(at: Vec3, radius: f32, is_open: impl Fn(f32, f32) -> bool) -> Tree {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        let place = |l: i32, e: i32| {
            let (l, e) = ((l as f32).to_radians(), (e as f32).to_radians());
            (at + Vec3::new(l.sin() * e.cos(), e.sin(), l.cos() * e.cos()) * radius).to_array()
        };
        for l in -90..90 {
            for e in -80..80 {
                if is_open((l as f32 + 0.5).to_radians(), (e as f32 + 0.5).to_radians()) {
                    continue;
                }
                let first = positions.len() as u32;
                positions.extend([place(l, e), place(l + 1, e), place(l + 1, e + 1), place(l, e + 1)]);
                triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
            }
        }
        Tree::new(&positions, &triangles)
    }

    #[test]
    fn lids_are_where_a_shell_is_cut() {
        let at = Vec3::new(0.03, 1.4, 0.05);
        let upper = |l: f32| 0.3 + 0.1 * l - 0.4 * l * l;
        let lower = |l: f32| -0.25 + 0.3 * l * l;
        let tree = shell(at, 0.013, |l, e| e < upper(l) && e > lower(l));
        let found = lids(&tree, at, 0.012, Vec3::Z).expect("lids");
        for l in [-0.5, 0.0, 0.5f32] {
            let of = |p: [f32; 3]| p[0] + p[1] * l + p[2] * l * l;
            assert!((of(found.upper) - upper(l)).abs() < 0.05, "{found:?} at {l}");
            assert!((of(found.lower) - lower(l)).abs() < 0.05, "{found:?} at {l}");
        }
    }

    #[test]
    fn a_bare_ball_has_none() {
        assert_eq!(lids(&Tree::new(&[], &[]), Vec3::ZERO, 0.012, Vec3::Z), None);
        // Nor one that is shut in.
        let all = shell(Vec3::ZERO, 0.013, |_, _| false);
        assert_eq!(lids(&all, Vec3::ZERO, 0.012, Vec3::Z), None);
    }
}
