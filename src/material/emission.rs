//! Light of its own.

use super::{Options, Section, Surroundings, TextureRef};
use crate::scene::ColorTarget;

crate::section! {
    /// Light of its own, added after shading.
    #[derive(Copy)]
    Emission = "emission" {
        unlit: true, on_line: true, of_file: true, channel: Some(("emission", "Light of a surface of its own.")),
    }
    {
        /// Colour, linear, times its strength; may exceed 1.
        color: [f32; 3] = [0.0; 3], in 0.0..=1000000.0;
        /// Texture, sRGB; multiplies the colour.
        texture: Option<TextureRef> = None, read SRGB;
        /// Movement of the texture, UV units a second.
        scroll_per_s: [f32; 2] = [0.0; 2], in -100.0..=100.0;
        /// Swells and ebbs.
        blink: Option<Blink> = None, part Blink;
    }
}

crate::part! {
    /// Light that swells and ebbs.
    #[derive(Copy)]
    Blink {
        /// Time from one peak to the next, seconds.
        period_s: f32 = 1.5, in 0.05..=60.0;
        /// Share of the light that stays between peaks.
        low: f32 = 0.2, in 0.0..=1.0;
        /// 0 swells like breath, 1 is switched on and off.
        sharpness: f32 = 0.0, in 0.0..=1.0;
    }
}

impl Section for Emission {
    fn options(&self, on: &mut Options, _: &Surroundings<'_>) {
        on.set("emission_scroll", self.texture.is_some() && self.scroll_per_s != [0.0; 2]);
        on.set("emission_blink", self.blink.is_some());
    }

    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        let has_color = self.color != [0.0; 3] || of.driven.shifts(ColorTarget::EmissionColor);
        has_color && !of.material.burns()
    }
}
