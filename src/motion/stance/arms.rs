//! Arms beside a body of any width: they are lifted until nothing of them is in it.

use glam::Vec3;

use super::rig::Rig;
use crate::motion::Pose;
use crate::motion::places::Place;
use crate::motion::rotation::{about, mul};
use crate::scene::{HumanBone, Scene, Skin};

/// Cells of a [`Girth`] along each axis.
const CELLS: usize = 64;
/// Steps in which an arm is lifted, degrees, and the most of them.
const STEP_DEG: f32 = 1.5;
const STEPS: usize = 28;
/// Share of vertices of an arm within its thickness; the rest are cuffs and folds.
const COUNTED: f32 = 0.5;

/// Lifts both arms of a pose off the body.
pub(super) fn clear(rig: &Rig<'_>, pose: &mut Pose) {
    use HumanBone::{
        LeftHand, LeftLowerArm, LeftMiddleDistal, LeftUpperArm, RightHand, RightLowerArm, RightMiddleDistal,
        RightUpperArm,
    };
    let sides = [
        (1.0, [LeftUpperArm, LeftLowerArm, LeftHand], LeftMiddleDistal),
        (-1.0, [RightUpperArm, RightLowerArm, RightHand], RightMiddleDistal),
    ];
    let girth = Girth::of(rig, &rig.places(pose));
    for (side, bones, tip) in sides {
        let [Some(upper), Some(lower), Some(hand)] = bones.map(|bone| rig.node(bone)) else { continue };
        let lengths = [[upper, lower], [lower, hand]].map(|[a, b]| rig.rest[a].position.distance(rig.rest[b].position));
        let thick = [thickness(rig, lower, hand), thickness(rig, hand, hand).min(lengths[1] * 0.4)];
        for _ in 0..STEPS {
            let places = rig.places(pose);
            let [elbow, wrist] = [lower, hand].map(|node| places[node].position);
            // Without fingers a hand is as long as a third of the forearm.
            let end = rig.node(tip).map_or(wrist + (wrist - elbow) * 0.33, |node| places[node].position);
            let points = [
                (elbow, thick[0]),
                (elbow.lerp(wrist, 0.5), thick[0]),
                (elbow.lerp(wrist, 0.85), thick[0]),
                (wrist.lerp(end, 0.3), thick[1]),
                (end, thick[1] * 0.6),
            ];
            if points.iter().all(|(point, thick)| girth.is_clear(*point, *thick, side)) {
                break;
            }
            let lifted = mul(about(Vec3::Z, side * STEP_DEG.to_radians()), places[upper].rotation);
            rig.set_rotation(pose, upper, lifted);
        }
    }
}

/// How far a body reaches to its left and right, by height and depth.
struct Girth {
    low: Vec3,
    cell: f32,
    /// Of each cell: to the left, to the right.
    reach: Vec<[f32; 2]>,
}

impl Girth {
    fn of(rig: &Rig<'_>, places: &[Place]) -> Self {
        let is_body = body(rig);
        let height = places.iter().fold(0f32, |high, place| high.max(place.position.y)).max(1e-3);
        let cell = height / CELLS as f32;
        let middle = rig.node(HumanBone::Hips).map_or(Vec3::ZERO, |node| places[node].position);
        let low = Vec3::new(middle.x, 0.0, middle.z - cell * CELLS as f32 * 0.5);
        let mut girth = Self { low, cell, reach: vec![[0.0; 2]; CELLS * CELLS] };
        for (node, primitive, skin) in parts(rig.scene) {
            let posed: Vec<Option<Vec3>> = (0..primitive.positions.len())
                .map(|v| {
                    let (owner, at_rest) = vertex(rig, node, skin, primitive, v);
                    is_body[owner].then(|| places[owner].point(rig.rest[owner].inverse_point(at_rest)))
                })
                .collect();
            for triangle in primitive.indices.chunks_exact(3) {
                let [Some(a), Some(b), Some(c)] = [0, 1, 2].map(|i| posed.get(triangle[i] as usize).copied().flatten())
                else {
                    continue;
                };
                let steps = [a.distance(b), b.distance(c), c.distance(a)].into_iter().fold(0.0, f32::max) / cell;
                let steps = (steps.ceil() as usize).clamp(1, CELLS);
                for i in 0..=steps {
                    for j in 0..=steps - i {
                        let (u, v) = (i as f32 / steps as f32, j as f32 / steps as f32);
                        girth.put(a + (b - a) * u + (c - a) * v);
                    }
                }
            }
        }
        girth
    }

