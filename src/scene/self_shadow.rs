//! The shadow that a character casts on itself.

/// A shadow map for each character (of a crowd the first [`MOST_SHADOWED`]), drawn from the key light by an orthographic
/// camera that is fitted to the character: near or far, its texels have the same size on it. Materials say by a
/// [`CastShadow`](crate::material::CastShadow) whether they cast and receive.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SelfShadow {
    /// Texels along a side of a map. Range 128..4096. Default: 1024.
    pub side: u32,
    /// Width that edges are smoothed over, metres; no less than three texels. What is smaller casts no shadow of its own, and
    /// a third of the width is soft. Range 0..0.05. Default: 0.01.
    pub soft_width_m: f32,
    /// How far a receiver is moved along its normal before it is tested, texels: too little and surfaces shade themselves in
    /// stripes, too much and thin parts cast none. Range 0..8. Default: 2.
    pub bias_texels: f32,
}

/// Characters of a crowd that have a shadow map.
pub const MOST_SHADOWED: u32 = 8;

impl Default for SelfShadow {
    fn default() -> Self {
        Self { side: 1024, soft_width_m: 0.01, bias_texels: 2.0 }
    }
}
