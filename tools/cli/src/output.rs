//! Text for people: aligned tables, sizes, and printing that does not mind a closed pipe. And folders for what is written.

use std::io::{ErrorKind, Write as _};
use std::path::Path;

use anstyle::Style;

use crate::failure::{Failure, printable};

/// Prints to standard output. A reader that has gone away (`| head`) is no fault.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = anstream::stdout();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(Failure::input(format!("standard output: {e}"))),
        _ => Ok(()),
    }
}

/// Prints a value as JSON.
pub(crate) fn print_json(value: &impl serde::Serialize) -> Result<(), Failure> {
    print(&format!("{}\n", json(value)?))
}

/// Makes a folder that a command writes into, with those above it.
pub(crate) fn make_folder(path: &Path) -> Result<(), Failure> {
    if path.exists() && !path.is_dir() {
        return Err(Failure::input(format!("{}: is not a folder", path.display())));
    }
    std::fs::create_dir_all(path).map_err(|e| Failure::input(format!("{}: {e}", path.display())))
}

/// A value as indented JSON.
pub(crate) fn json(value: &impl serde::Serialize) -> Result<String, Failure> {
    serde_json::to_string_pretty(value).map_err(|e| Failure::input(format!("JSON: {e}")))
}

/// Rows under a heading; numbers (cells that start with a digit or a minus) stand to the right.
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn new(heading: &[&str]) -> Self {
        Self { rows: vec![heading.iter().map(|h| (*h).to_owned()).collect()] }
    }

    pub(crate) fn row<const N: usize>(&mut self, cells: [String; N]) {
        self.rows.push(cells.iter().map(|c| clip(&printable(c))).collect());
    }

    /// The table with an indent of two, its heading dimmed; empty where it has no rows.
    pub(crate) fn text(&self) -> String {
        if self.rows.len() < 2 {
            return String::new();
        }
        let columns = self.rows[0].len();
        let body = &self.rows[1..];
        let width = |c: usize| self.rows.iter().filter_map(|r| r.get(c)).map(|t| columns_of(t)).max().unwrap_or(0);
        let widths: Vec<usize> = (0..columns).map(width).collect();
        let is_number = |t: &str| t.is_empty() || t == "-" || t.starts_with(|c: char| c.is_ascii_digit() || c == '-');
        let right: Vec<bool> =
            (0..columns).map(|c| body.iter().all(|r| r.get(c).is_none_or(|t| is_number(t)))).collect();

        let dim = Style::new().dimmed();
        let mut out = String::new();
        for (index, row) in self.rows.iter().enumerate() {
            let mut line = String::new();
            for (c, cell) in row.iter().enumerate() {
                let pad = " ".repeat(widths[c] - columns_of(cell));
                line += "  ";
                line += &if right[c] {
                    format!("{pad}{cell}")
                } else {
                    format!("{cell}{pad}")
                };
            }
            let line = line.trim_end();
            out += &if index == 0 {
                format!("{dim}{line}{dim:#}\n")
            } else {
                format!("{line}\n")
            };
        }
        out
    }
}

/// A heading of a section.
pub(crate) fn heading(text: &str) -> String {
    let bold = Style::new().bold();
    format!("{bold}{}{bold:#}\n", printable(text))
}

/// Bytes in the unit that suits them.
pub(crate) fn bytes(count: u64) -> String {
    match count {
        0..1024 => format!("{count} B"),
        1024..1_048_576 => format!("{:.1} KiB", count as f64 / 1024.0),
        _ => format!("{:.1} MiB", count as f64 / 1_048_576.0),
    }
}

/// Long names would tear the table apart.
fn clip(text: &str) -> String {
    const LONGEST: usize = 48;
    if text.chars().count() <= LONGEST {
        return text.to_owned();
    }
    text.chars().take(LONGEST - 1).chain(['…']).collect()
}

/// Columns on a terminal: East Asian letters and emoji take two.
fn columns_of(text: &str) -> usize {
    let wide = |c: char| {
        matches!(c as u32, 0x1100..=0x115f | 0x2e80..=0xa4cf | 0xac00..=0xd7a3 | 0xf900..=0xfaff
        | 0xfe30..=0xfe6f | 0xff00..=0xff60 | 0xffe0..=0xffe6 | 0x1f300..=0x1faff | 0x20000..=0x3fffd)
    };
    text.chars().map(|c| 1 + usize::from(wide(c))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_right_names_left_and_japanese_is_wide() {
        let mut table = Table::new(&["name", "count"]);
        table.row(["影".into(), "7".into()]);
        table.row(["abc".into(), "12".into()]);
        let text = anstream::adapter::strip_str(&table.text()).to_string();
        assert_eq!(text, "  name  count\n  影        7\n  abc      12\n");
    }
}
