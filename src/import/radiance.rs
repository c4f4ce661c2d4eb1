//! Pictures of an environment: Radiance files (`.hdr`).

use std::io::Cursor;
use std::path::Path;

use image::{DynamicImage, ImageDecoder as _, codecs::hdr::HdrDecoder};

use super::Limits;
use super::image::{guarded, read};
use crate::scene::Radiance;
use crate::{Error, Result};

/// Reads an equirectangular picture of radiance, a Radiance file (`.hdr`, RGBE).
///
/// # Errors
/// The file cannot be read, is no Radiance file, ends too early, is over the [`Limits`] with their defaults, is not twice as wide
/// as it is high, or holds a number that is none.
pub fn load_radiance(path: impl AsRef<Path>) -> Result<Radiance> {
    let path = path.as_ref();
    let limits = Limits::default();
    let bytes = read(path, &limits)?;
    let fault = |pointer: &str, message: String| Error::Input {
        path: path.display().to_string(),
        pointer: pointer.to_owned(),
        message,
    };
    if !bytes.starts_with(b"#?") {
        let head = bytes.get(..bytes.len().min(8)).unwrap_or_default().escape_ascii();
        let message =
            format!("starts with \"{head}\"; expected a Radiance file (.hdr), which starts with \"#?RADIANCE\"");
        return Err(fault("header", message));
    }
    let decoder = guarded(|| HdrDecoder::new(Cursor::new(&bytes))).map_err(|m| fault("header", m))?;
    let (width, height) = decoder.dimensions();
    if width.max(height) > limits.image_size {
        return Err(Error::Limit {
            path: path.display().to_string(),
            pointer: "header".to_owned(),
            found: width.max(height).into(),
            limit: limits.image_size.into(),
            unit: "pixels along a side",
        });
    }
    if width == 0 || width != height.saturating_mul(2) {
        let message = format!("is {width} x {height} pixels; expected all directions, twice as wide as high");
        return Err(fault("header", message));
    }
    let pixels = guarded(|| DynamicImage::from_decoder(decoder))
        .map_err(|m| fault("pixels", format!("{m}; the file may be cut off")))?
        .into_rgb32f();
    let texels = pixels.pixels().map(|p| p.0).collect();
    Radiance::new(width, height, texels).map_err(|e| fault("pixels", e.to_string()))
}
