//! The marks of a hair band as a painter sets them: one a lock, an arc with points where the strands end.

use rayon::prelude::*;

use super::BandStyle;
use crate::scene::Image;
use crate::smoothstep::smoothstep;

/// Cells of the picture from left to right: first those of the ring, then a row of marks for each strength.
pub(super) const CELLS: usize = RING_CELLS + LEVELS * VARIANTS;
/// Cells of the ring, which reaches from the front of the head to its back.
pub(super) const RING_CELLS: usize = 8;
/// Strengths, the last one full.
pub(super) const LEVELS: usize = 4;
/// Marks of one strength: the first half for narrow locks, the others for wide ones.
pub(super) const VARIANTS: usize = 4;

/// Texels of a cell, and of the picture's height.
const CELL: usize = 96;
const HEIGHT: usize = 128;
/// Thickness of the band, share of the picture's height.
const THICK: f32 = 0.232;

/// The same number between 0 and 1 for the same place.
fn hash(x: usize, seed: u32) -> f32 {
    let mut h = (x as u32).wrapping_mul(0x9e37_79b1) ^ seed.wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 15)).wrapping_mul(0x2c1b_3c6d);
    h = (h ^ (h >> 12)).wrapping_mul(0x297a_2d39);
    (h ^ (h >> 15)) as f32 / u32::MAX as f32
}

/// The upper and lower edge of a mark at `t` across a lock, in thicknesses below the band's middle; of the same height where
/// there is none.
fn edges(style: BandStyle, seed: usize, points: usize, t: f32) -> [f32; 2] {
    let across = 2.0 * t - 1.0;
    let lens = (1.0 - across * across).max(0.0);
    // It hangs through in the middle of a lock, as light does on a round one.
    let sag = 0.3 * lens - 0.15;
    if style == BandStyle::W {
        let fold = (t * 2.0 * (points.max(2) as f32)).rem_euclid(2.0);
        let zig = (fold - 1.0).abs() * 0.8 - 0.4;
        let half = 0.2 * lens.powf(0.7);
        return [sag + zig - half, sag + zig + half];
    }
    let body = lens.powf(0.6);
    let mut tip = 0.0f32;
    for i in 0..points {
        let middle = (i as f32 + 0.5 + 0.5 * (hash(seed * 16 + i, 3) - 0.5)) / points as f32;
        let width = 0.55 / points as f32 * (0.8 + 0.5 * hash(seed * 16 + i, 5));
        let long = (0.35 + 0.75 * hash(seed * 16 + i, 7)) * (0.4 + 0.6 * lens);
        tip = tip.max(long * (1.0 - (t - middle).abs() / width).max(0.0).powf(1.2));
    }
    let top = sag - body * (0.42 + 0.1 * hash(seed, 9));
    [top, (sag + body * 0.12 + tip * body).max(top)]
}

/// What a column of texels shows of a mark.
#[derive(Clone, Copy)]
struct Column {
    /// Upper and lower edge, in thicknesses below the band's middle.
    edges: [f32; 2],
    /// Share of the mark's strength.
    strength: f32,
}

impl Column {
    fn at(style: BandStyle, x: usize) -> Self {
        let (cell, t) = (x / CELL, (x % CELL) as f32 / CELL as f32);
        let Some(cell) = cell.checked_sub(RING_CELLS) else {
            return ring(style, (x as f32 + 0.5) / (RING_CELLS * CELL) as f32);
        };
        let (level, variant) = (cell / VARIANTS + 1, cell % VARIANTS);
        let points = if variant < VARIANTS / 2 {
            1 + variant % 2
        } else {
            3 + variant % 2
        };
        // A tenth of the cell on both sides stays empty: the lock's border.
        Self::faded(style, variant, points, (t - 0.13) / 0.74, level as f32 / LEVELS as f32)
    }

    /// A mark of which this share is left: it gets smaller and not only fainter, as a painter lets a row of them end.
    fn faded(style: BandStyle, seed: usize, points: usize, t: f32, share: f32) -> Self {
        let edges = edges(style, seed, points, 0.5 + (t - 0.5) / (0.35 + 0.65 * share));
        Self { edges: edges.map(|edge| edge * (0.25 + 0.75 * share)), strength: (2.0 * share).min(1.0) }
    }

    /// Coverage of one texel.
    fn cover(self, y: f32) -> f32 {
        let [top, bottom] = self.edges;
        let edge = 1.2 / (THICK * HEIGHT as f32);
        let inside = smoothstep(top - edge, top + edge, y) * smoothstep(bottom + edge, bottom - edge, y);
        // A mark that ends in a point has no width there to fill a texel.
        self.strength * inside * smoothstep(0.0, 2.0 * edge, bottom - top)
    }
}

/// The ring at a share of the way from the front to the back.
fn ring(style: BandStyle, around: f32) -> Column {
    let strength = smoothstep(0.56, 0.27, around);
    if style == BandStyle::Ring {
        let wave = 0.05 * (around * 40.0).sin() + 0.04 * (around * 93.0 + 1.0).sin();
        let half = 0.36 * smoothstep(0.6, 0.2, around);
        return Column { edges: [wave - half, wave + half], strength };
    }
    let cells = RING_CELLS as f32;
    let place = around * cells;
    // Locks of uneven width.
    let border = |i: usize| i as f32 + if i == 0 { 0.0 } else { 0.5 * (hash(i, 11) - 0.5) };
    let i = (0..RING_CELLS).rev().find(|i| border(*i) <= place).unwrap_or(0);
    let t = (place - border(i)) / (border(i + 1) - border(i));
    Column::faded(style, 40 + i, 3, (t - 0.04) / 0.92, strength)
}

/// Red: the marks, 0 where there is none.
pub(super) fn paint(style: BandStyle) -> Image {
    let width = CELLS * CELL;
    let columns: Vec<Column> = (0..width).map(|x| Column::at(style, x)).collect();
    let mut pixels = [0u8, 0, 0, 255].repeat(width * HEIGHT);
    pixels.par_chunks_exact_mut(width * 4).enumerate().for_each(|(row, out)| {
        let y = ((row as f32 + 0.5) / HEIGHT as f32 - 0.5) / THICK;
        if y.abs() > 2.0 {
            return;
        }
        for (column, texel) in columns.iter().zip(out.chunks_exact_mut(4)) {
            texel[0] = (column.cover(y).clamp(0.0, 1.0) * 255.0).round() as u8;
        }
    });
    Image {
        name: "hair band".to_owned(),
        width: width as u32,
        height: HEIGHT as u32,
        pixels,
        source_bits: 8,
        ..Image::default()
    }
}
