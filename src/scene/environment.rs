//! Light from all around: a picture of it, measured or made.

use std::f32::consts::{PI, TAU};
use std::fmt;
use std::sync::{Arc, OnceLock};

use glam::{Quat, Vec3};
use rayon::prelude::*;

use crate::smoothstep::smoothstep;
use crate::{Error, Result};

/// Light from all around, in place of [`Ambient`](super::Ambient). Surfaces of [`Standard`](crate::material::Standard) and lit
/// hair mirror it; toon surfaces take what comes from above and below.
#[derive(Clone, Debug)]
pub struct Environment {
    /// The picture of it.
    pub radiance: Arc<Radiance>,
    /// Turns it about the vertical, from the front to the character's left, radians. Default: 0.
    pub turn_rad: f32,
    /// What its light is multiplied by. Range 0... Default: 1.
    pub strength: f32,
}

impl PartialEq for Environment {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.radiance, &other.radiance)
            && (self.turn_rad, self.strength) == (other.turn_rad, other.strength)
    }
}

impl Environment {
    /// That of a picture.
    #[must_use]
    pub fn new(radiance: impl Into<Arc<Radiance>>) -> Self {
        Self { radiance: radiance.into(), turn_rad: 0.0, strength: 1.0 }
    }

    /// A photographer's studio: grey walls, a large soft light from the upper left, a fill from the right, a light from above,
    /// and two strips from behind that draw contours.
    #[must_use]
    pub fn studio() -> Self {
        static STUDIO: OnceLock<Arc<Radiance>> = OnceLock::new();
        Self::new(Arc::clone(STUDIO.get_or_init(|| Radiance::made(studio).into())))
    }

    /// A clear afternoon sky over sunlit ground, without the sun itself, which is the key light's place.
    #[must_use]
    pub fn sky() -> Self {
        static SKY: OnceLock<Arc<Radiance>> = OnceLock::new();
        Self::new(Arc::clone(SKY.get_or_init(|| Radiance::made(sky).into())))
    }

    /// The same light from everywhere.
    #[must_use]
    pub fn uniform(color: [f32; 3]) -> Self {
        let [width, height] = [64, 32];
        let texels = vec![color; (width * height) as usize];
        Self::new(Radiance { width, height, texels, irradiance: OnceLock::new() })
    }

    /// Irradiance over pi on a surface that faces `n`, a direction of the world: what a white one shows.
    pub(crate) fn irradiance(&self, n: Vec3) -> Vec3 {
        self.radiance.irradiance_on(Quat::from_rotation_y(-self.turn_rad) * n).max(Vec3::ZERO) * self.strength
    }

    /// Refuses numbers that are none.
    pub(crate) fn check(&self) -> Result<()> {
        let fault = |message: String| Err(Error::Argument { what: "environment".to_owned(), message });
        if !self.turn_rad.is_finite() || !(0.0..=1e6).contains(&self.strength) {
            return fault(format!(
                "turn {} and strength {}; expected finite numbers, and a strength of 0 to 1e6",
                self.turn_rad, self.strength
            ));
        }
        Ok(())
    }
}

/// Radiance from all directions as an equirectangular picture, linear. Its middle is what a camera in front of the character
/// sees behind it (-Z), its right is to the right of that picture (+X), its top is above.
#[derive(Clone)]
pub struct Radiance {
    width: u32,
    height: u32,
    texels: Vec<[f32; 3]>,
    irradiance: OnceLock<[[f32; 3]; 9]>,
}

impl fmt::Debug for Radiance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Its texels would fill screens.
        f.debug_struct("Radiance").field("width", &self.width).field("height", &self.height).finish_non_exhaustive()
    }
}

/// Greatest radiance that is kept: half floats end at 65504.
pub const MAX_RADIANCE: f32 = 65000.0;

/// Size of the pictures that are made.
const MADE: [u32; 2] = [512, 256];

impl Radiance {
    /// Of texels from the top left, row by row; what is brighter than [`MAX_RADIANCE`] is darkened to it.
    ///
    /// # Errors
    /// [`Error::Argument`] for another number of texels than `width` times `height`, for none, and for a radiance that is not
    /// finite or negative.
    pub fn new(width: u32, height: u32, mut texels: Vec<[f32; 3]>) -> Result<Self> {
        texels.iter_mut().flatten().filter(|x| x.is_finite()).for_each(|x| *x = x.min(MAX_RADIANCE));
        let made = Self { width, height, texels, irradiance: OnceLock::new() };
        made.check()?;
        Ok(made)
    }

