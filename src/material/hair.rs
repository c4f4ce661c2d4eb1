//! Hair that is lit as strands: the two shifted highlights of Kajiya and Kay, or light through fibres.

use serde::{Deserialize, Serialize};

use super::{Generated, Options, Section, Shading, Surroundings, TextureRef, walk::plain_parts};
use crate::render::layout::Block;

/// How strands are lit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum HairModel {
    /// Light through rough dielectric fibres ([`FibreModel`]).
    #[default]
    Fibre,
    /// Two highlights on a soft body ([`KajiyaKay`]).
    KajiyaKay,
}

/// Which way strands run, from root to tip.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StrandDirection {
    /// By the flow map where there is one, else as the file says (`_HAIR_TANGENT`), else `uv-v`.
    #[default]
    Auto,
    /// Along u.
    UvU,
    /// Along v, downwards in the picture.
    UvV,
    /// As the shape of each lock says: from its root to its tip.
    Mesh,
}

/// The density by which a fibre's roughness spreads light round it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Detector {
    /// Trimmed logistic (Chiang et al. 2016).
    #[default]
    Logistic,
    /// Wrapped Gaussian (d'Eon et al. 2011).
    Gaussian,
}

plain_parts!(HairModel, StrandDirection, Detector);

crate::section! {
    /// Hair lit as strands, in the place of the toon shading or as far as wanted: `natural` goes from one to the other.
    ///
    /// Sources: Kajiya and Kay 1989 with the shifts of Scheuermann 2004; d'Eon et al. 2011 and Chiang et al. 2016; multiple
    /// scattering after Zinke et al. 2008.
    #[derive(Copy)]
    Hair = "hair" {
        is_model: true, needs: &["tangent"],
        channel: Some(("strands", "Hair that is lit as strands: their direction in the world, -1..1 as 0..1.")),
        more_channels: &[
            ("hair-primary", "Primary highlight of lit hair: what is mirrored on its strands."),
            ("hair-secondary", "Secondary highlight of lit hair: what was inside of its strands."),
            ("hair-indirect", "Light from all around on lit hair."),
        ],
    }
    {
        /// How strands are lit: `fibre` or `kajiya-kay`.
        model: HairModel = HairModel::Fibre;
        /// 1 is lit hair, 0 the toon shading with the highlights on it.
        natural: f32 = 1.0, in 0.0..=1.0;
        /// Which way they run: `auto`, `uv-u`, `uv-v` or `mesh`.
        direction: StrandDirection = StrandDirection::Auto;
        /// Turns them, in the plane of the surface, radians.
        turn_rad: f32 = 0.0, in -6.3..=6.3;
        /// Comb of the hair in the texture's plane, linear: right in red, up in green, 0.5 for none. Source: KK Flow Map.
        flow_map: Option<TextureRef> = None, read LINEAR;
        /// Moves highlights along the strands, red, linear: 0.5 not at all.
        shift_map: Option<TextureRef> = None, read LINEAR_REPEAT;
        /// How far: tangent of the angle between the map's ends.
        shift_amount: f32 = 0.3, in -2.0..=2.0;
        /// How far light comes round the hair: 0 Lambert, 1 half Lambert; of fibres, how far they stand out of the surface that
        /// they lie on.
        wrap: f32 = 0.5, in 0.0..=1.0;
        /// How far the occlusion of strips is followed.
        occlusion: f32 = 1.0, in 0.0..=1.0;
        /// Which of its three strengths: 0 to 2.
        occlusion_strength: u32 = 0, in 0..=2;
        /// Bands of highlights, as painters cut them; 0 for smooth ones.
        steps: u32 = 0, in 0..=8;
        /// Softness of the edges of bands, share of a band.
        edge: f32 = 0.1, in 0.0..=1.0;
        /// What highlights of lights are multiplied by, linear; those of what is around stay.
        highlight_color: [f32; 3] = [1.0; 3], in 0.0..=10.0;
        /// Its numbers as `kajiya-kay`.
        kajiya_kay: KajiyaKay = KajiyaKay::default(), part KajiyaKay;
        /// Its numbers as `fibre`.
        fibre: FibreModel = FibreModel::default(), part FibreModel;
    }
    presets {
        /// Black, with a cold shine.
        black { fibre: FibreModel { eumelanin: 5.0, pheomelanin: 0.0, ..FibreModel::default() } }
        /// Dark brown.
        brown { fibre: FibreModel { eumelanin: 0.42, pheomelanin: 0.3, ..FibreModel::default() } }
        /// Golden blond.
        blond { fibre: FibreModel { eumelanin: 0.0, pheomelanin: 0.24, scatter: 1.6, ..FibreModel::default() } }
        /// Without any pigment.
        white { fibre: FibreModel { eumelanin: 0.0, pheomelanin: 0.02, scatter: 1.6, ..FibreModel::default() } }
        /// Bleached and dyed in the colour of its texture.
        dyed { fibre: FibreModel { eumelanin: 0.0, pheomelanin: 0.0, of_base: 1.0, scatter: 1.6, ..FibreModel::default() } }
        /// Silk of a drawn heroine: toon shade with two banded highlights.
        anime_silk {
            model: HairModel::KajiyaKay, natural: 0.0, steps: 2, edge: 0.25,
            kajiya_kay: KajiyaKay {
                primary_exponent: 220.0, primary_shift: -0.05, secondary_exponent: 40.0, secondary_shift: 0.12,
                direct: [0.34, 0.12, 0.0], ..KajiyaKay::default()
            },
        }
    }
}

