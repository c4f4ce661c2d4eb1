//! Clips of one humanoid on another: rotations are taken from rest to rest in the axes of the character, so that skeletons whose
//! bones lie otherwise move alike (the way of VRMA's `how_to_transform_human_pose`).
//!
//! Every map is linear in the quaternion, so that keys are mapped once, here, and sampled as they are.

use std::collections::BTreeMap;

use glam::{Quat, Vec3};

use super::bone_names::bones_of;
use super::clip::{Clip, RotationChannel, VectorChannel, rotations, vectors};
use super::places::{Place, place_all};
use super::rotation::{between, direction, inverse, mul};
use super::track::Track;
use crate::scene::{Animation, AnimationChannel, AnimationValues, HumanBone, Interpolation, Scene, Transform};
use crate::{Error, Result};

/// Rate at which movements are baked that no key map reproduces, keys a second.
const BAKED_HZ: f32 = 60.0;
/// Height of the hips below which a rest pose says nothing about size, metres.
const LOWEST_HIPS_M: f32 = 1e-3;
/// Most keys of a baked track.
const MOST_BAKED: usize = 100_000;

/// A skeleton at rest.
struct Rest<'a> {
    scene: &'a Scene,
    bones: BTreeMap<HumanBone, usize>,
    /// Facing +Z, whatever the file does.
    places: Vec<Place>,
    /// Which bone a node is.
    bone_of: BTreeMap<usize, HumanBone>,
}

impl<'a> Rest<'a> {
    fn of(scene: &'a Scene) -> Self {
        let bones = bones_of(scene);
        let root = Place { rotation: facing(scene, &bones), ..Place::ORIGIN };
        let bone_of = bones.iter().map(|(bone, node)| (*node, *bone)).collect();
        Self { places: places_of(scene, &locals_of(scene), &root), scene, bones, bone_of }
    }

    fn above(&self, node: usize) -> Option<usize> {
        self.scene.nodes.get(node)?.parent
    }

    /// Rotation of what is above a node.
    fn rotation_above(&self, node: usize) -> Quat {
        match self.above(node) {
            Some(parent) => self.places[parent].rotation,
            None => mul(self.places[node].rotation, inverse(self.scene.nodes[node].transform.rotation)),
        }
    }

    fn place_above(&self, node: usize) -> Place {
        let root = || Place { rotation: self.rotation_above(node), ..Place::ORIGIN };
        self.above(node).map_or_else(root, |parent| self.places[parent])
    }

    fn rotation(&self, node: usize) -> Quat {
        self.places[node].rotation
    }
}

fn locals_of(scene: &Scene) -> Vec<Transform> {
    scene.nodes.iter().map(|n| n.transform).collect()
}

fn places_of(scene: &Scene, locals: &[Transform], root: &Place) -> Vec<Place> {
    let parents: Vec<Option<usize>> = scene.nodes.iter().map(|n| n.parent).collect();
    let mut places = Vec::with_capacity(locals.len());
    place_all(&parents, locals, root, &mut places);
    places
}

/// What turns a skeleton to +Z: its left leg tells its left. Files that say which bones they have face it by their own rules.
pub(crate) fn facing(scene: &Scene, bones: &BTreeMap<HumanBone, usize>) -> Quat {
    let known = scene.animation_rig.is_some() || scene.character.as_ref().is_some_and(|c| !c.bones.is_empty());
    let leg = |bone| bones.get(&bone).copied();
    let (Some(left), Some(right), false) = (leg(HumanBone::LeftUpperLeg), leg(HumanBone::RightUpperLeg), known) else {
        return Quat::IDENTITY;
    };
    let places = places_of(scene, &locals_of(scene), &Place::ORIGIN);
    let side = places[left].position - places[right].position;
    // To the nearest quarter: hips that are askew stay so.
    let quarter = std::f32::consts::FRAC_PI_2;
    let yaw = libm::roundf(libm::atan2f(side.z, side.x) / quarter) * quarter;
    super::rotation::about(Vec3::Y, yaw)
}

/// Node of the hips.
pub(crate) fn hips_of(scene: &Scene) -> Option<usize> {
    bones_of(scene).get(&HumanBone::Hips).copied()
}

