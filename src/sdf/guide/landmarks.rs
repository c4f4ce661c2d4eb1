//! Where eyes, nose, mouth and chin are on a face: by roles, by what morphs move, by the relief, and by its paint.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};
use serde::Serialize;

use super::relief::{Relief, SIDE, sample};
use crate::scene::{HumanBone, Mesh, Role, Scene};
use crate::sets::Sets;

/// Contrast of luminance over its surroundings from which a file counts as painting a feature itself.
const PAINTED: f32 = 0.03;
/// Depth of a crease from which a mouth counts as modelled, share of the face's height.
const MODELLED: f32 = 0.0008;

/// What a face is read by. Lengths are shares of the face's height, from its lower edge and from its middle line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Landmarks {
    /// Height of the face, metres: of what follows the head bone, and a margin below.
    pub height_m: f32,
    /// Where its lower edge meets its middle line, under the skull, in the world at rest, metres.
    pub foot_m: [f32; 3],
    /// Middle of the left eye: how far from the middle line, how high. The right eye is its mirror image.
    pub eye: [f32; 2],
    /// Half its width and half its height.
    pub eye_half: [f32; 2],
    /// Height of the tip of the nose.
    pub nose: f32,
    /// How far the tip stands out from the cheeks beside it.
    pub nose_out: f32,
    /// Height of the mouth's line.
    pub mouth: f32,
    /// Half its width.
    pub mouth_half: f32,
    /// How deep the crease between the lips is.
    pub mouth_depth: f32,
    /// Height of the chin's tip.
    pub chin: f32,
    /// Whether the file paints the nose: lines or a tone that stands out from the skin.
    pub nose_is_painted: bool,
    /// Whether the file paints the mouth.
    pub mouth_is_painted: bool,
}

impl Landmarks {
    /// Whether there is a crease of a mouth in the mesh that nothing paints.
    #[must_use]
    pub fn mouth_is_bare(&self) -> bool {
        !self.mouth_is_painted && self.mouth_depth > MODELLED
    }

    pub(super) fn find(scene: &Scene, relief: &Relief) -> Option<Self> {
        let (eye, eye_half) = eyes(scene, relief)?;
        let at = |across: f32, up: f32| at(relief, &relief.distance, across, up);
        // The chin: the lowest place in front that is not yet under the jaw.
        let below_eyes = at(0.0, eye.y);
        let chin = (0..200).map(|i| eye.y - i as f32 * 0.004).take_while(|up| *up > 0.0);
        let chin = chin.take_while(|up| at(0.0, *up) > 0.8 * below_eyes).last().unwrap_or(0.0);
        let span = eye.y - chin;
        let (mouth, mouth_half) = mouth(scene, relief, chin, eye).unwrap_or((chin + 0.34 * span, 0.7 * eye.x));
        // The tip: what stands out most from the straight line between forehead and mouth.
        let between = |share: f32| mouth + (eye.y - mouth) * share;
        let stands_out = |share: f32| {
            let chord = at(0.0, mouth) + (at(0.0, eye.y) - at(0.0, mouth)) * share;
            at(0.0, between(share)) - chord
        };
        let share = (10..80).map(|i| i as f32 / 100.0).max_by(|a, b| stands_out(*a).total_cmp(&stands_out(*b)));
        let nose = between(share.unwrap_or(0.4));
        let beside = at(0.55 * eye.x, nose);
        let nose_out = (at(0.0, nose) - beside) / relief.height;
        let rows = (-12..=12).map(|i| mouth + i as f32 * 0.0025);
        let depth =
            |up: f32| self::at(relief, &relief.dent, 0.0, up) + self::at(relief, &relief.dent, 0.4 * mouth_half, up);
        let crease = rows.max_by(|a, b| depth(*a).total_cmp(&depth(*b))).unwrap_or(mouth);
        let mouth_depth = depth(crease) * 0.5 / relief.height;
        let contrast = |low: Vec2, high: Vec2| contrast(relief, low, high);
        let nose_box = Vec2::new(0.35 * eye.x, 0.14 * span);
        Some(Self {
            height_m: relief.height,
            foot_m: relief.foot.to_array(),
            eye: eye.to_array(),
            eye_half: eye_half.to_array(),
            nose,
            nose_out,
            mouth: if mouth_depth > MODELLED { crease } else { mouth },
            mouth_half,
            mouth_depth,
            chin,
            nose_is_painted: contrast(Vec2::new(0.0, nose) - nose_box, Vec2::new(0.0, nose) + nose_box) > PAINTED,
            mouth_is_painted: contrast(
                Vec2::new(-0.8 * mouth_half, mouth - 0.1 * span),
                Vec2::new(0.8 * mouth_half, mouth + 0.1 * span),
            ) > PAINTED,
        })
    }
}

