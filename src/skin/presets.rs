//! Diffusion profiles by name.

use super::DiffusionProfile;

/// A diffusion profile that has a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProfilePreset {
    /// Its name in look files.
    pub name: &'static str,
    /// What it is, and where its numbers come from.
    pub doc: &'static str,
    /// Its numbers.
    pub profile: DiffusionProfile,
}

impl DiffusionProfile {
    /// Profiles that a look file may call by name.
    ///
    /// Milk and marble are those of Jensen et al. 2001, table of `sigma_s'`, `sigma_a` and diffuse albedo A: the free path
    /// `l = 1 / (sigma_s' + sigma_a)` gives `d = l / s(A)` with `s(A) = 1.9 - A + 3.5 (A - 0.8)^2` (Christensen and
    /// Burley 2015, light from all around). Their first skin gives 0.68, 0.33 and 0.20 mm in that way, which is where
    /// `skin-light` stands. Jade, wax and dark skin have no such measurement and are chosen beside these.
    #[must_use]
    pub fn presets() -> [ProfilePreset; 6] {
        let of = |name, doc, scattering_distance_mm, ior, thickest_mm| ProfilePreset {
            name,
            doc,
            profile: Self { scattering_distance_mm, ior, thickness_remap_mm: [0.0, thickest_mm], ..Self::default() },
        };
        [
            ProfilePreset { name: "skin-light", doc: "Light skin.", profile: Self::default() },
            of("skin-dark", "Dark skin: melanin takes light early.", [0.52, 0.2, 0.11], 1.4, 5.5),
            of("jade", "Jade: thrice as far as marble, green farthest.", [1.0, 1.45, 0.95], 1.5, 15.0),
            of("wax", "Paraffin wax: far, and warm where it is thin.", [2.2, 1.5, 0.95], 1.5, 25.0),
            of("milk", "Whole milk (Jensen et al. 2001).", [0.380, 0.299, 0.231], 1.3, 4.0),
            of("marble", "Marble (Jensen et al. 2001).", [0.425, 0.343, 0.287], 1.5, 4.5),
        ]
    }

    /// The profile of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::presets().into_iter().find(|p| p.name == name).map(|p| p.profile)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::out_of_range;

    /// Burley's d of what Jensen et al. measured: reduced scattering and absorption, 1/mm, and diffuse albedo.
    fn distances(scattering: [f32; 3], absorption: [f32; 3], albedo: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|c| {
            let shape = 1.9 - albedo[c] + 3.5 * (albedo[c] - 0.8).powi(2);
            1.0 / (scattering[c] + absorption[c]) / shape
        })
    }

    #[test]
    fn measured_materials_are_those_of_the_paper() {
        let near = |name: &str, expected: [f32; 3], within: f32| {
            let found = DiffusionProfile::named(name).expect("a preset").scattering_distance_mm;
            for c in 0..3 {
                assert!((found[c] - expected[c]).abs() <= within * expected[c], "{name}: {found:?}, {expected:?}");
            }
        };
        near("milk", distances([2.55, 3.21, 3.77], [0.0011, 0.0024, 0.014], [0.91, 0.88, 0.76]), 0.005);
        near("marble", distances([2.19, 2.62, 3.0], [0.0021, 0.0041, 0.0071], [0.83, 0.79, 0.75]), 0.005);
        near("skin-light", distances([0.74, 0.88, 1.01], [0.032, 0.17, 0.48], [0.44, 0.22, 0.13]), 0.12);
    }

    #[test]
    fn presets_are_valid_and_have_names_of_their_own() {
        let presets = DiffusionProfile::presets();
        for (i, preset) in presets.iter().enumerate() {
            assert!(out_of_range(&mut preset.profile.clone()).is_none(), "{}", preset.name);
            assert!(presets[..i].iter().all(|p| p.name != preset.name), "{}", preset.name);
        }
        assert_eq!(DiffusionProfile::named("skin-light"), Some(DiffusionProfile::default()));
        assert_eq!(DiffusionProfile::named("glass"), None);
    }
}
