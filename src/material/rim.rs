//! Rim light of MToon: a Fresnel-shaped band and the mask that it shares with the matcap.

use super::{Options, Section, Surroundings, TextureRef};
use crate::scene::ColorTarget;

crate::section! {
    /// Parametric rim of MToon.
    #[derive(Copy)]
    Rim = "rim" { on_line: true, of_file: true }
    {
        /// Colour, linear; black is off, files hold 0 to 1.
        color: [f32; 3] = [0.0; 3], in 0.0..=100.0;
        /// Exponent of the falloff.
        fresnel_power: f32 = 5.0, in 0.0..=1000.0;
        /// Added to 1 - N·V before the exponent.
        lift: f32 = 0.0, in -100.0..=100.0;
        /// Mask of rim and matcap, sRGB.
        mask: Option<TextureRef> = None, read SRGB;
        /// 0 ignores the light, 1 multiplies by it.
        lighting_mix: f32 = 1.0, in 0.0..=1.0;
    }
}

impl Rim {
    fn shows(&self, of: &Surroundings<'_>) -> bool {
        self.color != [0.0; 3] || of.driven.shifts(ColorTarget::RimColor)
    }
}

impl Section for Rim {
    fn options(&self, on: &mut Options, of: &Surroundings<'_>) {
        on.set("rim_color", self.shows(of));
    }

    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        // It adds the matcap, under its mask.
        self.shows(of) || of.material.matcap.as_ref().is_some_and(|m| m.is_on(of))
    }
}
