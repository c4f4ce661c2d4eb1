//! What moves a character: poses and expressions.

mod expression;
mod pose;
mod stance;

pub use pose::Pose;
pub use stance::Stance;
