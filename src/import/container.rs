//! Splits a file into its JSON and its binary chunk. Sizes come from the bytes at hand, never from a header.

use serde_json::Value;

use super::fault::{Fault, Limits, Result, within};

const JSON_CHUNK: u32 = 0x4E4F_534A;
const BIN_CHUNK: u32 = 0x004E_4942;

/// JSON and binary chunk of a file.
#[derive(Debug)]
pub(super) struct Container<'a> {
    pub(super) json: Value,
    pub(super) bin: Option<&'a [u8]>,
}

/// Takes a file apart, by its content whatever it is called.
pub(super) fn split<'a>(bytes: &'a [u8], limits: &Limits) -> Result<Container<'a>> {
    within("file", bytes.len() as u64, limits.file_bytes, "bytes")?;
    if bytes.is_empty() {
        return Err(Fault::new("file", "found an empty file, expected glTF JSON or a GLB header"));
    }
    if bytes.starts_with(b"glTF") {
        return split_glb(bytes, limits);
    }
    if let Ok(format) = image::guess_format(bytes) {
        return Err(Fault::new("file", format!("found a {format:?} picture, expected glTF JSON or GLB")));
    }
    Ok(Container { json: parse(bytes, limits)?, bin: None })
}

fn parse(bytes: &[u8], limits: &Limits) -> Result<Value> {
    within("json", bytes.len() as u64, limits.json_bytes, "bytes of JSON")?;
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    serde_json::from_slice(bytes).map_err(|e| {
        let head = bytes.get(..bytes.len().min(12)).unwrap_or_default();
        let head = String::from_utf8_lossy(head).escape_default().to_string();
        Fault::new(
            "json",
            format!("not valid JSON: {e}; the text starts with \"{head}\", expected glTF JSON or GLB magic"),
        )
    })
}

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let four = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes(four.try_into().ok()?))
}

fn split_glb<'a>(bytes: &'a [u8], limits: &Limits) -> Result<Container<'a>> {
    let truncated = || Fault::new("header", format!("GLB header truncated: found {} bytes, expected 12", bytes.len()));
    let version = word(bytes, 4).ok_or_else(truncated)?;
    let length = word(bytes, 8).ok_or_else(truncated)? as usize;
    if version != 2 {
        return Err(Fault::new("header", format!("found GLB version {version}, expected 2")));
    }
    if length < 20 || length > bytes.len() {
        return Err(Fault::new(
            "header",
            format!(
                "GLB length field says {length} bytes, the file has {}, expected the same (at least 20)",
                bytes.len()
            ),
        ));
    }
    // No chunk starts after the declared length, but the last one may end after it: some writers forget padding.
    let (mut json, mut bin, mut at, mut number) = (None, None, 12usize, 0usize);
    while at < length {
        let fault = |message: String| Fault::new(format!("chunk at byte {at}"), message);
        let (Some(size), Some(kind)) = (word(bytes, at), word(bytes, at.saturating_add(4))) else {
            // A few padding bytes at the end hold no chunk header.
            if number == 0 {
                return Err(fault("GLB chunk header truncated".into()));
            }
            break;
        };
        let start = at.saturating_add(8);
        let end = start.checked_add(size as usize).filter(|e| *e <= bytes.len());
        let data = end.and_then(|e| bytes.get(start..e)).ok_or_else(|| {
            fault(format!(
                "GLB chunk length says {size} bytes, the file ends after {}",
                bytes.len().saturating_sub(start)
            ))
        })?;
        match kind {
            JSON_CHUNK if json.is_some() => return Err(fault("duplicate JSON chunk, expected one".into())),
            JSON_CHUNK if number > 0 => return Err(fault("JSON chunk is not the first".into())),
            BIN_CHUNK if bin.is_some() => return Err(fault("unexpected duplicate BIN chunk, expected one".into())),
            BIN_CHUNK if number > 1 => return Err(fault("unexpected BIN chunk, expected it to be the second".into())),
            _ if number == 0 && kind != JSON_CHUNK => {
                return Err(fault(format!("unexpected chunk type {kind:#010x}, expected the first chunk to be JSON")));
            }
            JSON_CHUNK => json = Some(data),
            BIN_CHUNK => bin = Some(data),
            _ => {}
        }
        number = number.saturating_add(1);
        at = end.unwrap_or(usize::MAX);
    }
    let json = json.ok_or_else(|| Fault::new("header", "GLB has no JSON chunk"))?;
    Ok(Container { json: parse(json, limits)?, bin })
}
