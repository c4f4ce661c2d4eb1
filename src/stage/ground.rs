//! What actors stand on.

use std::sync::Arc;

use glam::Vec3;

use crate::color::LinearRgb;
use crate::scene::Image;
use crate::{Error, Result};

/// A round piece of flat ground that fades out towards its rim. It takes the light and the shadow of the stage in two tones,
/// as characters do.
#[derive(Clone, Debug, PartialEq)]
pub struct Ground {
    /// Its middle, world space, metres. Default: the origin.
    pub middle: Vec3,
    /// Distance from the middle at which it has gone, metres; it begins to fade at half of that. Range above 0. Default: 4.
    pub radius_m: f32,
    /// Colour in full light, linear; a texture is multiplied by it. Default: light grey.
    pub color: LinearRgb,
    /// What the colour is multiplied by in shade, linear. Default: a cool grey.
    pub shade: LinearRgb,
    /// An sRGB picture that is repeated over it. Default: none.
    pub texture: Option<Arc<Image>>,
    /// Size of a repetition of the texture, metres. Range above 0. Default: 1.
    pub texture_m: f32,
    /// Lines on it. Default: none.
    pub grid: Option<Grid>,
    /// Draws nothing but the shadow on it, over whatever is there. Default: false.
    pub shadow_only: bool,
}

/// Lines on a ground, along the axes of the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Distance between two lines, metres. Range above 0. Default: 0.5.
    pub spacing_m: f32,
    /// Width of a line, metres. Range 0... Default: 0.01.
    pub width_m: f32,
    /// Colour in full light, linear. Default: a darker grey.
    pub color: LinearRgb,
}

impl Default for Ground {
    fn default() -> Self {
        Self {
            middle: Vec3::ZERO,
            radius_m: 4.0,
            color: LinearRgb([0.62, 0.62, 0.64]),
            shade: LinearRgb([0.45, 0.48, 0.62]),
            texture: None,
            texture_m: 1.0,
            grid: None,
            shadow_only: false,
        }
    }
}

impl Default for Grid {
    fn default() -> Self {
        Self { spacing_m: 0.5, width_m: 0.01, color: LinearRgb([0.38, 0.39, 0.42]) }
    }
}

impl Ground {
    /// Refuses numbers that are none.
    pub(crate) fn check(&self) -> Result<()> {
        let colors = [self.color, self.shade, self.grid.unwrap_or_default().color];
        let is_color = |c: &LinearRgb| c.0.iter().all(|x| x.is_finite() && *x >= 0.0);
        let grid = self.grid.unwrap_or_default();
        let faults = [
            ("middle", self.middle.is_finite(), "a place"),
            ("radius_m", self.radius_m > 0.0 && self.radius_m.is_finite(), "above 0"),
            ("texture_m", self.texture_m > 0.0 && self.texture_m.is_finite(), "above 0"),
            ("grid.spacing_m", grid.spacing_m > 0.0 && grid.spacing_m.is_finite(), "above 0"),
            ("grid.width_m", grid.width_m >= 0.0 && grid.width_m.is_finite(), "0 or above"),
            ("color", colors.iter().all(is_color), "colours of finite numbers, 0 or above"),
        ];
        match faults.into_iter().find(|(_, is_good, _)| !is_good) {
            Some((what, _, expected)) => {
                let message = format!("is out of its range; expected {expected}");
                Err(Error::Argument { what: format!("ground.{what}"), message })
            }
            None => Ok(()),
        }
    }
}
