//! Fluff: a soft coat of short hair.

use serde::{Deserialize, Serialize};

/// Most shells of a coat.
pub const MAX_SHELLS: u32 = 24;

/// Shells round the surface, each with the strands that reach so far. Fewer are drawn where they would lie closer than a
/// pixel. Light and colour are those of the surface; strands grow darker towards the root.
/// Each shell costs what drawing the surface once more does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Fluff {
    /// Most shells. Range 8..24. Default: 24.
    pub shells: u32,
    /// Length of the strands, metres. Range 0.001..0.1. Default: 0.008.
    pub length_m: f32,
    /// Strands across the texture coordinates. Range 8..1024. Default: 160.
    pub density: f32,
    /// Softness of the strands' ends, in shares of the length. Range 0.02..1. Default: 0.35.
    pub softness: f32,
    /// How far tips hang, metres down in the world. Range 0..0.1. Default: 0.0015.
    pub gravity_m: f32,
    /// How far wind moves the tips, metres. Range 0..0.1. Default: 0.001.
    pub wind_m: f32,
    /// Time after which the wind repeats, seconds. Range 0.1..60. Default: 3.
    pub wind_period_s: f32,
    /// How far strands ruffle the border of light: length by which each bends the normal. Range 0..1. Default: 0.3.
    pub ruffle: f32,
    /// Share of light at the root. Range 0..1. Default: 0.6.
    pub root_light: f32,
}

impl Default for Fluff {
    fn default() -> Self {
        Self {
            shells: 24,
            length_m: 0.008,
            density: 160.0,
            softness: 0.35,
            gravity_m: 0.0015,
            wind_m: 0.001,
            wind_period_s: 3.0,
            ruffle: 0.3,
            root_light: 0.6,
        }
    }
}

impl Fluff {
    /// Velvet and plush.
    #[must_use]
    pub fn plush() -> Self {
        Self { length_m: 0.003, density: 260.0, shells: 10, gravity_m: 0.0003, ruffle: 0.12, ..Self::default() }
    }

    /// Long hair that hangs.
    #[must_use]
    pub fn long() -> Self {
        Self { length_m: 0.015, density: 110.0, gravity_m: 0.006, ..Self::default() }
    }
}