/// A field's value at a distance from the middle line and a height.
pub(super) fn at(relief: &Relief, field: &[f32], across: f32, up: f32) -> f32 {
    sample(field, place(relief, across, up))
}

/// The place on the relief of a point of the face.
pub(super) fn place(relief: &Relief, across: f32, up: f32) -> Vec2 {
    // Where the face is as far from the axis as it is in the middle.
    let radius = sample(&relief.distance, Vec2::new(0.5, 1.0 - up));
    let angle = (across * relief.height / radius.max(1e-6)).clamp(-1.0, 1.0).asin();
    Vec2::new(0.5 + 0.5 * angle / super::relief::REACH, 1.0 - up)
}

/// Middle and half size of the left eye: of the parts that are eyes, else of what blinking moves, of lashes, of the eye bone,
/// or of what is painted.
fn eyes(scene: &Scene, relief: &Relief) -> Option<(Vec2, Vec2)> {
    let world = scene.rest_world_from_nodes();
    let parts_of = |roles: &[Role]| -> Vec<Vec3> {
        let placed = |(node, mesh): (usize, &Mesh)| {
            let matrix = scene.rest_placement(&world, node);
            let parts = mesh.primitives.iter().filter(|p| roles.contains(&p.role)).flat_map(|p| &p.positions);
            parts.map(|p| matrix.transform_point3(Vec3::from(*p))).collect::<Vec<_>>()
        };
        scene.mesh_nodes().flat_map(placed).collect()
    };
    let blinking = || -> Vec<Vec3> {
        let moved = moved(scene, &["blink", "blinkLeft", "blinkRight"]);
        let far = moved.iter().filter(|m| m.way.length() > 0.002);
        far.map(|m| m.place).collect()
    };
    let bones = || -> Vec<Vec3> {
        let bone = scene.bone_node(HumanBone::LeftEye).and_then(|bone| world.get(bone));
        bone.map_or(Vec::new(), |bone| {
            let middle = bone.w_axis.truncate();
            let half = 0.45 * (middle.x - relief.foot.x).abs();
            vec![middle - half, middle + half]
        })
    };
    let mut found = parts_of(&[Role::Eye, Role::EyeWhite]);
    for other in [&blinking as &dyn Fn() -> Vec<Vec3>, &|| parts_of(&[Role::Lash]), &bones] {
        if found.is_empty() {
            found = other();
        }
    }
    let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    for place in found {
        let at = relief.across_and_up(place);
        let at = Vec2::new(at.x.abs(), at.y);
        (low, high) = (low.min(at), high.max(at));
    }
    let (middle, half) = ((low + high) * 0.5, (high - low) * 0.5);
    if !middle.is_finite() {
        return painted_eyes(relief);
    }
    let is_sound = middle.x > 0.02 && (0.05..0.95).contains(&middle.y) && half.x < 0.4;
    is_sound.then_some((middle, half.min(Vec2::splat(0.2))))
}

/// How much darker than skin an eye is painted, share of the skin's luminance.
const DARK: f32 = 0.4;
/// Share of the largest dark spot from which another counts.
const COUNTS: f32 = 0.35;

