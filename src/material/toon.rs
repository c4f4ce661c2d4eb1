//! How light becomes colour: two tones with a band between them (MToon), as on a physical surface, or not at all.

use serde::{Deserialize, Serialize};

use super::{About, Options, Section, Standard, Surroundings, TextureRef, section::Held};

/// Shading model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shading {
    /// Two tones and a band.
    Toon(Toon),
    /// A physical surface, metal or not.
    Standard(Standard),
    /// The base colour, whatever the light.
    Unlit,
}

impl Default for Shading {
    fn default() -> Self {
        Self::Toon(Toon::default())
    }
}

impl Shading {
    /// Whether light falls on it.
    pub(crate) fn is_lit(&self) -> bool {
        !matches!(self, Self::Unlit)
    }
}

impl Held for Shading {
    const ABOUTS: &'static [&'static About] = &[&Toon::ABOUT, &Standard::ABOUT];

    fn held(&self) -> Option<&dyn Section> {
        match self {
            Self::Toon(toon) => Some(toon),
            Self::Standard(standard) => Some(standard),
            Self::Unlit => None,
        }
    }

    fn held_mut(&mut self) -> Option<&mut dyn Section> {
        match self {
            Self::Toon(toon) => Some(toon),
            Self::Standard(standard) => Some(standard),
            Self::Unlit => None,
        }
    }
}

crate::section! {
    /// Two-tone shading of `VRMC_materials_mtoon` 1.0.
    #[derive(Copy)]
    Toon = "toon" { is_model: true, on_line: true, of_file: true }
    {
        /// Colour in shade, linear; files hold 0 to 1. Black as in the specification.
        shade_color: [f32; 3] = [0.0; 3], in 0.0..=100.0;
        /// Texture of the shade colour, sRGB; multiplies it.
        shade_texture: Option<TextureRef> = None, read SRGB;
        /// Moves the band: positive lights more; files hold -1 to 1.
        shift: f32 = 0.0, in -10.0..=10.0;
        /// Adds its red channel, linear, times `shift_texture_scale` to `shift`.
        shift_texture: Option<TextureRef> = None, read LINEAR;
        /// Scale of the shift texture.
        shift_texture_scale: f32 = 1.0, in -100.0..=100.0;
        /// Hardness of the band: 0 is Lambert-soft, 1 a hard edge.
        toony: f32 = 0.9, in 0.0..=1.0;
        /// 0 keeps the direction of ambient light, 1 makes it even.
        gi_equalization: f32 = 0.9, in 0.0..=1.0;
    }
}

impl Section for Toon {
    fn options(&self, on: &mut Options, of: &Surroundings<'_>) {
        // One lookup serves both.
        on.set("shade_is_base", self.shade_texture.is_some() && self.shade_texture == of.material.base.texture);
    }
}