crate::part! {
    /// Two highlights along strands on a soft body: the reflection on them, and what was inside once.
    #[derive(Copy)]
    KajiyaKay {
        /// Colour of the primary highlight, linear. Source: KK Primary Specular Color.
        primary_color: [f32; 3] = [1.0; 3], in 0.0..=10.0;
        /// Its exponent. Source: KK Primary Exponent.
        primary_exponent: f32 = 110.0, in 1.0..=4000.0;
        /// Moves it towards the tip, tangent of the angle. Source: KK Primary Root Shift.
        primary_shift: f32 = -0.1, in -2.0..=2.0;
        /// Colour of the secondary highlight, linear, times the colour of the hair. Source: KK Secondary Specular Color.
        secondary_color: [f32; 3] = [1.6; 3], in 0.0..=10.0;
        /// Its exponent. Source: KK Secondary Exponent.
        secondary_exponent: f32 = 18.0, in 1.0..=4000.0;
        /// Moves it towards the tip, tangent of the angle. Source: KK Secondary Root Shift.
        secondary_shift: f32 = 0.1, in -2.0..=2.0;
        /// Shares of the primary and the secondary highlight and of Blinn's, by lights. Source: KK Spec Mix Direct Factors.
        direct: [f32; 3] = [0.25, 0.4, 0.0], in 0.0..=10.0;
        /// The same by light from all around. Source: KK Spec Mix Indirect Factors.
        indirect: [f32; 3] = [0.15, 0.3, 0.0], in 0.0..=10.0;
        /// How sharply it mirrors what is around. Source: KK Reflective Smoothness.
        smoothness: f32 = 0.55, in 0.0..=1.0;
        /// How far bright hair mirrors less. Source: KK Reflective Gray Scale.
        gray_scale: f32 = 0.5, in 0.0..=1.0;
    }
}

crate::part! {
    /// Light through fibres: reflected on them (R), through them (TT), thrown back inside (TRT), and what is left.
    #[derive(Copy)]
    FibreModel {
        /// Brown-black pigment: 0 white, 0.3 blond, 1.3 brown, 8 black.
        eumelanin: f32 = 1.3, in 0.0..=20.0;
        /// Red-yellow pigment.
        pheomelanin: f32 = 0.2, in 0.0..=20.0;
        /// Colour of dyed hair without pigment, linear; its absorption is added (Chiang et al. 2016: that of much hair in light
        /// from all around).
        dye: [f32; 3] = [1.0; 3], in 0.0..=1.0;
        /// How far the base colour takes the place of all pigment: a body of this hair has that share of the light that white
        /// hair has.
        of_base: f32 = 0.0, in 0.0..=1.0;
        /// How far strands that are light and dark in the base texture have less and more pigment and dye than the hair about
        /// them: 1 as light and dark as there.
        variation: f32 = 1.0, in 0.0..=1.0;
        /// Roughness along the fibre.
        longitudinal: f32 = 0.3, in 0.05..=1.0;
        /// Roughness round it.
        azimuthal: f32 = 0.3, in 0.1..=1.0;
        /// Tilt of its scales, radians.
        tilt_rad: f32 = 0.0349, in -0.2..=0.2;
        /// Index of refraction.
        ior: f32 = 1.55, in 1.1..=2.5;
        /// What roughens it round: `logistic` or `gaussian`.
        detector: Detector = Detector::Logistic;
        /// Share of the light that hair throws on hair.
        scatter: f32 = 1.0, in 0.0..=2.0;
        /// How far strands lie in a body of others, which keep light from them and them from view: 0 for a single layer.
        packing: f32 = 1.0, in 0.0..=1.0;
        /// Fibres that light crosses a metre inside of the hair, where it casts shadow on itself.
        density: f32 = 600.0, in 0.0..=100_000.0;
    }
}

/// Absorption by a unit of eumelanin and of pheomelanin, a fibre radius (d'Eon et al. 2011).
const MELANINS: [[f32; 3]; 2] = [[0.419, 0.697, 1.37], [0.187, 0.4, 1.05]];

impl FibreModel {
    /// Absorption of its pigment and dye, a fibre radius.
    #[must_use]
    pub fn absorption(&self) -> [f32; 3] {
        let scale = self.color_scale();
        std::array::from_fn(|c| {
            let dye = (self.dye[c].clamp(1e-3, 1.0).ln() / scale).powi(2);
            self.eumelanin * MELANINS[0][c] + self.pheomelanin * MELANINS[1][c] + dye
        })
    }

    /// What the logarithm of a colour is divided by (Chiang et al. 2016).
    fn color_scale(&self) -> f32 {
        let b = self.azimuthal;
        5.969 - 0.215 * b + 2.532 * b.powi(2) - 10.73 * b.powi(3) + 5.574 * b.powi(4) + 0.245 * b.powi(5)
    }

