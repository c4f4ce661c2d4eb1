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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_lit_over_one_half() {
        let pixels = [127u8, 128, 255, 0].iter().flat_map(|c| [*c, 0, 0, 255]).collect();
        let mask = Mask::from_image(&Image { width: 2, height: 2, pixels, ..Image::default() });
        assert_eq!(mask, Mask::from_fn(2, 2, |x, y| (x, y) == (1, 0) || (x, y) == (0, 1)));
    }
}
