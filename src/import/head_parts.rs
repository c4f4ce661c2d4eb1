//! Face and hair of a character that a file keeps in one part, told apart by pieces and colours: looks go by parts.

#![allow(
    clippy::arithmetic_side_effects,
    clippy::indexing_slicing,
    reason = "the scene has been checked: float vectors cannot overflow, and indices are in their range"
)]

use std::collections::BTreeMap;

use glam::{Mat4, Vec3};

use crate::material::Material;
use crate::scene::painted::Painted;
use crate::scene::{ColorBind, Primitive, Role, Scene, UvBind};
use crate::tone::Tone;

/// Fewest triangles of a head: what has less is a block.
const LEAST_TRIANGLES: usize = 200;
/// Distance of tones up to which two are of one colour, with its lights and shades.
const NEAR: f32 = 0.07;
/// Share of a piece that must have a colour for it to be of that colour.
const MOSTLY: f32 = 0.6;
/// Share of a head's surface that hair covers at least.
const LEAST_HAIR: f32 = 0.15;
/// How high a brow or an eye is at most, share of the face's height.
const FEATURE: f32 = 0.25;
/// How far it lies behind the tip of the nose at least, share of the face's depth: locks hang before the face.
const BEHIND_NOSE: f32 = 0.05;
/// Most colours among which the most frequent one is looked for.
const MOST_COLORS: usize = 512;

/// Gives face and hair parts and materials of their own, where nothing is known for a face and the head of an upright character
/// shows one.
pub(super) fn divide(scene: &mut Scene) {
    let mut parts = scene.meshes.iter().flat_map(|m| &m.primitives);
    if parts.any(|p| p.role == Role::Face) {
        return;
    }
    let mut heads = Head::all(scene);
    heads.sort_by(|a, b| b.area.total_cmp(&a.area));
    let found = heads.iter().find_map(|head| Some((head.mesh, head.index, head.roles()?)));
    let Some((mesh, index, roles)) = found else { return };
    let part = &scene.meshes[mesh].primitives[index];
    let mut by_role: BTreeMap<Role, Vec<u32>> = BTreeMap::new();
    for (corners, role) in part.indices.as_chunks::<3>().0.iter().zip(roles) {
        by_role.entry(role.unwrap_or(part.role)).or_default().extend(corners);
    }
    let whole = part.clone();
    let mut materials = BTreeMap::from([(whole.role, whole.material)]);
    let mut divided = Vec::new();
    for (role, triangles) in by_role {
        let kind = if role == Role::HairFront { Role::Hair } else { role };
        let material = *materials.entry(kind).or_insert_with(|| copied(scene, whole.material, kind));
        divided.push(Primitive { role, material, ..whole.with_triangles(triangles) });
    }
    scene.meshes[mesh].primitives.splice(index..=index, divided);
}

/// A copy of a material, which expressions change as they change it.
fn copied(scene: &mut Scene, material: usize, of: Role) -> usize {
    let copy = scene.materials.len();
    let original = &scene.materials[material];
    let kind = if of == Role::Face { "face" } else { "hair" };
    scene.materials.push(Material { name: format!("{} {kind}", original.name), ..original.clone() });
    for expression in scene.character.iter_mut().flat_map(|c| &mut c.expressions) {
        let colors = expression.colors.iter().filter(|c| c.material == material);
        let colors: Vec<ColorBind> = colors.map(|c| ColorBind { material: copy, ..*c }).collect();
        expression.colors.extend(colors);
        let moves = expression.uv_transforms.iter().filter(|t| t.material == material);
        let moves: Vec<UvBind> = moves.map(|t| UvBind { material: copy, ..*t }).collect();
        expression.uv_transforms.extend(moves);
    }
    copy
}

/// A triangle of a head, in the world at rest.
struct Triangle {
    /// Its number in the part.
    number: usize,
    piece: usize,
    tone: Tone,
    area: f32,
    middle: Vec3,
    /// Whether it looks to the front.
    is_front: bool,
}

/// What of a part follows the head.
struct Head<'a> {
    mesh: usize,
    index: usize,
    part: &'a Primitive,
    triangles: Vec<Triangle>,
    area: f32,
}

