//! Layers of clips: what plays, how strongly, on which bones, and how it blends with what is below.

use std::sync::Arc;

use super::clip::Clip;
use super::skeleton::{Skeleton, descendants};
use crate::scene::HumanBone;

/// A clip that plays.
#[derive(Clone, Debug, PartialEq)]
pub struct Play {
    /// The clip.
    pub clip: Arc<Clip>,
    /// Moment in the clip, seconds; grows beyond its length where it loops. Default: 0.
    pub time_s: f64,
    /// Speed; negative runs back. Default: 1.
    pub speed: f32,
    /// Whether it begins anew at its end; else it holds there. Default: true.
    pub looped: bool,
    /// Strength among the clips of its layer. Range 0... Default: 1.
    pub weight: f32,
    /// What of the body it moves. Default: `None`, all.
    pub mask: Option<Arc<Mask>>,
    /// Whether it keeps step with the other looped clips of its layer that do: walk and run blend foot by foot, whatever their
    /// lengths. Default: false.
    pub in_step: bool,
    /// What becomes of its way over the ground. Default: [`RootMotion::Keep`].
    pub root_motion: RootMotion,
    /// A change of `weight` that goes on ([`Play::fade_to`]). Default: none.
    pub fade: Option<Fade>,
    /// Whether it goes once that fade is over. Default: false.
    pub is_leaving: bool,
}

/// What becomes of the way that the hips of a clip take over the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RootMotion {
    /// It stays in the pose.
    #[default]
    Keep,
    /// It is left out: the character walks in place.
    InPlace,
    /// It moves the actor, loop after loop.
    Actor,
}

/// The course of a fade.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Curve {
    /// Even.
    #[default]
    Linear,
    /// Slow at both ends.
    Smooth,
}

/// A change of a weight over time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fade {
    from: f32,
    to: f32,
    elapsed_s: f32,
    length_s: f32,
    curve: Curve,
}

/// How much of each node a clip moves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mask {
    /// Share of each node. Range 0..1.
    pub nodes: Vec<f32>,
}

/// How a layer joins what is below it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Blend {
    /// It takes the place of what is below, by the sum of its weights.
    #[default]
    Override,
    /// Its movement from its own first frame is added, in the frame of each bone.
    Additive,
}

/// Clips that share the weight, on top of the layers below.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer {
    /// The clips; where their weights sum to more than 1 they share, where to less, the rest is what is below.
    pub plays: Vec<Play>,
    /// How it joins what is below. Default: it takes its place.
    pub blend: Blend,
}

impl Play {
    /// A clip from its beginning, looped, at full weight.
    #[must_use]
    pub fn new(clip: &Arc<Clip>) -> Self {
        Self {
            clip: clip.clone(),
            time_s: 0.0,
            speed: 1.0,
            looped: true,
            weight: 1.0,
            mask: None,
            in_step: false,
            root_motion: RootMotion::Keep,
            fade: None,
            is_leaving: false,
        }
    }

    /// The same once, holding its end.
    #[must_use]
    pub fn once(clip: &Arc<Clip>) -> Self {
        Self { looped: false, ..Self::new(clip) }
    }

    /// Moment in the clip that is shown, seconds.
    #[must_use]
    pub fn clip_time(&self) -> f64 {
        let length = f64::from(self.clip.length_s);
        if length <= 0.0 {
            return 0.0;
        }
        if self.looped {
            self.time_s - length * libm::floor(self.time_s / length)
        } else {
            self.time_s.clamp(0.0, length)
        }
    }

    /// Whether a clip that plays once has come to its end.
    #[must_use]
    pub fn is_over(&self) -> bool {
        let is_back = self.speed < 0.0;
        !self.looped
            && if is_back {
                self.time_s <= 0.0
            } else {
                self.time_s >= f64::from(self.clip.length_s)
            }
    }

