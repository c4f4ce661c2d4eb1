//! One key, read row by row from the top: a picture in a file or in memory, and shapes drawn over it.

use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

use png::{BitDepth, ColorType, Transformations};
use serde::{Deserialize, Serialize};

use super::{Drawing, LIT, Mask};
use crate::import::{Limits, image};
use crate::{Error, Result};

/// What of a drawing says how much is lit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MaskChannel {
    /// Its brightness (luma of Rec. 709 in the numbers of the file); what is transparent counts as black.
    #[default]
    Luma,
    /// Its opacity, whatever its colour.
    Alpha,
}

/// A drawing of a key in a file: PNG or WebP, 8 or 16 bits.
#[derive(Clone, Debug, PartialEq)]
pub struct MaskFile {
    /// The file.
    pub path: PathBuf,
    /// What of it says how much is lit.
    pub channel: MaskChannel,
    /// Value from which on a texel is lit, 0..1. Default: 0.5.
    pub threshold: f32,
}

impl MaskFile {
    /// A file whose brightness over one half is lit.
    #[must_use]
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self { path: path.into(), channel: MaskChannel::default(), threshold: 0.5 }
    }

    /// Reads the whole drawing.
    ///
    /// # Errors
    /// The file cannot be read, is no PNG or WebP, is corrupt, or is larger than [`MAX_SIDE`](super::MAX_SIDE).
    pub fn load(&self) -> Result<Mask> {
        let mut source = Source::file(self)?;
        let [width, height] = source.size;
        let mut coverage = vec![0; width as usize * height as usize];
        source.read(&mut coverage)?;
        Ok(Mask { width, height, coverage })
    }
}

enum Picture<'a> {
    Even(u8),
    Memory(&'a [u8]),
    Png(Box<PngRows>),
}

/// Rows of coverage.
pub(super) struct Source<'a> {
    picture: Picture<'a>,
    drawing: Option<(&'a Drawing, f32)>,
    /// Width and height, texels.
    pub(super) size: [u32; 2],
    top: u32,
}

impl<'a> Source<'a> {
    /// Light or shade everywhere.
    pub(super) fn even(lit: bool, size: [u32; 2]) -> Self {
        Self { picture: Picture::Even(if lit { 255 } else { 0 }), drawing: None, size, top: 0 }
    }

    /// A mask in memory, which holds as many texels as its sides say.
    pub(super) fn mask(mask: &'a Mask) -> Self {
        Self { picture: Picture::Memory(&mask.coverage), drawing: None, size: [mask.width, mask.height], top: 0 }
    }

    /// A file whose header has been read.
    pub(super) fn file(file: &MaskFile) -> Result<Self> {
        let rows = PngRows::open(file)?;
        Ok(Self { size: rows.size, picture: Picture::Png(Box::new(rows)), drawing: None, top: 0 })
    }

    /// With shapes drawn over it as they are at an angle, degrees.
    pub(super) fn with(self, drawing: &'a Drawing, angle_deg: f32) -> Self {
        Self { drawing: Some((drawing, angle_deg)), ..self }
    }

    pub(super) fn is_drawn(&self) -> bool {
        self.drawing.is_some()
    }

    /// The next rows.
    pub(super) fn read(&mut self, coverage: &mut [u8]) -> Result<()> {
        let [width, height] = self.size;
        match &mut self.picture {
            Picture::Even(value) => coverage.fill(*value),
            Picture::Memory(all) => {
                let (now, rest) = all.split_at(coverage.len().min(all.len()));
                coverage[..now.len()].copy_from_slice(now);
                *all = rest;
            }
            Picture::Png(rows) => rows.read(coverage)?,
        }
        if let Some((drawing, angle)) = self.drawing {
            drawing.draw(angle, width, height, self.top, coverage);
        }
        self.top += coverage.len() as u32 / width.max(1);
        Ok(())
    }
}

