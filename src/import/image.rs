//! Hardened decoding of PNG, JPEG and WebP: size checked by header, ancillary PNG chunks dropped, panics contained.

use std::borrow::Cow;
use std::io::Cursor;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use image::{ColorType, DynamicImage, ImageDecoder, codecs};

use crate::scene::Image;
use crate::sdf::Texels;
use crate::{Error, Result};

use super::Limits;
use super::fault::{Fault, within};
use super::files::{ReadFault, read_regular};

const PNG_SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Reads and decodes an image file.
///
/// # Errors
/// The file cannot be read, is no PNG, JPEG or WebP, is corrupt, or is over the [`Limits`] with their defaults.
pub fn load(path: impl AsRef<Path>) -> Result<Image> {
    let path = path.as_ref();
    let limits = Limits::default();
    let mut image = decode(&path.display().to_string(), &read(path, &limits)?, &limits)?;
    image.name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(image)
}

/// Reads an image file as plain numbers with all the bits that it has.
///
/// # Errors
/// Those of [`load`].
pub fn load_texels(path: impl AsRef<Path>) -> Result<Texels> {
    let path = path.as_ref();
    let limits = Limits::default();
    let bytes = read(path, &limits)?;
    let texels = probe("image", &bytes, &limits).and_then(|p| {
        if p.bits == 16 {
            p.decode_wide("image", &limits)
        } else {
            Ok(Texels::from(&p.decode("image", &limits)?))
        }
    });
    texels.map_err(|fault| fault.into_error(&path.display().to_string()))
}

/// Decodes an image in memory. `name` stands in errors and becomes the name of the image.
///
/// # Errors
/// The bytes are no PNG, JPEG or WebP, are corrupt, or are over the limits.
pub fn decode(name: &str, bytes: &[u8], limits: &Limits) -> Result<Image> {
    let decoded = probe("image", bytes, limits).and_then(|p| p.decode("image", limits));
    decoded.map(|image| Image { name: name.to_owned(), ..image }).map_err(|fault| fault.into_error(name))
}

/// A picture as a PNG that can be decoded row by row: checked, without the chunks that pixels do not need. What cannot be
/// (WebP, JPEG, interlaced PNG) is decoded and encoded again.
pub(crate) fn rows_of_png(path: &Path, bytes: &[u8], limits: &Limits) -> Result<Vec<u8>> {
    let name = path.display().to_string();
    let probe = probe("image", bytes, limits).map_err(|fault| fault.into_error(&name))?;
    // The last byte of the header, which stands first.
    if probe.format == Format::Png && probe.bytes.get(28) == Some(&0) {
        return Ok(probe.bytes.into_owned());
    }
    let image = probe.decode("image", limits).map_err(|fault| fault.into_error(&name))?;
    crate::picture::encode_png(&image)
}

/// Reads a regular file within the limits.
pub(crate) fn read(path: &Path, limits: &Limits) -> Result<Vec<u8>> {
    read_regular(path, limits).map_err(|fault| read_error(&path.display().to_string(), fault, limits))
}

/// The public error of a failed read.
fn read_error(name: &str, fault: ReadFault, limits: &Limits) -> Error {
    match fault {
        ReadFault::Io(e) => Error::io(name, &e),
        ReadFault::NotRegular => Error::Io { path: name.to_owned(), reason: "not a regular file".into() },
        ReadFault::TooLarge(found) => {
            Fault::Limit { pointer: "file".into(), found, limit: limits.file_bytes, unit: "bytes" }.into_error(name)
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Format {
    Png,
    Jpeg,
    Webp,
}

/// An image whose header is known and within the limits.
#[derive(Debug)]
pub(super) struct Probe<'a> {
    format: Format,
    bytes: Cow<'a, [u8]>,
    pub(super) width: u32,
    pub(super) height: u32,
    bits: u8,
}

/// Finds format and size without decoding pixels.
pub(super) fn probe<'a>(pointer: &str, bytes: &'a [u8], limits: &Limits) -> super::fault::Result<Probe<'a>> {
    let probe = if bytes.starts_with(PNG_SIGNATURE) {
        let header = clean_png(bytes).map_err(|m| Fault::new(pointer, format!("PNG image: {m}")))?;
        Probe {
            format: Format::Png,
            bytes: header.bytes.into(),
            width: header.width,
            height: header.height,
            bits: header.bits,
        }
    } else if bytes.starts_with(b"\xFF\xD8") {
        let size = guarded(|| codecs::jpeg::JpegDecoder::new(Cursor::new(bytes)).map(|d| d.dimensions()));
        let (width, height) = size.map_err(|m| Fault::new(pointer, format!("JPEG image: {m}")))?;
        Probe { format: Format::Jpeg, bytes: bytes.into(), width, height, bits: 8 }
    } else if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") {
        let size = guarded(|| codecs::webp::WebPDecoder::new(Cursor::new(bytes)).map(|d| d.dimensions()));
        let (width, height) = size.map_err(|m| Fault::new(pointer, format!("WebP image: {m}")))?;
        Probe { format: Format::Webp, bytes: bytes.into(), width, height, bits: 8 }
    } else {
        let head = bytes.get(..bytes.len().min(8)).unwrap_or_default().escape_ascii();
        return Err(Fault::new(
            pointer,
            format!(
                "image of {} bytes starts with \"{head}\", expected the signature of a PNG, JPEG or WebP",
                bytes.len()
            ),
        ));
    };
    if probe.width == 0 || probe.height == 0 {
        return Err(Fault::new(
            pointer,
            format!("image size is {} x {}, expected at least 1 x 1", probe.width, probe.height),
        ));
    }
    let largest = u64::from(probe.width.max(probe.height));
    within(pointer, largest, u64::from(limits.image_size), "pixels of image width or height (dimension limit)")?;
    within(pointer, probe.texture_bytes(), limits.image_bytes, "bytes of decoded image")?;
    Ok(probe)
}

