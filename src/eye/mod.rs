//! Eyes: their measures, where an eye is and looks, found from its mesh, and how its pupil follows light. Needs no GPU.

mod dimensions;
mod frame;
mod lids;
mod painted;
mod placed;
mod plane;
mod pupil;
mod sphere;

pub use dimensions::EyeDimensions;
pub use frame::{EyeBone, EyeFrame, NoEyeFrame};
pub use lids::Lids;
pub use placed::{EyeRow, MOST_EYES};
pub use pupil::PupilReflex;

pub(crate) use painted::Painted;
pub(crate) use placed::{EyeVertex, Eyes, parts_at_rest};
