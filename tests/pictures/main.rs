//! Pictures that were looked at, and sweeps of many pictures.

#[path = "../support/scene.rs"]
mod support;

mod golden;
mod golden_looks;
mod golden_natural;
mod sweeps;
