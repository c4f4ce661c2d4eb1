//! What is done to the whole picture once it is drawn.

use crate::material::plain_parts;

crate::part! {
    /// Bloom, exposure, tone curve and antialiasing. The picture is drawn in half floats then, and the background is laid behind it last,
    /// so that it keeps its colour, or stays transparent.
    #[derive(Copy)]
    Post {
        /// Light that spreads.
        bloom: Option<Bloom> = None, part Bloom;
        /// Exposure, stops: each doubles the light of the picture before the tone curve; the background of a view keeps its
        /// colour.
        exposure_ev: f32 = 0.0, in -16.0..=16.0;
        /// What becomes of light that is brighter than white.
        tone: ToneCurve = ToneCurve::None;
        /// How edges are smoothed beyond the samples of a pixel.
        antialias: Antialias = Antialias::Fxaa;
    }
}

crate::part! {
    /// Spreads the light of materials that have a [`Glow`](crate::material::Glow), and of nothing else.
    #[derive(Copy)]
    Bloom {
        /// Share of the light that spreads.
        strength: f32 = 0.6, in 0.0..=4.0;
        /// How far it spreads, share of the picture's height.
        radius: f32 = 0.04, in 0.002..=0.25;
    }
}

/// How edges are smoothed beyond the samples of a pixel. In a look file `"none"`, `"fxaa"` or `"temporal"`; `false` and `true`
/// stand for the first two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Antialias {
    /// They are not.
    None,
    /// In the finished picture, where it has one sample a pixel (after FXAA, Lottes 2009); with more it does nothing.
    #[default]
    Fxaa,
    /// Over the pictures of a window that follow each other ([`Renderer::draw`](crate::Renderer::draw)), whatever their samples:
    /// each is moved by a share of a pixel, and what was seen before is moved to where it is now and mixed in (TAA). Cuts,
    /// lines and [`hashed`](crate::material::Alpha::hashed) alpha become smooth, too. Blended surfaces move with what is behind
    /// them, and edges between what a host draws and actors move with the actors. Each view has a
    /// [`history`](crate::View::history) of its own. A still by itself is drawn without; its like is
    /// [`Renderer::render_accumulated`](crate::Renderer::render_accumulated).
    Temporal,
}
plain_parts!(Antialias);

impl<'de> serde::Deserialize<'de> for Antialias {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Names;
        impl serde::de::Visitor<'_> for Names {
            type Value = Antialias;

            fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.write_str("\"none\", \"fxaa\" or \"temporal\"")
            }

            fn visit_bool<E>(self, is_on: bool) -> Result<Antialias, E> {
                Ok(if is_on { Antialias::Fxaa } else { Antialias::None })
            }

            fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<Antialias, E> {
                match name {
                    "none" => Ok(Antialias::None),
                    "fxaa" => Ok(Antialias::Fxaa),
                    "temporal" => Ok(Antialias::Temporal),
                    other => Err(E::unknown_variant(other, &["none", "fxaa", "temporal"])),
                }
            }
        }
        from.deserialize_any(Names)
    }
}

impl Bloom {
    /// Pictures below that of the light: each doubles the reach of about two texels, and the light stands at half the size.
    pub(crate) fn levels(&self, height: u32) -> usize {
        let reach_px = (self.radius * height as f32 * 0.25).max(1.0);
        (reach_px.log2().round() as usize).clamp(1, 7)
    }
}

/// How light beyond white is brought back; all of them leave dark and middle tones as they are painted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToneCurve {
    /// It is cut: colours are exactly those that are painted.
    #[default]
    None,
    /// Rolled off above 0.75, half by the brightest channel and half each by itself: hues stay until they are nearly white.
    Filmic,
    /// Khronos PBR Neutral: compressed above 0.8, then faded to white.
    Neutral,
}
plain_parts!(ToneCurve);
