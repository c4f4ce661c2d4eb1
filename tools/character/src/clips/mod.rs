//! Animation clips of the humanoid, made by code (CC0): standing, walk, run, a wave, a look round.
//!
//! Each clip is a function from time to a posture in terms of the body; legs follow the feet by inverse kinematics. All
//! start near one standing posture, so that a player may fade from any to any.

mod clip;
mod curve;
mod foot;
mod gait;
mod idle;
mod posture;
mod turn;
mod wave;

pub use clip::{Clip, Track};

use crate::skeleton::Skeleton;

/// Names of the clips.
pub const NAMES: &[&str] = &["idle", "walk", "run", "wave", "turn"];

/// The clip of this name: one of [`NAMES`].
#[must_use]
pub fn build(name: &str) -> Option<Clip> {
    let skeleton = Skeleton::humanoid();
    match name {
        "idle" => Some(idle::idle(&skeleton)),
        "walk" => Some(gait::walk(&skeleton)),
        "run" => Some(gait::run(&skeleton)),
        "wave" => Some(wave::wave(&skeleton)),
        "turn" => Some(turn::turn(&skeleton)),
        _ => None,
    }
}

/// All clips, in the order of [`NAMES`].
#[must_use]
pub fn all() -> Vec<Clip> {
    NAMES.iter().filter_map(|name| build(name)).collect()
}
