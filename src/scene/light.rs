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

    /// Luminance of a white surface at a place of the world that faces `n`, unit, where this share of the key light arrives.
    pub(crate) fn luminance(&self, position: Vec3, n: Vec3, key_light: f32) -> f32 {
        let DirectionalLight { to_light, color, intensity } = self.directional;
        let key = color.luminance() * intensity * key_light * to_light.normalize_or(Vec3::Z).dot(n).max(0.0);
        let around = match &self.environment {
            Some(environment) => LinearRgb(environment.irradiance(n).to_array()).luminance(),
            None => 0.5 * (self.ambient.sky.luminance() + self.ambient.ground.luminance()),
        };
        let lamp = |light: &PunctualLight| {
            let (to_light, share) = light.arriving(position);
            light.color.luminance() * light.intensity * share * to_light.dot(n).max(0.0)
        };
        key + around + self.punctual.iter().take(MAX_PUNCTUAL_LIGHTS).map(lamp).sum::<f32>()
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

impl PunctualLight {
    /// Direction to it from a place of the world, unit, and the share of its light that arrives there, as
    /// `wgsl/lib/light.wgsl` has it.
    fn arriving(&self, position: Vec3) -> (Vec3, f32) {
        let to_light = self.position - position;
        let distance_sq = to_light.length_squared();
        let to_light = to_light * distance_sq.max(1e-8).sqrt().recip();
        let ratio_sq = distance_sq / (self.range * self.range);
        let window = if self.range > 0.0 {
            (1.0 - ratio_sq * ratio_sq).max(0.0)
        } else {
            1.0
        };
        let cone = self.spot.map_or(1.0, |spot| {
            let [scale, offset] = spot.scale_and_offset();
            (-to_light.dot(spot.direction) * scale + offset).clamp(0.0, 1.0)
        });
        (to_light, window / distance_sq.max(1e-4) * cone * cone)
    }
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

impl SpotCone {
    /// What the cosine of an angle is multiplied by, and what is added, for the root of the light's share there
    /// (`KHR_lights_punctual`, "Inner and Outer Cone Angles").
    pub(crate) fn scale_and_offset(&self) -> [f32; 2] {
        let outer_cos = self.outer_rad.cos();
        let scale = 1.0 / (self.inner_rad.cos() - outer_cos).max(1e-3);
        [scale, -outer_cos * scale]
    }
}

#[cfg(test)]
mod tests {
    use std::f32::consts::FRAC_PI_2;

    use super::*;
    use crate::scene::Radiance;

    fn near(found: f32, expected: f32) {
        assert!((found - expected).abs() < 1e-4, "{found} {expected}");
    }

    /// No light but these lamps.
    fn dark(punctual: Vec<PunctualLight>) -> Lights {
        let directional = DirectionalLight { intensity: 0.0, ..DirectionalLight::default() };
        Lights { directional, ambient: Ambient::uniform(LinearRgb::BLACK), punctual, ..Lights::default() }
    }

    #[test]
    fn a_face_is_lit_by_the_key_light_and_from_around() {
        let lights = Lights {
            directional: DirectionalLight {
                to_light: Vec3::new(0.0, 3.0, 4.0),
                color: LinearRgb([1.0, 0.5, 0.0]),
                intensity: 2.0,
            },
            ambient: Ambient { sky: LinearRgb::splat(0.3), ground: LinearRgb::splat(0.1) },
            ..Lights::default()
        };
        let color = 0.2126 + 0.5 * 0.7152;
        near(lights.luminance(Vec3::ZERO, Vec3::Z, 1.0), 2.0 * color * 0.8 + 0.2);
        near(lights.luminance(Vec3::ZERO, Vec3::Z, 0.25), 0.5 * color * 0.8 + 0.2);
        near(lights.luminance(Vec3::ZERO, Vec3::NEG_Z, 1.0), 0.2);
        // A picture of the light stands in the place of sky and ground, and turns.
        let uniform = Lights { environment: Some(Environment::uniform([0.4; 3])), ..lights };
        let found = uniform.luminance(Vec3::ZERO, Vec3::NEG_Z, 1.0);
        assert!((found - 0.4).abs() < 2e-3, "{found}");
        // From the left, and a quarter of a turn on from behind.
        let left = (0..64 * 32).map(|i| [f32::from(u8::from(i % 64 >= 32)); 3]).collect();
        let left = Environment::new(Radiance::new(64, 32, left).expect("a picture"));
        for (turn_rad, from) in [(0.0, Vec3::X), (FRAC_PI_2, Vec3::NEG_Z)] {
            let environment = Some(Environment { turn_rad, strength: 2.0, ..left.clone() });
            let lights = Lights { environment, ..dark(Vec::new()) };
            for (n, expected) in [(from, 2.0), (-from, 0.0), (Vec3::Y, 1.0)] {
                let found = lights.luminance(Vec3::ZERO, n, 1.0);
                assert!((found - expected).abs() < 0.02, "{from} on {n}: {found}");
            }
        }
    }

    #[test]
    fn lamps_fade_with_distance_and_beside_their_cone() {
        let point = PunctualLight {
            position: Vec3::new(0.0, 1.0, 2.0),
            color: LinearRgb::WHITE,
            intensity: 4.0,
            range: 0.0,
            spot: None,
        };
        let of = |light| dark(vec![light]).luminance(Vec3::Y, Vec3::Z, 1.0);
        near(of(point), 1.0);
        near(of(PunctualLight { range: 4.0, ..point }), 1.0 - 1.0 / 16.0);
        near(of(PunctualLight { range: 1.0, ..point }), 0.0);
        near(of(PunctualLight { position: Vec3::new(0.0, 1.0, -2.0), ..point }), 0.0);
        let spot = |angle: f32| {
            let direction = Vec3::new(angle.sin(), 0.0, -angle.cos());
            of(PunctualLight { spot: Some(SpotCone { direction, inner_rad: 0.2, outer_rad: 0.6 }), ..point })
        };
        near(spot(0.1), 1.0);
        near(spot(0.7), 0.0);
        let (at, outer) = (0.4f32.cos(), 0.6f32.cos());
        near(spot(0.4), ((at - outer) / (0.2f32.cos() - outer)).powi(2));
        // In the lamp itself the light is strong and a number.
        assert!(of(PunctualLight { position: Vec3::Y, ..point }).is_finite());
    }
}
