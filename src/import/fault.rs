//! The importer's own error: a place in the file and what is wrong there. The file name is added at the very end.

use crate::Error;

/// Longest message, characters; names in a hostile file can be of any length.
const LONGEST_MESSAGE: usize = 400;

/// What is wrong, and where.
#[derive(Debug)]
pub(super) enum Fault {
    /// Found something else than expected.
    Input { pointer: String, message: String },
    /// Asks for more than the limits allow.
    Limit { pointer: String, found: u64, limit: u64, unit: &'static str },
}

pub(super) type Result<T> = std::result::Result<T, Fault>;

impl Fault {
    pub(super) fn new(pointer: impl Into<String>, message: impl AsRef<str>) -> Self {
        Self::Input { pointer: shown(&pointer.into()), message: shown(message.as_ref()) }
    }

    pub(super) fn into_error(self, path: &str) -> Error {
        let path = shown(path);
        match self {
            Self::Input { pointer, message } => Error::Input { path, pointer, message },
            Self::Limit { pointer, found, limit, unit } => Error::Limit { path, pointer, found, limit, unit },
        }
    }
}

/// Checks a count against a limit.
pub(super) fn within(pointer: &str, found: u64, limit: u64, unit: &'static str) -> Result<()> {
    if found > limit {
        Err(Fault::Limit { pointer: shown(pointer), found, limit, unit })
    } else {
        Ok(())
    }
}

/// Text from a file made safe to print: control characters escaped, shortened.
pub(super) fn shown(text: &str) -> String {
    let mut out = String::new();
    let mut count = 0usize;
    for c in text.chars() {
        if count >= LONGEST_MESSAGE.saturating_sub(1) {
            out.push('…');
            break;
        }
        // Bidirectional marks could reorder the rest of a terminal line.
        if c.is_control() || matches!(c, '\u{200e}'..='\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}') {
            let escaped = c.escape_default().to_string();
            count = count.saturating_add(escaped.len());
            out.push_str(&escaped);
        } else {
            count = count.saturating_add(1);
            out.push(c);
        }
    }
    out
}

/// A name for use inside a message: quoted, escaped, at most 60 characters.
pub(super) fn quoted(name: &str) -> String {
    let short: String = name.chars().take(60).collect();
    let dots = if short.len() < name.len() { "…" } else { "" };
    format!("\"{}{dots}\"", shown(&short))
}

/// Limits of what a file may ask for. All are checked before anything is allocated.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Size of one file and of all buffers together, bytes. Default: 1 GiB.
    pub file_bytes: u64,
    /// Size of the JSON part, bytes. Default: 64 MiB.
    pub json_bytes: u64,
    /// Nodes. Default: 100,000.
    pub nodes: u64,
    /// Vertices over all primitives, after unused ones are dropped. Default: 20 million.
    pub vertices: u64,
    /// Triangle corners over all primitives. Default: 120 million.
    pub indices: u64,
    /// Memory of all decoded geometry and animation, bytes. Default: 1 GiB.
    pub geometry_bytes: u64,
    /// Joints of one skin. Default: 4,096.
    pub joints: u64,
    /// Morph targets of one mesh. Default: 1,024.
    pub morph_targets: u64,
    /// Width and height of one image, pixels. Default: 8,192, wgpu's default texture limit.
    pub image_size: u32,
    /// Memory of all decoded images, bytes at 4 a pixel. Default: 1 GiB.
    pub image_bytes: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: 1 << 30,
            json_bytes: 64 << 20,
            nodes: 100_000,
            vertices: 20_000_000,
            indices: 120_000_000,
            geometry_bytes: 1 << 30,
            joints: 4_096,
            morph_targets: 1_024,
            image_size: 8_192,
            image_bytes: 1 << 30,
        }
    }
}
