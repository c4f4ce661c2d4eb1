//! Hikage (日陰, "shade"): stylized (NPR) shading of anime characters on wgpu.
//!
//! A VRM or glTF character goes in, a toon picture comes out: in an application's own window, or headless on a machine
//! without a GPU. The shading follows MToon 1.0 clause by clause; [`Look::Anime`] and look files ([`LookFile`]) add what it
//! has no words for.
//!
//! ```no_run
//! use hikage::{Actor, Gpu, Renderer, Stage, View, import, picture, scene::Framing};
//!
//! # fn main() -> Result<(), hikage::Error> {
//! let scene = import::load("character.vrm")?;
//! let gpu = Gpu::headless(None)?;
//! let renderer = Renderer::new(&gpu)?;
//! let mut stage = Stage::of([Actor::new(&renderer.upload(&scene)?)]);
//! let view = View::framed(&scene, Framing::Portrait, 0.4, [1024, 1024]);
//! let image = renderer.render(&mut stage, &view)?;
//! picture::write_png("character.png", &image)?;
//! # Ok(())
//! # }
//! ```
//!
//! An application with a device of its own calls [`Gpu::from_parts`], and each frame [`Renderer::prepare`] and
//! [`Renderer::draw`]. Characters move by [`motion`]: clips of any humanoid, gaze, blinking, hair that swings; [`Stage::update`] each
//! frame.
//!
//! # Conventions
//!
//! Right-handed, +Y up, metres, radians; a character faces +Z. Light directions point from the surface to the light. A
//! light of intensity 1 shows a material's lit colour exactly. Colours are linear RGB unless a type says sRGB. Matrices are
//! named `target_from_source`. Depth is reversed: 1 at the near plane, 0 at infinity.

// What macros of the library write begins with its name, here as in an application.
extern crate self as hikage;

pub mod bench;
pub mod color;
mod error;
pub mod eye;
pub mod golden;
pub mod gpu;
pub mod hair;
pub mod import;
mod look;
pub mod material;
pub mod motion;
pub mod picture;
pub mod render;
pub mod scene;
pub mod sdf;
mod sets;
pub mod skin;
mod smoothstep;
mod stage;
mod tone;

pub use error::{Error, Result};
pub use glam;
pub use gpu::{AdapterInfo, Gpu};
pub use look::{Anime, BandStyle, Look, LookFile, ProfileFile};
pub use render::{Background, Channel, Character, Far, GpuMemory, HostDepth, Output, Renderer, Target, View, shaders};
pub use stage::{Actor, Grid, Ground, Stage, StageShadow};
pub use wgpu;

/// What macros reach.
#[doc(hidden)]
pub mod __private {
    pub use serde;

    /// Values of a section as a look file would write them.
    pub fn table(section: &impl serde::Serialize) -> toml::Table {
        toml::Table::try_from(section).unwrap_or_default()
    }
}

/// The code of the README compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
