//! Stylized (NPR) shading of anime characters on wgpu.
pub mod color;
mod error;
pub mod material;
pub mod scene;
pub mod import {
    //! stub
}
pub use error::{Error, Result};
