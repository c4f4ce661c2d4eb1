//! The eyes of a scene at rest: where each is, which vertices are whose, and how pictures lie on them.

use std::collections::HashMap;

use glam::{DMat3, DVec3, Mat3, Mat4, Vec2, Vec3};

use super::frame::{EyeBone, EyeFrame, NoEyeFrame, piece_numbers};
use super::lids::{self, Lids, lids};
use super::plane::IrisPlane;
use crate::material::TextureRef;
use crate::scene::{Primitive, Role, Scene};
use crate::skin::{self, Tree};

/// Eyes that a character may have.
pub const MOST_EYES: usize = 4;

/// What the shaders of a material ask for of one eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyeRow {
    /// Texture coordinates of a place of the iris, x to the right as it is seen and y up in its unit disc: of u, and of v, the factor
    /// of x, of y, and what is added.
    pub uv: [[f32; 3]; 2],
    /// Lids round it, where there are any.
    pub lids: Option<Lids>,
    /// Half width of a drawn iris over its half height.
    pub aspect: f32,
}

impl Default for EyeRow {
    /// The square of a picture round the iris, no lids.
    fn default() -> Self {
        Self { uv: [[0.5, 0.0, 0.5], [0.0, -0.5, 0.5]], lids: None, aspect: 1.0 }
    }
}

/// Elevation at which no place of a ball lies, radians: lids that are not there.
const NO_LID: f32 = 10.0;

impl EyeRow {
    /// Whether there are lids round it.
    pub(crate) fn has_lids(&self) -> bool {
        self.lids.is_some()
    }

    /// As shaders read it: three rows with the upper lid's numbers at the end of each, then the lower lid's.
    pub(crate) fn rows(&self) -> [[f32; 4]; 3] {
        let [[ux, uy, u], [vx, vy, v]] = self.uv;
        let none = Lids { upper: [NO_LID, 0.0, 0.0], lower: [-NO_LID, 0.0, 0.0] };
        let Lids { upper, lower } = self.lids.unwrap_or(none);
        [[ux, uy, u, upper[0]], [vx, vy, v, upper[1]], [upper[2], lower[0], lower[1], lower[2]]]
    }
}

/// An eye whose pose shaders follow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlacedEye {
    /// Character space at rest; axes unit.
    pub centre: Vec3,
    pub axis: Vec3,
    pub up: Vec3,
    /// What moves it: a part by its place in the order of nodes and primitives, and the joint of its skin.
    pub part: u32,
    pub joint: u16,
}

/// A vertex in its eye: place from -2 to 2 in 15 bits and a sign, and the number of the eye.
pub(crate) type EyeVertex = [i16; 4];

/// All eyes of a scene that a material shades as such.
#[derive(Clone, Debug, Default)]
pub(crate) struct Eyes {
    pub list: Vec<PlacedEye>,
    /// Of parts that have some.
    pub vertices: HashMap<u32, Vec<EyeVertex>>,
    /// By material, each with one for every eye; empty where it shades none.
    pub rows: Vec<Vec<EyeRow>>,
}

/// Why a material cannot shade the eyes that it is on: the material, its key, and what is wrong.
pub(crate) type EyeFault = (usize, &'static str, String);

/// A part at rest.
pub(crate) struct RestPart<'a> {
    id: u32,
    pub primitive: &'a Primitive,
    /// Character space.
    positions: Vec<Vec3>,
    /// Whether it goes by the joints of a skin.
    is_skinned: bool,
}

/// An eye as a material sees it: takes character space to its own.
struct Seen {
    of_eye: Mat4,
    number: usize,
}

/// Places of the front of a ball, shares of its radius.
const FRONT: f32 = 0.4;
/// Beyond its iris, a picture is not asked how it lies; and nearer it must be known, shares of its radius.
const ON_IRIS: f32 = 1.1;
const INNER: f32 = 0.75;
/// How far a picture may lie off, share of its radius.
const BENT: f64 = 0.2;

impl Eyes {
    pub fn of(scene: &Scene) -> Result<Self, EyeFault> {
        let has_none = scene.materials.iter().all(|m| m.eye.is_none() && m.eye_depth.is_none());
        if has_none {
            return Ok(Self::default());
        }
        let parts = parts_at_rest(scene);
        let mut eyes = Self { rows: vec![Vec::new(); scene.materials.len()], ..Self::default() };
        eyes.add_balls(scene, &parts)?;
        eyes.add_planes(scene, &parts)?;
        Ok(eyes)
    }

