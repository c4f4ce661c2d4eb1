//! Where an eye is and which way it looks, found from its mesh.

use std::fmt;

use glam::{DMat4, DVec3, Mat3, Mat4, Vec3};

use super::EyeDimensions;
use super::sphere::{Sample, Sphere};
use crate::scene::{HumanBone, Primitive, Scene};
use crate::sets::Sets;

/// Place, size and direction of an eye at rest, in the space that its mesh was brought to.
///
/// The radius is that of the ball, whatever its size: an anime eye is mostly twice as wide as a human one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyeFrame {
    /// Centre of the ball, metres.
    pub centre: Vec3,
    /// Direction of gaze, out of the pupil; unit.
    pub axis: Vec3,
    /// Upwards, at right angles to `axis`; unit.
    pub up: Vec3,
    /// Radius of the ball, metres.
    pub radius: f32,
}

/// What the bone of an eye says at rest, in the space that its mesh is brought to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyeBone {
    /// Where it is, metres.
    pub position: Vec3,
    /// Where the eye looks; any length but 0. Of a VRM at rest it is +Z of the model, whatever axes the bone has.
    pub forward: Vec3,
    /// Upwards; any length but 0.
    pub up: Vec3,
}

impl EyeBone {
    /// Those of a scene at rest, in character space.
    pub(crate) fn of(scene: &Scene) -> Vec<Self> {
        let rest = scene.rest_world_from_nodes();
        let bone = |bone| {
            let position = rest.get(scene.bone_node(bone)?)?.w_axis.truncate();
            Some(Self { position, forward: Vec3::Z, up: Vec3::Y })
        };
        [HumanBone::LeftEye, HumanBone::RightEye].into_iter().filter_map(bone).collect()
    }
}

/// Why a mesh has no frame of an eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoEyeFrame {
    /// It has no triangles.
    Empty,
    /// A triangle refers to a vertex that is not there, or one that is not finite.
    Broken,
    /// It is flat, or a shallow bowl, not a ball.
    Flat,
    /// Only this share of its area lies on a sphere.
    NotRound(f32),
    /// A plain sphere, closed all around, without a bone that says where it looks.
    NoFront,
    /// The bone's direction is zero, or not finite.
    Bone,
}

impl fmt::Display for NoEyeFrame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("has no triangles"),
            Self::Broken => f.write_str("refers to vertices that are not there, or not finite"),
            Self::Flat => f.write_str("is flat; expected a ball, or the front of one"),
            Self::NotRound(share) => {
                write!(
                    f,
                    "has {:.0} % of its area on a sphere; an eye has at least {:.0} %",
                    share * 100.0,
                    ROUND * 100.0
                )
            }
            Self::NoFront => f.write_str(
                "is a sphere without a front: it has no cornea, no iris and no opening; give it an eye bone",
            ),
            Self::Bone => f.write_str("has an eye bone whose direction is zero or not finite"),
        }
    }
}

/// Gap between the parts of one eye, share of the larger part; between two eyes there is more.
const GAP: f64 = 0.1;
/// What of the area must lie on the sphere, and how near, shares.
const ROUND: f32 = 0.4;
const NEAR: f64 = 0.05;
/// Least share of a sphere that is a ball or the front of one, and not a cap such as a cornea or a bowl.
const COVERED: f64 = 0.3;
/// Height from which on a part stands out of the sphere or lies within it: cornea, iris. Share of the radius.
const STANDS_OUT: f64 = 0.02;
/// How much must stand out: mean square over the area; and how far to one side, 0 (all around) to 1.
const LEAST_OUT: f64 = 1e-6;
const ONE_SIDED: f64 = 0.6;
/// Share of the sphere that a shell leaves open behind.
const OPEN: f64 = 0.2;
/// The mesh says better than the bone where an eye looks, but what is farther from the bone's forward is another thing than
/// its front, such as a nerve. Cosine of 45 degrees.
const AGREES: f64 = 0.707;

