//! Masks: how much of each texel is lit.

use crate::scene::Image;

/// A picture of light and shade, rows from the top.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mask {
    /// Width, texels.
    pub width: u32,
    /// Height, texels.
    pub height: u32,
    /// Share of each texel that is lit, 0..=255: `width * height` of them. A texel is lit from [`LIT`] on; values between 0
    /// and 255 say where in the texel the border runs.
    pub coverage: Vec<u8>,
}

/// Least coverage of a texel that counts as lit.
pub const LIT: u8 = 128;

impl Mask {
    /// Evaluates a function of column and row at every texel.
    #[must_use]
    pub fn from_fn(width: u32, height: u32, lit: impl Fn(u32, u32) -> bool) -> Self {
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Self { width, height, coverage: places.map(|(x, y)| if lit(x, y) { 255 } else { 0 }).collect() }
    }

    /// The red channel of a picture; masks are grey.
    #[must_use]
    pub fn from_image(image: &Image) -> Self {
        let coverage = image.pixels.chunks_exact(4).map(|p| p[0]).collect();
        Self { width: image.width, height: image.height, coverage }
    }

    /// Which texels are lit.
    pub fn lit(&self) -> impl Iterator<Item = bool> {
        self.coverage.iter().map(|c| *c >= LIT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_lit_over_one_half() {
        let pixels = [127u8, 128, 255, 0].iter().flat_map(|c| [*c, 0, 0, 255]).collect();
        let mask = Mask::from_image(&Image { width: 2, height: 2, pixels, ..Image::default() });
        assert!(mask.lit().eq([false, true, true, false]));
    }
}