    /// Changes the weight over a time.
    pub fn fade_to(&mut self, weight: f32, seconds: f32, curve: Curve) {
        if seconds > 0.0 {
            self.fade = Some(Fade { from: self.weight, to: weight, elapsed_s: 0.0, length_s: seconds, curve });
        } else {
            (self.weight, self.fade) = (weight, None);
        }
    }

    /// Share of a node that it moves, by weight and mask.
    pub(crate) fn share(&self, node: usize) -> f32 {
        let mask = self.mask.as_ref().map_or(1.0, |mask| mask.nodes.get(node).copied().unwrap_or(0.0));
        self.weight.max(0.0) * mask
    }

    fn advance_fade(&mut self, dt: f32) {
        let Some(fade) = &mut self.fade else { return };
        fade.elapsed_s += dt.max(0.0);
        let t = (fade.elapsed_s / fade.length_s).min(1.0);
        let t = match fade.curve {
            Curve::Linear => t,
            Curve::Smooth => t * t * (3.0 - 2.0 * t),
        };
        self.weight = fade.from * (1.0 - t) + fade.to * t;
        if fade.elapsed_s >= fade.length_s {
            self.fade = None;
        }
    }
}

impl Layer {
    /// A layer whose clips are added to what is below.
    #[must_use]
    pub fn additive() -> Self {
        Self { blend: Blend::Additive, ..Self::default() }
    }

    /// Lets everything go over to another clip within a time; what goes on is faded from where it is.
    pub fn cross_fade(&mut self, mut play: Play, seconds: f32, curve: Curve) {
        let weight = play.weight;
        if play.in_step
            && let Some(other) = self.plays.iter().find(|p| p.in_step && p.looped && p.clip.length_s > 0.0)
        {
            let phase = other.clip_time() / f64::from(other.clip.length_s);
            play.time_s = phase * f64::from(play.clip.length_s);
        }
        self.fade_out(seconds, curve);
        play.weight = 0.0;
        play.fade_to(weight, seconds, curve);
        self.plays.push(play);
    }

    /// Fades all its clips out.
    pub fn fade_out(&mut self, seconds: f32, curve: Curve) {
        for play in &mut self.plays {
            play.fade_to(0.0, seconds, curve);
            play.is_leaving = true;
        }
        self.plays.retain(|p| p.fade.is_some());
    }

    /// Moves time on. Calls `moved` with each clip whose way is the actor's, and the moments before and after.
    pub(crate) fn advance(&mut self, dt: f32, mut moved: impl FnMut(&Play, f64, f64)) {
        for play in &mut self.plays {
            play.advance_fade(dt);
        }
        let keeps_step = |p: &Play| p.in_step && p.looped && p.clip.length_s > 0.0;
        // Cycles a second of those that keep step, by weight.
        let (mut rate, mut sum) = (0.0, 0.0);
        for play in self.plays.iter().filter(|p| keeps_step(p)) {
            let weight = play.weight.max(1e-6);
            rate += weight * play.speed / play.clip.length_s;
            sum += weight;
        }
        for play in &mut self.plays {
            let speed = if keeps_step(play) {
                rate / sum * play.clip.length_s
            } else {
                play.speed
            };
            let before = play.time_s;
            play.time_s += f64::from(speed) * f64::from(dt);
            if play.root_motion == RootMotion::Actor {
                moved(play, before, play.time_s);
            }
        }
        self.plays.retain(|p| !(p.is_leaving && p.fade.is_none()));
    }
}

impl Mask {
    /// Nothing but a bone and all below it.
    #[must_use]
    pub fn below(skeleton: &Skeleton, bone: HumanBone) -> Self {
        Self::default().with(skeleton, bone, 1.0)
    }

    /// The same with another share of a bone and all below it. Bones that the character lacks change nothing.
    #[must_use]
    pub fn with(mut self, skeleton: &Skeleton, bone: HumanBone, share: f32) -> Self {
        self.nodes.resize(skeleton.node_count(), 0.0);
        if let Some(&node) = skeleton.bones.get(&bone) {
            descendants(&skeleton.parents, node).iter().for_each(|n| self.nodes[*n as usize] = share);
        }
        self
    }
}