    fn add_balls(&mut self, scene: &Scene, parts: &[RestPart<'_>]) -> Result<(), EyeFault> {
        let of = |part: &RestPart<'_>| scene.materials.get(part.primitive.material)?.eye;
        for (index, material) in scene.materials.iter().enumerate() {
            if let Some(Err(error)) = material.eye.map(|eye| eye.dimensions.check()) {
                return Err((index, "eye.dimensions", message_of(error)));
            }
        }
        let own: Vec<&RestPart<'_>> = parts.iter().filter(|part| of(part).is_some()).collect();
        let Some(first) = own.first().map(|part| part.primitive.material) else { return Ok(()) };
        let bodies: Vec<Primitive> = own.iter().map(|part| part.body()).collect();
        let placed: Vec<_> = bodies.iter().map(|body| (body, Mat4::IDENTITY)).collect();
        let bones = EyeBone::of(scene);
        // Which of several is not sound, each says alone.
        let frames = EyeFrame::of(&placed, &bones).map_err(|why| {
            let alone = |body: &Primitive| EyeFrame::of(&[(body, Mat4::IDENTITY)], &bones).err() == Some(why);
            let of = own
                .iter()
                .zip(&bodies)
                .find(|(_, body)| alone(body))
                .map_or(first, |(part, _)| part.primitive.material);
            (of, "eye", why.to_string())
        })?;
        if frames.len() > MOST_EYES {
            let message = format!("is on a mesh that falls apart into {} eyes; there may be {MOST_EYES}", frames.len());
            return Err((first, "eye", message));
        }
        let seen: Vec<Seen> =
            frames.iter().enumerate().map(|(number, frame)| Seen { of_eye: unit(frame), number }).collect();
        self.take(&own, &seen, frames.iter().map(|f| (f.centre, f.axis, f.up)));
        let hiding = |frame: &EyeFrame| hiding(scene, parts, frame);
        let lids: Vec<Option<Lids>> = frames.iter().map(|f| lids(&hiding(f), f.centre, f.radius, f.axis)).collect();
        for (index, material) in scene.materials.iter().enumerate() {
            let Some(eye) = material.eye else { continue };
            let picture = eye.iris_map.or(material.base.texture);
            let wears = |part: &&RestPart<'_>| {
                let of = &scene.materials[part.primitive.material];
                match (eye.iris_map, of.base.texture) {
                    (None, _) => part.primitive.material == index,
                    (Some(map), Some(base)) => (map.texture, map.uv_set) == (base.texture, base.uv_set),
                    (Some(_), None) => false,
                }
            };
            let wearing: Vec<&RestPart<'_>> = parts.iter().filter(wears).collect();
            let share = eye.dimensions.iris_radius_mm / eye.dimensions.eyeball_radius_mm;
            for (seen, lids) in seen.iter().zip(&lids) {
                let uv = picture.map(|picture| iris_uv(&wearing, &seen.of_eye, share, picture));
                let uv = uv.transpose().map_err(|message| (index, "eye.iris_map", message))?.flatten();
                self.rows[index].push(EyeRow { uv: uv.unwrap_or(EyeRow::default().uv), lids: *lids, aspect: 1.0 });
            }
        }
        Ok(())
    }

