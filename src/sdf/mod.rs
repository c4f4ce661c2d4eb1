//! Threshold maps of painted face shadows: drawings in, one number a texel out. Needs no GPU.
//!
//! An artist draws the lit part of a face at a few angles of the light, as pictures ([`MaskFile`]) or vector shapes
//! ([`Drawing`]); [`Guide`] makes a start from the mesh. [`bake`] finds for each texel the angle at which it turns dark,
//! by the exact distances to the borders of the two keys round it, so that the border of light and shade glides from one
//! drawing to the next. [`Profile`] says what a shader measures the angle in, [`Layout`] which channel holds what;
//! [`check`](check()) names what will look wrong. A [`Project`] (`face.sdf.toml`) holds all of it, a [`Session`] bakes one
//! edited key anew:
//!
//! ```no_run
//! use hikage::sdf::Project;
//!
//! let project = Project::read("face/face.sdf.toml")?;
//! let sides = project.bake(false)?.into_sides();
//! hikage::picture::write_atomic("face.png", &project.encode(&sides)?)?;
//! # Ok::<(), hikage::Error>(())
//! ```
//!
//! # Limits
//! Sides of [`MAX_SIDE`] texels, [`MAX_KEYS`] keys a side. Baking takes at most 10 bytes a texel beside the files in work,
//! whatever the number of keys. One number holds one border: lit parts may only shrink as the angle grows.

mod band;
mod border;
mod check;
mod columns;
mod distance;
mod face_map;
mod guide;
mod layout;
mod mask;
mod profile;
mod project;
mod session;
mod shapes;
mod source;
mod stack;
mod svg_path;
mod threshold;

pub use check::{Remark, check};
pub use columns::MAX_SIDE;
pub use distance::{NEVER, distance_squared};
pub use face_map::{FaceLayout, FaceMap, MAX_PITCHES, Texels};
pub use guide::{Contrast, FaceStyle, Feature, Guide, KEPT, Landmarks, wireframe};
pub use layout::{ChannelSource, Layout, Sides};
pub use mask::{LIT, Mask};
pub use profile::Profile;
pub use project::{BakedSides, CapFront, DrawnKey, Project, ProjectKey, Size};
pub use session::Session;
pub use shapes::{Drawing, Ellipse, Shape, ShapeKey, ShapeKind, Tween};
pub use source::{MaskChannel, MaskFile};
pub use stack::{Contradiction, MAX_KEYS};
pub use threshold::{BakeOptions, Baked, Blend, Depth, Key, ThresholdMap, bake};
