//! Stylized (NPR) shading of anime characters on wgpu.
pub mod color;
mod error;
pub mod material;
pub mod scene;
pub mod import;
pub use error::{Error, Result};
