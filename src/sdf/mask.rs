//! Masks: which texels are lit.

use crate::scene::Image;

/// A picture of yes and no, rows from the top.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mask {
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// Whether a texel is lit: `width * height` of them.
    pub lit: Vec<bool>,
}

impl Mask {
    /// Evaluates a function of column and row at every texel.
    #[must_use]
    pub fn from_fn(width: u32, height: u32, lit: impl Fn(u32, u32) -> bool) -> Self {
        let lit = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| lit(x, y)).collect();
        Self { width, height, lit }
    }

    /// Texels whose red channel is over one half; masks are grey.
    #[must_use]
    pub fn from_image(image: &Image) -> Self {
        let lit = image.pixels.chunks_exact(4).map(|p| p[0] > 127).collect();
        Self { width: image.width, height: image.height, lit }
    }
}
