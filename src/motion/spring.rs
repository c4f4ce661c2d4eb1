//! Swinging chains (`VRMC_springBone` 1.0 and the secondary animation of VRM 0.x): fixed steps of 1/60 s, whatever the display's
//! rate, in plain arithmetic and one order: the same bits everywhere.
//!
//! Steps are taken in the axes of the world, from the place of the character, in its own size: a small character swings as a
//! large one does, and far from the origin nothing is lost to rounding.

use std::ops::Range;

use glam::{Quat, Vec3};

use super::collide::distance;
use super::places::{Place, place_some};
use super::rotation::{between, direction, dot, inverse, length, mix, mul, slerp, turn};
use super::skeleton::Skeleton;
use crate::scene::{Character, Collider, Transform};

/// Length of a step, seconds: what authors of springs tune at.
pub const SPRING_STEP_S: f32 = 1.0 / 60.0;

/// Parts of a second that time is counted in: a step is a whole number of them.
const TICKS: i64 = 60_000_000;
const TICKS_A_STEP: i64 = TICKS / 60;
/// Steps a frame at most; a display slower than that sees slow motion.
const MOST_STEPS: i64 = 4;
/// Bones shorter than this do not swing, metres.
const SHORTEST_M: f32 = 1e-6;

/// The chains of a character.
#[derive(Clone, Debug, Default)]
pub(crate) struct SpringRig {
    /// Pairs of a joint and the next, those above before those below.
    joints: Vec<Joint>,
    colliders: Vec<Collider>,
    /// Colliders of chains, in their order.
    of_chains: Vec<u32>,
    /// Nodes whose place moves with each joint, and with no joint below it.
    below: Vec<u32>,
    /// Nodes whose place counts, parents first.
    involved: Vec<u32>,
}

#[derive(Clone, Debug)]
struct Joint {
    node: usize,
    /// Its rotation at rest.
    rest: Quat,
    /// From it to the next joint, in its own space, and how far that is.
    axis: Vec3,
    length: f32,
    hit_radius: f32,
    stiffness: f32,
    gravity: Vec3,
    drag: f32,
    center: Option<usize>,
    /// In `of_chains`.
    colliders: Range<usize>,
    /// In `below`.
    below: Range<usize>,
}

/// The swinging of one character. Its state is this value: a clone saves it.
#[derive(Clone, Debug, PartialEq)]
pub struct Springs {
    /// Whether chains swing. Default: true.
    pub on: bool,
    /// Wind on all chains. Default: none.
    pub wind: Option<Wind>,
    tails: Vec<Tail>,
    /// Where the character stood at the last step; tails of chains without a center are relative to it.
    origin: Vec3,
    /// Place of the character, and locals of the involved nodes, at the last frame.
    last_root: Place,
    last: Vec<Transform>,
    /// Ticks since the last step.
    pending: i64,
    /// Steps so far.
    steps: u64,
    scratch: Scratch,
}

/// Wind: pushes joints as gravity does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    /// Direction times strength, world space; strength as that of gravity in files: 0.1 stirs, 1 carries hair away. Default: 0.
    pub force: Vec3,
    /// Share of the strength that comes and goes. Range 0..1. Default: 0.6.
    pub gusts: f32,
}

impl Default for Wind {
    fn default() -> Self {
        Self { force: Vec3::ZERO, gusts: 0.6 }
    }
}

/// State of a pair of joints.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Tail {
    /// Where the end was before the last step, and is: from the origin in the axes of the world, or in the space of the center.
    previous: Vec3,
    current: Vec3,
    /// Rotation of the joint before the last step, and now.
    before: Quat,
    now: Quat,
}

/// Lists that are filled anew; they are not part of the state.
#[derive(Clone, Debug, Default)]
struct Scratch {
    locals: Vec<Transform>,
    places: Vec<Place>,
    root: Quat,
}

