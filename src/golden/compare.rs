//! The comparison itself: pixel differences, connected groups of them, and slow drifts of colour.

use crate::scene::Image;
use crate::{Error, Result};

/// Side of the tiles whose mean must not drift, pixels.
const TILE: usize = 16;
/// Tiles with fewer comparable pixels say nothing about a drift.
const TILE_MIN_PIXELS: u32 = TILE as u32 * 4;

/// What may differ before a picture is wrong. Every bound must hold.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Tolerance {
    /// A pixel is an outlier where a channel is off by more than this. Range 0..255. Default: 2.
    pub channel: u8,
    /// Share of outliers over all pixels that may be there. Range 0..1. Default: 0.0005.
    pub outliers: f32,
    /// Pixels in the largest 8-connected group of outliers that may be there. Default: 6.
    pub blob: u32,
    /// How far the mean of a 16 × 16 tile may move in any channel, outliers left out. Range 0..255. Default: 1.
    pub drift: f32,
}

impl Default for Tolerance {
    fn default() -> Self {
        Self { channel: 2, outliers: 0.0005, blob: 6, drift: 1.0 }
    }
}

impl Tolerance {
    /// Every byte must be the same.
    pub const EXACT: Self = Self { channel: 0, outliers: 0.0, blob: 0, drift: 0.0 };
}

/// A connected group of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Blob {
    /// How many pixels it has.
    pub pixels: u32,
    /// Left and upper end, pixels from the upper left corner.
    pub min: [u32; 2],
    /// Right and lower end, inclusive.
    pub max: [u32; 2],
}

/// What a comparison found.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Report {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Mean absolute difference over all channels. Range 0..255. Only to be read: no decision rests on it.
    pub mean_abs: f64,
    /// Largest difference in any channel. Range 0..255.
    pub max_abs: u8,
    /// Pixels with a channel off by more than [`Tolerance::channel`].
    pub outliers: u32,
    /// Largest 8-connected group of outliers; `None` where there are none.
    pub largest_blob: Option<Blob>,
    /// Largest move of a tile's mean in any channel. Range 0..255.
    pub drift: f32,
    /// Upper left corner of the tile of `drift`, pixels.
    pub drift_at: [u32; 2],
}

impl Report {
    /// Outliers over all pixels. Range 0..1.
    #[must_use]
    pub fn outlier_share(&self) -> f64 {
        f64::from(self.outliers) / (f64::from(self.size[0]) * f64::from(self.size[1]))
    }

    /// What is over the tolerance, in one line; `None` where the picture passes.
    #[must_use]
    pub fn fault(&self, tolerance: &Tolerance) -> Option<String> {
        let mut faults = Vec::new();
        if self.outlier_share() > f64::from(tolerance.outliers) {
            faults.push(format!(
                "{} pixels ({:.3} %) are off by more than {}/255, allowed {:.3} %",
                self.outliers,
                self.outlier_share() * 100.0,
                tolerance.channel,
                tolerance.outliers * 100.0
            ));
        }
        if let Some(blob) = self.largest_blob.filter(|blob| blob.pixels > tolerance.blob) {
            let ([x0, y0], [x1, y1]) = (blob.min, blob.max);
            faults.push(format!(
                "{} of them lie together in ({x0}, {y0})..=({x1}, {y1}), allowed {}",
                blob.pixels, tolerance.blob
            ));
        }
        if self.drift > tolerance.drift {
            let [x, y] = self.drift_at;
            faults.push(format!(
                "the mean of the tile at ({x}, {y}) moved by {:.2}/255, allowed {:.2}",
                self.drift, tolerance.drift
            ));
        }
        (!faults.is_empty()).then(|| format!("{} (largest difference {}/255)", faults.join("; "), self.max_abs))
    }
}

