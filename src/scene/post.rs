//! What is done to the whole picture once it is drawn.

/// Bloom, tone curve and antialiasing. The picture is drawn in half floats then, and the background is laid behind it last,
/// so that it keeps its colour, or stays transparent.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Post {
    /// Light that spreads. Default: none.
    pub bloom: Option<Bloom>,
    /// What becomes of light that is brighter than white. Default: none.
    pub tone: ToneCurve,
    /// Smooths edges in the finished picture where it has one sample a pixel (after FXAA, Lottes 2009). Default: true.
    pub antialias: bool,
}

impl Default for Post {
    fn default() -> Self {
        Self { bloom: None, tone: ToneCurve::None, antialias: true }
    }
}

/// Spreads the light of materials that have a [`Glow`](crate::material::Glow), and of nothing else.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Bloom {
    /// Share of the light that spreads. Range 0..4. Default: 0.6.
    pub strength: f32,
    /// How far it spreads, share of the picture's height. Range 0.002..0.25. Default: 0.04.
    pub radius: f32,
}

impl Bloom {
    /// Pictures below that of the light: each doubles the reach of about two texels, and the light stands at half the size.
    pub(crate) fn levels(&self, height: u32) -> usize {
        let reach_px = (self.radius.clamp(0.002, 0.25) * height as f32 * 0.25).max(1.0);
        (reach_px.log2().round() as usize).clamp(1, 7)
    }
}

impl Default for Bloom {
    fn default() -> Self {
        Self { strength: 0.6, radius: 0.04 }
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
