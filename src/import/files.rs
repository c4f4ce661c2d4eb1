//! Data that JSON refers to by URI: data URIs, and files below the model's folder. Nothing else is ever opened.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::fault::{Fault, Limits, Result, quoted, within};

/// Standard base64 that takes padding or its absence.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// Where a URI points to.
#[derive(Debug)]
pub(super) enum Source {
    Data(Vec<u8>),
    /// Path relative to the model's folder, free of `..`.
    File(PathBuf),
}

/// Takes a URI apart and refuses every one that could lead out of the model's folder. Opens nothing.
pub(super) fn parse_uri(pointer: &str, uri: &str) -> Result<Source> {
    let fault = |message: String| Fault::new(pointer, format!("uri {}: {message}", quoted(uri)));
    if uri.get(..5).is_some_and(|s| s.eq_ignore_ascii_case("data:")) {
        return decode_data(uri.get(5..).unwrap_or_default()).map(Source::Data).map_err(|m| Fault::new(pointer, m));
    }
    if uri.is_empty() {
        return Err(fault("empty, expected a file name or a data URI".into()));
    }
    let path = percent_encoding::percent_decode_str(uri)
        .decode_utf8()
        .map_err(|_| fault("percent escapes are not UTF-8".into()))?;
    // The raw text may hide a scheme behind escapes, and a file name may hold a percent sign: both forms are checked.
    for text in [uri, path.as_ref()] {
        if text.contains('\0') {
            return Err(fault("path holds a NUL character".into()));
        }
        if text.contains('\\') {
            return Err(fault("path holds a backslash, expected forward slashes".into()));
        }
        if text.starts_with('/') {
            return Err(fault("absolute path, expected a path inside the model's folder".into()));
        }
        if let Some(colon) = text.find(':') {
            let head = text.get(..colon).unwrap_or_default();
            let scheme = head.chars().all(|c| c.is_ascii_alphanumeric() || matches!(c, '+' | '-' | '.'));
            if !head.is_empty() && scheme {
                return Err(fault(format!("scheme {} is not supported, expected a relative path", quoted(head))));
            }
        }
    }
    let mut clean = PathBuf::new();
    for part in path.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                if !clean.pop() {
                    return Err(fault("path leads outside the model's folder".into()));
                }
            }
            part => clean.push(part),
        }
    }
    if clean.as_os_str().is_empty() {
        return Err(fault("path names a directory, expected a file".into()));
    }
    Ok(Source::File(clean))
}

/// The bytes of a data URI without its `data:`.
fn decode_data(rest: &str) -> std::result::Result<Vec<u8>, String> {
    let (head, payload) = rest.split_once(',').ok_or("data uri without a comma")?;
    if !head.split(';').any(|p| p.trim().eq_ignore_ascii_case("base64")) {
        return Ok(percent_encoding::percent_decode_str(payload).collect());
    }
    let clean: Vec<u8> = percent_encoding::percent_decode_str(payload).filter(|b| !b.is_ascii_whitespace()).collect();
    BASE64.decode(clean).map_err(|e| format!("data uri is not valid base64: {e}"))
}

/// Reads a file below `folder`; symbolic links that lead outside are refused.
pub(super) fn read_below(folder: Option<&Path>, relative: &Path, pointer: &str, limits: &Limits) -> Result<Vec<u8>> {
    let shown = quoted(&relative.display().to_string());
    let folder =
        folder.ok_or_else(|| Fault::new(pointer, format!("uri {shown}: the model has no folder to read from")))?;
    let fault = |message: String| Fault::new(pointer, format!("uri {shown}: {message}"));
    let no_file = |e: std::io::Error| fault(format!("no such file: {e}"));
    let root = folder.canonicalize().map_err(no_file)?;
    let path = root.join(relative).canonicalize().map_err(no_file)?;
    if !path.starts_with(&root) {
        return Err(fault("path leads outside the model's folder".into()));
    }
    read_regular(&path, limits).map_err(|e| match e {
        ReadFault::Io(e) => fault(e.to_string()),
        ReadFault::NotRegular => fault("not a regular file".into()),
        ReadFault::TooLarge(found) => {
            Fault::Limit { pointer: pointer.to_owned(), found, limit: limits.file_bytes, unit: "bytes" }
        }
    })
}

/// Why a file was not read.
#[derive(Debug)]
pub(super) enum ReadFault {
    Io(std::io::Error),
    NotRegular,
    TooLarge(u64),
}

/// Reads a regular file up to the limit. Devices and pipes are refused before they are opened: opening one may block.
pub(super) fn read_regular(path: &Path, limits: &Limits) -> std::result::Result<Vec<u8>, ReadFault> {
    let meta = std::fs::metadata(path).map_err(ReadFault::Io)?;
    if !meta.is_file() {
        return Err(ReadFault::NotRegular);
    }
    if meta.len() > limits.file_bytes {
        return Err(ReadFault::TooLarge(meta.len()));
    }
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(usize::try_from(meta.len()).unwrap_or(0)).map_err(|_| ReadFault::TooLarge(meta.len()))?;
    // The file may grow between the check and the reading, and files under /proc claim a length of 0.
    let most = limits.file_bytes.saturating_add(1);
    File::open(path).and_then(|f| f.take(most).read_to_end(&mut bytes)).map_err(ReadFault::Io)?;
    within("file", bytes.len() as u64, limits.file_bytes, "bytes")
        .map_err(|_| ReadFault::TooLarge(bytes.len() as u64))?;
    Ok(bytes)
}