impl EyeFrame {
    /// The eyes of a mesh, the one farthest along +X (a character's left) first.
    ///
    /// An eye may be one sphere, closed or open behind, a sphere with a bulge, or cornea, iris and sclera apart, in one primitive
    /// or several; each is given with the matrix that brings it to the space of the frames. Eyes are told apart by the gap
    /// between them. The ball is the sphere on which most of the area lies; its front is where the mesh stands out of it or lies
    /// within it, else away from its opening, else where the nearest bone looks. Up is the bone's, else +Y.
    ///
    /// # Errors
    /// What is no eye: see [`NoEyeFrame`].
    pub fn of(parts: &[(&Primitive, Mat4)], bones: &[EyeBone]) -> Result<Vec<Self>, NoEyeFrame> {
        let mut pieces = Vec::new();
        for (primitive, rest) in parts {
            pieces.extend(pieces_of(primitive, *rest)?);
        }
        let mut frames =
            eyes(pieces).iter().map(|samples| Self::found(samples, bones)).collect::<Result<Vec<_>, _>>()?;
        if frames.is_empty() {
            return Err(NoEyeFrame::Empty);
        }
        frames.sort_by(|a, b| b.centre.x.total_cmp(&a.centre.x));
        Ok(frames)
    }

    /// Takes the frame's space (metres) to that of the eye (mm): origin at the centre, +z out of the pupil, +y up, the ball as
    /// large as in `dimensions`. Never mirrors, on neither side of a face.
    #[must_use]
    pub fn eye_from_mesh(&self, dimensions: &EyeDimensions) -> Mat4 {
        let turn = Mat3::from_cols(self.up.cross(self.axis), self.up, self.axis).transpose();
        let scale = dimensions.eyeball_radius_mm / self.radius;
        Mat4::from_mat3(turn * scale) * Mat4::from_translation(-self.centre)
    }

    fn found(samples: &[Sample], bones: &[EyeBone]) -> Result<Self, NoEyeFrame> {
        let sphere = Sphere::through(samples).ok_or(NoEyeFrame::Flat)?;
        let area = |samples: &mut dyn Iterator<Item = &Sample>| samples.map(|s| s.area).sum::<f64>();
        let near = area(&mut samples.iter().filter(|s| sphere.height(s.at).abs() <= NEAR));
        let round = (near / area(&mut samples.iter())) as f32;
        if round < ROUND {
            return Err(NoEyeFrame::NotRound(round));
        }
        if near < COVERED * 4.0 * std::f64::consts::PI * sphere.radius.powi(2) {
            return Err(NoEyeFrame::Flat);
        }
        let distance = |bone: &&EyeBone| bone.position.as_dvec3().distance_squared(sphere.centre);
        let bone = bones.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let unit = |v: Vec3| v.as_dvec3().try_normalize().ok_or(NoEyeFrame::Bone);
        let forward = bone.map(|b| unit(b.forward)).transpose()?;
        let up = bone.map(|b| unit(b.up)).transpose()?.unwrap_or(DVec3::Y);
        let axis = match (front(samples, &sphere), forward) {
            (Some(front), Some(forward)) if front.dot(forward) < AGREES => forward,
            (Some(front), _) => front,
            (None, Some(forward)) => forward,
            (None, None) => return Err(NoEyeFrame::NoFront),
        };
        let up = up.reject_from_normalized(axis).try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector());
        Ok(Self {
            centre: sphere.centre.as_vec3(),
            axis: axis.as_vec3(),
            up: up.as_vec3(),
            radius: sphere.radius as f32,
        })
    }
}

/// Where the front of an eye is, as its mesh says; unit.
fn front(samples: &[Sample], sphere: &Sphere) -> Option<DVec3> {
    let toward = |s: &Sample| (s.at - sphere.centre).normalize_or_zero();
    let all: f64 = samples.iter().map(|s| s.area).sum();
    let outstanding = |s: &Sample| s.area * (sphere.height(s.at).abs() - STANDS_OUT).max(0.0).powi(2);
    let out: f64 = samples.iter().map(outstanding).sum();
    let side: DVec3 = samples.iter().map(|s| toward(s) * outstanding(s)).sum();
    if out > LEAST_OUT * all {
        return (side.length() > ONE_SIDED * out).then(|| side.normalize());
    }
    // Directions of a shell from which a share of the sphere is cut off have that share as their mean.
    let shell: DVec3 = samples.iter().map(|s| toward(s) * s.area).sum();
    (shell.length() > OPEN * all).then(|| shell.normalize())
}

fn bounds(samples: &[Sample]) -> (DVec3, DVec3) {
    let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    samples.iter().fold(none, |(low, high), s| (low.min(s.at), high.max(s.at)))
}