impl<'a> Head<'a> {
    /// Of all parts of which nothing is known.
    fn all(scene: &'a Scene) -> Vec<Self> {
        let world = scene.rest_world_from_nodes();
        let Some(node) = scene.head_node().filter(|node| is_upright(&world, *node)) else { return Vec::new() };
        let below = scene.descendants(node);
        let parts =
            scene.mesh_nodes().flat_map(|(node, mesh)| mesh.primitives.iter().enumerate().map(move |p| (node, p)));
        let unknown = parts.filter(|(_, (_, part))| part.role == Role::Other);
        let heads = unknown.filter_map(|(node, (index, part))| {
            let mesh = scene.nodes[node].mesh?;
            let follows = scene.shares(node, part, &below);
            Self::of(scene, (mesh, index), part, scene.rest_placement(&world, node), &follows)
        });
        heads.collect()
    }

    fn of(
        scene: &Scene,
        (mesh, index): (usize, usize),
        part: &'a Primitive,
        matrix: Mat4,
        follows: &[f32],
    ) -> Option<Self> {
        let material = scene.materials.get(part.material)?;
        let of_head = |corners: &[u32; 3]| corners.iter().all(|v| follows[*v as usize] > 0.5);
        let corners = part.indices.as_chunks::<3>().0;
        if corners.iter().filter(|c| of_head(c)).count() < LEAST_TRIANGLES {
            return None;
        }
        let painted = Painted::new(scene, material);
        let (pieces, _) = part.pieces();
        let triangle = |(number, corners): (usize, &[u32; 3])| {
            let [a, b, c] = corners.map(|v| matrix.transform_point3(Vec3::from(part.positions[v as usize])));
            let uvs = corners.map(|v| painted.uv(part, v as usize));
            let [red, green, blue, _] = painted.at([0, 1].map(|k| uvs.iter().map(|uv| uv[k]).sum::<f32>() / 3.0));
            let own = corners.iter().filter_map(|v| part.colors.get(*v as usize));
            let own = own.fold(Vec3::ZERO, |sum, c| sum + Vec3::from_slice(c) / 3.0);
            let by = if part.colors.is_empty() { Vec3::ONE } else { own };
            let normal = (b - a).cross(c - a);
            let area = 0.5 * normal.length();
            let tone = Tone::of((Vec3::new(red, green, blue) * by).to_array());
            let is_front = normal.z > 0.4 * normal.length();
            let piece = pieces[corners[0] as usize];
            area.is_finite().then_some(Triangle { number, piece, tone, area, middle: (a + b + c) / 3.0, is_front })
        };
        let of_head = corners.iter().enumerate().filter(|(_, c)| of_head(c));
        let triangles: Vec<Triangle> = of_head.filter_map(triangle).collect();
        let area = triangles.iter().map(|t| t.area).sum();
        Some(Self { mesh, index, part, triangles, area })
    }

