//! Tables that skin is shaded with, made from its profile.
//!
//! One picture of 64 x 99 texels, linear RGB, alpha 1. The texel i of a row stands for i/63 of the row's axis.
//!
//! | rows | what | along a row, 0 to 1 | down the rows |
//! |---|---|---|---|
//! | 0..64 | light on a round surface, in the place of `max(0, N.L)` | (N.L + 1) / 2 | curvature 0 to 1/mm |
//! | 64..96 | light within the penumbra of a shadow | share of light | 1 / width, 0 to 0.5/mm |
//! | 96 | transmittance of the profile | sqrt(thickness / thickness range) | |
//! | 97 | transmittance of a volume | the same | |
//! | 98 | directional albedo of the specular, one number for all colours | N.V | |
//!
//! Lengths are mm of the real world; `DiffusionProfile::thickness_range_mm` is the thickness range.

use rayon::prelude::*;

use super::DiffusionProfile;
use super::gaussians::GaussianSum;
use super::specular::{Speculars, directional_albedo};

/// Texels of a table, across and down.
pub(crate) const TABLE_SIZE: [u32; 2] = [WIDTH as u32, ALBEDO_ROW as u32 + 1];

const WIDTH: usize = 64;

/// Rows of curvature, the first of which is flat.
const CURVATURE_ROWS: usize = 64;

/// Rows of penumbra follow, the first of which is endlessly wide.
const PENUMBRA_ROWS: usize = 32;

/// Curvature of the last of its rows, 1/mm.
const HIGHEST_CURVATURE: f64 = 1.0;

/// Inverse width of the penumbra in the last of its rows, 1/mm.
const NARROWEST_PENUMBRA: f64 = 0.5;

/// Lit part of a penumbra that is kept as the ramp, so that red has room to bleed into the rest.
const KEPT_PENUMBRA: f64 = 0.5;

const PROFILE_ROW: usize = CURVATURE_ROWS + PENUMBRA_ROWS;
const VOLUME_ROW: usize = PROFILE_ROW + 1;
const ALBEDO_ROW: usize = VOLUME_ROW + 1;

/// Least N.V of the albedo: at 0 nothing is seen of a surface.
const LEAST_N_DOT_V: f64 = 1e-3;

/// The table of a profile and a specular, row by row, linear RGBA.
pub(crate) fn skin_table(profile: &DiffusionProfile, speculars: &Speculars) -> Vec<[f32; 4]> {
    let gaussians = GaussianSum::of(profile);
    let rows = (0..=ALBEDO_ROW).into_par_iter();
    rows.flat_map_iter(|y| row(profile, speculars, &gaussians, y)).collect()
}

fn row(profile: &DiffusionProfile, speculars: &Speculars, gaussians: &GaussianSum, y: usize) -> [[f32; 4]; WIDTH] {
    match y {
        0 => texels(|x| [(2.0 * x - 1.0).max(0.0) as f32; 3]),
        1..CURVATURE_ROWS => {
            let rings = gaussians.rings(part(y, CURVATURE_ROWS) * HIGHEST_CURVATURE);
            texels(|x| {
                let theta = (2.0 * x - 1.0).acos();
                rings.each_ref().map(|ring| ring.diffused(theta) as f32)
            })
        }
        CURVATURE_ROWS..PROFILE_ROW => {
            let width_mm = (part(y - CURVATURE_ROWS, PENUMBRA_ROWS) * NARROWEST_PENUMBRA).recip();
            texels(|x| gaussians.penumbra(x, width_mm, KEPT_PENUMBRA).map(|v| v as f32))
        }
        PROFILE_ROW => texels(|x| profile.transmittance(thickness(profile, x))),
        VOLUME_ROW => texels(|x| profile.transmittance_of_volume(thickness(profile, x))),
        _ => texels(|x| [directional_albedo(speculars, x.max(LEAST_N_DOT_V)) as f32; 3]),
    }
}

/// Thickness, mm, at x of a row: fine where it is thin.
fn thickness(profile: &DiffusionProfile, x: f64) -> f32 {
    (x * x) as f32 * profile.thickness_range_mm()
}

fn texels(of: impl Fn(f64) -> [f32; 3]) -> [[f32; 4]; WIDTH] {
    std::array::from_fn(|i| {
        let [r, g, b] = of(part(i, WIDTH));
        [r, g, b, 1.0]
    })
}

/// Place of one of several texels along its axis, 0 to 1.
fn part(i: usize, of: usize) -> f64 {
    i as f64 / (of - 1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::SkinSpecular;

    const DUAL: Speculars =
        Speculars { model: SkinSpecular::DualGgx, roughness: 0.45, lobes: [0.75, 1.3], lobe_mix: 0.85, f0: 0.027_778 };

    fn at(table: &[[f32; 4]], x: usize, y: usize) -> [f32; 3] {
        let [r, g, b, alpha] = table[y * WIDTH + x];
        assert_eq!(alpha, 1.0);
        [r, g, b]
    }

    #[test]
    fn rows_hold_what_their_layout_says() {
        let profile = DiffusionProfile::default();
        let table = skin_table(&profile, &DUAL);
        let gaussians = GaussianSum::of(&profile);
        assert_eq!((table.len(), TABLE_SIZE), (64 * 99, [64, 99]));
        let near = |found: [f32; 3], expected: [f64; 3]| {
            assert!((0..3).all(|c| (f64::from(found[c]) - expected[c]).abs() < 1e-6), "{found:?} {expected:?}");
        };
        for i in 0..64 {
            let x = i as f64 / 63.0;
            let n_dot_l = 2.0 * x - 1.0;
            assert_eq!(at(&table, i, 0), [n_dot_l.max(0.0) as f32; 3]);
            for j in [1, 20, 63] {
                near(at(&table, i, j), gaussians.diffused(n_dot_l.acos(), j as f64 / 63.0));
            }
            near(at(&table, i, 64), [n_dot_l.max(0.0); 3]);
            for j in [1, 12, 31] {
                near(at(&table, i, 64 + j), gaussians.penumbra(x, 62.0 / j as f64, 0.5));
            }
            let thickness = (x * x * 24.0 * 0.757) as f32;
            near(at(&table, i, 96), profile.transmittance(thickness).map(f64::from));
            near(at(&table, i, 97), profile.transmittance_of_volume(thickness).map(f64::from));
            near(at(&table, i, 98), [directional_albedo(&DUAL, x.max(1e-3)); 3]);
        }
    }

    #[test]
    fn tables_of_all_that_is_valid_hold_shares() {
        let distances = [[0.001; 3], [1000.0; 3], [0.001, 1.0, 1000.0]];
        for scattering_distance_mm in distances {
            let profile = DiffusionProfile { scattering_distance_mm, ..DiffusionProfile::default() };
            for roughness in [0.05, 1.0] {
                let table = skin_table(&profile, &Speculars { roughness, ..DUAL });
                let all = table.as_flattened();
                assert!(all.iter().all(|v| (0.0..=1.000_001).contains(v)), "{scattering_distance_mm:?}");
            }
        }
    }
}
