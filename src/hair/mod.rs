//! Hair as strips: which triangles belong to one lock or card, where it starts and ends, and which way it runs. Needs no GPU.

mod axis;
mod flow;
mod patches;
mod strands;
mod strips;

pub(crate) use flow::holds_flow;
pub(crate) use strands::tangents;
pub use strips::{HairStrips, MAX_STRIPS, NoStrips, StripSort};