/// Middle and half size of the left eye as it is painted: the lowest of the great dark spots beside the middle, over which
/// brows lie.
fn painted_eyes(relief: &Relief) -> Option<(Vec2, Vec2)> {
    let column = |angle: f32| Relief::cell(Vec2::new(0.5 + 0.5 * angle / super::relief::REACH, 0.0))[0];
    let (left, right) = (column(0.1), column(1.0));
    let rows = SIDE / 8..SIDE * 4 / 5;
    let mut luminances: Vec<f32> =
        rows.clone().flat_map(|y| &relief.painted[y * SIDE + left..y * SIDE + right]).copied().collect();
    luminances.sort_by(f32::total_cmp);
    let skin = *luminances.get(luminances.len() / 2)?;
    let is_dark = |x: usize, y: usize| relief.painted[y * SIDE + x] < (1.0 - DARK) * skin;
    let mut spots = Sets::new(SIDE * SIDE);
    for (x, y) in rows.clone().flat_map(|y| (left..right).map(move |x| (x, y))).filter(|(x, y)| is_dark(*x, *y)) {
        let before = [(x.max(left + 1) - 1, y), (x, y.max(rows.start + 1) - 1)];
        before.iter().filter(|(x, y)| is_dark(*x, *y)).for_each(|(i, j)| spots.join(j * SIDE + i, y * SIDE + x));
    }
    let mut cells: BTreeMap<usize, Vec<[usize; 2]>> = BTreeMap::new();
    for (x, y) in rows.clone().flat_map(|y| (left..right).map(move |x| (x, y))).filter(|(x, y)| is_dark(*x, *y)) {
        cells.entry(spots.root(y * SIDE + x)).or_default().push([x, y]);
    }
    // What goes on beyond these bounds is hair, or a mouth.
    let is_inside =
        |[x, y]: &[usize; 2]| (left + 1..right - 1).contains(x) && (rows.start + 1..rows.end - 1).contains(y);
    cells.retain(|_, spot| spot.iter().all(is_inside));
    let most = cells.values().map(Vec::len).max()?;
    let great = cells.values().filter(|spot| spot.len() as f32 > COUNTS * most as f32);
    let height = |spot: &&Vec<[usize; 2]>| spot.iter().map(|[_, y]| *y as f32).sum::<f32>() / spot.len() as f32;
    let eye = great.max_by(|a, b| height(a).total_cmp(&height(b)))?;
    let (mut low, mut high) = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    for [x, y] in eye {
        let across = relief.distance[y * SIDE + x] * Relief::angle(*x as f32).sin() / relief.height;
        let at = Vec2::new(across, 1.0 - (*y as f32 + 0.5) / SIDE as f32);
        (low, high) = (low.min(at), high.max(at));
    }
    // Less would be a freckle.
    let half = (high - low) * 0.5;
    (half.min_element() > 0.01).then_some(((low + high) * 0.5, half.min(Vec2::splat(0.2))))
}

/// Height and half width of the mouth by what visemes move sideways, on which lips differ from a jaw.
fn mouth(scene: &Scene, relief: &Relief, chin: f32, eye: Vec2) -> Option<(f32, f32)> {
    let (mut sum, mut weight) = (0.0, 0.0);
    let mut places = Vec::new();
    for moved in moved(scene, &["ou", "ih", "ee", "oh"]) {
        let at = relief.across_and_up(moved.place);
        let sideways = moved.way.x.abs();
        if (chin..eye.y).contains(&at.y) && at.x.abs() < 1.2 * eye.x && sideways > 1e-5 {
            sum += at.y * sideways;
            weight += sideways;
            places.push((at.x.abs(), sideways));
        }
    }
    if weight.is_nan() || weight <= 0.0 {
        return None;
    }
    let most = places.iter().fold(0.0f32, |most, (_, w)| most.max(*w));
    let half = places.iter().filter(|(_, w)| *w > 0.5 * most).fold(0.0f32, |half, (x, _)| half.max(*x));
    Some((sum / weight, half.clamp(0.2 * eye.x, 1.1 * eye.x)))
}

/// A vertex of a face that an expression moves, in the world at rest.
struct Moved {
    place: Vec3,
    way: Vec3,
}

fn moved(scene: &Scene, names: &[&str]) -> Vec<Moved> {
    let world = scene.rest_world_from_nodes();
    let expressions = scene.character.iter().flat_map(|c| &c.expressions);
    let binds = expressions.filter(|e| names.contains(&e.name.as_str())).flat_map(|e| &e.morphs);
    let mut found = Vec::new();
    for bind in binds {
        let Some(mesh) = scene.nodes.get(bind.node).and_then(|n| scene.meshes.get(n.mesh?)) else { continue };
        let matrix = scene.rest_placement(&world, bind.node);
        for part in mesh.primitives.iter().filter(|p| p.role == Role::Face) {
            let Some(target) = part.morphs.get(bind.target) else { continue };
            for (vertex, way) in target.vertices.iter().zip(&target.positions) {
                if let Some(position) = part.positions.get(*vertex as usize) {
                    found.push(Moved {
                        place: matrix.transform_point3(Vec3::from(*position)),
                        way: matrix.transform_vector3(Vec3::from(*way)) * bind.weight,
                    });
                }
            }
        }
    }
    found
}

/// How much darker than most of it the darkest twentieth of a box of the relief is painted, share of what is most.
fn contrast(relief: &Relief, low: Vec2, high: Vec2) -> f32 {
    let [left, bottom] = Relief::cell(place(relief, low.x, low.y));
    let [right, top] = Relief::cell(place(relief, high.x, high.y));
    let mut values: Vec<f32> = (top..=bottom)
        .flat_map(|y| (left..=right).map(move |x| (x, y)))
        .map(|(x, y)| relief.painted[y * SIDE + x])
        .collect();
    values.sort_by(f32::total_cmp);
    let at = |share: f32| values.get(((values.len().max(1) - 1) as f32 * share) as usize).copied().unwrap_or(1.0);
    (at(0.5) - at(0.02)) / at(0.5).max(1e-3)
}
