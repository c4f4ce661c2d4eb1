//! A stone that is seen into: amber, ruby, jade.

use super::{Section, TextureRef};

crate::section! {
    /// A clear or cloudy body: light is refracted into it, absorbed on its way, gathered on the far side, and shows what is
    /// enclosed at several depths. The base colour does nothing.
    ///
    /// Sources: Snell's law and Fresnel's equations; Beer-Lambert absorption.
    #[derive(Copy)]
    Gem = "gem" {
        is_model: true, needs: &["tangent"],
        channel: Some((
            "stone",
            "Stones: light that is gathered or thrown back in red, depth of what is enclosed in green, what is mirrored in blue.",
        )),
    }
    {
        /// Index of refraction; that of amber.
        ior: f32 = 1.54, in 1.0..=3.0;
        /// Depth of the body along the normal, metres.
        depth_m: f32 = 0.01, in 0.0001..=1.0;
        /// Colour of white light that crossed the depth once, linear; amber.
        color: [f32; 3] = [0.82, 0.3, 0.04], in 0.001..=1.0;
        /// Light that a cloudy body scatters back by itself, in place of what comes through.
        cloudiness: f32 = 0.12, in 0.0..=1.0;
        /// Strength of the light that is gathered on the side away from the light.
        caustic: f32 = 3.0, in 0.0..=8.0;
        /// How closely it is gathered: exponent of the cosine.
        caustic_focus: f32 = 1.7, in 1.0..=64.0;
        /// What is enclosed, sRGB with alpha, by the surface's texture coordinates.
        inclusions: Option<TextureRef> = None, read SRGB_REPEAT;
        /// Layers of it, the deepest at the depth of the body.
        layers: u32 = 3, in 1..=4;
        /// Texture coordinates a metre along the surface: how far layers move against each other.
        uv_per_m: f32 = 45.0, in 0.0..=1000.0;
        /// Strength of what the surface mirrors.
        polish: f32 = 1.0, in 0.0..=1.0;
    }
    presets {
        /// Clear honey.
        amber {}
        /// Deep red, clear.
        ruby { ior: 1.76, color: [0.9, 0.012, 0.07], cloudiness: 0.06, caustic: 2.6, caustic_focus: 2.6 }
        /// Milky green.
        jade { ior: 1.66, color: [0.16, 0.62, 0.3], cloudiness: 0.75, caustic: 1.2, caustic_focus: 1.6 }
    }
}

impl Section for Gem {}
