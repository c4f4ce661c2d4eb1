//! A clip that fits one character: the movements of a glTF animation or a VRMA, bound to its nodes.

use glam::{Quat, Vec3};

use super::expression::share;
use super::gaze::{Angles, angles_of};
use super::retarget;
use super::track::{Track, WeightTrack};
use crate::scene::{Animation, AnimationChannel, AnimationValues, Scene};
use crate::{Error, Result};

/// A movement over time that fits one character. Shared by all its actors, as `Arc<Clip>`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clip {
    /// Name in the file; may be empty.
    pub name: String,
    /// Time of the last key, seconds.
    pub length_s: f32,
    /// What of it does not fit the character: bones and expressions that this one lacks.
    pub warnings: Vec<String>,
    pub(crate) rotations: Vec<RotationChannel>,
    pub(crate) translations: Vec<VectorChannel>,
    pub(crate) scales: Vec<VectorChannel>,
    pub(crate) morphs: Vec<MorphChannel>,
    /// Expressions, by index, and their weights as the x of a vector.
    pub(crate) expressions: Vec<(usize, Track<Vec3>)>,
    /// Rotation of the gaze from straight ahead.
    pub(crate) gaze: Option<Track<Quat>>,
    pub(crate) root: Option<RootChannel>,
}

/// Rotations of a node: the product of its tracks, the first one outermost.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RotationChannel {
    pub node: usize,
    pub tracks: Vec<Track<Quat>>,
    /// Value at time 0: what additive layers measure from.
    pub first: Quat,
}

/// Translations or scales of a node.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct VectorChannel {
    pub node: usize,
    pub track: Track<Vec3>,
    pub first: Vec3,
}

/// Weights of the morphs of a node.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MorphChannel {
    pub node: usize,
    pub track: WeightTrack,
}

/// Where a clip takes its character: movement of the hips over the ground.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RootChannel {
    /// The channel of the hips among the translations, and among the rotations.
    pub translation: usize,
    pub rotation: Option<usize>,
    /// From the space of the hips' parent at rest to the character's own: rotation and scale.
    pub above: Quat,
    pub scale: f32,
    /// Movement over the whole clip, the character's own space, y 0; and turn about the vertical, radians.
    pub travel: Vec3,
    pub turn: f32,
}

impl RotationChannel {
    pub fn new(node: usize, tracks: Vec<Track<Quat>>) -> Self {
        let mut channel = Self { node, tracks, first: Quat::IDENTITY };
        channel.first = channel.sample(0.0);
        channel
    }

    pub fn sample(&self, time: f64) -> Quat {
        let mut tracks = self.tracks.iter();
        let first = tracks.next().map_or(Quat::IDENTITY, |t| t.sample(time));
        tracks.fold(first, |product, track| super::rotation::mul(product, track.sample(time)))
    }
}

impl VectorChannel {
    pub fn new(node: usize, track: Track<Vec3>) -> Self {
        let first = track.sample(0.0);
        Self { node, track, first }
    }
}

impl Clip {
    /// A clip of a file, for a character: `of(&scene, 0, &scene)` takes the first one that a model brings itself.
    ///
    /// From another file, humanoids take it over bone by bone from rest to rest: those of VRMA and VRM, and skeletons whose
    /// names are those of Mixamo, KayKit, VRoid, Unreal or Rigify. Others take over the nodes that have the same names.
    ///
    /// # Errors
    /// [`Error::Argument`] where there is no such animation, or where nothing of it fits; the message says why.
    pub fn of(source: &Scene, animation: usize, target: &Scene) -> Result<Self> {
        let Some(found) = source.animations.get(animation) else {
            let message = match source.animations.len() {
                0 => "the file has no animations".to_owned(),
                n => format!("the file has {n} animations, the first is 0"),
            };
            return Err(Error::Argument { what: format!("animation {animation}"), message });
        };
        let clip = if is_same(source, target) {
            Self::own(found)
        } else {
            retarget::fit(source, found, target)?
        };
        Ok(clip.finished(found, target))
    }

    /// A clip by its name, or by its index written as a number, or the first one for an empty name.
    ///
    /// # Errors
    /// As for [`Clip::of`]; the message lists the names that there are.
    pub fn named(source: &Scene, name: &str, target: &Scene) -> Result<Self> {
        let animations = &source.animations;
        let by_name = animations.iter().position(|a| a.name == name);
        let index = name.parse().ok().filter(|i: &usize| *i < animations.len());
        let first = (name.is_empty() && !animations.is_empty()).then_some(0);
        let Some(found) = by_name.or(index).or(first) else {
            let names: Vec<&str> = animations.iter().map(|a| a.name.as_str()).collect();
            let message = if names.is_empty() {
                "the file has no animations".to_owned()
            } else {
                format!("the file has no such animation; it has: {}", names.join(", "))
            };
            return Err(Error::Argument { what: format!("clip {name:?}"), message });
        };
        Self::of(source, found, target)
    }

    /// Channels on the nodes that they name.
    fn own(animation: &Animation) -> Self {
        let mut clip = Self::default();
        for channel in &animation.channels {
            clip.add(channel, channel.node);
        }
        clip
    }

