//! What is painted behind actors: a gradient, one large glow, and lights out of focus.

use crate::color::Srgb;

/// A painted backdrop. It fills the picture, whatever the camera does, and is the same for the same numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Backdrop {
    /// Colour at the top of the picture. Default: white.
    pub top: Srgb,
    /// Colour half-way down. Default: white.
    pub middle: Srgb,
    /// Colour at the bottom. Default: white.
    pub bottom: Srgb,
    /// Colour that is added round `glow_at`: a sun or a moon behind mist. Default: black.
    pub glow: Srgb,
    /// Its middle, from the top left, share of the picture. Default: the middle.
    pub glow_at: [f32; 2],
    /// How far it reaches, share of the picture's height. Default: 0.5.
    pub glow_radius: f32,
    /// Colour of the lights out of focus, which is added; each is a little warmer or cooler. Default: white.
    pub discs: Srgb,
    /// How many of them there are. Range 0..64. Default: 0.
    pub disc_count: u32,
    /// Radius of the largest one, share of the picture's height; the smallest has a quarter of it. Default: 0.08.
    pub disc_radius: f32,
    /// Where they are. Default: 0.
    pub seed: u32,
}

impl Default for Backdrop {
    fn default() -> Self {
        let white = Srgb([255; 3]);
        Self {
            top: white,
            middle: white,
            bottom: white,
            glow: Srgb([0; 3]),
            glow_at: [0.5; 2],
            glow_radius: 0.5,
            discs: white,
            disc_count: 0,
            disc_radius: 0.08,
            seed: 0,
        }
    }
}
