//! What moves a character: poses and expressions.

mod driven;
mod expression;
mod pose;
mod shifts;
mod stance;

pub use driven::Driven;
pub use pose::Pose;
pub use shifts::Shifts;
pub use stance::Stance;