    fn add_planes(&mut self, scene: &Scene, parts: &[RestPart<'_>]) -> Result<(), EyeFault> {
        let bones = EyeBone::of(scene);
        for (index, material) in scene.materials.iter().enumerate() {
            if material.eye_depth.is_none() || material.eye.is_some() {
                continue;
            }
            let own: Vec<&RestPart<'_>> = parts.iter().filter(|part| part.primitive.material == index).collect();
            if own.is_empty() {
                continue;
            }
            let bodies: Vec<Primitive> = own.iter().map(|part| part.body()).collect();
            let placed: Vec<_> = bodies.iter().map(|body| (body, Mat4::IDENTITY)).collect();
            let planes = IrisPlane::of(&placed, &bones).map_err(|why| (index, "eye_depth", of_plane(why)))?;
            let first = self.list.len();
            if first + planes.len() > MOST_EYES {
                let message = format!(
                    "is on a mesh that falls apart into {} irises; a character may have {MOST_EYES} eyes (is it on more than irises?)",
                    planes.len()
                );
                return Err((index, "eye_depth", message));
            }
            let seen: Vec<Seen> =
                (first..).zip(&planes).map(|(number, p)| Seen { of_eye: p.disc_from_mesh(), number }).collect();
            self.take(
                &own,
                &seen,
                planes.iter().map(|p| (p.centre, p.gaze, p.up.reject_from_normalized(p.gaze).normalize_or(p.up))),
            );
            // Rows go by the number of the eye.
            self.rows[index] = vec![EyeRow::default(); first];
            for (seen, plane) in seen.iter().zip(&planes) {
                let uv = flat_uv(&own, &seen.of_eye).ok_or_else(|| {
                    let message =
                        "needs texture coordinates that lie evenly over each iris; the part has none, or they are bent";
                    (index, "eye_depth", message.to_owned())
                })?;
                self.rows[index].push(EyeRow { uv, lids: None, aspect: plane.half.x / plane.half.y });
            }
        }
        Ok(())
    }

    /// Gives each vertex of parts to the eye that is nearest, and eyes to what moves them.
    fn take(&mut self, parts: &[&RestPart<'_>], seen: &[Seen], frames: impl Iterator<Item = (Vec3, Vec3, Vec3)>) {
        // By eye: vertices by part and joint.
        let mut moving: Vec<HashMap<(u32, u16), usize>> = vec![HashMap::new(); seen.len()];
        for part in parts {
            let mut vertices = Vec::with_capacity(part.positions.len());
            for (v, position) in part.positions.iter().enumerate() {
                let places = seen.iter().map(|s| s.of_eye.transform_point3(*position)).enumerate();
                let nearest = places.min_by(|a, b| a.1.length_squared().total_cmp(&b.1.length_squared()));
                let (eye, place) = nearest.unwrap_or((0, Vec3::ZERO));
                let packed = place.to_array().map(|x| (x * 0.5 * 32767.0).round().clamp(-32767.0, 32767.0) as i16);
                vertices.push([packed[0], packed[1], packed[2], seen[eye].number as i16]);
                *moving[eye].entry((part.id, part.heaviest(v))).or_default() += 1;
            }
            self.vertices.insert(part.id, vertices);
        }
        for ((centre, axis, up), moving) in frames.zip(moving) {
            // Of as many the first, so that it is the same each time.
            let most = moving.into_iter().max_by_key(|(of, count)| (*count, std::cmp::Reverse(*of)));
            let (part, joint) = most.map_or((parts[0].id, 0), |(of, _)| of);
            self.list.push(PlacedEye { centre, axis, up, part, joint });
        }
    }
}

impl RestPart<'_> {
    /// Its shape alone.
    pub fn body(&self) -> Primitive {
        let positions = self.positions.iter().map(Vec3::to_array).collect();
        Primitive { positions, indices: self.primitive.indices.clone(), ..Primitive::default() }
    }

    /// The joint that moves a vertex most.
    fn heaviest(&self, vertex: usize) -> u16 {
        let of = &self.primitive.influences;
        let at = vertex * of.per_vertex..(vertex + 1) * of.per_vertex;
        let weights = of.weights.get(at.clone()).unwrap_or_default().iter();
        let joints = of.joints.get(at).unwrap_or_default().iter();
        let heaviest = joints.zip(weights).max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(joint, _)| *joint);
        if self.is_skinned { heaviest } else { 0 }
    }

    fn uv(&self, picture: TextureRef, vertex: usize) -> Option<Vec2> {
        self.primitive.uvs.get(picture.uv_set as usize)?.get(vertex).copied().map(Vec2::from)
    }
}

/// All parts, in the order of nodes and primitives.
pub(crate) fn parts_at_rest(scene: &Scene) -> Vec<RestPart<'_>> {
    let rest = scene.rest_world_from_nodes();
    let mut list = Vec::new();
    for (node, mesh) in scene.mesh_nodes() {
        let of = &scene.nodes[node];
        let skin = of.skin.and_then(|s| scene.skins.get(s));
        let character_from_mesh = skin.map_or(rest[node], |skin| skin.matrix(&rest, 0));
        for primitive in &mesh.primitives {
            let part = skin::Part { primitive, character_from_mesh, morph_weights: &of.morph_weights };
            let is_skinned = skin.is_some() && primitive.influences.per_vertex > 0;
            list.push(RestPart { id: list.len() as u32, primitive, positions: part.positions(), is_skinned });
        }
    }
    list
}

/// Takes the space of a frame to that of its eye in radii of the ball.
fn unit(frame: &EyeFrame) -> Mat4 {
    let turn = Mat3::from_cols(frame.up.cross(frame.axis), frame.up, frame.axis).transpose();
    Mat4::from_mat3(turn * (1.0 / frame.radius)) * Mat4::from_translation(-frame.centre)
}

/// What may be lids: surfaces near a ball that are not eyes, nor drawn on skin, nor hair.
fn hiding(scene: &Scene, parts: &[RestPart<'_>], frame: &EyeFrame) -> Tree {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for part in parts {
        let material = &scene.materials[part.primitive.material];
        let is_lid = matches!(part.primitive.role, Role::Face | Role::Skin | Role::Other);
        if material.eye.is_some() || material.eye_depth.is_some() || !is_lid {
            continue;
        }
        let is_near = |v: &u32| {
            part.positions.get(*v as usize).is_some_and(|p| p.distance(frame.centre) < lids::NEAR * frame.radius)
        };
        for corners in part.primitive.indices.as_chunks::<3>().0.iter().filter(|c| c.iter().any(is_near)) {
            let first = positions.len() as u32;
            positions.extend(corners.iter().filter_map(|c| part.positions.get(*c as usize)).map(Vec3::to_array));
            if positions.len() as u32 == first + 3 {
                triangles.push([first, first + 1, first + 2]);
            } else {
                positions.truncate(first as usize);
            }
        }
    }
    Tree::new(&positions, &triangles)
}