/// What of a primitive hangs together by its vertices: the corners of its triangles, each with its share of the area.
pub(super) fn pieces_of(primitive: &Primitive, rest: Mat4) -> Result<Vec<Vec<Sample>>, NoEyeFrame> {
    let rest: DMat4 = rest.as_dmat4();
    let points: Vec<DVec3> =
        primitive.positions.iter().map(|p| rest.transform_point3(Vec3::from(*p).as_dvec3())).collect();
    let triangles = primitive.indices.as_chunks::<3>().0;
    let is_sound = |i: &u32| points.get(*i as usize).is_some_and(|p| p.is_finite());
    let numbers = piece_numbers(primitive).filter(|_| triangles.as_flattened().iter().all(is_sound));
    let Some(numbers) = numbers else { return Err(NoEyeFrame::Broken) };
    let mut pieces = vec![Vec::new(); points.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|i| points[i as usize]);
        let area = (b - a).cross(c - a).length() / 6.0;
        let piece = &mut pieces[numbers[triangle[0] as usize]];
        if area > 0.0 {
            piece.extend([a, b, c].map(|at| Sample { at, area }));
        }
    }
    pieces.retain(|piece| !piece.is_empty());
    Ok(pieces)
}

/// By vertex, the piece that it belongs to, of what hangs together by triangles; `None` where a triangle lacks a corner.
pub(super) fn piece_numbers(primitive: &Primitive) -> Option<Vec<usize>> {
    let mut sets = Sets::new(primitive.positions.len());
    for [a, b, c] in primitive.indices.as_chunks::<3>().0.iter().map(|t| t.map(|i| i as usize)) {
        if a.max(b).max(c) >= primitive.positions.len() {
            return None;
        }
        sets.join(a, b);
        sets.join(a, c);
    }
    Some(sets.numbered().0)
}

/// Pieces that belong to one eye: along the longest side of the whole, where two eyes lie side by side, there is a gap.
pub(super) fn eyes(pieces: Vec<Vec<Sample>>) -> Vec<Vec<Sample>> {
    let boxes: Vec<(DVec3, DVec3)> = pieces.iter().map(|piece| bounds(piece)).collect();
    let (low, high) = boxes.iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), b| (l.min(b.0), h.max(b.1)));
    let size = (high - low).to_array();
    let along = (1..3).fold(0, |longest, i| if size[i] > size[longest] { i } else { longest });
    let mut pieces: Vec<_> =
        pieces.into_iter().zip(boxes).map(|(piece, (low, high))| (low[along], high[along], piece)).collect();
    pieces.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut eyes: Vec<(f64, f64, Vec<Sample>)> = Vec::new();
    for (low, high, piece) in pieces {
        match eyes.last_mut() {
            Some(eye) if low - eye.1 <= GAP * (eye.1 - eye.0).max(high - low) => {
                eye.1 = eye.1.max(high);
                eye.2.extend(piece);
            }
            _ => eyes.push((low, high, piece)),
        }
    }
    eyes.into_iter().map(|eye| eye.2).collect()
}

#[cfg(test)]
mod tests {
    use std::f32::consts::{PI, TAU};

    use glam::{EulerRot, Quat};

    use super::*;

    /// A surface of revolution about +z through rings of radius and height.
    fn lathe(rings: &[[f32; 2]]) -> Primitive {
        const STEPS: u32 = 32;
        let mut made = Primitive::default();
        for [radius, height] in rings {
            for s in 0..STEPS {
                let (sin, cos) = (s as f32 / STEPS as f32 * TAU).sin_cos();
                made.positions.push([radius * cos, radius * sin, *height]);
            }
        }
        for r in 0..rings.len() as u32 - 1 {
            for s in 0..STEPS {
                let [a, b] = [s, (s + 1) % STEPS].map(|s| r * STEPS + s);
                made.indices.extend([a, a + STEPS, b + STEPS, a, b + STEPS, b]);
            }
        }
        made
    }

    /// Rings of a unit sphere between two angles from the front.
    fn arc(low: f32, high: f32) -> Vec<[f32; 2]> {
        (0..=24).map(|i| (low + (high - low) * i as f32 / 24.0).sin_cos().into()).collect()
    }

    /// Rings of a human cornea on a ball of radius 1.
    fn cornea() -> Vec<[f32; 2]> {
        let human = EyeDimensions::default();
        let [radius, limbus, centre] =
            [human.cornea_radius_mm, human.limbus_radius_mm, human.cornea_centre_z_mm()].map(|x| x / 12.0);
        let widest = (limbus / radius).asin();
        arc(0.0, widest).iter().map(|[r, h]| [r * radius, h * radius + centre]).collect()
    }

