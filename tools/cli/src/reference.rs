//! What the descriptions of all reference pictures state alike.

use glam::Vec3;
use hikage::color::LinearRgb;
use hikage::scene::{Camera, DirectionalLight};
use serde::Deserialize;

/// Where a picture is seen from.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct ReferenceCamera {
    pub(crate) eye: [f32; 3],
    target: [f32; 3],
    up: [f32; 3],
    fov_y_deg: f32,
    near: f32,
}

/// The light from one direction.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct ReferenceLight {
    dir_to_light: [f32; 3],
    color_linear: [f32; 3],
    unit_intensity: f32,
}

impl From<&ReferenceCamera> for Camera {
    fn from(of: &ReferenceCamera) -> Self {
        Self {
            eye: of.eye.into(),
            target: of.target.into(),
            up: of.up.into(),
            fov_y_rad: of.fov_y_deg.to_radians(),
            near: of.near,
            matrices: None,
        }
    }
}

impl From<&ReferenceLight> for DirectionalLight {
    fn from(of: &ReferenceLight) -> Self {
        Self {
            to_light: Vec3::from(of.dir_to_light).normalize_or(Vec3::Z),
            color: LinearRgb(of.color_linear),
            intensity: of.unit_intensity,
        }
    }
}
