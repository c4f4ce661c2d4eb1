//! Eyes: their measures, and where an eye is and looks, found from its mesh. Needs no GPU.

mod dimensions;
mod frame;
mod sphere;

pub use dimensions::EyeDimensions;
pub use frame::{EyeBone, EyeFrame, NoEyeFrame};