/// Rotation and scale of what is above a node at rest.
pub(crate) fn rest_above(scene: &Scene, node: usize) -> (Quat, f32) {
    let places = places_of(scene, &locals_of(scene), &Place::ORIGIN);
    scene.nodes[node].parent.map_or((Quat::IDENTITY, 1.0), |p| (places[p].rotation, places[p].scale.x))
}

/// An animation of one scene as a clip for another.
pub(crate) fn fit(source: &Scene, animation: &Animation, target: &Scene) -> Result<Clip> {
    let (from, to) = (Rest::of(source), Rest::of(target));
    let mut clip = Clip::default();
    if from.bones.is_empty() || to.bones.is_empty() {
        by_names(source, animation, target, &mut clip);
    } else {
        let fit = Fit { lean: lean(&from, &to), from, to, animation };
        fit.rotations(&mut clip);
        fit.hips(&mut clip);
        fit.expressions(&mut clip);
    }
    let is_empty = clip.rotations.is_empty()
        && clip.translations.is_empty()
        && clip.scales.is_empty()
        && clip.morphs.is_empty()
        && clip.expressions.is_empty()
        && clip.gaze.is_none();
    if is_empty {
        let message = "nothing of it fits the model: neither humanoid bones of both, nor nodes of the same names";
        return Err(Error::Argument {
            what: format!("animation {:?} of {}", animation.name, source.source.file),
            message: message.to_owned(),
        });
    }
    Ok(clip)
}

/// Channels on the nodes of the same names.
fn by_names(source: &Scene, animation: &Animation, target: &Scene, clip: &mut Clip) {
    let mut nodes: BTreeMap<&str, usize> = BTreeMap::new();
    for (i, node) in target.nodes.iter().enumerate().filter(|(_, n)| !n.name.is_empty()) {
        nodes.entry(&node.name).or_insert(i);
    }
    let mut lacking = Vec::new();
    for channel in &animation.channels {
        let name = source.nodes[channel.node].name.as_str();
        match nodes.get(name) {
            Some(node) if fits(channel, target, *node) => clip.add(channel, *node),
            _ => lacking.push(name.to_owned()),
        }
    }
    warn(clip, "nodes", lacking);
}

/// Whether a channel of weights has as many as the node has morphs.
fn fits(channel: &AnimationChannel, target: &Scene, node: usize) -> bool {
    let AnimationValues::MorphWeights(values) = &channel.values else { return true };
    let per_key = if channel.interpolation == Interpolation::CubicSpline {
        3
    } else {
        1
    };
    values.len() == channel.times.len() * per_key * target.nodes[node].morph_weights.len()
}

fn warn(clip: &mut Clip, what: &str, mut lacking: Vec<String>) {
    lacking.sort();
    lacking.dedup();
    if !lacking.is_empty() {
        clip.warnings.push(format!("the model lacks {what} that the clip moves: {}", lacking.join(", ")));
    }
}

/// What takes the limbs of the target at rest to where those of the source rest, by bone: sources that do not say so may rest with
/// their arms down.
fn lean(from: &Rest, to: &Rest) -> BTreeMap<HumanBone, Quat> {
    use HumanBone::*;
    const LIMBS: [(HumanBone, HumanBone, &[HumanBone]); 8] = [
        (LeftUpperArm, LeftLowerArm, &[]),
        (LeftLowerArm, LeftHand, &[LeftHand]),
        (RightUpperArm, RightLowerArm, &[]),
        (RightLowerArm, RightHand, &[RightHand]),
        (LeftUpperLeg, LeftLowerLeg, &[]),
        (LeftLowerLeg, LeftFoot, &[]),
        (RightUpperLeg, RightLowerLeg, &[]),
        (RightLowerLeg, RightFoot, &[]),
    ];
    let mut lean = BTreeMap::new();
    // VRM and VRMA rest in a T-pose, by their specifications.
    if from.scene.animation_rig.is_some() || from.scene.character.is_some() {
        return lean;
    }
    let along = |rest: &Rest, bone, next| {
        let at = |bone| Some(rest.places[*rest.bones.get(&bone)?].position);
        direction(at(next)? - at(bone)?)
    };
    for (bone, next, follow) in LIMBS {
        if let (Some(theirs), Some(ours)) = (along(from, bone, next), along(to, bone, next)) {
            let turn = between(ours, theirs);
            lean.insert(bone, turn);
            lean.extend(follow.iter().map(|b| (*b, turn)));
        }
    }
    // Fingers rest as their hands do.
    for (side, hand) in [("left", LeftHand), ("right", RightHand)] {
        if let Some(turn) = lean.get(&hand).copied() {
            let is_finger = |b: &&HumanBone| {
                let name = b.name();
                name.starts_with(side)
                    && ["Thumb", "Index", "Middle", "Ring", "Little"].iter().any(|f| name.contains(f))
            };
            lean.extend(HumanBone::ALL.iter().filter(is_finger).map(|b| (*b, turn)));
        }
    }
    lean
}

