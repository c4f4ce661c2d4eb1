//! The shadow that a character casts on itself and on others.

crate::part! {
    /// A shadow map for each actor (of a stage for [`MOST_SHADOWED`] of them, the rest share one), drawn from the key light by an
    /// orthographic camera that is fitted to it: near or far, its texels have the same size on it. The sixteen nearest other
    /// actors cast into it, too. Materials say by a [`CastShadow`](crate::material::CastShadow) whether they cast and receive.
    #[derive(Copy)]
    SelfShadow {
        /// Texels along a side of a map; twice as many round characters wider than 2.4 m.
        side: u32 = 1024, in 128..=4096;
        /// Width that edges are smoothed over, metres; from three to five texels. What is smaller casts no shadow of its own,
        /// and a third of the width is soft.
        soft_width_m: f32 = 0.01, in 0.0..=0.05;
        /// How far a receiver is moved along its normal before it is tested, texels of a map of `side`: too little and surfaces shade themselves
        /// in stripes, too much and thin parts cast none.
        bias_texels: f32 = 2.0, in 0.0..=8.0;
    }
}

/// Actors of a stage that have a shadow map.
pub const MOST_SHADOWED: u32 = 8;
