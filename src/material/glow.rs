//! Light that blooms.

use super::Section;

crate::section! {
    /// What of a surface [`Bloom`](crate::scene::Bloom) spreads around it; nothing else blooms.
    #[derive(Copy)]
    Glow = "glow" { unlit: true }
    {
        /// Share of its emission, and of fire.
        emission: f32 = 1.0, in 0.0..=10.0;
        /// Share of its highlights and sparks.
        highlight: f32 = 0.0, in 0.0..=10.0;
    }
}

impl Section for Glow {}