/// How a picture lies on an iris whose radius is this share of the ball's: of all shells of the eye that wear it, that counts on
/// which it is largest. `None` where nothing of it is there.
fn iris_uv(
    parts: &[&RestPart<'_>],
    of_eye: &Mat4,
    share: f32,
    picture: TextureRef,
) -> Result<Option<[[f32; 3]; 2]>, String> {
    let mut shells: HashMap<(u32, usize), Vec<(Vec2, Vec2)>> = HashMap::new();
    for part in parts {
        let Some(pieces) = piece_numbers(part.primitive) else { continue };
        for (v, position) in part.positions.iter().enumerate() {
            let place = of_eye.transform_point3(*position);
            let q = place.truncate() / share;
            let (true, Some(uv)) = (place.z > FRONT && q.length() <= ON_IRIS, part.uv(picture, v)) else { continue };
            shells.entry((part.id, pieces[v])).or_default().push((q, uv));
        }
    }
    let is_whole = |shell: &Vec<(Vec2, Vec2)>| shell.iter().any(|(q, _)| q.length() < INNER);
    let fits = shells.iter().filter(|(_, shell)| is_whole(shell)).filter_map(|(of, shell)| Some((of, affine(shell)?)));
    let size = |uv: &[[f32; 3]; 2]| (uv[0][0] * uv[1][1] - uv[0][1] * uv[1][0]).abs();
    let largest = fits.max_by(|a, b| size(&a.1.0).total_cmp(&size(&b.1.0)).then(b.0.cmp(a.0)));
    match largest {
        Some((_, (_, off))) if off > BENT => Err(format!(
            "the picture does not lie evenly over the front of the eye (it is {:.0} % of the iris off in the mean; a ball wrapped by \
             latitude?); please give the iris a picture of its own, whose square is drawn round it",
            (off * 100.0).min(100.0)
        )),
        largest => Ok(largest.map(|(_, (uv, _))| uv)),
    }
}

/// How the base texture's coordinates lie on a flat iris.
fn flat_uv(parts: &[&RestPart<'_>], of_eye: &Mat4) -> Option<[[f32; 3]; 2]> {
    let mut points = Vec::new();
    for part in parts {
        for (v, position) in part.positions.iter().enumerate() {
            let q = of_eye.transform_point3(*position).truncate();
            if q.abs().max_element() < 1.01
                && let Some(uv) = part.uv(TextureRef::default(), v)
            {
                points.push((q, uv));
            }
        }
    }
    affine(&points).filter(|(_, off)| *off <= BENT).map(|(uv, _)| uv)
}

/// Least squares of an affine map, and how far it is off in the mean, share of what its unit is.
fn affine(points: &[(Vec2, Vec2)]) -> Option<([[f32; 3]; 2], f64)> {
    let (mut normal, mut right) = (DMat3::ZERO, [DVec3::ZERO; 2]);
    for (q, uv) in points {
        let row = q.as_dvec2().extend(1.0);
        normal += DMat3::from_cols(row * row.x, row * row.y, row * row.z);
        right[0] += row * f64::from(uv.x);
        right[1] += row * f64::from(uv.y);
    }
    if points.len() < 3 || normal.determinant().abs() < 1e-9 {
        return None;
    }
    let found = right.map(|r| normal.inverse() * r);
    let size = (found[0].x * found[1].y - found[0].y * found[1].x).abs().sqrt();
    let off = |(q, uv): &(Vec2, Vec2)| {
        let row = q.as_dvec2().extend(1.0);
        (found[0].dot(row) - f64::from(uv.x)).powi(2) + (found[1].dot(row) - f64::from(uv.y)).powi(2)
    };
    let mean = (points.iter().map(off).sum::<f64>() / points.len() as f64).sqrt();
    (size > 1e-6).then(|| (found.map(|f| f.as_vec3().to_array()), mean / size))
}

fn of_plane(why: NoEyeFrame) -> String {
    match why {
        NoEyeFrame::NoFront => {
            "is on a mesh that looks everywhere; expected the flat part that an iris is drawn on (on eyeballs \
                                the section eye stands)"
                .to_owned()
        }
        other => other.to_string(),
    }
}

fn message_of(error: crate::Error) -> String {
    match error {
        crate::Error::Argument { what, message } => {
            format!("{} {message}", what.rsplit(": ").next().unwrap_or_default())
        }
        other => other.to_string(),
    }
}