/// A PNG that is decoded as its rows are asked for.
struct PngRows {
    path: PathBuf,
    reader: png::Reader<Cursor<Vec<u8>>>,
    size: [u32; 2],
    channels: usize,
    /// 1 or 2.
    bytes: usize,
    channel: MaskChannel,
    /// Coverage of each 8-bit value: its threshold becomes one half.
    table: Box<[u8; 256]>,
    row: Vec<u8>,
}

impl PngRows {
    fn open(file: &MaskFile) -> Result<Self> {
        let path = &file.path;
        if !(file.threshold > 0.0 && file.threshold < 1.0) {
            let message = format!("is {}; expected a number between 0 and 1", file.threshold);
            return Err(Error::Argument { what: format!("threshold of {}", path.display()), message });
        }
        let limits = Limits { image_size: super::MAX_SIDE, image_bytes: u64::MAX, ..Limits::default() };
        let bytes = image::rows_of_png(path, &image::read(path, &limits)?, &limits)?;
        // Bytes that say nothing about the size have been dropped, and rows are decoded one at a time.
        let mut decoder = png::Decoder::new(Cursor::new(bytes));
        decoder.set_transformations(Transformations::EXPAND);
        let reader = guarded(path, || decoder.read_info())?;
        let (color, depth) = reader.output_color_type();
        let channels = match color {
            ColorType::Grayscale => 1,
            ColorType::GrayscaleAlpha => 2,
            ColorType::Rgb => 3,
            ColorType::Rgba | ColorType::Indexed => 4,
        };
        let bytes = if depth == BitDepth::Sixteen { 2 } else { 1 };
        let info = reader.info();
        let size = [info.width, info.height];
        let row = vec![0; info.width as usize * channels * bytes];
        let coverage = |value: usize| {
            let (value, threshold) = (value as f32, file.threshold * 255.0);
            let half = f32::from(LIT) - 0.5;
            let coverage = if value < threshold {
                value / threshold * half
            } else {
                255.0 - (255.0 - value) / (255.0 - threshold) * (255.0 - half)
            };
            coverage.round() as u8
        };
        let table = Box::new(std::array::from_fn(coverage));
        Ok(Self { path: path.clone(), reader, size, channels, bytes, channel: file.channel, table, row })
    }

    fn read(&mut self, coverage: &mut [u8]) -> Result<()> {
        let Self { path, reader, size, channels, bytes, channel, table, row } = self;
        let pixel = *channels * *bytes;
        for out in coverage.chunks_exact_mut(size[0] as usize) {
            guarded(path, || reader.read_row(row))?;
            let of = |p: &[u8], c: usize| u32::from(p[c * *bytes]);
            match (*channel, *channels) {
                (MaskChannel::Alpha, 1 | 3) => out.fill(255),
                (MaskChannel::Luma, 1) if *bytes == 1 => {
                    out.iter_mut().zip(&*row).for_each(|(out, value)| *out = table[usize::from(*value)]);
                }
                (channel, channels) => {
                    for (out, p) in out.iter_mut().zip(row.chunks_exact(pixel)) {
                        let luma = |p: &[u8]| (54 * of(p, 0) + 183 * of(p, 1) + 19 * of(p, 2)) / 256;
                        let value = match (channel, channels) {
                            (MaskChannel::Alpha, n) => of(p, n - 1),
                            (MaskChannel::Luma, 1) => of(p, 0),
                            (MaskChannel::Luma, 2) => of(p, 0) * of(p, 1) / 255,
                            (MaskChannel::Luma, 3) => luma(p),
                            (MaskChannel::Luma, _) => luma(p) * of(p, 3) / 255,
                        };
                        *out = table[value as usize];
                    }
                }
            }
        }
        Ok(())
    }
}

/// Runs a decoder on bytes of a stranger; a panic inside it becomes an error.
fn guarded<T>(path: &Path, decode: impl FnOnce() -> std::result::Result<T, png::DecodingError>) -> Result<T> {
    let message = match catch_unwind(AssertUnwindSafe(decode)) {
        Ok(Ok(value)) => return Ok(value),
        Ok(Err(e)) => e.to_string(),
        Err(_) => "the decoder failed on corrupt data".into(),
    };
    Err(Error::Input { path: path.display().to_string(), pointer: "image".into(), message })
}