impl PartialEq for Scratch {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Default for Springs {
    fn default() -> Self {
        Self {
            on: true,
            wind: None,
            tails: Vec::new(),
            origin: Vec3::ZERO,
            last_root: Place::ORIGIN,
            last: Vec::new(),
            pending: 0,
            steps: 0,
            scratch: Scratch::default(),
        }
    }
}

impl SpringRig {
    pub fn of(character: &Character, parents: &[Option<usize>], locals: &[Transform], rest: &[Place]) -> Self {
        let mut rig = Self { colliders: character.colliders.clone(), ..Self::default() };
        rig.colliders.iter_mut().for_each(|c| c.node = c.node.min(parents.len().saturating_sub(1)));
        let count = rig.colliders.len();
        for spring in &character.springs {
            let first = rig.of_chains.len();
            rig.of_chains.extend(spring.colliders.iter().filter(|c| **c < count).map(|c| *c as u32));
            let colliders = first..rig.of_chains.len();
            for pair in spring.joints.windows(2) {
                let [joint, next] = pair else { continue };
                if joint.node >= parents.len() || next.node >= parents.len() {
                    continue;
                }
                let to_next = rest[joint.node].inverse_point(rest[next.node].position);
                let size = rest[joint.node].scale.x;
                rig.joints.push(Joint {
                    node: joint.node,
                    rest: locals[joint.node].rotation,
                    axis: direction(to_next).unwrap_or(Vec3::Y),
                    length: length(to_next) * size,
                    hit_radius: joint.hit_radius,
                    stiffness: joint.stiffness,
                    gravity: joint.gravity_dir * joint.gravity_power,
                    drag: joint.drag,
                    center: spring.center.filter(|c| *c < parents.len()),
                    colliders: colliders.clone(),
                    below: 0..0,
                });
            }
        }
        // Parents stand before their children, so the order of nodes is one from roots to tips.
        rig.joints.sort_by_key(|joint| joint.node);
        rig.joints.dedup_by_key(|joint| joint.node);
        rig.involve(parents);
        rig
    }

    /// Finds the nodes whose places count, and which joint moves each.
    fn involve(&mut self, parents: &[Option<usize>]) {
        let mut counts = vec![false; parents.len()];
        let chosen = self.joints.iter().flat_map(|j| j.center.into_iter().chain([j.node]));
        let hit = self.of_chains.iter().map(|c| self.colliders[*c as usize].node);
        for node in chosen.chain(hit) {
            let mut at = Some(node);
            while let Some(node) = at.filter(|n| !counts[*n]) {
                counts[node] = true;
                at = parents[node];
            }
        }
        self.involved = (0..parents.len() as u32).filter(|n| counts[*n as usize]).collect();
        let mut of_node = vec![None; parents.len()];
        for (i, joint) in self.joints.iter().enumerate() {
            of_node[joint.node] = Some(i);
        }
        // The joint that moves each involved node: the nearest above it.
        let mut mover: Vec<Option<usize>> = vec![None; parents.len()];
        let mut moved: Vec<(usize, u32)> = Vec::new();
        for &node in &self.involved {
            let above = parents[node as usize];
            let by = above.and_then(|p| of_node[p].or(mover[p]));
            mover[node as usize] = by;
            if let (Some(by), None) = (by, of_node[node as usize]) {
                moved.push((by, node));
            }
        }
        moved.sort_unstable();
        for (by, node) in moved {
            let below = &mut self.joints[by].below;
            if below.start == below.end {
                *below = self.below.len()..self.below.len();
            }
            below.end += 1;
            self.below.push(node);
        }
    }

    /// Whether nothing swings.
    pub fn is_empty(&self) -> bool {
        self.joints.is_empty()
    }
}

impl Springs {
    /// Swings for `dt` seconds: as many fixed steps as are due, with pose and place in between, and turns the joints of `locals`
    /// to what lies between the last two steps. The first call sets everything to rest; so does one after
    /// [`Springs::reset`]. Time that stands still, or runs back, moves nothing.
    pub(crate) fn advance(&mut self, skeleton: &Skeleton, locals: &mut [Transform], root: &Place, dt: f32) {
        let rig = &skeleton.springs;
        if rig.is_empty() || !self.on {
            self.tails.clear();
            return;
        }
        if self.tails.len() != rig.joints.len() {
            self.rest(skeleton, locals, root);
        }
        let ticks = ticks_of(dt);
        let from = self.pending;
        self.pending += ticks;
        let due = self.pending / TICKS_A_STEP;
        self.pending -= due * TICKS_A_STEP;
        let dropped = (due - MOST_STEPS).max(0);
        if dropped > 0 {
            // What there is no time for carries hair along instead of leaving it behind.
            let share = (dropped * TICKS_A_STEP - from) as f32 / ticks as f32;
            self.origin = mix(self.last_root.position, root.position, share);
        }
        for step in dropped + 1..=due {
            // Where the step lies between the last frame and this one.
            let share = (step * TICKS_A_STEP - from) as f32 / ticks as f32;
            self.place(rig, skeleton, locals, root, share);
            self.step_once(skeleton, SPRING_STEP_S);
        }
        self.remember(rig, locals, root);
        let share = self.pending as f32 / TICKS_A_STEP as f32;
        for (joint, tail) in rig.joints.iter().zip(&self.tails) {
            locals[joint.node].rotation = slerp(tail.before, tail.now, share);
        }
    }

