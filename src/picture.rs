//! PNG in and out for [`Image`], and files that are either written whole or not at all.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _, ImageFormat, ImageReader};

use crate::scene::Image;
use crate::{Error, Result};

/// Encodes 8-bit RGBA with straight alpha as PNG. The same picture always gives the same bytes.
///
/// # Errors
/// Where a side is 0 or `pixels` has not `width * height * 4` bytes.
pub fn encode_png(picture: &Image) -> Result<Vec<u8>> {
    let expected = u64::from(picture.width) * u64::from(picture.height) * 4;
    if expected == 0 || expected != picture.pixels.len() as u64 {
        return Err(Error::Argument {
            what: "picture".into(),
            message: format!(
                "{} x {} pixels with {} bytes; expected {expected} and not 0",
                picture.width,
                picture.height,
                picture.pixels.len()
            ),
        });
    }
    let mut bytes = Vec::new();
    // Paeth rows compress toon pictures as well as the adaptive choice, in half the time.
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Default, FilterType::Paeth)
        .write_image(&picture.pixels, picture.width, picture.height, ExtendedColorType::Rgba8)
        .map_err(|e| Error::Argument { what: "picture".into(), message: e.to_string() })?;
    Ok(bytes)
}

/// Writes a PNG: the file is replaced as a whole, or left as it was.
///
/// # Errors
/// Those of [`encode_png`] and [`write_atomic`].
pub fn write_png(path: impl AsRef<Path>, picture: &Image) -> Result<()> {
    write_atomic(path, &encode_png(picture)?)
}

/// Reads a texture back that an application has drawn, as [`Renderer::render`](crate::Renderer::render) does: sRGB, straight
/// alpha. It has one sample a texel and `COPY_SRC` among its usages; its alpha is premultiplied.
///
/// # Errors
/// [`Error::Argument`] for a format that is neither RGBA nor BGRA with 8 bits nor floats;
/// [`Error::Gpu`] where the adapter fails or does not answer.
pub fn read_texture(gpu: &crate::Gpu, texture: &wgpu::Texture) -> Result<Image> {
    crate::render::readback::read(gpu, texture)
}

/// Reads a texture of floats back that an application has drawn: linear, premultiplied as it was drawn, from the top left row by
/// row.
///
/// # Errors
/// [`Error::Argument`] for a format other than `Rgba16Float` and `Rgba32Float`; [`Error::Gpu`] where the adapter fails or does
/// not answer.
pub fn read_linear(gpu: &crate::Gpu, texture: &wgpu::Texture) -> Result<Vec<[f32; 4]>> {
    crate::render::readback::read_linear(gpu, texture)
}

/// Reads a PNG of any colour type as 8-bit RGBA with straight alpha.
///
/// Meant for pictures of one's own, as goldens are; textures of strangers go through
/// [`import`](crate::import), which has limits.
///
/// # Errors
/// Where the file cannot be read or is not a PNG.
pub fn read_png(path: impl AsRef<Path>) -> Result<Image> {
    let path = path.as_ref();
    let bytes = fs::read(path).map_err(|e| Error::io(path, &e))?;
    let decoded = ImageReader::with_format(std::io::Cursor::new(bytes), ImageFormat::Png).decode().map_err(|e| {
        Error::Input { path: path.display().to_string(), pointer: "png".into(), message: e.to_string() }
    })?;
    let source_bits = if decoded.color().bytes_per_pixel() > decoded.color().channel_count() {
        16
    } else {
        8
    };
    let rgba = decoded.into_rgba8();
    let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    Ok(Image { name, width: rgba.width(), height: rgba.height(), pixels: rgba.into_raw(), format: "png", source_bits })
}

/// Writes a file through a temporary one in the same folder, so that no reader ever sees half of it.
///
/// A link is followed; after an error the old file stands and no temporary one is left.
///
/// # Errors
/// Where the folder does not exist or cannot be written, or `path` is something other than a regular file.
pub fn write_atomic(path: impl AsRef<Path>, bytes: &[u8]) -> Result<()> {
    static COUNT: AtomicU32 = AtomicU32::new(0);

    let named = path.as_ref();
    let path = match fs::metadata(named) {
        // Renaming over a device or a pipe would replace it.
        Ok(found) if !found.is_file() => {
            return Err(Error::Io { path: named.display().to_string(), reason: "is not a regular file".into() });
        }
        Ok(_) => fs::canonicalize(named).map_err(|e| Error::io(named, &e))?,
        Err(_) => named.to_path_buf(),
    };
    let (Some(folder), Some(file)) = (path.parent(), path.file_name()) else {
        return Err(Error::Io { path: named.display().to_string(), reason: "is not the name of a file".into() });
    };
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    if !folder.is_dir() {
        let reason = format!("the folder {} does not exist", folder.display());
        return Err(Error::Io { path: named.display().to_string(), reason });
    }

    let mut temp_name = std::ffi::OsString::from(".");
    temp_name.push(file);
    temp_name.push(format!(".{}-{}.tmp", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed)));
    let temp: PathBuf = folder.join(temp_name);
    let written =
        fs::File::create_new(&temp).and_then(|mut file| file.write_all(bytes)).and_then(|()| fs::rename(&temp, &path));
    written.map_err(|e| {
        let _ = fs::remove_file(&temp);
        Error::io(named, &e)
    })
}
