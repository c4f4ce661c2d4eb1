//! Where frames go: into an animated picture, a folder, or a contact sheet.

use std::path::{Path, PathBuf};

use hikage::picture::{encode_png, write_atomic};
use hikage::scene::Image;

use super::{Form, Out, Times};
use crate::animation::Animation;
use crate::failure::{Failure, warn};
use crate::sheet::{GAP, LINE, paper, place, write};

/// Longest side of a contact sheet, pixels.
const MOST_SIDE: u32 = 16384;

/// Where frames go.
pub(super) enum Sink<'a> {
    Animation(Animation),
    Folder(&'a Path),
    Sheet { sheet: Image, columns: usize },
}

impl<'a> Sink<'a> {
    /// For frames of this size, pixels.
    pub(super) fn new(out: &'a Out, times: &Times, [width, height]: [u32; 2]) -> Result<Self, Failure> {
        Ok(match out.form {
            Form::Animation(kind) => {
                let frame_ms = (times.step() * 1000.0).round() as u32;
                Self::Animation(Animation::new(kind, width, height, frame_ms).map_err(Failure::input)?)
            }
            Form::Folder => Self::Folder(&out.path),
            Form::Sheet => {
                let columns = columns(times.count, [width, height]);
                let rows = times.count.div_ceil(columns) as u32;
                let side = |cells: u32, cell: u32| cells.saturating_mul(cell.saturating_add(GAP)).saturating_add(GAP);
                let (whole, high) = (side(columns as u32, width), side(rows, height.saturating_add(LINE)));
                if whole.max(high) > MOST_SIDE {
                    let most = format!("at most {MOST_SIDE} a side; say fewer --frames or a smaller --size");
                    return Err(Failure::input(format!("the sheet would have {whole}x{high} pixels: {most}")));
                }
                Self::Sheet { sheet: paper(whole, high), columns }
            }
        })
    }

    /// Adds a frame, which shows a moment.
    pub(super) fn add(&mut self, picture: &Image, frame: usize, time_s: f32) -> Result<(), Failure> {
        match self {
            Self::Animation(animation) => animation.add(&picture.pixels).map_err(Failure::input)?,
            Self::Folder(folder) => write_atomic(file(folder, frame), &encode_png(picture)?)?,
            Self::Sheet { sheet, columns } => {
                let (column, row) = ((frame % *columns) as u32, (frame / *columns) as u32);
                let left = GAP + column * (picture.width + GAP);
                let top = GAP + row * (picture.height + LINE + GAP);
                place(sheet, picture, left, top);
                write(sheet, &format!("{time_s:.2} s"), left, top + picture.height + 4);
            }
        }
        Ok(())
    }

    /// The bytes of the file; none where frames are files of their own.
    pub(super) fn finish(self, frames: usize) -> Result<Option<Vec<u8>>, Failure> {
        Ok(match self {
            Self::Animation(animation) => Some(animation.finish().map_err(Failure::input)?),
            Self::Folder(folder) => {
                let old = file(folder, frames);
                if old.exists() {
                    warn(&format!("{}: is of an earlier animation, as those after it may be", old.display()));
                }
                None
            }
            Self::Sheet { sheet, .. } => Some(encode_png(&sheet)?),
        })
    }
}

fn file(folder: &Path, frame: usize) -> PathBuf {
    folder.join(format!("frame-{frame:04}.png"))
}

/// Cells in a line of a sheet that is about as wide as high: one more where fewer places stay empty.
fn columns(count: usize, [width, height]: [u32; 2]) -> usize {
    let shape = (height + LINE + GAP) as f32 / (width + GAP) as f32;
    let square = ((count as f32 * shape).sqrt().round() as usize).clamp(1, count.max(1));
    let empty = |columns: &usize| count.next_multiple_of(*columns) - count;
    [square, square + 1].into_iter().min_by_key(empty).unwrap_or(square)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sheets_are_about_square() {
        assert_eq!(columns(12, [320, 400]), 4);
        assert_eq!(columns(12, [640, 400]), 3);
        assert_eq!(columns(8, [240, 300]), 4);
        assert_eq!(columns(10, [320, 400]), 5);
        assert_eq!(columns(1, [10, 4000]), 1);
        assert_eq!(columns(3, [10, 4000]), 3);
    }
}
