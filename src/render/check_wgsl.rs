//! The check of a user's WGSL.

use serde::Serialize;

use crate::{Error, Result};

/// Longest WGSL text that [`check`] takes, bytes.
pub const MAX_WGSL_BYTES: usize = 128 * 1024;

// The front end recurses once an operator: 128 KiB of text cannot use this up.
const CHECK_STACK_BYTES: usize = 512 * 1024 * 1024;

/// What a valid WGSL text holds.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct ShaderSummary {
    /// Entry points, as `stage name`.
    pub entry_points: Vec<String>,
    /// Bindings, as `group:binding name`.
    pub bindings: Vec<String>,
}

/// Parses and validates a user's WGSL.
///
/// # Errors
/// [`Error::Input`] or [`Error::Limit`] that name the file, the line and the fault.
pub fn check(file: &str, bytes: &[u8]) -> Result<ShaderSummary> {
    if bytes.len() > MAX_WGSL_BYTES {
        return Err(Error::Limit {
            path: file.to_owned(),
            pointer: "file".to_owned(),
            found: bytes.len() as u64,
            limit: MAX_WGSL_BYTES as u64,
            unit: "bytes",
        });
    }
    let fault = |pointer: String, message: String| Error::Input { path: file.to_owned(), pointer, message };
    let text = std::str::from_utf8(bytes)
        .map_err(|e| fault(format!("byte {}", e.valid_up_to()), "is not UTF-8; WGSL is UTF-8 text".to_owned()))?;
    if let Some(depth_fault) = too_deep(text) {
        return Err(fault(depth_fault.0, depth_fault.1));
    }
    let checked = std::thread::scope(|scope| {
        std::thread::Builder::new()
            .name("wgsl-check".to_owned())
            .stack_size(CHECK_STACK_BYTES)
            .spawn_scoped(scope, || parse_and_validate(text))
            .map_err(|e| Error::Io { path: file.to_owned(), reason: format!("starting a thread to parse it: {e}") })?
            .join()
            .map_err(|_| fault("file".to_owned(), "the WGSL front end failed on it; please simplify it".to_owned()))
    })?;
    checked.map_err(|(pointer, message)| fault(pointer, message))
}

/// Most operators in one statement and brackets around one place.
const MAX_DEPTH: usize = 1000;

/// Refuses texts whose nesting would exhaust the front end or a driver behind it.
fn too_deep(text: &str) -> Option<(String, String)> {
    let (mut depth, mut operators, mut line) = (0usize, 0usize, 1usize);
    for c in text.chars() {
        match c {
            '\n' => line += 1,
            '(' | '[' | '{' => depth += 1,
            ')' | ']' => depth = depth.saturating_sub(1),
            '}' => {
                depth = depth.saturating_sub(1);
                operators = 0;
            }
            ';' => operators = 0,
            '+' | '-' | '*' | '/' | '%' | '&' | '|' | '^' | '!' | '~' | '<' | '>' => operators += 1,
            _ => {}
        }
        if depth > MAX_DEPTH || operators > 8 * MAX_DEPTH {
            return Some((
                format!("line {line}"),
                format!(
                    "an expression is nested too deep: more than {MAX_DEPTH} brackets or {} operators; the limit \
                     keeps the compiler's recursion bounded",
                    8 * MAX_DEPTH
                ),
            ));
        }
    }
    None
}

fn parse_and_validate(text: &str) -> Result<ShaderSummary, (String, String)> {
    let one_line = |s: String| s.split_whitespace().collect::<Vec<_>>().join(" ");
    let place = |location: Option<naga::SourceLocation>| {
        location.map_or_else(|| "file".to_owned(), |l| format!("line {}:{}", l.line_number, l.line_position))
    };
    let module = naga::front::wgsl::parse_str(text).map_err(|e| {
        // Some labels have no place of their own.
        let at = e.labels().find(|(span, _)| span.is_defined()).map(|(span, _)| span.location(text));
        (place(at), one_line(e.emit_to_string(text)))
    })?;
    let mut validator =
        naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::all());
    validator.validate(&module).map_err(|e| (place(e.location(text)), one_line(e.emit_to_string(text))))?;
    if module.entry_points.is_empty() {
        return Err((
            "file".to_owned(),
            "the WGSL text has no entry point; expected at least one @vertex, @fragment or @compute function"
                .to_owned(),
        ));
    }
    let mut seen = std::collections::BTreeSet::new();
    for entry in &module.entry_points {
        if !seen.insert(&entry.name) {
            return Err(("file".to_owned(), format!("redefinition of the entry point {}", entry.name)));
        }
    }
    Ok(ShaderSummary {
        entry_points: module.entry_points.iter().map(|e| format!("{:?} {}", e.stage, e.name).to_lowercase()).collect(),
        bindings: module
            .global_variables
            .iter()
            .filter_map(|(_, v)| {
                let b = v.binding.as_ref()?;
                Some(format!("{}:{} {}", b.group, b.binding, v.name.as_deref().unwrap_or("_")))
            })
            .collect(),
    })
}