    const LIMBUS: f32 = 0.513_9;

    fn bulged() -> Primitive {
        lathe(&[cornea(), arc(LIMBUS, PI)].concat())
    }

    /// Cornea, iris and sclera apart.
    fn apart() -> Vec<Primitive> {
        let iris: Vec<[f32; 2]> = (0..=8).map(|i| [0.49 * i as f32 / 8.0, 0.83]).collect();
        vec![lathe(&cornea()), lathe(&iris), lathe(&arc(LIMBUS, PI * 0.9))]
    }

    fn find(parts: &[Primitive], rest: Mat4, bones: &[EyeBone]) -> Result<Vec<EyeFrame>, NoEyeFrame> {
        EyeFrame::of(&parts.iter().map(|p| (p, rest)).collect::<Vec<_>>(), bones)
    }

    fn one(parts: &[Primitive], rest: Mat4, bones: &[EyeBone]) -> EyeFrame {
        let frames = find(parts, rest, bones).expect("a frame");
        assert_eq!(frames.len(), 1);
        frames[0]
    }

    fn placed(radius: f32, turn: [f32; 3], centre: [f32; 3]) -> Mat4 {
        let turn = Quat::from_euler(EulerRot::YXZ, turn[0], turn[1], turn[2]);
        Mat4::from_scale_rotation_translation(Vec3::splat(radius), turn, centre.into())
    }

    #[track_caller]
    fn assert_eye(found: &EyeFrame, rest: Mat4, off: f32) {
        let (radius, turn, centre) = rest.to_scale_rotation_translation();
        assert!(found.centre.distance(centre) <= off * radius.z.abs(), "{found:?}");
        assert!((found.radius / radius.z.abs() - 1.0).abs() <= off, "{found:?}");
        assert!(found.axis.distance(turn * Vec3::Z) <= 2.0 * off, "{found:?}");
        assert!(found.up.dot(found.axis).abs() < 1e-6 && found.up.y >= 0.0 && found.up.is_normalized());
    }

    const AHEAD: EyeBone = EyeBone { position: Vec3::ZERO, forward: Vec3::Z, up: Vec3::Y };

    #[test]
    fn frames_are_found_at_any_place_size_and_turn() {
        for rest in [
            placed(0.012, [0.0; 3], [0.032, 1.6, 0.08]),
            placed(0.0255, [0.3, -0.2, 1.0], [-0.036, 1.41, 0.045]),
            placed(1.2, [2.0, 0.4, -2.0], [50.0, -3.0, 7.0]),
        ] {
            assert_eye(&one(&[bulged()], rest, &[]), rest, 2e-3);
            assert_eye(&one(&apart(), rest, &[]), rest, 1e-3);
            // The front of a ball.
            assert_eye(&one(&[lathe(&arc(0.0, 1.6))], rest, &[]), rest, 1e-4);
            // A ball says nothing of where it looks; its bone does.
            let forward = rest.transform_vector3(Vec3::Z * 3.0);
            let bone = EyeBone { position: rest.w_axis.truncate(), forward, up: Vec3::Y };
            assert_eye(&one(&[lathe(&arc(0.0, PI))], rest, &[bone]), rest, 1e-4);
        }
    }

    #[test]
    fn mirrored_eyes_are_told_apart_and_look_mirrored() {
        let left = placed(0.012, [0.09, 0.05, 0.0], [0.03, 1.6, 0.08]);
        let right = Mat4::from_scale(Vec3::new(-1.0, 1.0, 1.0)) * left;
        // In one primitive, and in three parts a side.
        let mut both = bulged();
        let count = both.positions.len() as u32;
        let at = |rest: Mat4| both.positions.iter().map(move |p| rest.transform_point3(Vec3::from(*p)).to_array());
        let positions: Vec<[f32; 3]> = at(left).chain(at(right)).collect();
        both.positions = positions;
        both.indices = both.indices.iter().copied().chain(both.indices.iter().map(|i| i + count)).collect();
        let apart = apart();
        let sides: Vec<(&Primitive, Mat4)> = apart.iter().flat_map(|p| [(p, right), (p, left)]).collect();
        for frames in [EyeFrame::of(&[(&both, Mat4::IDENTITY)], &[]), EyeFrame::of(&sides, &[])] {
            let frames = frames.expect("frames");
            assert_eq!(frames.len(), 2);
            assert_eye(&frames[0], left, 2e-3);
            let flip = Vec3::new(-1.0, 1.0, 1.0);
            for (l, r) in [(frames[0].centre, frames[1].centre), (frames[0].axis, frames[1].axis)] {
                assert!((l * flip).distance(r) < 1e-5, "{frames:?}");
            }
        }
        // Each takes the bone that is nearest.
        let ball = lathe(&arc(0.0, PI));
        let bones = [-0.03, 0.03].map(|x| EyeBone {
            position: Vec3::new(x, 1.6, 0.07),
            forward: Vec3::new(x, 0.0, 1.0),
            up: Vec3::Y,
        });
        let frames = EyeFrame::of(&[(&ball, left), (&ball, right)], &bones).expect("frames");
        assert!(frames[0].axis.x > 0.02 && frames[1].axis.x < -0.02, "{frames:?}");
    }

