//! What needs no adapter: files, numbers, texts.

#[path = "../support/gltf.rs"]
mod gltf;

mod anime_look;
mod expressions;
mod eye;
mod golden_comparer;
mod hair;
mod import;
mod import_models;
mod import_mutate;
mod look_file;
mod motion;
mod profile_file;
mod sdf;
mod shaders;
