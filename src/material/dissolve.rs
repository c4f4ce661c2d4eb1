//! Burning away.

use super::Section;

crate::section! {
    /// Fire that eats a character away from its feet to its head, along an edge that is frayed by noise and glows, on all of
    /// its materials at once; what has no head goes by the noise alone. What is gone casts no shadow. Lines round the shape
    /// grow thin and have gone at an amount of 0.1.
    #[derive(Copy)]
    Dissolve = "dissolve" {
        unlit: true, on_line: true,
        channel: Some(("dissolve", "Surfaces that burn away: the border dark green, what is whole yellow.")),
    }
    {
        /// How much is gone: 0 nothing, 1 all.
        amount: f32 = 0.0, in 0.0..=1.0;
        /// Size of a cell of noise in the space of the character, metres: the same on every material.
        cell_m: f32 = 0.03, in 0.001..=1.0;
        /// Width of the glowing border, in amount.
        border: f32 = 0.06, in 0.0..=0.5;
        /// Colour of the border, linear; above 1 it glows.
        color: [f32; 3] = [2.0, 0.6, 0.1], in 0.0..=10.0;
    }
}

impl Section for Dissolve {}