    /// Radiance by direction.
    fn made(of: fn(Vec3) -> Vec3) -> Self {
        let [width, height] = MADE;
        let texel = |i: u32| of(direction(width, height, i % width, i / width)).to_array();
        let texels = (0..width * height).into_par_iter().map(texel).collect();
        Self { width, height, texels, irradiance: OnceLock::new() }
    }

    /// Width and height, texels.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// The texels, from the top left, row by row.
    #[must_use]
    pub fn texels(&self) -> &[[f32; 3]] {
        &self.texels
    }

    fn check(&self) -> Result<()> {
        let fault = |message: String| Err(Error::Argument { what: "radiance".to_owned(), message });
        let expected = u64::from(self.width) * u64::from(self.height);
        if expected == 0 || expected != self.texels.len() as u64 {
            let (w, h) = (self.width, self.height);
            return fault(format!("{w} x {h} with {} texels; expected {expected} and not 0", self.texels.len()));
        }
        match self.texels.iter().flatten().position(|x| !(0.0..=MAX_RADIANCE).contains(x)) {
            None => Ok(()),
            Some(at) => {
                let (x, y) = (at as u32 / 3 % self.width, at as u32 / 3 / self.width);
                fault(format!("texel {x}, {y} is {:?}; expected finite numbers from 0", self.texels[at / 3]))
            }
        }
    }

    /// Irradiance over pi as spherical harmonics of three bands, their constants multiplied in: factors of 1, y, z, x, xy, yz,
    /// 3z²-1, xz, x²-y² (Ramamoorthi and Hanrahan 2001).
    pub(crate) fn irradiance(&self) -> &[[f32; 3]; 9] {
        self.irradiance.get_or_init(|| {
            let row = |y: u32| {
                let mut sums = [[0f64; 3]; 9];
                let theta = (y as f32 + 0.5) / self.height as f32 * PI;
                // Solid angle of a texel of this row.
                let weight = f64::from(PI / self.height as f32 * TAU / self.width as f32 * theta.sin());
                for x in 0..self.width {
                    let basis = harmonics(direction(self.width, self.height, x, y));
                    let texel = self.texels[(y * self.width + x) as usize];
                    for (sum, basis) in sums.iter_mut().zip(basis) {
                        for (sum, value) in sum.iter_mut().zip(texel) {
                            *sum += f64::from(value * basis) * weight;
                        }
                    }
                }
                sums
            };
            // Rows are added in their order, so that the sums are the same on any number of cores.
            let rows: Vec<_> = (0..self.height).into_par_iter().map(row).collect();
            let mut sums = [[0f64; 3]; 9];
            for row in rows {
                sums.iter_mut().flatten().zip(row.iter().flatten()).for_each(|(sum, x)| *sum += x);
            }
            // Few rows do not fill the sphere exactly; light that is the same everywhere stays so.
            let solid: f64 =
                (0..self.height).map(|y| ((f64::from(y) + 0.5) / f64::from(self.height) * f64::from(PI)).sin()).sum();
            let fill = 2.0 * f64::from(self.height) / (f64::from(PI) * solid);
            let scale: [f32; 9] = std::array::from_fn(|i| CONSTANTS[i] * CONSTANTS[i] * COSINE[i]);
            std::array::from_fn(|i| sums[i].map(|x| (x * fill) as f32 * scale[i]))
        })
    }

    /// The same on a surface that faces `n`.
    fn irradiance_on(&self, n: Vec3) -> Vec3 {
        harmonics(n).into_iter().zip(self.irradiance()).map(|(basis, c)| Vec3::from(*c) * basis).sum()
    }
}

/// Normalisation of the harmonics.
const CONSTANTS: [f32; 9] =
    [0.282_095, 0.488_603, 0.488_603, 0.488_603, 1.092_548, 1.092_548, 0.315_392, 1.092_548, 0.546_274];
/// The clamped cosine's own harmonics over pi, by band.
const COSINE: [f32; 9] = [1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 0.25, 0.25, 0.25, 0.25, 0.25];

fn harmonics(d: Vec3) -> [f32; 9] {
    let Vec3 { x, y, z } = d;
    [1.0, y, z, x, x * y, y * z, 3.0 * z * z - 1.0, x * z, x * x - y * y]
}

/// Direction of the middle of a texel.
fn direction(width: u32, height: u32, x: u32, y: u32) -> Vec3 {
    let (phi, theta) = (((x as f32 + 0.5) / width as f32 - 0.5) * TAU, (y as f32 + 0.5) / height as f32 * PI);
    Vec3::new(theta.sin() * phi.sin(), theta.cos(), -theta.sin() * phi.cos())
}