struct Fit<'a> {
    from: Rest<'a>,
    to: Rest<'a>,
    animation: &'a Animation,
    lean: BTreeMap<HumanBone, Quat>,
}

impl Fit<'_> {
    fn channel(&self, node: usize, is_of: fn(&AnimationValues) -> bool) -> Option<&AnimationChannel> {
        self.animation.channels.iter().find(|c| c.node == node && is_of(&c.values))
    }

    /// Rotations of a node of the source over time.
    fn turns(&self, node: usize) -> Option<Track<Quat>> {
        rotations(self.channel(node, |v| matches!(v, AnimationValues::Rotation(_)))?)
    }

    /// Whether helper nodes count: a VRMA moves bones alone.
    fn has_helpers(&self) -> bool {
        self.from.scene.animation_rig.is_none()
    }

    fn lean_of(&self, bone: Option<HumanBone>) -> Quat {
        bone.and_then(|b| self.lean.get(&b)).copied().unwrap_or(Quat::IDENTITY)
    }

    /// Rotations of the bones that the target has.
    fn rotations(&self, clip: &mut Clip) {
        let mut lacking: Vec<String> = Vec::new();
        let is_eye = |bone: HumanBone| matches!(bone, HumanBone::LeftEye | HumanBone::RightEye);
        for (&bone, &node) in self.from.bones.iter().filter(|(bone, _)| !is_eye(**bone)) {
            match self.to.bones.get(&bone) {
                Some(&ours) => clip.rotations.extend(self.rotation(bone, node, ours)),
                None if self.turns(node).is_some() && !self.is_taken_over(node) => {
                    lacking.push(bone.name().to_owned());
                }
                None => {}
            }
        }
        warn(clip, "bones", lacking);
    }

    /// Rotations of one bone. What moves in the source between it and the next one that the target has, bones that the target
    /// lacks or helper nodes, goes to it.
    fn rotation(&self, bone: HumanBone, node: usize, ours: usize) -> Option<RotationChannel> {
        let (nodes, above) = self.down_to(node);
        let (before, after) = (self.lean_of(above), self.lean_of(Some(bone)));
        // From rest to rest in the axes of the character.
        let neutral = |node: &usize| {
            let (above, rest) = (self.from.rotation_above(*node), inverse(self.from.rotation(*node)));
            let map = |q: Quat| mul(above, mul(q, rest));
            Some(self.turns(*node)?.map(map, map))
        };
        let mut tracks: Vec<Track<Quat>> = nodes.iter().filter_map(neutral).collect();
        if tracks.is_empty() {
            if before == after {
                return None;
            }
            tracks.push(Track::constant(Quat::IDENTITY));
        }
        let outer = mul(inverse(self.to.rotation_above(ours)), inverse(before));
        let inner = mul(after, self.to.rotation(ours));
        if let Some(first) = tracks.first_mut() {
            *first = first.map(|q| mul(outer, q), |q| mul(outer, q));
        }
        if let Some(last) = tracks.last_mut() {
            *last = last.map(|q| mul(q, inner), |q| mul(q, inner));
        }
        Some(RotationChannel::new(ours, tracks))
    }

    /// Nodes of the source from below the next bone that the target has down to a node; and that bone.
    fn down_to(&self, node: usize) -> (Vec<usize>, Option<HumanBone>) {
        let mut nodes = vec![node];
        let mut above = self.from.above(node);
        let mut bone_above = None;
        while let Some(at) = above {
            let bone = self.from.bone_of.get(&at).copied();
            if bone.is_some_and(|b| self.to.bones.contains_key(&b)) {
                bone_above = bone;
                break;
            }
            if bone.is_some() || self.has_helpers() {
                nodes.push(at);
            }
            above = self.from.above(at);
        }
        nodes.reverse();
        (nodes, bone_above)
    }

    /// Whether a bone below a node of the source, which the target has, takes its rotation over.
    fn is_taken_over(&self, node: usize) -> bool {
        let below = self.to.bones.keys().filter_map(|bone| self.from.bones.get(bone));
        below.into_iter().any(|n| std::iter::successors(Some(*n), |n| self.from.above(*n)).any(|n| n == node))
    }

    /// Movement of the hips from rest, by the height of both.
    fn hips(&self, clip: &mut Clip) {
        let hips = HumanBone::Hips;
        let (Some(&theirs), Some(&ours)) = (self.from.bones.get(&hips), self.to.bones.get(&hips)) else { return };
        let Some(track) = self.hips_track(theirs) else { return };
        let (from, to) = (self.from.places[theirs].position, self.to.places[ours].position);
        let size = if from.y > LOWEST_HIPS_M { to.y / from.y } else { 1.0 };
        let above = self.to.place_above(ours);
        let local = |p: Vec3| above.inverse_point(p);
        let origin = local(Vec3::ZERO);
        let track = track.map(|p| local(to + (p - from) * size), |v| local(v * size) - origin);
        clip.translations.push(VectorChannel::new(ours, track));
    }

    /// Where the hips of the source are over time, in the space of the character.
    fn hips_track(&self, hips: usize) -> Option<Track<Vec3>> {
        let moves = |node: usize| {
            let of_rotation = self.channel(node, |v| matches!(v, AnimationValues::Rotation(_)));
            of_rotation.or(self.channel(node, |v| matches!(v, AnimationValues::Translation(_)))).is_some()
        };
        let mut above = std::iter::successors(self.from.above(hips), |n| self.from.above(*n));
        if self.has_helpers() && above.any(moves) {
            return Some(self.baked(hips));
        }
        let channel = self.channel(hips, |v| matches!(v, AnimationValues::Translation(_)))?;
        let parent = self.from.place_above(hips);
        let origin = parent.point(Vec3::ZERO);
        Some(vectors(channel)?.map(|p| parent.point(p), |v| parent.point(v) - origin))
    }

    /// The same where what is above them moves too: at a rate.
    fn baked(&self, hips: usize) -> Track<Vec3> {
        let chain: Vec<usize> = std::iter::successors(Some(hips), |n| self.from.above(*n)).collect();
        let end = self.animation.channels.iter().filter_map(|c| c.times.last()).fold(0.0f32, |a, b| a.max(*b));
        let count = (((end * BAKED_HZ) as usize) + 2).min(MOST_BAKED);
        let times: Vec<f32> = (0..count).map(|i| end * i as f32 / (count - 1) as f32).collect();
        let tracks: Vec<_> = chain.iter().map(|n| (*n, self.turns(*n), self.moves(*n))).collect();
        let root = self.from.rotation_above(*chain.last().unwrap_or(&hips));
        let place = |time: f64| {
            let mut place = Place { rotation: root, ..Place::ORIGIN };
            for (node, turns, moves) in tracks.iter().rev() {
                let mut local = self.from.scene.nodes[*node].transform;
                local.rotation = turns.as_ref().map_or(local.rotation, |t| t.sample(time));
                local.translation = moves.as_ref().map_or(local.translation, |t| t.sample(time));
                place = place.below(&local);
            }
            place.position
        };
        let values = times.iter().map(|t| place(f64::from(*t))).collect();
        // A clip of one pose has all its keys at once.
        if end > 0.0 {
            Track { times, interpolation: Interpolation::Linear, values }
        } else {
            Track::constant(place(0.0))
        }
    }

    fn moves(&self, node: usize) -> Option<Track<Vec3>> {
        vectors(self.channel(node, |v| matches!(v, AnimationValues::Translation(_)))?)
    }

    /// Weights of expressions, and the gaze.
    fn expressions(&self, clip: &mut Clip) {
        let Some(rig) = &self.from.scene.animation_rig else { return };
        let ours = self.to.scene.character.as_ref().map_or(&[][..], |c| &c.expressions);
        let mut lacking = Vec::new();
        for (name, node) in &rig.expressions {
            let Some(track) = self.moves(*node) else { continue };
            match ours.iter().position(|e| e.name == *name) {
                Some(index) => clip.expressions.push((index, track)),
                None => lacking.push(name.clone()),
            }
        }
        warn(clip, "expressions", lacking);
        clip.gaze = rig.look_at.and_then(|node| self.turns(node));
    }
}