    /// The role of each triangle of the part, where it has one of its own. `None` where there is no face.
    fn roles(&self) -> Option<Vec<Option<Role>>> {
        let front = self.triangles.iter().filter(|t| t.is_front);
        let (skin, _) = most_frequent(front.map(|t| (t.tone, t.area * t.tone.like_skin())))?;
        if skin.like_skin() < 0.5 {
            return None;
        }
        let is_skin = |t: &Triangle| t.tone.distance(skin) < NEAR;
        let others = self.triangles.iter().filter(|t| !is_skin(t));
        let hair = most_frequent(others.map(|t| (t.tone, t.area)));
        let hair = hair.filter(|(_, area)| *area > LEAST_HAIR * self.area).map(|(tone, _)| tone);
        let is_hair = |t: &Triangle| hair.is_some_and(|hair| t.tone.distance(hair) < NEAR.min(t.tone.distance(skin)));
        let mut pieces: BTreeMap<usize, Vec<&Triangle>> = BTreeMap::new();
        self.triangles.iter().for_each(|t| pieces.entry(t.piece).or_default().push(t));
        let mut roles = vec![None; self.part.indices.len() / 3];
        let mut others = Vec::new();
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for piece in pieces.into_values() {
            let [skin, hair] = [share(&piece, is_skin), share(&piece, is_hair)];
            let is_mixed = skin + hair > MOSTLY && skin.min(hair) > 0.1;
            if skin < MOSTLY && !is_mixed {
                others.push((piece, hair));
                continue;
            }
            for t in piece {
                let role = if is_mixed && is_hair(t) { Role::Hair } else { Role::Face };
                roles[t.number] = Some(role);
                if role == Role::Face {
                    (low, high) = (low.min(t.middle), high.max(t.middle));
                }
            }
        }
        let (middle, size) = ((low + high) * 0.5, high - low);
        let before = |t: &Triangle| t.middle.z > middle.z && t.middle.y < high.y - 0.1 * size.y;
        for (piece, hair) in others {
            let middles = piece.iter().map(|t| t.middle);
            let (from, to) = middles.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), at| (l.min(at), h.max(at)));
            let is_feature = to.y - from.y < FEATURE * size.y && to.z < high.z - BEHIND_NOSE * size.z;
            let role = match share(&piece, before) > 0.5 {
                true if is_feature => Role::Face,
                true if hair > MOSTLY => Role::HairFront,
                false if hair > MOSTLY => Role::Hair,
                _ => continue,
            };
            piece.iter().for_each(|t| roles[t.number] = Some(role));
        }
        size.is_finite().then_some(roles)
    }
}

/// Share of a piece's surface for which something holds.
fn share(piece: &[&Triangle], holds: impl Fn(&Triangle) -> bool) -> f32 {
    let all: f32 = piece.iter().map(|t| t.area).sum();
    piece.iter().filter(|t| holds(t)).map(|t| t.area).sum::<f32>() / all.max(f32::MIN_POSITIVE)
}

/// The colour round which most weight lies, and how much. `None` where there is no weight.
fn most_frequent(colors: impl Iterator<Item = (Tone, f32)>) -> Option<(Tone, f32)> {
    let mut known: BTreeMap<[i16; 3], (Tone, f32)> = BTreeMap::new();
    for (tone, weight) in colors.filter(|(_, w)| *w > 0.0) {
        let (sin, cos) = tone.hue_rad.sin_cos();
        let key = [tone.lightness, tone.chroma * cos, tone.chroma * sin].map(|x| (x * 60.0).round() as i16);
        let (mean, sum) = known.entry(key).or_insert((tone, 0.0));
        *sum += weight;
        *mean = mean.mixed(tone, weight / *sum);
    }
    let mut known: Vec<(Tone, f32)> = known.into_values().collect();
    known.sort_by(|a, b| b.1.total_cmp(&a.1));
    known.truncate(MOST_COLORS);
    let near = |of: Tone| known.iter().filter(move |(t, _)| t.distance(of) < NEAR);
    let weight = |of: Tone| near(of).map(|(_, w)| w).sum::<f32>();
    let (best, _) = known.iter().max_by(|a, b| weight(a.0).total_cmp(&weight(b.0)))?;
    Some((*best, weight(*best)))
}

