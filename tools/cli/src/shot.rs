//! `SHOT.json`: a view in numbers, so that a picture can be taken again exactly.

use std::path::Path;

use glam::Vec3;
use hikage::View;
use hikage::color::LinearRgb;
use hikage::scene::{Ambient, Camera, DirectionalLight, Lights};
use serde::Deserialize;

use crate::args::{self, MAX_SIDE};
use crate::failure::Failure;

/// A shot file. Every field may be missing; a field that is not known is an error.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Shot {
    /// Width and height, pixels.
    pub(crate) size: Option<[u32; 2]>,
    pub(crate) camera: Option<ShotCamera>,
    pub(crate) light: Option<ShotLight>,
    /// Linear RGB of the light from everywhere.
    ambient: Option<[f32; 3]>,
    /// `none` or `#RRGGBB`.
    background: Option<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ShotCamera {
    eye: Option<[f32; 3]>,
    target: Option<[f32; 3]>,
    up: Option<[f32; 3]>,
    /// Vertical field of view, degrees.
    fov_y_deg: Option<f32>,
    near: Option<f32>,
    /// Accepted for the sake of other programs; our far plane is infinite.
    far: Option<f32>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ShotLight {
    /// From the surface to the light, any length but 0.
    to_light: Option<[f32; 3]>,
    /// Linear RGB.
    color: Option<[f32; 3]>,
    intensity: Option<f32>,
}

impl Shot {
    /// Reads and checks a shot file.
    pub(crate) fn read(path: &Path) -> Result<Self, Failure> {
        let fail = |what: String| Failure::input(format!("{}: {what}", path.display()));
        let text = crate::setup::read_small(path)?;
        let shot: Self = serde_json::from_slice(&text).map_err(|e| fail(e.to_string()))?;
        shot.check().map_err(fail)?;
        Ok(shot)
    }

    fn check(&self) -> Result<(), String> {
        if let Some(size) = self.size
            && !size.iter().all(|s| (1..=MAX_SIDE).contains(s))
        {
            return Err(format!("size: is {} x {}, expected each from 1 to {MAX_SIDE}", size[0], size[1]));
        }
        let mut numbers = vec![("ambient", self.ambient.map(Vec::from), 0.0)];
        if let Some(camera) = &self.camera {
            numbers.push(("camera.eye", camera.eye.map(Vec::from), f32::MIN));
            numbers.push(("camera.target", camera.target.map(Vec::from), f32::MIN));
            numbers.push(("camera.up", camera.up.map(Vec::from), f32::MIN));
            if camera.fov_y_deg.is_some_and(|f| !(0.01..=179.0).contains(&f)) {
                return Err("camera.fov_y_deg: expected 0.01 to 179".into());
            }
            for (name, distance) in [("camera.near", camera.near), ("camera.far", camera.far)] {
                if distance.is_some_and(|d| !(1e-4..=1e6).contains(&d)) {
                    return Err(format!("{name}: expected 0.0001 to 1000000"));
                }
            }
            if camera.near.zip(camera.far).is_some_and(|(near, far)| near >= far) {
                return Err("camera.far: expected more than camera.near".into());
            }
        }
        if let Some(light) = &self.light {
            numbers.push(("light.to_light", light.to_light.map(Vec::from), f32::MIN));
            numbers.push(("light.color", light.color.map(Vec::from), 0.0));
            numbers.push(("light.intensity", light.intensity.map(|i| vec![i]), 0.0));
            if light.to_light.is_some_and(|d| Vec3::from(d).try_normalize().is_none()) {
                return Err("light.to_light: expected a direction, found length 0".into());
            }
        }
        for (name, values, low) in numbers {
            // serde_json turns numbers that do not fit into infinities.
            if values.is_some_and(|v| !v.iter().all(|n| (low..=1e6).contains(n) && *n >= -1e6)) {
                let low = low.max(-1e6);
                return Err(format!("{name}: expected numbers from {low} to 1000000"));
            }
        }
        if let Some(background) = &self.background {
            args::background(background).map_err(|e| format!("background: {e}"))?;
        }
        Ok(())
    }

    /// Writes the given fields over those of `view`, whose size stays.
    pub(crate) fn apply(&self, view: &mut View, lights: &mut Lights) -> Result<(), String> {
        if let Some(camera) = &self.camera {
            let to = &mut view.camera;
            *to = Camera {
                eye: camera.eye.map_or(to.eye, Vec3::from),
                target: camera.target.map_or(to.target, Vec3::from),
                up: camera.up.map_or(to.up, Vec3::from),
                fov_y_rad: camera.fov_y_deg.map_or(to.fov_y_rad, f32::to_radians),
                near: camera.near.unwrap_or(to.near),
                matrices: None,
            };
            let forward = to.target - to.eye;
            if forward.cross(to.up).length() <= 1e-6 * forward.length() * to.up.length() {
                return Err("camera: eye, target and up lie on one line".into());
            }
        }
        if let Some(light) = &self.light {
            let to = &mut lights.directional;
            *to = DirectionalLight {
                to_light: light.to_light.map_or(to.to_light, |d| Vec3::from(d).normalize_or(Vec3::Z)),
                color: light.color.map_or(to.color, LinearRgb),
                intensity: light.intensity.unwrap_or(to.intensity),
            };
        }
        if let Some(ambient) = self.ambient {
            lights.ambient = Ambient::uniform(LinearRgb(ambient));
        }
        if let Some(Ok(background)) = self.background.as_deref().map(args::background) {
            view.background = background;
        }
        Ok(())
    }
}
