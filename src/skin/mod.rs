//! Skin: how light scatters below a surface, and what is measured of a mesh for that.

mod curvature;
mod disc;
mod gaussians;
mod line;
mod measures;
mod occlusion;
mod presets;
mod profile;
mod seams;
mod shape;
mod specular;
mod tables;
mod thickness;
mod tree;

pub use presets::ProfilePreset;
pub use profile::{DiffusionProfile, Texturing, Transmission};

pub(crate) use disc::{MOST_TAPS, discs};
pub(crate) use line::{MOST_LINE_TAPS, lines};
pub(crate) use measures::{Part, measured};
pub(crate) use seams::Seams;
pub(crate) use specular::Speculars;
pub(crate) use tables::{TABLE_SIZE, skin_table};
pub(crate) use tree::Tree;