    #[test]
    fn a_bone_settles_what_a_mesh_leaves_open() {
        let rest = placed(0.012, [0.2, 0.0, 0.0], [0.0; 3]);
        // The mesh is nearer to the truth than the bone, whose up counts.
        let tilted = EyeBone { up: Vec3::new(0.5, 1.0, 0.0), ..AHEAD };
        let found = one(&[bulged()], rest, &[tilted]);
        assert_eye(&found, rest, 2e-3);
        assert!((found.up.x / found.up.y - 0.5).abs() < 0.05, "{found:?}");
        // Behind, only a nerve stands out.
        let nerve = placed(0.012, [PI, 0.0, 0.0], [0.0; 3]);
        assert!(one(&[bulged()], nerve, &[AHEAD]).axis.z > 0.999);
        // Straight up there is no up.
        let up = placed(0.012, [0.0, -PI / 2.0, 0.0], [0.0; 3]);
        assert!(one(&[bulged()], up, &[]).up.is_normalized());
    }

    #[test]
    fn frames_lead_to_the_space_of_the_eye() {
        let rest = placed(0.0255, [0.3, -0.2, 0.0], [-0.036, 1.41, 0.045]);
        let human = EyeDimensions::default();
        let frame = one(&apart(), rest, &[]);
        let to_eye = frame.eye_from_mesh(&human) * rest;
        assert!(to_eye.determinant() > 0.0);
        let apex = human.cornea_centre_z_mm() + human.cornea_radius_mm;
        for (mesh, eye) in [(Vec3::Z, 12.0), (Vec3::ZERO, 0.0), (Vec3::Z * apex / 12.0, apex)] {
            assert!(to_eye.transform_point3(mesh).distance(Vec3::Z * eye) < 0.03, "{mesh}");
        }
    }

    #[test]
    fn what_is_no_eye_is_named() {
        let none = |parts: &[Primitive], bones: &[EyeBone]| {
            let error = find(parts, Mat4::IDENTITY, bones).expect_err("no eye");
            assert!(!error.to_string().contains('\n'));
            error
        };
        let ball = || lathe(&arc(0.0, PI));
        let flat: Vec<[f32; 2]> = (0..=8).map(|i| [i as f32, 0.0]).collect();
        let bowl: Vec<[f32; 2]> = arc(0.0, 0.3);
        assert_eq!(none(&[], &[]), NoEyeFrame::Empty);
        assert_eq!(none(&[Primitive::default()], &[]), NoEyeFrame::Empty);
        assert_eq!(none(&[lathe(&[[0.0; 2]; 2])], &[]), NoEyeFrame::Empty);
        assert_eq!(none(&[lathe(&flat)], &[AHEAD]), NoEyeFrame::Flat);
        assert_eq!(none(&[lathe(&bowl)], &[AHEAD]), NoEyeFrame::Flat);
        assert_eq!(none(&[ball()], &[]), NoEyeFrame::NoFront);
        assert_eq!(none(&[ball()], &[EyeBone { forward: Vec3::ZERO, ..AHEAD }]), NoEyeFrame::Bone);
        let tube: Vec<[f32; 2]> = (0..=40).map(|i| [1.0, i as f32 * 0.25]).collect();
        assert!(matches!(none(&[lathe(&tube)], &[AHEAD]), NoEyeFrame::NotRound(_)));
        let mut broken = ball();
        broken.indices[0] = 1_000_000;
        assert_eq!(none(&[broken], &[AHEAD]), NoEyeFrame::Broken);
        let mut broken = ball();
        broken.positions[5] = [f32::NAN, 0.0, 0.0];
        assert_eq!(none(&[broken], &[AHEAD]), NoEyeFrame::Broken);
    }
}
