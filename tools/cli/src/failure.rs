//! What ends the program early: one line on standard error and an exit status.

use std::fmt::Write as _;

use anstyle::{AnsiColor, Style};

/// A failed command.
#[derive(Debug)]
pub(crate) struct Failure {
    message: String,
    status: i32,
}

impl Failure {
    /// Bad input: status 1.
    pub(crate) fn input(message: impl Into<String>) -> Self {
        Self { message: message.into(), status: 1 }
    }

    /// No usable graphics: status 3.
    pub(crate) fn gpu(message: impl Into<String>) -> Self {
        Self { message: message.into(), status: 3 }
    }

    pub(crate) fn status(&self) -> i32 {
        self.status
    }

    /// Writes `error: …` on one line.
    pub(crate) fn print(&self) {
        print_line("error", AnsiColor::Red, &self.message);
    }
}

impl From<hikage::Error> for Failure {
    fn from(error: hikage::Error) -> Self {
        if error.is_gpu() {
            Self::gpu(error.to_string())
        } else {
            Self::input(error.to_string())
        }
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.message)
    }
}

/// Writes `warning: …` on one line.
pub(crate) fn warn(message: &str) {
    print_line("warning", AnsiColor::Yellow, message);
}

fn print_line(word: &str, color: AnsiColor, message: &str) {
    use std::io::Write as _;
    let style = Style::new().bold().fg_color(Some(color.into()));
    // Nothing can be done where standard error is closed.
    let _ = writeln!(anstream::stderr(), "{style}{word}{style:#}: {}", printable(message));
}

/// The text with everything escaped that could move the cursor, colour or reorder what a terminal shows.
pub(crate) fn printable(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        let reorders = matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        if c.is_control() || reorders || matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}') {
            let _ = write!(out, "{}", c.escape_default());
        } else {
            out.push(c);
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_steers_a_terminal_gets_through() {
        assert_eq!(printable("a\n\u{1b}[31mb\u{202e}c 影 é"), "a\\n\\u{1b}[31mb\\u{202e}c 影 é");
    }
}
