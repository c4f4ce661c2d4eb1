//! What moves a character: clips in layers, gaze, blinking, expressions, constraints, swinging chains, and the pose that they
//! make.
//!
//! [`Actor::update`](crate::Actor::update) does all of it once a frame. Where nothing is drawn, a [`Skeleton`] and an [`Animator`]
//! do the same. Everything is plain arithmetic in one order: the same calls give the same bits on any machine.

mod animator;
mod blink;
mod bone_names;
mod clip;
mod collide;
mod constraint;
mod driven;
mod expression;
mod gaze;
mod layer;
mod places;
mod player;
mod pose;
mod retarget;
mod rotation;
mod shifts;
mod skeleton;
mod spring;
mod stance;
mod track;

pub use animator::Animator;
pub use blink::Blink;
pub use clip::Clip;
pub use driven::Driven;
pub use gaze::{Gaze, GazeTarget};
pub use layer::{Blend, Curve, Fade, Layer, Mask, Play, RootMotion};
pub use player::Player;
pub use pose::Pose;
pub use shifts::Shifts;
pub use skeleton::Skeleton;
pub use spring::{SPRING_STEP_S, Springs, Wind};
pub use stance::Stance;
