//! Everything that moves a character, in the order of a frame: clips, gaze, expressions, constraints, springs (VRM 1.0,
//! "Expression, LookAt, SpringBone, Constraints execution order").

use std::collections::BTreeMap;

use glam::Mat4;

use super::blink::Blink;
use super::constraint::constrain;
use super::expression::{resolve, unknown};
use super::gaze::{Angles, Gaze, drive_looks, turn_eyes};
use super::places::{Place, place_all};
use super::player::Player;
use super::pose::Pose;
use super::skeleton::Skeleton;
use super::spring::Springs;
use crate::Result;

/// What moves one character. Its state is this value: a clone saves it, and with the same calls goes on to the same pose.
///
/// [`Animator::update`] does everything. The parts may be called apart, in their order: [`Player::advance`],
/// [`Animator::play`], [`Animator::look`], [`Animator::express`], [`Animator::constrain`], [`Animator::swing`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Animator {
    /// Clips.
    pub player: Player,
    /// Where it looks. Default: where clips say.
    pub gaze: Gaze,
    /// Blinking. Default: none.
    pub blink: Option<Blink>,
    /// Swinging chains: hair, skirts. Default: on.
    pub springs: Springs,
    /// What is below all clips. Default: `None`, the rest pose of the file.
    pub base: Option<Pose>,
    /// Weights that are asked of expressions, by index.
    asked: BTreeMap<usize, f32>,
    /// Time since the beginning, seconds.
    time_s: f64,
    /// Where the gaze goes, radians.
    looks: Option<Angles>,
    /// What shows of each expression.
    shown: Vec<f32>,
    scratch: Scratch,
}

/// Places of nodes, filled anew in each frame.
#[derive(Clone, Debug, Default)]
struct Scratch {
    places: Vec<Place>,
}

impl PartialEq for Scratch {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Animator {
    /// A frame: moves time on by `dt` seconds and poses the character; its way over the ground moves `world`
    /// (`world_from_character`). Without clips, the pose is what [`Animator::base`] says.
    pub fn update(&mut self, skeleton: &Skeleton, world: &mut Mat4, pose: &mut Pose, dt: f32) {
        let dt = if dt.is_finite() { dt.max(0.0) } else { 0.0 };
        self.time_s += f64::from(dt);
        self.player.advance(dt);
        self.play(skeleton, pose);
        *world *= self.player.take_root_motion();
        self.look(skeleton, world, pose, dt);
        self.express(skeleton, pose);
        self.constrain(skeleton, pose);
        self.swing(skeleton, world, pose, dt);
    }

    /// Poses by the clips alone, over [`Animator::base`].
    pub fn play(&mut self, skeleton: &Skeleton, pose: &mut Pose) {
        let (locals, weights) = match &self.base {
            Some(base) => (&base.locals, &base.morph_weights),
            None => (&skeleton.rest, &skeleton.rest_weights),
        };
        copy(locals, &skeleton.rest, &mut pose.locals);
        pose.morph_weights.resize_with(skeleton.node_count(), Vec::new);
        for &node in &skeleton.morphed {
            let node = node as usize;
            let own = weights.get(node).filter(|w| !w.is_empty()).unwrap_or(&skeleton.rest_weights[node]);
            pose.morph_weights[node].clone_from(own);
        }
        self.player.sample(skeleton, pose);
    }

    /// Turns head and eyes to what the gaze is on.
    pub fn look(&mut self, skeleton: &Skeleton, world: &Mat4, pose: &mut Pose, dt: f32) {
        let of_clips = self.player.gaze;
        self.looks = None;
        if self.gaze.is_idle() && of_clips.is_none() {
            return;
        }
        let places = &mut self.scratch.places;
        place_all(&skeleton.parents, &pose.locals, &Place::ORIGIN, places);
        let root = Place::of(world);
        let time = [self.time_s, f64::from(dt)];
        self.looks = self.gaze.aim(skeleton, &mut pose.locals, places, &root, of_clips, time);
        if let Some(angles) = self.looks {
            turn_eyes(skeleton, angles, &mut pose.locals);
        }
    }

    /// Shows expressions: those asked for and those of clips, blinks, and gazes that go by expressions.
    pub fn express(&mut self, skeleton: &Skeleton, pose: &mut Pose) {
        self.shown.clear();
        self.shown.extend_from_slice(&self.player.expressions);
        self.shown.resize(skeleton.expressions.len(), 0.0);
        for (&index, weight) in &self.asked {
            if let Some(slot) = self.shown.get_mut(index) {
                *slot += weight;
            }
        }
        if let Some(blink) = self.blink {
            for index in skeleton.driven.blink.into_iter().flatten() {
                self.shown[index] = self.shown[index].max(blink.at(self.time_s));
            }
        }
        if let Some(angles) = self.looks {
            drive_looks(skeleton, angles, &mut self.shown);
        }
        resolve(&skeleton.expressions, &skeleton.kinds, &mut self.shown);
        pose.show_expressions(skeleton, &self.shown);
    }

    /// Turns constrained nodes.
    pub fn constrain(&self, skeleton: &Skeleton, pose: &mut Pose) {
        constrain(skeleton, &mut pose.locals);
    }

    /// Swings chains for `dt` seconds, in fixed steps of 1/60 s with pose and place in between.
    pub fn swing(&mut self, skeleton: &Skeleton, world: &Mat4, pose: &mut Pose, dt: f32) {
        self.springs.advance(skeleton, &mut pose.locals, &Place::of(world), dt);
    }

    /// One step of chains of any length, without what lies between: what reference trajectories are made of. The first call, and
    /// that after [`Springs::reset`], sets them to rest.
    pub fn swing_once(&mut self, skeleton: &Skeleton, world: &Mat4, pose: &mut Pose, dt: f32) {
        self.springs.step(skeleton, &mut pose.locals, &Place::of(world), dt);
    }

    /// Takes swinging chains along where the character jumps from one place to another.
    pub fn warp(&mut self, skeleton: &Skeleton, from: &Mat4, to: &Mat4) {
        self.springs.warp(skeleton, &Place::of(from), &Place::of(to));
    }

    /// Asks for an expression, from now on: a weight of 0..1 that is added to what clips say; 0 asks for nothing.
    ///
    /// # Errors
    /// [`Error::Argument`](crate::Error::Argument) for a name that the character lacks; the message lists the known names.
    pub fn set_expression(&mut self, skeleton: &Skeleton, name: &str, weight: f32) -> Result<()> {
        let index = skeleton.expression(name).ok_or_else(|| unknown(name, &skeleton.expressions))?;
        if weight > 0.0 {
            self.asked.insert(index, weight.min(1.0));
        } else {
            self.asked.remove(&index);
        }
        Ok(())
    }

    /// What shows of each expression, after overrides: name and weight.
    pub fn shown<'a>(&'a self, skeleton: &'a Skeleton) -> impl Iterator<Item = (&'a str, f32)> {
        skeleton.expressions.iter().map(|e| e.name.as_str()).zip(self.shown.iter().copied())
    }

    /// Where the gaze goes from the head: yaw (left +) and pitch (down +), radians; `None` where nothing says it.
    #[must_use]
    pub fn gaze_angles(&self) -> Option<[f32; 2]> {
        self.looks
    }

    /// Time since the beginning, seconds: what blinking goes by.
    #[must_use]
    pub fn time_s(&self) -> f64 {
        self.time_s
    }
}

/// `from` where it has all, else `rest`.
fn copy<T: Copy>(from: &[T], rest: &[T], to: &mut Vec<T>) {
    to.clear();
    to.extend_from_slice(if from.len() == rest.len() { from } else { rest });
}
