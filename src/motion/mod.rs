//! What moves a character: poses and expressions.

mod driven;
mod expression;
mod pose;
mod stance;

pub use driven::Driven;
pub use pose::Pose;
pub use stance::Stance;