    /// Sets all joints to rest under the pose, without speed, as the next call would after a jump.
    pub fn reset(&mut self) {
        self.tails.clear();
        self.pending = 0;
    }

    /// Takes the joints along where the character has jumped from one place to another.
    pub(crate) fn warp(&mut self, skeleton: &Skeleton, from: &Place, to: &Place) {
        let size = from.scale.x;
        let turned = mul(to.rotation, inverse(from.rotation));
        let gap = (self.origin - from.position) / size;
        for (joint, tail) in skeleton.springs.joints.iter().zip(&mut self.tails) {
            if joint.center.is_none() {
                tail.previous = turn(turned, tail.previous + gap);
                tail.current = turn(turned, tail.current + gap);
            }
        }
        self.origin = to.position;
        self.last_root = *to;
    }

    /// One step of any length under a pose, without interpolation, as reference trajectories are made. Turns the joints to
    /// their state after it.
    pub(crate) fn step(&mut self, skeleton: &Skeleton, locals: &mut [Transform], root: &Place, dt: f32) {
        let rig = &skeleton.springs;
        if self.tails.len() != rig.joints.len() {
            self.rest(skeleton, locals, root);
        } else if dt > 0.0 {
            self.place(rig, skeleton, locals, root, 1.0);
            self.step_once(skeleton, dt);
        }
        self.remember(rig, locals, root);
        for (joint, tail) in rig.joints.iter().zip(&self.tails) {
            locals[joint.node].rotation = tail.now;
        }
    }

    fn remember(&mut self, rig: &SpringRig, locals: &[Transform], root: &Place) {
        self.last_root = *root;
        self.last.clear();
        self.last.extend(rig.involved.iter().map(|n| locals[*n as usize]));
    }

    /// Joints at rest, tails where that puts them.
    fn rest(&mut self, skeleton: &Skeleton, locals: &[Transform], root: &Place) {
        let rig = &skeleton.springs;
        let still =
            |joint: &Joint| Tail { previous: Vec3::ZERO, current: Vec3::ZERO, before: joint.rest, now: joint.rest };
        self.tails.clear();
        self.tails.extend(rig.joints.iter().map(still));
        self.origin = root.position;
        self.pending = 0;
        self.place(rig, skeleton, locals, root, 1.0);
        for (joint, tail) in rig.joints.iter().zip(&mut self.tails) {
            let place = self.scratch.places[joint.node];
            let end = along(place.position, turn(place.rotation, joint.axis), joint.length);
            let end = joint.center.map_or(end, |c| self.scratch.places[c].inverse_point(end));
            (tail.previous, tail.current) = (end, end);
        }
        self.remember(rig, locals, root);
    }

    /// Places the involved nodes as they were at a share of the way from the last frame to this one.
    fn place(&mut self, rig: &SpringRig, skeleton: &Skeleton, locals: &[Transform], root: &Place, share: f32) {
        let Self { scratch: Scratch { locals: between, places, root: turned }, last, last_root, tails, origin, .. } =
            self;
        between.resize(locals.len(), Transform::default());
        places.resize(locals.len(), Place::ORIGIN);
        let (position, rotation) = if share < 1.0 {
            (mix(last_root.position, root.position, share), slerp(last_root.rotation, root.rotation, share))
        } else {
            (root.position, root.rotation)
        };
        for (i, &node) in rig.involved.iter().enumerate() {
            let to = locals[node as usize];
            between[node as usize] = match last.get(i).filter(|_| share < 1.0) {
                Some(from) => Transform {
                    translation: mix(from.translation, to.translation, share),
                    rotation: slerp(from.rotation, to.rotation, share),
                    scale: mix(from.scale, to.scale, share),
                },
                None => to,
            };
        }
        for (joint, tail) in rig.joints.iter().zip(&*tails) {
            between[joint.node].rotation = tail.now;
        }
        // What stays in the world falls behind where the character goes.
        let moved = (position - *origin) / root.scale.x;
        for (joint, tail) in rig.joints.iter().zip(&mut *tails) {
            if joint.center.is_none() {
                tail.previous -= moved;
                tail.current -= moved;
            }
        }
        *origin = position;
        place_some(&rig.involved, &skeleton.parents, between, &Place { rotation, ..Place::ORIGIN }, places);
        *turned = rotation;
    }

