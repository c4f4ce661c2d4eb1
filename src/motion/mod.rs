//! What moves a character: poses and expressions.

mod expression;
mod pose;

pub use pose::Pose;
