//! The picture that a person looks at when a check failed: expected, actual and their difference side by side.

use tiny_skia::{
    Color, ColorU8, FilterQuality, Paint, PathBuilder, Pixmap, PixmapPaint, PremultipliedColorU8, Rect, Stroke,
    Transform,
};

use super::Report;
use super::compare::pixel_difference;
use crate::scene::Image;
use crate::{Error, Result};

/// Space between and around the panels, pixels.
const GAP: u32 = 8;
/// Panels of smaller pictures are enlarged by a whole factor up to about this side, pixels.
const PANEL: u32 = 384;
/// Differences are multiplied by this, so that 3/255 can be seen.
const AMPLIFY: u16 = 16;

/// Draws expected, actual and the amplified difference (black where equal) with a frame round the largest group of
/// wrong pixels. Where the sizes differ, the third panel is missing.
///
/// # Errors
/// Where a picture is empty or its buffer has the wrong length.
pub fn sheet(expected: &Image, actual: &Image, report: Option<&Report>) -> Result<Image> {
    let mut panels = vec![pixmap(expected)?, pixmap(actual)?];
    if (expected.width, expected.height) == (actual.width, actual.height) {
        panels.push(pixmap(&difference(expected, actual))?);
    }
    let widest = panels.iter().map(|p| p.width().max(p.height())).max().unwrap_or(1);
    let zoom = (PANEL / widest).max(1);

    let width = panels.iter().map(|p| p.width() * zoom + GAP).sum::<u32>() + GAP;
    let height = panels.iter().map(|p| p.height() * zoom).max().unwrap_or(1) + 2 * GAP;
    let mut canvas = Pixmap::new(width, height).ok_or_else(|| too_large(width, height))?;
    canvas.fill(Color::from_rgba8(96, 96, 104, 255));

    let mut x = GAP;
    let paint = PixmapPaint { quality: FilterQuality::Nearest, ..PixmapPaint::default() };
    for panel in &panels {
        let place = Transform::from_row(zoom as f32, 0.0, 0.0, zoom as f32, x as f32, GAP as f32);
        canvas.draw_pixmap(0, 0, panel.as_ref(), &paint, place, None);
        x += panel.width() * zoom + GAP;
    }
    if let (Some(blob), 3) = (report.and_then(|r| r.largest_blob), panels.len()) {
        let left = GAP + 2 * (expected.width * zoom + GAP);
        let around = |at: u32, by: i64| (i64::from(at * zoom) + by) as f32;
        let frame = Rect::from_ltrb(
            left as f32 + around(blob.min[0], -3),
            GAP as f32 + around(blob.min[1], -3),
            left as f32 + around(blob.max[0] + 1, 3),
            GAP as f32 + around(blob.max[1] + 1, 3),
        );
        if let Some(frame) = frame {
            let mut red = Paint::default();
            red.set_color_rgba8(255, 48, 48, 255);
            let stroke = Stroke { width: 2.0, ..Stroke::default() };
            canvas.stroke_path(&PathBuilder::from_rect(frame), &red, &stroke, Transform::identity(), None);
        }
    }
    // The canvas is opaque: premultiplied and straight alpha are the same there.
    Ok(Image { width, height, pixels: canvas.take(), format: "png", source_bits: 8, ..Image::default() })
}

/// Amplified absolute difference of colour, with that of alpha added to all channels. Sizes are equal.
fn difference(expected: &Image, actual: &Image) -> Image {
    let mut pixels = Vec::with_capacity(expected.pixels.len());
    for (a, b) in expected.pixels.chunks_exact(4).zip(actual.pixels.chunks_exact(4)) {
        let [red, green, blue, alpha] = pixel_difference(a, b).map(i16::unsigned_abs);
        pixels.extend([red, green, blue].map(|c| ((c + alpha) * AMPLIFY).min(255) as u8));
        pixels.push(255);
    }
    Image { pixels, ..Image { width: expected.width, height: expected.height, ..Image::default() } }
}

fn pixmap(picture: &Image) -> Result<Pixmap> {
    let mut pixmap = Pixmap::new(picture.width, picture.height)
        .filter(|p| p.data().len() == picture.pixels.len())
        .ok_or_else(|| too_large(picture.width, picture.height))?;
    for (to, from) in pixmap.pixels_mut().iter_mut().zip(picture.pixels.chunks_exact(4)) {
        *to = match from {
            [r, g, b, a] => ColorU8::from_rgba(*r, *g, *b, *a).premultiply(),
            _ => PremultipliedColorU8::TRANSPARENT,
        };
    }
    Ok(pixmap)
}

fn too_large(width: u32, height: u32) -> Error {
    Error::Argument {
        what: "picture".into(),
        message: format!("{width} x {height} pixels are none, too many, or not as many as the buffer holds"),
    }
}
