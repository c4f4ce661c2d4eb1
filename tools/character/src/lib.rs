//! Hikage's own character: an anime heroine made by code, as a VRM 1.0 file that anybody may use (CC0).
//!
//! [`file()`] gives the file. Each module adds its parts, materials and textures to one [`model::Model`], which [`glb`]
//! writes. Same bytes each time.

#![allow(
    clippy::type_complexity,
    clippy::needless_range_loop,
    reason = "tables of measures and grids read best as such"
)]

mod animation;
pub mod body;
pub mod clips;
pub mod clothes;
pub mod glb;
pub mod hair;
pub mod head;
pub mod loft;
pub mod mesh;
pub mod model;
pub mod picture;
pub mod props;
mod ramp;
pub mod skeleton;
mod vrm;
pub mod vrma;

use model::Model;
use skeleton::Skeleton;

/// The whole character.
#[must_use]
pub fn build() -> Model {
    let mut model = Model { skeleton: Skeleton::humanoid(), ..Model::default() };
    body::add(&mut model);
    clothes::add(&mut model);
    head::add(&mut model);
    hair::add(&mut model);
    props::add(&mut model);
    ramp::add(&mut model);
    model
}

/// Bytes of `hikage.vrm`.
#[must_use]
pub fn file() -> Vec<u8> {
    glb::write(&build(), &[])
}

/// Bytes of `hikage.vrm` with all of [`clips::NAMES`] as animations of her bones.
#[must_use]
pub fn file_with_clips() -> Vec<u8> {
    glb::write(&build(), &clips::all())
}