/// A soft rectangular light: 1 within, 0 beyond, in the plane that faces the middle. Half sizes are tangents.
fn soft_box(d: Vec3, middle: Vec3, half: [f32; 2], soft: f32) -> f32 {
    let forward = middle.normalize();
    let right = Vec3::Y.cross(forward).normalize_or(Vec3::X);
    let up = forward.cross(right);
    let ahead = d.dot(forward);
    if ahead <= 0.0 {
        return 0.0;
    }
    let edge = |x: f32, half: f32| 1.0 - smoothstep(half - soft, half + soft, (x / ahead).abs());
    edge(d.dot(right), half[0]) * edge(d.dot(up), half[1])
}

fn studio(d: Vec3) -> Vec3 {
    let walls = Vec3::new(0.155, 0.16, 0.172) * (0.75 + 0.35 * d.y);
    let floor = Vec3::new(0.20, 0.185, 0.17);
    let mut light = walls.lerp(floor, smoothstep(0.05, -0.25, d.y));
    let mut add = |middle, half, soft, color: [f32; 3]| light += Vec3::from(color) * soft_box(d, middle, half, soft);
    add(Vec3::new(-0.75, 0.65, 0.85), [0.45, 0.55], 0.12, [3.1, 3.0, 2.85]);
    add(Vec3::new(0.95, 0.15, 0.6), [0.3, 0.55], 0.15, [0.75, 0.8, 0.9]);
    add(Vec3::new(0.05, 1.0, -0.1), [0.55, 0.4], 0.15, [1.5, 1.5, 1.5]);
    add(Vec3::new(-0.9, 0.25, -0.75), [0.14, 0.8], 0.06, [2.6, 2.8, 3.2]);
    add(Vec3::new(0.9, 0.3, -0.8), [0.16, 0.8], 0.06, [3.6, 3.4, 3.1]);
    light
}

fn sky(d: Vec3) -> Vec3 {
    let up = d.y.max(0.0);
    let zenith = Vec3::new(0.16, 0.36, 0.85);
    let horizon = Vec3::new(0.75, 0.86, 1.0);
    let sky = horizon.lerp(zenith, up.powf(0.5));
    // Haze towards where the key light stands by default.
    let glow = d.dot(Vec3::new(-0.35, 0.55, 0.76).normalize()).max(0.0);
    let sky = sky + Vec3::new(1.0, 0.9, 0.72) * (0.6 * glow.powf(8.0) + 1.6 * glow.powf(64.0));
    let ground = Vec3::new(0.30, 0.27, 0.22) * (0.75 + 0.25 * (1.0 + d.y));
    sky.lerp(ground, smoothstep(0.01, -0.03, d.y))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_from_everywhere_is_the_same_on_every_side() {
        for of in [&*Environment::uniform([0.7, 0.2, 0.1]).radiance, &Radiance::made(|_| Vec3::new(0.7, 0.2, 0.1))] {
            for n in [Vec3::X, Vec3::NEG_Y, Vec3::new(0.6, -0.48, 0.64)] {
                let found = of.irradiance_on(n);
                assert!(found.abs_diff_eq(Vec3::new(0.7, 0.2, 0.1), 2e-3), "{n}: {found}");
            }
        }
    }

    #[test]
    fn a_hemisphere_of_light_falls_as_one_plus_the_cosine() {
        let half = Radiance::made(|d| Vec3::splat(f32::from(u8::from(d.x > 0.0))));
        for n in [Vec3::X, Vec3::Y, Vec3::NEG_X, Vec3::new(0.5, 0.5, -0.5f32.sqrt())] {
            // Three bands leave out what a step has beyond them.
            assert!((half.irradiance_on(n).x - (0.5 + 0.5 * n.x)).abs() < 0.01, "{n}");
        }
    }

    #[test]
    fn bad_radiance_is_refused_by_its_texel() {
        let fault =
            |texels: Vec<[f32; 3]>| Radiance::new(2, 1, texels).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(fault(vec![[0.0; 3], [0.0, f32::NAN, 0.0]]).contains("texel 1, 0"));
        assert!(fault(vec![[-1.0, 0.0, 0.0], [0.0; 3]]).contains("texel 0, 0"));
        assert!(fault(vec![[0.0; 3]]).contains("1 texels"));
        assert_eq!(Radiance::new(1, 1, vec![[1e30; 3]]).map(|r| r.texels[0]).ok(), Some([MAX_RADIANCE; 3]));
    }
}
