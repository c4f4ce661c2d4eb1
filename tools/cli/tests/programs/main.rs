//! The program `hikage`, run as its users run it.

#[path = "../../../../tests/support/gltf.rs"]
mod gltf;

mod animate;
mod cli;
mod determinism;
mod motion;
mod preset;
mod sdf;
mod stance;
