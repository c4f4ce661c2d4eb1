//! A picture of colours in shade, for one that holds many colours: as a painter mixes a shade for each of the palette.

use rayon::prelude::*;

use crate::color::{linear_from_srgb, srgb_from_linear};
use crate::scene::Image;

/// Bits of a channel by which colours are told apart: by fewer, gradients would show steps.
const BITS: usize = 6;

/// The picture with each colour multiplied by what `factor` says of it, linear. `base` is what the material multiplies it with
/// before. `None` where there are no pixels.
pub(super) fn shaded(image: &Image, base: [f32; 3], factor: impl Fn([f32; 3]) -> [f32; 3] + Sync) -> Option<Image> {
    let is_whole = image.pixels.len() == image.width as usize * image.height as usize * 4;
    if !is_whole || image.pixels.is_empty() {
        return None;
    }
    let number = |pixel: &[u8]| pixel[..3].iter().fold(0, |n, c| n << BITS | usize::from(*c) >> (8 - BITS));
    let mut is_used = vec![false; 1 << (3 * BITS)];
    image.pixels.chunks_exact(4).for_each(|pixel| is_used[number(pixel)] = true);
    // Of encoded values, so that no pixel is decoded.
    let share = |number: usize| -> [f32; 3] {
        let encoded: [f32; 3] = std::array::from_fn(|c| {
            let step = number >> ((2 - c) * BITS) & ((1 << BITS) - 1);
            (step as f32 + 0.5) / (1 << BITS) as f32
        });
        let lit = encoded.map(linear_from_srgb);
        let by = factor(std::array::from_fn(|c| lit[c] * base[c]));
        std::array::from_fn(|c| srgb_from_linear(lit[c] * by[c]) / encoded[c])
    };
    let shares: Vec<[f32; 3]> =
        is_used.par_iter().enumerate().map(|(n, used)| if *used { share(n) } else { [1.0; 3] }).collect();
    let mut pixels = image.pixels.clone();
    pixels.par_chunks_exact_mut(4).with_min_len(4096).for_each(|pixel| {
        let by = shares[number(pixel)];
        pixel.iter_mut().zip(by).for_each(|(c, by)| *c = (f32::from(*c) * by).round().min(255.0) as u8);
    });
    Some(Image { name: format!("{} in shade", image.name), pixels, format: "", source_bits: 8, ..*image })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_color_has_its_own_factor_and_alpha_stays() {
        let pixels = vec![200, 10, 10, 255, 10, 10, 200, 0, 200, 200, 200, 128];
        let image = Image { width: 3, height: 1, pixels, ..Image::default() };
        let rule = |[r, _, b]: [f32; 3]| if r > 2.0 * b { [0.5, 1.0, 1.0] } else { [1.0, 1.0, 0.25] };
        let shade = shaded(&image, [1.0; 3], rule).unwrap();
        let linear = |code: u8| linear_from_srgb(f32::from(code) / 255.0);
        assert!((linear(shade.pixels[0]) / linear(200) - 0.5).abs() < 0.02, "{:?}", shade.pixels);
        assert!((linear(shade.pixels[6]) / linear(200) - 0.25).abs() < 0.02, "{:?}", shade.pixels);
        assert!((linear(shade.pixels[10]) / linear(200) - 0.25).abs() < 0.02, "{:?}", shade.pixels);
        assert_eq!([3, 7, 11].map(|i| shade.pixels[i]), [255, 0, 128]);
        assert_eq!(shade.pixels[4..6], [10, 10]);
        assert!(shaded(&Image { width: 2, ..image }, [1.0; 3], rule).is_none());
    }
}
