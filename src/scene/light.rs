//! Lights of a stage: one directional key light, ambient light, a few punctual lights.

use glam::Vec3;

use super::Environment;
use crate::color::LinearRgb;
use crate::{Error, Result};

/// How many punctual lights a stage may have.
pub const MAX_PUNCTUAL_LIGHTS: usize = 4;

/// All lights of a stage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lights {
    /// The key light.
    pub directional: DirectionalLight,
    /// Light from everywhere.
    pub ambient: Ambient,
    /// A picture of the light from everywhere, in the place of `ambient`. Default: `None`.
    pub environment: Option<Environment>,
    /// Point and spot lights; at most [`MAX_PUNCTUAL_LIGHTS`].
    ///
    /// Each cuts a band of its own, adds the lit colour where it shines and casts no shadow; on its far side it shows the shade
    /// colour only as far as it outshines the key light, whose shade that is.
    pub punctual: Vec<PunctualLight>,
    /// Which of their two sets materials with a [`ShadeRamp`](crate::material::ShadeRamp) show: 0 warm, 1 cool, as a time of
    /// day sets it. Range 0..1. Default: `None`, by the colour of the key light.
    pub coolness: Option<f32>,
}

impl Lights {
    /// 0 for warm light, 1 for cool light: 1/2 for white, and by the step from red to blue else.
    #[must_use]
    pub fn coolness(&self) -> f32 {
        let [r, g, b] = self.directional.color.0;
        let by_color = 0.5 + 1.5 * (b - r) / r.max(g).max(b).max(1e-6);
        self.coolness.unwrap_or(by_color).clamp(0.0, 1.0)
    }

    /// Light from above and from below: `ambient`, or what the environment sheds there.
    pub(crate) fn hemisphere(&self) -> Ambient {
        let Some(of) = &self.environment else { return self.ambient };
        let [sky, ground] = [1.0, -1.0].map(|y: f32| {
            let [constant, linear, .., squares, _, differences] = of.radiance.irradiance();
            // At the poles 3z² - 1 and x² - y² are -1.
            let at = |c: usize| constant[c] + linear[c] * y - squares[c] - differences[c];
            LinearRgb(std::array::from_fn(|c| at(c).max(0.0) * of.strength))
        });
        Ambient { sky, ground }
    }

    /// Refuses lights that have no direction, or numbers that are none.
    pub(crate) fn check(&self) -> Result<()> {
        let fault = |what: String, message: &str| Err(Error::Argument { what, message: message.to_owned() });
        let directional = &self.directional;
        if directional.to_light.try_normalize().is_none() {
            return fault("directional light".to_owned(), "has no direction; expected a vector from the surface to it");
        }
        let ambient = [self.ambient.sky, self.ambient.ground];
        let is_light = |color: &LinearRgb, strength: f32| color.scaled(strength).0.iter().all(|c| c.is_finite());
        if !is_light(&directional.color, directional.intensity) || !ambient.iter().all(|c| is_light(c, 1.0)) {
            return fault("lights".to_owned(), "a colour or a strength is not finite");
        }
        self.environment.as_ref().map_or(Ok(()), Environment::check)?;
        for (i, light) in self.punctual.iter().enumerate() {
            let spot = light.spot.is_none_or(|s| s.direction.try_normalize().is_some() && s.outer_rad > 0.0);
            if !(light.position.is_finite()
                && light.range.is_finite()
                && is_light(&light.color, light.intensity)
                && spot)
            {
                return fault(
                    format!("punctual light {i}"),
                    "expected a finite place, colour, strength and range, and of a spot light a direction and an angle",
                );
            }
        }
        if self.punctual.len() > MAX_PUNCTUAL_LIGHTS {
            let message = format!("are {}; expected at most {MAX_PUNCTUAL_LIGHTS}", self.punctual.len());
            return fault("punctual lights".to_owned(), &message);
        }
        Ok(())
    }
}

/// Light from far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalLight {
    /// Unit direction from the surface to the light, world space. Default: from the front, upper left of the picture.
    pub to_light: Vec3,
    /// Colour, linear. Default: white.
    pub color: LinearRgb,
    /// Strength; 1 shows a material's lit colour exactly. Range 0... Default: 1.
    pub intensity: f32,
}

impl Default for DirectionalLight {
    fn default() -> Self {
        Self { to_light: Vec3::new(-0.35, 0.55, 0.76).normalize(), color: LinearRgb::WHITE, intensity: 1.0 }
    }
}

/// Light from everywhere, as a hemisphere: `sky` on surfaces that face up, `ground` on those that face down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ambient {
    /// Radiance from above, linear. Default: 0.1 grey.
    pub sky: LinearRgb,
    /// Radiance from below, linear. Default: 0.1 grey.
    pub ground: LinearRgb,
}

impl Default for Ambient {
    fn default() -> Self {
        Self::uniform(LinearRgb::splat(0.1))
    }
}

impl Ambient {
    /// The same light from every direction.
    #[must_use]
    pub const fn uniform(color: LinearRgb) -> Self {
        Self { sky: color, ground: color }
    }
}

/// A point or spot light (`KHR_lights_punctual` attenuation).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PunctualLight {
    /// Position, metres, world space.
    pub position: Vec3,
    /// Colour, linear.
    pub color: LinearRgb,
    /// Strength at one metre; 1 shows a material's lit colour there. Range 0...
    pub intensity: f32,
    /// Distance at which it ends, metres; 0 for none.
    pub range: f32,
    /// Cone of a spot light; `None` shines in all directions.
    pub spot: Option<SpotCone>,
}

/// Cone of a spot light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotCone {
    /// Unit direction in which it shines, world space.
    pub direction: Vec3,
    /// Half-angle of full strength, radians. Range 0..`outer_rad`.
    pub inner_rad: f32,
    /// Half-angle at which it ends, radians. Range `inner_rad`..π/2.
    pub outer_rad: f32,
}
