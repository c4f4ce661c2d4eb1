//! Numbers that tell two pictures apart.

use hikage::golden::{Blob, largest_blob};
use hikage::scene::Image;
use serde::Serialize;

/// A pixel is off where a channel differs by more than this.
pub(super) const OFF: u8 = 8;
/// Half the width of the band along silhouettes, pixels.
pub(super) const BAND: usize = 2;
/// Levels of the depth picture between neighbours that make a silhouette: about a hundredth of the depth of what is seen.
pub(super) const STEP: u8 = 3;

/// Numbers over a set of pixels.
#[derive(Clone, Copy, Default, Serialize)]
pub(super) struct Figures {
    /// Pixels in the set, without the band.
    pub(super) pixels: u32,
    /// Mean absolute difference over RGB of all pixels of the set, band included. Range 0..255.
    pub(super) mean_abs: f64,
    /// Share of the pixels outside the band that are off. Range 0..1.
    pub(super) off_share: f64,
    /// Largest group of them.
    pub(super) largest_blob: Option<Blob>,
}

/// Part number + 1 of every pixel, 0 for background.
pub(super) fn part_ids(picture: &Image) -> Vec<u16> {
    picture.pixels.chunks_exact(4).map(|p| u16::from_le_bytes([p[0], p[1]])).collect()
}

/// Which pixels have a silhouette within [`BAND`] pixels, diagonals included: the border of a part, or a step of at least
/// [`STEP`] in the depth picture, as where one lock of hair lies before another.
pub(super) fn band(ids: &[u16], depth: &Image) -> Vec<bool> {
    let (width, height) = (depth.width as usize, depth.height as usize);
    let grey = |i: usize| depth.pixels[i * 4];
    let mut near = vec![false; ids.len()];
    for y in 0..height {
        for x in 0..width {
            let i = y * width + x;
            // The other half of the neighbours meets this pixel from its own side.
            for (dx, dy) in [(1, 0), (-1, 1), (0, 1), (1, 1)] {
                let (Some(x), y) = (x.checked_add_signed(dx).filter(|x| *x < width), y + dy) else { continue };
                let j = y * width + x;
                if y < height && (ids[i] != ids[j] || grey(i).abs_diff(grey(j)) >= STEP) {
                    (near[i], near[j]) = (true, true);
                }
            }
        }
    }
    // Pixels beside a silhouette are near by one already.
    for _ in 1..BAND {
        let before = near.clone();
        for i in (0..near.len()).filter(|i| before[*i]) {
            let (x, y) = (i % width, i / width);
            for y in y.saturating_sub(1)..(y + 2).min(height) {
                near[y * width..][x.saturating_sub(1)..(x + 2).min(width)].fill(true);
            }
        }
    }
    near
}

/// Sum over RGB, and largest over RGBA, of the absolute differences of every pixel, both laid on mid grey.
pub(super) fn differences(theirs: &Image, ours: &Image) -> Vec<(u16, u8)> {
    let on_grey = |p: &[u8], i: usize| {
        let alpha = u32::from(p[3]);
        ((u32::from(p[i]) * alpha + 128 * (255 - alpha) + 127) / 255) as u8
    };
    let pairs = theirs.pixels.chunks_exact(4).zip(ours.pixels.chunks_exact(4));
    pairs
        .map(|(a, b)| {
            let rgb = [0, 1, 2].map(|i| on_grey(a, i).abs_diff(on_grey(b, i)));
            let largest = rgb.iter().fold(a[3].abs_diff(b[3]), |m, d| m.max(*d));
            (rgb.iter().map(|d| u16::from(*d)).sum(), largest)
        })
        .collect()
}

pub(super) fn figures(
    differences: &[(u16, u8)],
    width: u32,
    in_band: &[bool],
    counts: impl Fn(usize) -> bool,
) -> Figures {
    let (mut sum, mut members, mut pixels, mut off_pixels) = (0u64, 0u64, 0u32, 0u32);
    let mut off = vec![false; differences.len()];
    for (i, (rgb, largest)) in differences.iter().enumerate().filter(|(i, _)| counts(*i)) {
        sum += u64::from(*rgb);
        members += 1;
        if !in_band[i] {
            pixels += 1;
            off[i] = *largest > OFF;
            off_pixels += u32::from(off[i]);
        }
    }
    Figures {
        pixels,
        mean_abs: sum as f64 / (members.max(1) * 3) as f64,
        off_share: f64::from(off_pixels) / f64::from(pixels.max(1)),
        largest_blob: largest_blob(&off, width),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_band_reaches_two_pixels_to_each_side_and_over_corners() {
        let flat = Image { width: 9, height: 9, pixels: vec![90; 9 * 9 * 4], ..Image::default() };
        let mut ids = vec![1u16; 81];
        ids[4 * 9 + 4] = 2;
        let mut step = flat.clone();
        step.pixels[(4 * 9 + 4) * 4] += STEP;
        for band in [band(&ids, &flat), band(&[1; 81], &step)] {
            let inside = |x: usize, y: usize| x.abs_diff(4) <= 2 && y.abs_diff(4) <= 2;
            for (i, found) in band.iter().enumerate() {
                assert_eq!(*found, inside(i % 9, i / 9), "{i}");
            }
        }
        assert!(band(&[1; 81], &flat).iter().all(|near| !near));
    }

    #[test]
    fn colour_under_alpha_0_does_not_count_and_alpha_does() {
        let one = |pixel: [u8; 4]| Image { width: 1, height: 1, pixels: pixel.to_vec(), ..Image::default() };
        assert_eq!(differences(&one([9, 9, 9, 0]), &one([200, 0, 0, 0])), [(0, 0)]);
        assert_eq!(differences(&one([128, 128, 128, 0]), &one([128, 128, 128, 20])), [(0, 20)]);
    }
}
