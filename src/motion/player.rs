//! Plays clips in layers and blends them into a pose.

use std::sync::Arc;

use glam::{Mat4, Quat, Vec3};

use super::clip::Clip;
use super::gaze::Angles;
use super::layer::{Blend, Curve, Layer, Play, RootMotion};
use super::pose::Pose;
use super::rotation::{about, inverse, mix, mul, slerp, turn};
use super::skeleton::Skeleton;
use crate::scene::Transform;

/// Clips in layers, the lowest first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Player {
    /// The layers. [`Player::play`] and [`Player::fade_to`] use the first one.
    pub layers: Vec<Layer>,
    /// What clips say of expressions, the sum of weights by index.
    pub(crate) expressions: Vec<f32>,
    /// What they say of the gaze.
    pub(crate) gaze: Option<Angles>,
    /// Movement of the actor since it was taken last.
    way: Way,
    mixed: Mixed,
}

/// A movement over the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Way {
    travel: Vec3,
    turn: f32,
}

/// What the clips of a layer sum to, by node; not part of the state.
#[derive(Clone, Debug, Default)]
struct Mixed {
    rotations: Vec<(Quat, f32)>,
    translations: Vec<(Vec3, f32)>,
    scales: Vec<(Vec3, f32)>,
    touched: Vec<usize>,
    is_touched: Vec<bool>,
}

impl PartialEq for Mixed {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Player {
    /// Plays a clip, looped, in the place of everything on the first layer.
    pub fn play(&mut self, clip: &Arc<Clip>) {
        self.base().plays = vec![Play::new(clip)];
    }

    /// Goes over to a clip, looped, on the first layer, within a time.
    pub fn fade_to(&mut self, clip: &Arc<Clip>, seconds: f32) {
        self.cross_fade(Play::new(clip), seconds);
    }

    /// Goes over to what plays as it says, on the first layer, within a time.
    pub fn cross_fade(&mut self, play: Play, seconds: f32) {
        self.base().cross_fade(play, seconds, Curve::Smooth);
    }

    /// The first layer.
    pub fn base(&mut self) -> &mut Layer {
        if self.layers.is_empty() {
            self.layers.push(Layer::default());
        }
        &mut self.layers[0]
    }

    /// Whether a clip plays on the first layer, or fades in there.
    #[must_use]
    pub fn is_playing(&self, clip: &Arc<Clip>) -> bool {
        let plays = self.layers.first().map_or(&[][..], |layer| &layer.plays);
        plays.iter().any(|p| !p.is_leaving && Arc::ptr_eq(&p.clip, clip))
    }

    /// Moves time on.
    pub fn advance(&mut self, dt: f32) {
        let way = &mut self.way;
        for layer in &mut self.layers {
            let sum: f32 = layer.plays.iter().map(|p| p.weight.max(0.0)).sum();
            let share = 1.0 / sum.max(1.0);
            layer.advance(dt, |play, before, after| way.add(play, before, after, play.weight.max(0.0) * share));
        }
    }

    /// What takes the actor from where it was to where its clips have moved it since this was asked last: in its own space.
    pub fn take_root_motion(&mut self) -> Mat4 {
        let Way { travel, turn } = std::mem::take(&mut self.way);
        Mat4::from_rotation_translation(about(Vec3::Y, turn), travel)
    }

    /// Blends all layers over a pose, which stands for what is below them.
    pub fn sample(&mut self, skeleton: &Skeleton, pose: &mut Pose) {
        self.expressions.clear();
        self.expressions.resize(skeleton.expressions.len(), 0.0);
        self.gaze = None;
        let Self { layers, expressions, gaze, mixed, .. } = self;
        mixed.fit(skeleton.node_count());
        let mut gazes = 0f32;
        for layer in layers {
            match layer.blend {
                Blend::Override => {
                    for play in &layer.plays {
                        mixed.add(play);
                    }
                    mixed.apply(pose);
                    add_morphs(&layer.plays, pose);
                }
                Blend::Additive => layer.plays.iter().for_each(|play| add_on_top(play, pose)),
            }
            for play in layer.plays.iter().filter(|p| p.weight > 0.0) {
                let time = play.clip_time();
                for (index, weight) in play.clip.expressions_at(time) {
                    if let Some(sum) = expressions.get_mut(index) {
                        *sum += weight * play.weight;
                    }
                }
                if let Some(angles) = play.clip.gaze_at(time) {
                    gazes += play.weight;
                    let sum = gaze.unwrap_or_default();
                    *gaze = Some([0, 1].map(|i| sum[i] + angles[i] * play.weight));
                }
            }
        }
        // Where weights sum to less than 1, the rest looks straight ahead.
        *gaze = gaze.map(|sum| sum.map(|angle| angle / gazes.max(1.0)));
    }
}

impl Mixed {
    fn fit(&mut self, nodes: usize) {
        self.rotations.resize(nodes, (Quat::IDENTITY, 0.0));
        self.translations.resize(nodes, (Vec3::ZERO, 0.0));
        self.scales.resize(nodes, (Vec3::ONE, 0.0));
        self.is_touched.resize(nodes, false);
    }