impl Probe<'_> {
    /// Bytes as RGBA8.
    pub(super) fn texture_bytes(&self) -> u64 {
        u64::from(self.width).saturating_mul(u64::from(self.height)).saturating_mul(4)
    }

    /// Media type of the data.
    pub(super) const fn mime(&self) -> &'static str {
        match self.format {
            Format::Png => "image/png",
            Format::Jpeg => "image/jpeg",
            Format::Webp => "image/webp",
        }
    }

    /// Decodes a PNG of 16 bits to as many.
    fn decode_wide(&self, pointer: &str, limits: &Limits) -> super::fault::Result<Texels> {
        let decoded = guarded(|| {
            let decoder = codecs::png::PngDecoder::with_limits(Cursor::new(&*self.bytes), self.caps(limits))?;
            Ok(DynamicImage::from_decoder(decoder)?.into_rgba16())
        });
        let picture = decoded.map_err(|m| Fault::new(pointer, format!("png image is corrupt: {m}")))?;
        let rgba = picture.pixels().map(|p| p.0).collect();
        Ok(Texels { width: picture.width(), height: picture.height(), rgba, is_8_bit: false })
    }

    fn caps(&self, limits: &Limits) -> image::Limits {
        let mut caps = image::Limits::default();
        caps.max_image_width = Some(limits.image_size);
        caps.max_image_height = Some(limits.image_size);
        // A decoder may need 16-bit RGBA and as much again for itself.
        caps.max_alloc = Some(self.texture_bytes().saturating_mul(4).saturating_add(1 << 20));
        caps
    }

    /// Decodes to RGBA8.
    pub(super) fn decode(&self, pointer: &str, limits: &Limits) -> super::fault::Result<Image> {
        let caps = self.caps(limits);
        let cursor = Cursor::new(&*self.bytes);
        let (name, pixels) = match self.format {
            Format::Png => ("png", guarded(|| rgba8(codecs::png::PngDecoder::with_limits(cursor, caps)?))),
            Format::Jpeg => ("jpeg", guarded(|| limited(codecs::jpeg::JpegDecoder::new(cursor)?, caps))),
            Format::Webp => ("webp", guarded(|| limited(codecs::webp::WebPDecoder::new(cursor)?, caps))),
        };
        let (size, pixels) = pixels.map_err(|m| Fault::new(pointer, format!("{name} image is corrupt: {m}")))?;
        if size != (self.width, self.height) {
            return Err(Fault::new(pointer, format!("{name} image: header and data disagree about the size")));
        }
        Ok(Image {
            name: String::new(),
            width: self.width,
            height: self.height,
            pixels,
            format: name,
            source_bits: self.bits,
        })
    }
}

/// Size and RGBA8 pixels.
type Decoded = ((u32, u32), Vec<u8>);

fn limited(mut decoder: impl ImageDecoder, caps: image::Limits) -> image::ImageResult<Decoded> {
    decoder.set_limits(caps)?;
    rgba8(decoder)
}

