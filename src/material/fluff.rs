//! Fluff: a soft coat of short hair.

use super::Section;

/// Most shells of a coat.
pub const MAX_SHELLS: u32 = 24;

crate::section! {
    /// Shells round the surface, each with the strands that reach so far. Fewer are drawn where they would lie closer than a
    /// pixel and a half. Light and colour are those of the surface; strands grow darker towards the root.
    /// Each shell costs what drawing the surface once more does.
    #[derive(Copy)]
    Fluff = "fluff" { channel: Some(("fluff", "Height of a coat of short hair, root to tip.")) }
    {
        /// Most shells.
        shells: u32 = 24, in 1..=24;
        /// Length of the strands, metres.
        length_m: f32 = 0.008, in 0.001..=0.1;
        /// Strands across the texture coordinates.
        density: f32 = 160.0, in 8.0..=1024.0;
        /// Softness of the strands' ends, in shares of the length.
        softness: f32 = 0.35, in 0.02..=1.0;
        /// How far tips hang, metres down in the world.
        gravity_m: f32 = 0.0015, in 0.0..=0.1;
        /// How far wind moves the tips, metres.
        wind_m: f32 = 0.001, in 0.0..=0.1;
        /// Time after which the wind repeats, seconds.
        wind_period_s: f32 = 3.0, in 0.05..=60.0;
        /// How far strands ruffle the border of light: length by which each bends the normal.
        ruffle: f32 = 0.3, in 0.0..=1.0;
        /// Share of light at the root.
        root_light: f32 = 0.6, in 0.0..=1.0;
    }
    presets {
        /// The trim of a coat.
        trim {}
        /// Velvet and plush.
        plush { length_m: 0.003, density: 260.0, shells: 10, gravity_m: 0.0003, ruffle: 0.12 }
        /// Long hair that hangs.
        long { length_m: 0.015, density: 110.0, gravity_m: 0.006 }
    }
}

impl Section for Fluff {}
