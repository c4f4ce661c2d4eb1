//! Whether a picture can be the comb of hair.

use crate::scene::Image;

/// Length of a direction, of 1, below which a texel has none.
const LEAST: f32 = 0.25;

/// Whether a picture holds directions in red and green: at least a tenth of its opaque texels are combed. Normal maps hold next to
/// none, and neither does what is gray.
pub(crate) fn holds_flow(image: &Image) -> bool {
    let texels = image.pixels.as_chunks::<4>().0;
    let stride = (texels.len() / 65_536).max(1);
    let (mut combed, mut all) = (0usize, 0usize);
    for [r, g, _, a] in texels.iter().step_by(stride) {
        if *a > 0 {
            let [x, y] = [r, g].map(|c| f32::from(*c) / 127.5 - 1.0);
            combed += usize::from(x.hypot(y) >= LEAST);
            all += 1;
        }
    }
    combed * 10 >= all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn combs_are_told_from_normal_maps() {
        let of =
            |texel: [u8; 4]| holds_flow(&Image { width: 8, height: 8, pixels: texel.repeat(64), ..Image::default() });
        assert!(of([128, 0, 128, 255]) && of([230, 60, 255, 255]));
        assert!(!of([128, 128, 255, 255]) && !of([140, 120, 250, 255]));
    }
}