    fn touch(&mut self, node: usize) {
        if !std::mem::replace(&mut self.is_touched[node], true) {
            self.touched.push(node);
        }
    }

    fn add(&mut self, play: &Play) {
        let time = play.clip_time();
        let clip = &*play.clip;
        let nodes = self.is_touched.len();
        for channel in clip.rotations.iter().filter(|c| c.node < nodes) {
            let weight = play.share(channel.node);
            if weight > 0.0 {
                self.touch(channel.node);
                let mut value = channel.sample(time);
                if let Some((_, yaw)) = play.root_at(channel.node, time, false) {
                    value = yaw_taken(clip, yaw, value);
                }
                let (sum, total) = &mut self.rotations[channel.node];
                *total += weight;
                *sum = if *total == weight {
                    value
                } else {
                    slerp(*sum, value, weight / *total)
                };
            }
        }
        for channel in clip.translations.iter().filter(|c| c.node < nodes) {
            let weight = play.share(channel.node);
            if weight > 0.0 {
                self.touch(channel.node);
                let mut value = channel.track.sample(time);
                if let Some((travel, yaw)) = play.root_at(channel.node, time, true) {
                    value = way_taken(clip, travel, yaw, value);
                }
                add_vector(&mut self.translations[channel.node], value, weight);
            }
        }
        for channel in clip.scales.iter().filter(|c| c.node < nodes) {
            let weight = play.share(channel.node);
            if weight > 0.0 {
                self.touch(channel.node);
                add_vector(&mut self.scales[channel.node], channel.track.sample(time), weight);
            }
        }
    }

    /// Lays the sums over a pose and begins anew.
    fn apply(&mut self, pose: &mut Pose) {
        for node in self.touched.drain(..) {
            self.is_touched[node] = false;
            let Some(local) = pose.locals.get_mut(node) else { continue };
            let (rotation, by) = std::mem::replace(&mut self.rotations[node], (Quat::IDENTITY, 0.0));
            local.rotation = slerp(local.rotation, rotation, by.min(1.0));
            let (translation, by) = std::mem::replace(&mut self.translations[node], (Vec3::ZERO, 0.0));
            local.translation = lerp(local.translation, translation, by);
            let (scale, by) = std::mem::replace(&mut self.scales[node], (Vec3::ONE, 0.0));
            local.scale = lerp(local.scale, scale, by);
        }
    }
}

/// Exact at both ends.
fn lerp(from: Vec3, to: Vec3, by: f32) -> Vec3 {
    if by >= 1.0 {
        to
    } else if by <= 0.0 {
        from
    } else {
        mix(from, to, by)
    }
}

fn add_vector((sum, total): &mut (Vec3, f32), value: Vec3, weight: f32) {
    *total += weight;
    *sum = lerp(*sum, value, weight / *total);
}

/// Morph weights of the clips of a layer, by their shares, over what is below.
fn add_morphs(plays: &[Play], pose: &mut Pose) {
    for (i, play) in plays.iter().enumerate() {
        for channel in &play.clip.morphs {
            let own = play.share(channel.node);
            let Some(weights) = pose.morph_weights.get_mut(channel.node).filter(|_| own > 0.0) else { continue };
            let of = |p: &Play| {
                let has = p.clip.morphs.iter().any(|c| c.node == channel.node);
                if has { p.share(channel.node) } else { 0.0 }
            };
            let total: f32 = plays.iter().map(of).sum();
            let is_first = !plays[..i].iter().any(|p| of(p) > 0.0);
            let (below, share) = (1.0 - total.min(1.0), own * total.min(1.0) / total);
            for (target, weight) in weights.iter_mut().enumerate().take(channel.track.targets) {
                let kept = if is_first { *weight * below } else { *weight };
                *weight = kept + channel.track.sample(target, play.clip_time()) * share;
            }
        }
    }
}

fn add_on_top(play: &Play, pose: &mut Pose) {
    let time = play.clip_time();
    for channel in &play.clip.rotations {
        let weight = play.share(channel.node);
        if let Some(local) = pose.locals.get_mut(channel.node).filter(|_| weight > 0.0) {
            let delta = mul(inverse(channel.first), channel.sample(time));
            local.rotation = mul(local.rotation, slerp(Quat::IDENTITY, delta, weight));
        }
    }
    let vectors = |channels: &[super::clip::VectorChannel], pose: &mut Pose, of: fn(&mut Transform) -> &mut Vec3| {
        for channel in channels {
            let weight = play.share(channel.node);
            if let Some(local) = pose.locals.get_mut(channel.node).filter(|_| weight > 0.0) {
                *of(local) += (channel.track.sample(time) - channel.first) * weight;
            }
        }
    };
    vectors(&play.clip.translations, pose, |l| &mut l.translation);
    vectors(&play.clip.scales, pose, |l| &mut l.scale);
}

impl Play {
    /// What is taken from the hips at a moment: way and turn, where they are not kept.
    fn root_at(&self, node: usize, time: f64, is_translation: bool) -> Option<(Vec3, f32)> {
        if self.root_motion == RootMotion::Keep {
            return None;
        }
        let root = self.clip.root.as_ref()?;
        let hips = self.clip.translations[root.translation].node;
        (node == hips && (is_translation || root.rotation.is_some())).then(|| self.way_at(time))
    }