/// Whether the head stands over the middle of what carries it, as that of a quadruped does not.
fn is_upright(world: &[Mat4], head: usize) -> bool {
    let place = |matrix: &Mat4| matrix.w_axis.truncate();
    let sum: Vec3 = world.iter().map(place).sum();
    let low = world.iter().map(|m| place(m).y).fold(f32::INFINITY, f32::min);
    let off = place(&world[head]) - sum / world.len().max(1) as f32;
    off.with_y(0.0).length() < 0.3 * (place(&world[head]).y - low)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::color::Srgb;
    use crate::material::Base;
    use crate::scene::{Character, Expression, Mesh, Node, Transform};

    const SKIN: &str = "#f6aa8c";
    const HAIR: &str = "#2483e4";
    const BLACK: &str = "#191919";

    /// A ball of some colour.
    fn ball(into: &mut Primitive, middle: [f32; 3], radius: f32, color: &str) {
        let linear = Srgb::from_hex(color).unwrap().to_linear().0;
        let first = into.positions.len() as u32;
        for (i, j) in (0..=12).flat_map(|i| (0..=24).map(move |j| (i, j))) {
            let (theta, phi) = (i as f32 / 12.0 * std::f32::consts::PI, (j % 24) as f32 / 12.0 * std::f32::consts::PI);
            let out = Vec3::new(theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos());
            into.positions.push((Vec3::from(middle) + out * radius).to_array());
            into.normals.push(out.to_array());
            into.colors.push([linear[0], linear[1], linear[2], 1.0]);
        }
        for (i, j) in (0..12).flat_map(|i| (0..24).map(move |j| (i, j))) {
            let at = |i: u32, j: u32| first + i * 25 + j;
            into.indices.extend([at(i, j), at(i + 1, j), at(i, j + 1), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)]);
        }
    }

    /// A head of one part under a node of this name: a skull of skin, a bun of hair behind, bangs in front, eyes, a black tie.
    fn scene(head: &str, skin: &str) -> Scene {
        let mut part = Primitive::default();
        ball(&mut part, [0.0, 1.5, 0.0], 0.1, skin);
        ball(&mut part, [0.0, 1.56, -0.06], 0.1, HAIR);
        ball(&mut part, [0.0, 1.57, 0.08], 0.03, HAIR);
        ball(&mut part, [0.04, 1.5, 0.07], 0.012, BLACK);
        ball(&mut part, [-0.04, 1.5, 0.07], 0.012, BLACK);
        ball(&mut part, [0.0, 1.62, -0.12], 0.04, BLACK);
        let node = |name: &str, parent: Option<usize>, y: f32| Node {
            name: name.to_owned(),
            parent,
            transform: Transform { translation: Vec3::Y * y, ..Transform::default() },
            ..Node::default()
        };
        let mut nodes = vec![node("root", None, 0.0), node(head, Some(0), 1.4)];
        nodes.push(Node { mesh: Some(0), ..node("all", Some(1), -1.4) });
        let color = ColorBind { material: 0, target: crate::scene::ColorTarget::Color, value: [1.0; 4] };
        let blush = Expression { name: "blush".to_owned(), colors: vec![color], ..Expression::default() };
        Scene {
            nodes,
            meshes: vec![Mesh { primitives: vec![part], ..Mesh::default() }],
            materials: vec![Material {
                name: "all".to_owned(),
                base: Base { color: [1.0; 4], ..Base::default() },
                ..Material::default()
            }],
            character: Some(Character { expressions: vec![blush], ..Character::default() }),
            ..Scene::default()
        }
    }

    #[test]
    fn face_and_hair_are_told_apart() {
        let mut scene = scene("mixamorig:Head", SKIN);
        divide(&mut scene);
        let ball = 12 * 24 * 2;
        let parts: Vec<_> =
            scene.meshes[0].primitives.iter().map(|p| (p.role, p.material, p.indices.len() / 3 / ball)).collect();
        // Eyes stay with the face, and what nobody knows where it was.
        assert_eq!(parts, [(Role::Face, 1, 3), (Role::HairFront, 2, 1), (Role::Hair, 2, 1), (Role::Other, 0, 1)]);
        let names: Vec<&str> = scene.materials.iter().map(|m| m.name.as_str()).collect();
        assert_eq!(names, ["all", "all face", "all hair"]);
        let colors = &scene.character.unwrap().expressions[0].colors;
        assert_eq!(colors.iter().map(|c| c.material).collect::<Vec<_>>(), [0, 1, 2]);
    }

    #[test]
    fn the_head_of_a_quadruped_stays_whole() {
        let mut scene = scene("head", SKIN);
        scene.nodes[1].transform.translation.z = 1.5;
        divide(&mut scene);
        assert_eq!((scene.meshes[0].primitives.len(), scene.materials.len()), (1, 1));
    }

    #[test]
    fn without_a_head_or_skin_nothing_changes() {
        for (head, skin) in [("pelvis", SKIN), ("head", "#60c060")] {
            let mut scene = scene(head, skin);
            let before = scene.meshes.clone();
            divide(&mut scene);
            assert_eq!(scene.meshes, before, "{head} {skin}");
            assert_eq!(scene.materials.len(), 1);
        }
    }
}
