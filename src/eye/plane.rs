//! The plane that an iris is drawn on, found from its mesh.

use glam::{DVec2, DVec3, Mat3, Mat4, Vec2, Vec3};

use super::frame::{EyeBone, NoEyeFrame, eyes, pieces_of};
use crate::scene::Primitive;

/// Place, size and direction of a drawn iris at rest, in the space that its mesh was brought to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct IrisPlane {
    /// Middle of the box round it.
    pub centre: Vec3,
    /// Out of the eye, unit.
    pub axis: Vec3,
    /// Where the eye looks, unit: as the nearest bone does, else along `axis`. A drawn iris lies as the face does, turned outwards.
    pub gaze: Vec3,
    /// Upwards, at right angles to `axis`; unit.
    pub up: Vec3,
    /// Half of its width and of its height, metres.
    pub half: Vec2,
}

/// Cosine of the angle from which on a bone does not mean an iris.
const AHEAD: f64 = 0.7;
/// Half of a side below which it is none, metres.
const LEAST_HALF: f64 = 1e-6;

impl IrisPlane {
    /// The irises of a mesh, told apart by the gap between them, the one farthest along +X first. Each looks where its triangles
    /// do on the whole; up is that of the nearest bone, else +Y.
    ///
    /// # Errors
    /// [`NoEyeFrame::Empty`] and [`NoEyeFrame::Broken`] as for eyes; [`NoEyeFrame::NoFront`] where its triangles look everywhere.
    pub fn of(parts: &[(&Primitive, Mat4)], bones: &[EyeBone]) -> Result<Vec<Self>, NoEyeFrame> {
        let mut pieces = Vec::new();
        for (primitive, rest) in parts {
            pieces.extend(pieces_of(primitive, *rest)?);
        }
        let mut planes = Vec::new();
        for samples in eyes(pieces) {
            let points: Vec<DVec3> = samples.iter().map(|s| s.at).collect();
            let corners = points.as_chunks::<3>().0;
            let area: DVec3 = corners.iter().map(|[a, b, c]| (*b - *a).cross(*c - *a)).sum();
            let whole: f64 = corners.iter().map(|[a, b, c]| (*b - *a).cross(*c - *a).length()).sum();
            let axis = area.try_normalize().filter(|_| area.length() > 0.5 * whole).ok_or(NoEyeFrame::NoFront)?;
            let middle = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
            let near = |bone: &&EyeBone| bone.position.as_dvec3().distance_squared(middle);
            let bone = bones.iter().min_by(|a, b| near(a).total_cmp(&near(b)));
            let gaze = bone.and_then(|b| b.forward.as_dvec3().try_normalize()).filter(|gaze| gaze.dot(axis) > AHEAD);
            let up = bone.and_then(|b| b.up.as_dvec3().try_normalize()).unwrap_or(DVec3::Y);
            let up = up.reject_from_normalized(axis).try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
            let right = up.cross(axis);
            let flat = points.iter().map(|p| DVec2::new((*p - middle).dot(right), (*p - middle).dot(up)));
            let (low, high) =
                flat.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
            let (off, half) = ((low + high) * 0.5, (high - low) * 0.5);
            if half.min_element() < LEAST_HALF {
                return Err(NoEyeFrame::Empty);
            }
            planes.push(Self {
                centre: (middle + right * off.x + up * off.y).as_vec3(),
                axis: axis.as_vec3(),
                gaze: gaze.unwrap_or(axis).as_vec3(),
                up: up.as_vec3(),
                half: half.as_vec2(),
            });
        }
        if planes.is_empty() {
            return Err(NoEyeFrame::Empty);
        }
        planes.sort_by(|a, b| b.centre.x.total_cmp(&a.centre.x));
        Ok(planes)
    }

    /// Takes the plane's space to that in which the box round the iris reaches from -1 to 1: x to the right as it is seen, y up, z
    /// out of the eye by half of the width.
    pub fn disc_from_mesh(&self) -> Mat4 {
        let turn = Mat3::from_cols(self.up.cross(self.axis), self.up, self.axis).transpose();
        let scale = Mat3::from_diagonal(Vec3::new(1.0 / self.half.x, 1.0 / self.half.y, 1.0 / self.half.x));
        Mat4::from_mat3(scale * turn) * Mat4::from_translation(-self.centre)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A card of this size about a place, whose left side lies nearer to the viewer.
    fn card(at: Vec3, half: Vec2) -> Primitive {
        let corner = |x: f32, y: f32| (at + Vec3::new(x * half.x, y * half.y, -0.1 * x * half.x)).to_array();
        Primitive {
            positions: vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)],
            indices: vec![0, 1, 2, 0, 2, 3],
            ..Primitive::default()
        }
    }

    #[test]
    fn two_irises_are_told_apart_and_measured() {
        let (left, right) = (Vec3::new(0.03, 1.4, 0.05), Vec3::new(-0.03, 1.4, 0.05));
        let half = Vec2::new(0.009, 0.012);
        let [a, b] = [left, right].map(|at| card(at, half));
        let planes = IrisPlane::of(&[(&b, Mat4::IDENTITY), (&a, Mat4::IDENTITY)], &[]).expect("two planes");
        assert_eq!(planes.len(), 2);
        for (plane, at) in planes.iter().zip([left, right]) {
            assert!(plane.centre.distance(at) < 1e-6, "{plane:?}");
            assert!((plane.half / half - 1.0).abs().max_element() < 0.01, "{plane:?}");
            assert!(plane.axis.distance(Vec3::new(0.0995, 0.0, 0.995)) < 1e-3, "{plane:?}");
            let to_disc = plane.disc_from_mesh();
            let corner = to_disc.transform_point3(at + Vec3::new(half.x, half.y, -0.1 * half.x));
            assert!(corner.distance(Vec3::new(1.0, 1.0, 0.0)) < 1e-3, "{corner}");
        }
    }

    #[test]
    fn what_has_no_front_is_named() {
        let at = Vec3::ZERO;
        let mut both = card(at, Vec2::ONE);
        both.indices.extend([2, 1, 0, 3, 2, 0]);
        assert_eq!(IrisPlane::of(&[(&both, Mat4::IDENTITY)], &[]), Err(NoEyeFrame::NoFront));
        assert_eq!(IrisPlane::of(&[], &[]), Err(NoEyeFrame::Empty));
        let thin = card(at, Vec2::new(1.0, 0.0));
        assert_eq!(IrisPlane::of(&[(&thin, Mat4::IDENTITY)], &[]), Err(NoEyeFrame::Empty));
    }
}