    /// Way and turn from the beginning of the clip: of loops an even share of the whole, else what the hips do.
    fn way_at(&self, time: f64) -> (Vec3, f32) {
        let Some(root) = &self.clip.root else { return (Vec3::ZERO, 0.0) };
        if self.looped {
            let share = if self.clip.length_s > 0.0 {
                (time / f64::from(self.clip.length_s)) as f32
            } else {
                0.0
            };
            return (root.travel * share, root.turn * share);
        }
        let (start, now) = (root.place(&self.clip, 0.0), root.place(&self.clip, time));
        (now.0 - start.0, now.1 - start.1)
    }
}

/// The translation of hips without their way: moved back to the start, and turned back about it.
fn way_taken(clip: &Clip, travel: Vec3, yaw: f32, value: Vec3) -> Vec3 {
    let Some(root) = &clip.root else { return value };
    let place = turn(root.above, value * root.scale) - travel;
    let start = root.place(clip, 0.0).0;
    let from_start = turn(about(Vec3::Y, -yaw), place - start);
    turn(inverse(root.above), start + from_start) / root.scale
}

/// The rotation of hips without their turn.
fn yaw_taken(clip: &Clip, yaw: f32, value: Quat) -> Quat {
    let Some(root) = &clip.root else { return value };
    let back = mul(inverse(root.above), mul(about(Vec3::Y, -yaw), root.above));
    mul(back, value)
}

impl Way {
    /// One after the other.
    fn then(self, next: Self) -> Self {
        Self { travel: self.travel + turn(about(Vec3::Y, self.turn), next.travel), turn: self.turn + next.turn }
    }

    fn back(self) -> Self {
        Self { travel: -turn(about(Vec3::Y, -self.turn), self.travel), turn: -self.turn }
    }

    /// Adds what a clip has moved between two moments, loops included.
    fn add(&mut self, play: &Play, before: f64, after: f64, weight: f32) {
        let length_s = f64::from(play.clip.length_s);
        if weight <= 0.0 || length_s <= 0.0 || play.clip.root.is_none() {
            return;
        }
        let at = |time: f64| {
            let (travel, turn) = play.way_at(time);
            Self { travel, turn }
        };
        let moved = if play.looped {
            let loops = |time: f64| libm::floor(time / length_s);
            let within = |time: f64| at(time - loops(time) * length_s);
            let whole = at(length_s);
            let count = (loops(after) - loops(before)).clamp(-MOST_LOOPS, MOST_LOOPS) as i32;
            let one = if count < 0 { whole.back() } else { whole };
            let between = (0..count.abs()).fold(Self::default(), |way, _| way.then(one));
            within(before).back().then(between).then(within(after))
        } else {
            let within = |time: f64| at(time.clamp(0.0, length_s));
            within(before).back().then(within(after))
        };
        *self = self.then(Self { travel: moved.travel * weight, turn: moved.turn * weight });
    }
}

/// Loops that a clip may go through in one frame.
const MOST_LOOPS: f64 = 64.0;