    /// A channel as it is, on a node.
    pub(crate) fn add(&mut self, channel: &AnimationChannel, node: usize) {
        match &channel.values {
            AnimationValues::Rotation(_) => {
                self.rotations.extend(rotations(channel).map(|track| RotationChannel::new(node, vec![track])));
            }
            AnimationValues::Translation(_) => {
                self.translations.extend(vectors(channel).map(|track| VectorChannel::new(node, track)));
            }
            AnimationValues::Scale(_) => {
                self.scales.extend(vectors(channel).map(|track| VectorChannel::new(node, track)));
            }
            AnimationValues::MorphWeights(values) => {
                let keys = channel.times.len() * if is_spline(channel) { 3 } else { 1 };
                let keys_track = Track {
                    times: channel.times.clone(),
                    interpolation: channel.interpolation,
                    values: values.clone(),
                };
                let targets = values.len() / keys.max(1);
                if targets > 0 {
                    self.morphs.push(MorphChannel { node, track: WeightTrack { targets, keys: keys_track } });
                }
            }
        }
    }

    /// Name, length and the way of the hips.
    fn finished(mut self, animation: &Animation, target: &Scene) -> Self {
        self.name.clone_from(&animation.name);
        let ends = animation.channels.iter().filter_map(|c| c.times.last().copied());
        self.length_s = ends.fold(0.0, f32::max);
        self.keep_finite();
        self.root = self.way_of_hips(target);
        self
    }

    /// Leaves out what rest poses of no size have made infinite, or so large that what lies between keys would be.
    fn keep_finite(&mut self) {
        const LARGEST: f32 = 1e15;
        let before = self.rotations.len() + self.translations.len();
        self.rotations.retain(|c| c.tracks.iter().all(|t| t.values.iter().all(|q| q.length() < LARGEST)));
        self.translations.retain(|c| c.track.values.iter().all(|v| v.length() < LARGEST));
        let left_out = before - self.rotations.len() - self.translations.len();
        if left_out > 0 {
            self.warnings.push(format!("{left_out} movements have no size in the rest pose of the file: left out"));
        }
    }

    fn way_of_hips(&self, target: &Scene) -> Option<RootChannel> {
        let hips = retarget::hips_of(target)?;
        let translation = self.translations.iter().position(|c| c.node == hips)?;
        let rotation = self.rotations.iter().position(|c| c.node == hips);
        let (above, scale) = retarget::rest_above(target, hips);
        let mut root = RootChannel { translation, rotation, above, scale, travel: Vec3::ZERO, turn: 0.0 };
        let (start, end) = (root.place(self, 0.0), root.place(self, f64::from(self.length_s)));
        (root.travel, root.turn) = (end.0 - start.0, wrapped(end.1 - start.1));
        Some(root)
    }

    /// Weight that the clip gives to an expression, where it gives it one. Range 0..1.
    pub(crate) fn expressions_at(&self, time: f64) -> impl Iterator<Item = (usize, f32)> {
        self.expressions.iter().map(move |(e, track)| (*e, share(track.sample(time).x)))
    }

    pub(crate) fn gaze_at(&self, time: f64) -> Option<Angles> {
        self.gaze.as_ref().map(|track| angles_of(track.sample(time)))
    }

    /// Speed over the ground at which its feet stand still, metres a second: 0 for clips that stay in place.
    #[must_use]
    pub fn ground_speed(&self) -> f32 {
        match &self.root {
            Some(root) if self.length_s > 0.0 => super::rotation::length(root.travel) / self.length_s,
            _ => 0.0,
        }
    }
}

impl RootChannel {
    /// Where the hips are over the ground, and how far they are turned about the vertical, radians.
    pub fn place(&self, clip: &Clip, time: f64) -> (Vec3, f32) {
        let local = clip.translations[self.translation].track.sample(time);
        let place = super::rotation::turn(self.above, local * self.scale);
        let turned = self.rotation.map_or(0.0, |r| {
            let channel = &clip.rotations[r];
            // Against the first key: rest rotations drop out.
            let (now, first) = (channel.sample(time), channel.first);
            let q = super::rotation::mul(now, super::rotation::inverse(first));
            let world = super::rotation::mul(self.above, super::rotation::mul(q, super::rotation::inverse(self.above)));
            2.0 * libm::atan2f(world.y, world.w)
        });
        (Vec3::new(place.x, 0.0, place.z), wrapped(turned))
    }
}

/// An angle from -π to π.
fn wrapped(angle: f32) -> f32 {
    use std::f32::consts::{PI, TAU};
    angle - TAU * libm::floorf((angle + PI) / TAU)
}

fn is_spline(channel: &AnimationChannel) -> bool {
    channel.interpolation == crate::scene::Interpolation::CubicSpline
}

/// Rotations of a channel.
pub(crate) fn rotations(channel: &AnimationChannel) -> Option<Track<Quat>> {
    let AnimationValues::Rotation(values) = &channel.values else { return None };
    let values = values.iter().map(|q| Quat::from_array(*q)).collect();
    Some(Track { times: channel.times.clone(), interpolation: channel.interpolation, values })
}

/// Translations or scales of a channel.
pub(crate) fn vectors(channel: &AnimationChannel) -> Option<Track<Vec3>> {
    let (AnimationValues::Translation(values) | AnimationValues::Scale(values)) = &channel.values else { return None };
    let values = values.iter().map(|v| Vec3::from_array(*v)).collect();
    Some(Track { times: channel.times.clone(), interpolation: channel.interpolation, values })
}

/// Whether both have the same nodes: a clip of the one fits the other as it is.
fn is_same(source: &Scene, target: &Scene) -> bool {
    source.animation_rig.is_none()
        && source.nodes.len() == target.nodes.len()
        && source.nodes.iter().zip(&target.nodes).all(|(a, b)| a.name == b.name && a.parent == b.parent)
}