    /// Variance along the fibre of R, TT, TRT and the rest, radians squared.
    fn variances(&self) -> [f32; 4] {
        let b = self.longitudinal;
        let v = (0.726 * b + 0.812 * b.powi(2) + 3.7 * b.powi(20)).powi(2);
        [v, 0.25 * v, 4.0 * v, 4.0 * v]
    }

    /// Width of the detector, radians.
    fn width(&self) -> f32 {
        let b = self.azimuthal;
        match self.detector {
            Detector::Logistic => (std::f32::consts::PI / 8.0).sqrt() * (0.265 * b + 1.194 * b.powi(2) + 5.372 * b.powi(22)),
            // A logistic of scale s deviates by pi s / sqrt(3).
            Detector::Gaussian => {
                let s = Self { detector: Detector::Logistic, ..*self }.width();
                s * std::f32::consts::PI / 3f32.sqrt()
            }
        }
    }
}

impl Section for Hair {
    fn put(&self, gpu: &mut Block<'_>, _: &Surroundings<'_>) {
        let of = &self.fibre;
        let tilt = |times: f32| [(times * of.tilt_rad).sin(), (times * of.tilt_rad).cos()];
        gpu.put("turn", [self.turn_rad.sin(), self.turn_rad.cos()]);
        gpu.put("fibre_sharp", of.variances().map(|v| 1.0 / v));
        gpu.put("fibre_scales", of.variances().map(|v| 1.0 / (v * (1.0 - (-2.0 / v).exp()))));
        gpu.put("fibre_tilt_r", tilt(-2.0));
        gpu.put("fibre_tilt_tt", tilt(1.0));
        gpu.put("fibre_tilt_trt", tilt(4.0));
        gpu.put("fibre_absorption", of.absorption());
    }

    fn options(&self, on: &mut Options, of: &Surroundings<'_>) {
        let is_toon = matches!(of.material.shading, Shading::Toon(_));
        on.set("hair_toon", is_toon && self.natural < 1.0);
        on.set("hair_kajiya_kay", self.model == HairModel::KajiyaKay);
        on.set("hair_fibre", self.model == HairModel::Fibre);
        let is_varied = self.fibre.of_base < 1.0 && self.fibre.variation > 0.0 && of.material.base.texture.is_some();
        on.set("hair_of_base", self.model == HairModel::Fibre && self.fibre.of_base > 0.0);
        on.set("hair_varied", self.model == HairModel::Fibre && is_varied);
        on.set("hair_blinn", self.kajiya_kay.direct[2].max(self.kajiya_kay.indirect[2]) > 0.0);
        on.set("hair_bands", self.steps > 0);
        on.set("hair_turned", self.turn_rad != 0.0);
        // Tangents are those of the texture only where a flow map needs them.
        on.set("strands_by_vertex", self.flow_map.is_none());
    }

    fn generated(&self, _: &Surroundings<'_>) -> Option<(&'static str, Generated)> {
        let of = &self.fibre;
        let table = Generated::Fibre {
            width: of.width().to_bits(),
            ior: of.ior.to_bits(),
            is_gaussian: of.detector == Detector::Gaussian,
        };
        (self.model == HairModel::Fibre).then_some(("table", table))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_artists_become_those_of_the_model() {
        let text = include_str!("../../tests/oracles/hair_melanin.json");
        let file: serde_json::Value = serde_json::from_str(text).expect("vectors");
        let number = |v: &serde_json::Value| v.as_f64().expect("a number") as f32;
        let close = |found: f32, expected: f32| (found - expected).abs() <= 1e-4 * expected.abs().max(1e-2);
        for case in file["melanin"].as_array().expect("cases") {
            let of = FibreModel {
                eumelanin: number(&case["eumelanin"]),
                pheomelanin: number(&case["pheomelanin"]),
                ..FibreModel::default()
            };
            for (c, found) in of.absorption().into_iter().enumerate() {
                assert!(close(found, number(&case["sigma_a"][c])), "{case}: {found}");
            }
        }
        for case in file["roughness_maps"].as_array().expect("cases") {
            let of = FibreModel {
                longitudinal: number(&case["beta_m"]),
                azimuthal: number(&case["beta_n"]),
                ..FibreModel::default()
            };
            assert!(close(of.width(), number(&case["s"])), "{case}: {}", of.width());
            for (p, found) in of.variances().into_iter().enumerate() {
                assert!(close(found, number(&case["v"][p])), "{case}: {found}");
            }
        }
        for case in file["reflectance"].as_array().expect("cases") {
            let dye = std::array::from_fn(|c| number(&case["color"][c]));
            let none = FibreModel { eumelanin: 0.0, pheomelanin: 0.0, ..FibreModel::default() };
            let of = FibreModel { dye, azimuthal: number(&case["beta_n"]), ..none };
            for (c, found) in of.absorption().into_iter().enumerate() {
                assert!(close(found, number(&case["sigma_a"][c])), "{case}: {found}");
            }
        }
    }
}