    /// A step of all joints, under places that are set.
    fn step_once(&mut self, skeleton: &Skeleton, dt: f32) {
        let rig = &skeleton.springs;
        let wind = self.wind;
        let time_s = self.steps as f64 * f64::from(SPRING_STEP_S);
        self.steps += 1;
        let root = Place { rotation: self.scratch.root, ..Place::ORIGIN };
        let Self { scratch: Scratch { locals, places, .. }, tails, .. } = self;
        for (joint, tail) in rig.joints.iter().zip(tails) {
            let above = skeleton.parents[joint.node].map_or(root, |p| places[p]);
            let head = above.point(locals[joint.node].translation);
            tail.before = tail.now;
            if joint.length > SHORTEST_M {
                let blown = wind.map_or(Vec3::ZERO, |wind| wind.at(time_s, head));
                let center = joint.center.map(|c| places[c]);
                let end = swung(joint, tail, &above, head, center.as_ref(), blown, dt);
                let end = pushed(rig, joint, places, head, end);
                let stored = center.map_or(end, |c| c.inverse_point(end));
                (tail.previous, tail.current) = (tail.current, stored);
                let to_end = Vec3::new(end.x - head.x, end.y - head.y, end.z - head.z);
                let local = turn(inverse(joint.rest), turn(inverse(above.rotation), to_end));
                if let Some(local) = direction(local) {
                    tail.now = mul(joint.rest, between(joint.axis, local));
                }
            }
            locals[joint.node].rotation = tail.now;
            places[joint.node] = above.below(&locals[joint.node]);
            place_some(&rig.below[joint.below.clone()], &skeleton.parents, locals, &root, places);
        }
    }
}

/// Where the end of a bone goes by inertia, stiffness, gravity and wind, at its length from the joint.
fn swung(joint: &Joint, tail: &Tail, above: &Place, head: Vec3, center: Option<&Place>, wind: Vec3, dt: f32) -> Vec3 {
    let Tail { previous, current, .. } = *tail;
    let keep = 1.0 - joint.drag;
    let coast = Vec3::new(
        (current.x - previous.x) * keep + current.x,
        (current.y - previous.y) * keep + current.y,
        (current.z - previous.z) * keep + current.z,
    );
    let coast = center.map_or(coast, |c| c.point(coast));
    let bone = turn(above.rotation, turn(joint.rest, joint.axis));
    let force = |bone: f32, gravity: f32, wind: f32| dt * (joint.stiffness * bone + gravity + wind);
    let end = Vec3::new(
        coast.x + force(bone.x, joint.gravity.x, wind.x),
        coast.y + force(bone.y, joint.gravity.y, wind.y),
        coast.z + force(bone.z, joint.gravity.z, wind.z),
    );
    at_length(joint, head, end, bone)
}

/// The same direction from the joint at the bone's length; where there is none, that of rest.
fn at_length(joint: &Joint, head: Vec3, end: Vec3, rest: Vec3) -> Vec3 {
    let to_end = Vec3::new(end.x - head.x, end.y - head.y, end.z - head.z);
    along(head, direction(to_end).unwrap_or(rest), joint.length)
}

fn along(from: Vec3, direction: Vec3, length: f32) -> Vec3 {
    Vec3::new(from.x + direction.x * length, from.y + direction.y * length, from.z + direction.z * length)
}

/// Out of all colliders of its chain, one after the other.
fn pushed(rig: &SpringRig, joint: &Joint, places: &[Place], head: Vec3, mut end: Vec3) -> Vec3 {
    for &collider in &rig.of_chains[joint.colliders.clone()] {
        let collider = &rig.colliders[collider as usize];
        let Some((out, distance)) = distance(&collider.shape, &places[collider.node], end, joint.hit_radius) else {
            continue;
        };
        if distance < 0.0 {
            end = at_length(joint, head, along(end, out, -distance), out);
        }
    }
    end
}

impl Wind {
    /// Its force at a moment and a place: gusts travel with it.
    fn at(&self, time_s: f64, place: Vec3) -> Vec3 {
        let along = direction(self.force).map_or(0.0, |d| dot(d, place));
        let wave = |rate: f64, shift: f32| libm::sinf((time_s * rate % std::f64::consts::TAU) as f32 - along * shift);
        let gust = 0.5 * wave(1.9, 2.0) + 0.3 * wave(4.7, 5.0) + 0.2 * wave(11.3, 9.0);
        let strength = 1.0 + self.gusts * gust;
        Vec3::new(self.force.x * strength, self.force.y * strength, self.force.z * strength)
    }
}

/// Ticks of a time; 0 for none, and for times that run back.
fn ticks_of(dt: f32) -> i64 {
    // An hour a frame is as good as for ever.
    (f64::from(dt.clamp(0.0, 3600.0)) * TICKS as f64).round() as i64
}
