//! How much of the scene's light a material takes.

use super::Section;

crate::section! {
    /// Keeps a character readable in any light: bounds on its luminance, and how far its colour counts.
    #[derive(Copy)]
    LightResponse = "light_response" { on_line: true }
    {
        /// Least luminance of the direct light that is taken.
        min: f32 = 0.0, in 0.0..=1.0;
        /// Greatest luminance.
        max: f32 = 1.0, in 0.0..=10.0;
        /// 0 takes the light's colour, 1 its luminance alone.
        monochrome: f32 = 0.0, in 0.0..=1.0;
    }
}

impl Section for LightResponse {}