/// Decodes to RGBA8. Pictures of 8 bits are decoded into the end of the result and spread out from its start, so that no
/// second copy of them ever stands in memory.
fn rgba8(decoder: impl ImageDecoder) -> image::ImageResult<Decoded> {
    let size = decoder.dimensions();
    let channels: usize = match decoder.color_type() {
        ColorType::L8 => 1,
        ColorType::La8 => 2,
        ColorType::Rgb8 => 3,
        ColorType::Rgba8 => 4,
        _ => return Ok((size, DynamicImage::from_decoder(decoder)?.into_rgba8().into_raw())),
    };
    let count = (size.0 as usize).saturating_mul(size.1 as usize);
    let mut pixels = vec![0u8; count.saturating_mul(4)];
    let start = pixels.len().saturating_sub(count.saturating_mul(channels));
    decoder.read_image(pixels.get_mut(start..).unwrap_or_default())?;
    if channels < 4 {
        for i in 0..count {
            let from = start.saturating_add(i.saturating_mul(channels));
            let rgba = match pixels.get(from..from.saturating_add(channels)) {
                Some(&[l]) => [l, l, l, 255],
                Some(&[l, a]) => [l, l, l, a],
                Some(&[r, g, b]) => [r, g, b, 255],
                _ => break,
            };
            let to = i.saturating_mul(4);
            if let Some(pixel) = pixels.get_mut(to..to.saturating_add(4)) {
                pixel.copy_from_slice(&rgba);
            }
        }
    }
    Ok((size, pixels))
}

/// Runs a decoder; a panic inside it becomes an error.
pub(super) fn guarded<T>(decode: impl FnOnce() -> image::ImageResult<T>) -> std::result::Result<T, String> {
    match catch_unwind(AssertUnwindSafe(decode)) {
        Ok(result) => result.map_err(|e| e.to_string()),
        Err(_) => Err("the decoder failed on corrupt data".into()),
    }
}

/// A PNG with only the chunks that pixels need.
struct CleanPng {
    bytes: Vec<u8>,
    width: u32,
    height: u32,
    bits: u8,
}

/// Copies the critical chunks and `tRNS`. Colour profiles and texts can be bombs and are not used; the decoder panics on
/// some malformed palettes.
fn clean_png(bytes: &[u8]) -> std::result::Result<CleanPng, String> {
    let mut out = Vec::with_capacity(bytes.len());
    out.extend_from_slice(PNG_SIGNATURE);
    let mut rest = bytes.get(PNG_SIGNATURE.len()..).unwrap_or_default();
    let mut header: Option<(u32, u32, u8, u8)> = None;
    let (mut has_data, mut has_palette) = (false, false);
    while !rest.is_empty() {
        let (Some((length, after)), Some(kind)) = (rest.split_first_chunk::<4>(), rest.get(4..8)) else {
            return Err("truncated chunk header".into());
        };
        let length = u32::from_be_bytes(*length) as usize;
        let name = kind.escape_ascii().to_string();
        let body = after.get(4..).and_then(|b| b.get(..length));
        let whole = length.checked_add(12).and_then(|n| rest.get(..n));
        let (Some(body), Some(whole)) = (body, whole) else {
            return Err(format!(
                "chunk {name} has length {length}, the data is truncated after {}",
                after.len().saturating_sub(4)
            ));
        };
        match (kind, &header) {
            (b"IHDR", None) => {
                let &[w0, w1, w2, w3, h0, h1, h2, h3, bits, color, ..] = body else {
                    return Err(format!("IHDR header has {length} bytes, expected 13"));
                };
                if length != 13 {
                    return Err(format!("IHDR header has {length} bytes, expected 13"));
                }
                header =
                    Some((u32::from_be_bytes([w0, w1, w2, w3]), u32::from_be_bytes([h0, h1, h2, h3]), bits, color));
                out.extend_from_slice(whole);
            }
            (_, None) => return Err(format!("first chunk is {name}, expected IHDR")),
            (b"PLTE", Some((.., color))) => {
                if length == 0 || length > 768 || !length.is_multiple_of(3) {
                    return Err(format!("palette (PLTE) has {length} bytes, expected a multiple of 3 up to 768"));
                }
                // A suggested palette of a true-colour picture is of no use.
                if *color == 3 && !has_palette && !has_data {
                    has_palette = true;
                    out.extend_from_slice(whole);
                }
            }
            (b"tRNS", Some((.., color))) => {
                let fits = match color {
                    0 => length == 2,
                    2 => length == 6,
                    3 => has_palette && (1..=256).contains(&length),
                    _ => false,
                };
                if fits && !has_data {
                    out.extend_from_slice(whole);
                }
            }
            (b"IDAT", Some((.., color))) => {
                if *color == 3 && !has_palette {
                    return Err("palette (PLTE) is missing before the image data".into());
                }
                has_data = true;
                out.extend_from_slice(whole);
            }
            (b"IEND", _) => {
                out.extend_from_slice(whole);
                break;
            }
            (b"IHDR", _) => return Err("second IHDR header".into()),
            ([first, ..], _) if first.is_ascii_uppercase() => return Err(format!("unknown critical chunk {name}")),
            _ => {}
        }
        rest = rest.get(whole.len()..).unwrap_or_default();
    }
    let Some((width, height, bits, _)) = header else { return Err("no IHDR header".into()) };
    if !has_data {
        return Err("no image data (IDAT)".into());
    }
    Ok(CleanPng { bytes: out, width, height, bits: if bits == 16 { 16 } else { 8 } })
}
