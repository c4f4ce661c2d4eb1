//! Fire of cartoons: a drawn shape that noise eats away.

use super::{Section, Surroundings, TextureRef};
use crate::render::layout::Block;

crate::section! {
    /// Heat is the drawn shape times noise that rises through it; where it is low nothing is left, and the colour goes by the
    /// same number. It is moved by time alone, begins anew without a seam after each period, and shines in its own light.
    /// The material must be blended; its base colour, texture and outline do nothing.
    #[derive(Copy)]
    Fire = "fire" { is_model: true, unlit: true, channel: Some(("fire", "Heat of fire.")) }
    {
        /// Shape as heat, red channel, linear: 1 in the heart, 0 outside; v grows downwards from the tip. Without it, one
        /// tongue as wide as the texture coordinates.
        heat: Option<TextureRef> = None, read LINEAR;
        /// Colours of the rim, the body and the heart, linear.
        colors: [[f32; 3]; 3] = [[0.9, 0.07, 0.01], [1.0, 0.36, 0.03], [1.0, 0.88, 0.42]], in 0.0..=1.0;
        /// Heat at which the body and the heart begin, growing.
        edges: [f32; 2] = [0.34, 0.62], in 0.0..=1.0;
        /// Heat below which it is eaten away: 0 whole, 1 gone.
        erosion: f32 = 0.2, in 0.0..=1.0;
        /// Softness of its border, in heat.
        softness: f32 = 0.03, in 0.001..=0.5;
        /// How far noise changes the heat.
        turbulence: f32 = 0.8, in 0.0..=1.0;
        /// How far tongues sway, in texture coordinates at the tip.
        sway: f32 = 0.22, in 0.0..=0.5;
        /// Cells of noise across the texture.
        cells: u32 = 4, in 1..=32;
        /// Time after which it repeats, seconds.
        period_s: f32 = 2.0, in 0.05..=60.0;
        /// 0 hides what is behind it, 1 adds its light to that.
        additive: f32 = 0.35, in 0.0..=1.0;
        /// Brightness.
        strength: f32 = 1.0, in 0.0..=10.0;
    }
    presets {
        /// A camp fire.
        orange {}
        /// Gas and ghosts.
        blue { colors: [[0.02, 0.1, 0.8], [0.06, 0.42, 1.0], [0.75, 0.95, 1.0]] }
    }
}

impl Section for Fire {
    fn put(&self, gpu: &mut Block<'_>, _: &Surroundings<'_>) {
        let [rim, body, heart] = self.colors.map(|color| color.map(|c| c * self.strength));
        gpu.put("rim", rim);
        gpu.put("body", body);
        gpu.put("heart", heart);
    }

    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        of.material.burns()
    }
}
