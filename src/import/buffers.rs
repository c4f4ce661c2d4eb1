//! Buffers and buffer views: every range is checked here, once, so that later reading cannot leave the bytes.

use std::borrow::Cow;
use std::path::Path;

use super::fault::{Fault, Limits, Result, within};
use super::files::{Source, parse_uri, read_below};
use super::json::Json;
use super::meshopt;

/// A range of bytes with an optional stride.
#[derive(Debug)]
pub(super) struct View<'a> {
    pub(super) bytes: Cow<'a, [u8]>,
    /// Distance of elements; `None` for tightly packed.
    pub(super) stride: Option<u64>,
}

/// A buffer view before its bytes are looked up.
#[derive(Debug)]
struct Range {
    buffer: usize,
    start: u64,
    length: u64,
}

/// Bytes of all buffers. `None` marks the placeholder buffers of meshopt, which need no data.
#[derive(Debug)]
pub(super) struct Buffers<'a> {
    data: Vec<Option<Cow<'a, [u8]>>>,
}

impl<'a> Buffers<'a> {
    /// Loads every buffer.
    pub(super) fn load(root: &Json, bin: Option<&'a [u8]>, folder: Option<&Path>, limits: &Limits) -> Result<Self> {
        let mut data = Vec::new();
        let mut total = 0u64;
        for (index, buffer) in root.objects("buffers")?.into_iter().enumerate() {
            let length = buffer.need("byteLength")?.as_u64()?;
            let fallback = buffer.extension("EXT_meshopt_compression")?.is_some_and(|e| e.flag("fallback"));
            let bytes: Cow<'a, [u8]> = if let Some(uri) = buffer.str("uri")? {
                let pointer = format!("{}/uri", buffer.pointer());
                match parse_uri(&pointer, uri)? {
                    Source::Data(bytes) => bytes.into(),
                    Source::File(path) => read_below(folder, &path, &pointer, limits)?.into(),
                }
            } else if index == 0 && bin.is_some() && !fallback {
                bin.unwrap_or_default().into()
            } else if fallback {
                data.push(None);
                continue;
            } else {
                return Err(
                    buffer.fault("buffer data missing: found no uri and no GLB BIN chunk, expected one of them")
                );
            };
            let Some(bytes) = cut(bytes, length) else {
                return Err(buffer.fault(format!("byteLength is {length}, over the length of the buffer's data")));
            };
            total = total.saturating_add(length);
            within(buffer.pointer(), total, limits.file_bytes, "bytes of buffers")?;
            data.push(Some(bytes));
        }
        Ok(Self { data })
    }

    fn slice(&'a self, place: &Json, range: &Range) -> Result<&'a [u8]> {
        let buffer = self.data.get(range.buffer).and_then(Option::as_ref);
        let buffer = buffer.ok_or_else(|| place.fault(format!("buffer {} has no data", range.buffer)))?;
        let end = range.start.checked_add(range.length).filter(|end| *end <= buffer.len() as u64);
        end.and_then(|end| buffer.get(usize::try_from(range.start).ok()?..usize::try_from(end).ok()?)).ok_or_else(
            || {
                place.fault(format!(
                    "bufferView range of offset {} and length {} is outside the buffer of {} bytes",
                    range.start,
                    range.length,
                    buffer.len()
                ))
            },
        )
    }

    fn range(&self, place: &Json) -> Result<Range> {
        Ok(Range {
            buffer: place.need("buffer")?.as_index(self.data.len(), "buffers")?,
            start: place.u64("byteOffset")?.unwrap_or(0),
            length: place.need("byteLength")?.as_u64()?,
        })
    }

    /// Checks all views and decodes the compressed ones.
    pub(super) fn views(&'a self, root: &Json, limits: &Limits) -> Result<Vec<View<'a>>> {
        let mut views = Vec::new();
        let mut decoded = 0u64;
        for view in root.objects("bufferViews")? {
            let range = self.range(&view)?;
            let stride = view.u64("byteStride")?;
            if let Some(stride) = stride
                && !(1..=252).contains(&stride)
            {
                return Err(view.fault(format!("found byteStride {stride}, expected 4 to 252")));
            }
            let bytes = if let Some(compressed) = view.extension("EXT_meshopt_compression")? {
                let source = self.slice(&compressed, &self.range(&compressed)?)?;
                let header = meshopt::Header::read(&compressed)?;
                let size = header.decoded_bytes(&compressed, source.len())?;
                decoded = decoded.saturating_add(size);
                within(view.pointer(), decoded, limits.geometry_bytes, "bytes of decompressed data")?;
                Cow::Owned(meshopt::decode(&compressed, &header, source)?)
            } else if self.data.get(range.buffer).is_some_and(Option::is_none) {
                // A view of a placeholder buffer without compressed data: an error only where something reads it.
                Cow::Borrowed(&[][..])
            } else {
                Cow::Borrowed(self.slice(&view, &range)?)
            };
            views.push(View { bytes, stride });
        }
        Ok(views)
    }
}

/// The first `length` bytes.
fn cut(bytes: Cow<'_, [u8]>, length: u64) -> Option<Cow<'_, [u8]>> {
    let length = usize::try_from(length).ok().filter(|l| *l <= bytes.len())?;
    Some(match bytes {
        Cow::Borrowed(b) => Cow::Borrowed(b.get(..length)?),
        Cow::Owned(mut b) => {
            b.truncate(length);
            Cow::Owned(b)
        }
    })
}

/// Bytes of an image: its view, data URI or file. Opens the file.
pub(super) fn image_bytes<'a>(
    image: &Json,
    views: &'a [View<'a>],
    folder: Option<&Path>,
    limits: &Limits,
) -> Result<Cow<'a, [u8]>> {
    if let Some(index) = image.index("bufferView", views.len(), "bufferViews")? {
        let view = views.get(index).ok_or_else(|| image.fault("bufferView is missing"))?;
        return Ok(Cow::Borrowed(&view.bytes));
    }
    let Some(uri) = image.str("uri")? else {
        return Err(Fault::new(image.pointer(), "found neither uri nor bufferView, expected one of them"));
    };
    let pointer = format!("{}/uri", image.pointer());
    match parse_uri(&pointer, uri)? {
        Source::Data(bytes) => Ok(Cow::Owned(bytes)),
        Source::File(path) => Ok(Cow::Owned(read_below(folder, &path, &pointer, limits)?)),
    }
}
