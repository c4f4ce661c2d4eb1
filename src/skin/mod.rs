//! Skin: how light scatters below a surface, and what is measured of a mesh for that.

mod curvature;
mod disc;
mod gaussians;
mod measures;
mod presets;
mod profile;
mod seams;
mod specular;
mod tables;
mod thickness;

pub use presets::ProfilePreset;
pub use profile::{DiffusionProfile, Texturing, Transmission};

pub(crate) use disc::{MOST_TAPS, discs};
pub(crate) use measures::measured;
pub(crate) use seams::Seams;
pub(crate) use specular::Speculars;
pub(crate) use tables::{TABLE_SIZE, skin_table};
