//! Stylized (NPR) shading of anime characters on wgpu.
pub mod bench;
pub mod color;
mod error;
pub mod golden;
pub mod gpu;
pub mod material;
pub mod motion;
pub mod picture;
pub mod render;
pub mod scene;
pub mod import;
pub use error::{Error, Result};
pub use gpu::{AdapterInfo, Gpu};
pub use render::{Background, Channel, GpuMemory, GpuScene, Output, Renderer, View, shaders};