/// Compares two pictures; [`Report::fault`] then says whether they agree.
///
/// Colour counts by alpha: where both pictures are transparent, their colours do not matter.
///
/// # Errors
/// Where the sizes differ, a buffer has the wrong length, or both arguments are the same picture in memory.
pub fn compare(expected: &Image, actual: &Image, tolerance: &Tolerance) -> Result<Report> {
    refuse(expected, actual)?;
    let (width, height) = (expected.width as usize, expected.height as usize);
    let tiles_x = width.div_ceil(TILE);
    let mut tiles = vec![([0i32; 4], 0u32); tiles_x * height.div_ceil(TILE)];
    let mut wrong = vec![false; width * height];
    let (mut sum, mut max_abs, mut outliers) = (0u64, 0u8, 0u32);

    let pairs = expected.pixels.chunks_exact(4).zip(actual.pixels.chunks_exact(4));
    for ((index, wrong), (a, b)) in wrong.iter_mut().enumerate().zip(pairs) {
        let difference = pixel_difference(a, b);
        let largest = difference.iter().map(|d| d.unsigned_abs()).max().unwrap_or(0) as u8;
        sum += difference.iter().map(|d| u64::from(d.unsigned_abs())).sum::<u64>();
        max_abs = max_abs.max(largest);
        if largest > tolerance.channel {
            *wrong = true;
            outliers += 1;
        } else {
            let (total, count) = &mut tiles[index / width / TILE * tiles_x + index % width / TILE];
            for (total, d) in total.iter_mut().zip(difference) {
                *total += i32::from(d);
            }
            *count += 1;
        }
    }

    let (mut drift, mut drift_at) = (0f32, [0; 2]);
    for (index, (total, count)) in tiles.iter().enumerate().filter(|(_, (_, count))| *count >= TILE_MIN_PIXELS) {
        let moved = total.iter().map(|t| t.unsigned_abs()).max().unwrap_or(0) as f32 / *count as f32;
        if moved > drift {
            drift = moved;
            drift_at = [(index % tiles_x * TILE) as u32, (index / tiles_x * TILE) as u32];
        }
    }

    Ok(Report {
        size: [expected.width, expected.height],
        mean_abs: sum as f64 / (width * height * 4) as f64,
        max_abs,
        outliers,
        largest_blob: largest_blob(&wrong, expected.width),
        drift,
        drift_at,
    })
}

/// Actual minus expected, the colour channels scaled by the larger alpha and rounded away from 0.
pub(super) fn pixel_difference(expected: &[u8], actual: &[u8]) -> [i16; 4] {
    let alpha = i32::from(expected[3].max(actual[3]));
    let channel = |i: usize| {
        let scaled = (i32::from(actual[i]) - i32::from(expected[i])) * alpha;
        ((scaled.abs() + 254) / 255 * scaled.signum()) as i16
    };
    [channel(0), channel(1), channel(2), i16::from(actual[3]) - i16::from(expected[3])]
}

fn refuse(expected: &Image, actual: &Image) -> Result<()> {
    let argument = |message: String| Err(Error::Argument { what: "picture".into(), message });
    if std::ptr::eq(expected, actual) || std::ptr::eq(expected.pixels.as_ptr(), actual.pixels.as_ptr()) {
        return argument("compared with itself".into());
    }
    if (expected.width, expected.height) != (actual.width, actual.height) {
        return argument(format!(
            "is {} x {}, expected {} x {}",
            actual.width, actual.height, expected.width, expected.height
        ));
    }
    let bytes = u64::from(expected.width) * u64::from(expected.height) * 4;
    for picture in [expected, actual] {
        if bytes == 0 || picture.pixels.len() as u64 != bytes {
            return argument(format!("has {} bytes, expected {bytes} and not 0", picture.pixels.len()));
        }
    }
    Ok(())
}

/// The largest 8-connected group of set pixels in a picture of `width` columns; the first of several.
///
/// # Panics
/// Where `width` is 0 and the mask is not empty.
#[must_use]
pub fn largest_blob(mask: &[bool], width: u32) -> Option<Blob> {
    let columns = width as usize;
    let mut open = mask.to_vec();
    let mut stack = Vec::new();
    let mut largest: Option<Blob> = None;
    for start in 0..open.len() {
        if !std::mem::take(&mut open[start]) {
            continue;
        }
        let mut blob = Blob { pixels: 0, min: [u32::MAX; 2], max: [0; 2] };
        stack.push(start);
        while let Some(index) = stack.pop() {
            let (x, y) = (index % columns, index / columns);
            blob.pixels += 1;
            for (axis, at) in [x as u32, y as u32].into_iter().enumerate() {
                blob.min[axis] = blob.min[axis].min(at);
                blob.max[axis] = blob.max[axis].max(at);
            }
            for near_y in y.saturating_sub(1)..=y + 1 {
                for near_x in x.saturating_sub(1)..=(x + 1).min(columns - 1) {
                    let near = near_y * columns + near_x;
                    if open.get_mut(near).is_some_and(std::mem::take) {
                        stack.push(near);
                    }
                }
            }
        }
        if largest.is_none_or(|l| blob.pixels > l.pixels) {
            largest = Some(blob);
        }
    }
    largest
}