    fn at(&self, point: Vec3) -> [i32; 2] {
        let cell = (point - self.low) / self.cell;
        [cell.y.floor() as i32, cell.z.floor() as i32]
    }

    fn index([y, z]: [i32; 2]) -> Option<usize> {
        let inside = |i: i32| usize::try_from(i).ok().filter(|i| *i < CELLS);
        Some(inside(y)? * CELLS + inside(z)?)
    }

    fn put(&mut self, point: Vec3) {
        if let Some(reach) = Self::index(self.at(point)).and_then(|i| self.reach.get_mut(i)) {
            let aside = point.x - self.low.x;
            *reach = [reach[0].max(aside), reach[1].max(-aside)];
        }
    }

    /// Whether a ball at a point is beside the body.
    fn is_clear(&self, point: Vec3, radius: f32, side: f32) -> bool {
        let [low, high] = [-radius, radius].map(|r| self.at(point + Vec3::new(0.0, r, r)));
        let aside = (point.x - self.low.x) * side - radius - self.cell * 0.25;
        let which = usize::from(side < 0.0);
        let cells = (low[0]..=high[0]).flat_map(|y| (low[1]..=high[1]).map(move |z| [y, z]));
        cells.filter_map(Self::index).all(|i| self.reach[i][which] <= aside)
    }
}

type Part<'a> = (usize, &'a crate::scene::Primitive, Option<&'a Skin>);

fn parts(scene: &Scene) -> impl Iterator<Item = Part<'_>> {
    scene.mesh_nodes().flat_map(move |(node, mesh)| {
        let skin = scene.nodes[node].skin.and_then(|s| scene.skins.get(s));
        mesh.primitives.iter().map(move |primitive| (node, primitive, skin))
    })
}

/// The node that a vertex follows most, and where it is at rest.
fn vertex(rig: &Rig<'_>, node: usize, skin: Option<&Skin>, of: &crate::scene::Primitive, v: usize) -> (usize, Vec3) {
    let position = Vec3::from(of.positions[v]);
    let per_vertex = of.influences.per_vertex;
    let Some(skin) = skin.filter(|_| per_vertex > 0) else { return (node, rig.rest[node].point(position)) };
    let joint = of.influences.joints.get(v * per_vertex).map_or(0, |j| usize::from(*j));
    let owner = skin.joints.get(joint).copied().filter(|n| *n < rig.rest.len()).unwrap_or(node);
    let local = skin.joint_from_mesh.get(joint).copied().unwrap_or_default().transform_point3(position);
    (owner, rig.rest[owner].point(local))
}

/// Which nodes carry what arms must keep clear of: trunk and legs, and what hangs from hips and legs.
fn body(rig: &Rig<'_>) -> Vec<bool> {
    use HumanBone::{Chest, Hips, LeftLowerLeg, LeftUpperLeg, RightLowerLeg, RightUpperLeg, Spine, UpperChest};
    let mut nearest: Vec<Option<HumanBone>> = vec![None; rig.rest.len()];
    for (bone, node) in &rig.bones {
        nearest[*node] = Some(*bone);
    }
    (0..rig.rest.len())
        .map(|node| {
            let own = nearest[node];
            let above = rig.scene.nodes[node].parent.and_then(|p| nearest[p]);
            nearest[node] = own.or(above);
            match nearest[node] {
                Some(Hips | Spine | LeftUpperLeg | RightUpperLeg | LeftLowerLeg | RightLowerLeg) => true,
                Some(Chest | UpperChest) => own.is_some(),
                _ => false,
            }
        })
        .collect()
}

/// Radius of what a bone carries round its way to the next.
fn thickness(rig: &Rig<'_>, bone: usize, next: usize) -> f32 {
    let from = rig.rest[bone].position;
    let along = (rig.rest[next].position - from).normalize_or(Vec3::X * (from.x.signum()));
    let mut away: Vec<f32> = Vec::new();
    for (node, primitive, skin) in parts(rig.scene) {
        // What is held does not count.
        for v in (0..primitive.positions.len()).filter(|_| skin.is_some()) {
            let (owner, at) = vertex(rig, node, skin, primitive, v);
            if owner == bone {
                away.push((at - from).reject_from(along).length());
            }
        }
    }
    away.sort_by(f32::total_cmp);
    away.get((away.len() as f32 * COUNTED) as usize).copied().unwrap_or(0.0)
}
