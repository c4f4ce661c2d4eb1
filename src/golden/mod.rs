//! Golden tests: pictures that were looked at and accepted, and a comparison that a small fault cannot slip through.
//!
//! A mean over all pixels hides a lost outline, and a bare per-pixel limit fails on another driver's edges. So four
//! things are asked of a picture at once, and any of them can fail it ([`Tolerance`]):
//!
//! 1. how many pixels are off by more than a few steps (`channel`, `outliers`): catches a shifted or lost line;
//! 2. how large the largest connected group of such pixels is (`blob`): drivers differ in scattered pixels along edges,
//!    faults come in lumps;
//! 3. how far the mean of any 16 × 16 tile drifts (`drift`), over the pixels that are *not* outliers: catches a hue
//!    that is off by less than `channel`;
//! 4. the size of the picture, and alpha as a fourth channel.
//!
//! ```no_run
//! use hikage::golden::{Goldens, Tolerance};
//! # fn draw() -> hikage::scene::Image { hikage::scene::Image::default() }
//! # fn main() -> hikage::Result<()> {
//! let goldens = Goldens::new("tests/golden");
//! goldens.check("hello", &draw(), &Tolerance::default())?;
//! # Ok(())
//! # }
//! ```
//!
//! A missing golden fails, and nothing here ever writes into the folder of the expected pictures: a person looks at
//! what a failed check left, then accepts it.

mod compare;
mod sheet;

use std::path::{Path, PathBuf};

pub use compare::{Blob, Report, Tolerance, compare, largest_blob};
pub use sheet::sheet;

use crate::picture::{read_png, write_atomic, write_png};
use crate::scene::Image;
use crate::{Error, Result};

/// Where golden pictures lie, and where a failed check leaves its evidence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Goldens {
    /// Folder of the accepted pictures, `NAME.png`.
    pub expected: PathBuf,
    /// Folder for `NAME.png` (what was drawn), `NAME.diff.png` (expected, actual, difference side by side) and
    /// `NAME.txt` (the finding in one line) of checks that failed. Made when needed; keep it out of version control.
    pub actual: PathBuf,
    /// Command that accepts a picture, shown when a check fails; `{name}` stands for its name. Default: empty, which
    /// says to copy the file.
    pub bless_command: String,
}

impl Goldens {
    /// `folder/expected` and `folder/actual`.
    #[must_use]
    pub fn new(folder: impl AsRef<Path>) -> Self {
        let folder = folder.as_ref();
        Self { expected: folder.join("expected"), actual: folder.join("actual"), bless_command: String::new() }
    }

    /// Compares a picture with `expected/NAME.png`.
    ///
    /// `name` consists of ASCII letters, digits, `-`, `_` and `.`, and does not start with a dot.
    ///
    /// # Errors
    /// Where the golden is missing or cannot be read, the sizes differ, or the difference is over the tolerance. The
    /// message gives the figures, the files to look at and how to accept the new picture.
    pub fn check(&self, name: &str, actual: &Image, tolerance: &Tolerance) -> Result<Report> {
        let name_is_plain = !name.is_empty()
            && !name.starts_with('.')
            && name.bytes().all(|b| b.is_ascii_alphanumeric() || matches!(b, b'-' | b'_' | b'.'));
        if !name_is_plain {
            return Err(Error::Argument {
                what: "golden".into(),
                message: format!("the name {name:?}; expected ASCII letters, digits, `-`, `_`, `.`"),
            });
        }
        self.refuse_one_folder()?;

        let expected_path = self.expected.join(format!("{name}.png"));
        if !expected_path.is_file() {
            return Err(self.failed(name, actual, None, None, "there is no such golden yet"));
        }
        let expected = read_png(&expected_path)?;
        match compare(&expected, actual, tolerance) {
            Ok(report) => match report.fault(tolerance) {
                None => {
                    self.remove_evidence(name);
                    Ok(report)
                }
                Some(fault) => Err(self.failed(name, actual, Some(&expected), Some(&report), &fault)),
            },
            Err(error) => Err(self.failed(name, actual, Some(&expected), None, &error.to_string())),
        }
    }

    /// A picture that is compared with what the last run wrote would always pass.
    fn refuse_one_folder(&self) -> Result<()> {
        let real = |path: &Path| std::fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        if real(&self.expected) == real(&self.actual) {
            return Err(Error::Argument {
                what: "goldens".into(),
                message: format!("{} is both the expected and the actual folder", self.expected.display()),
            });
        }
        Ok(())
    }

    fn failed(
        &self,
        name: &str,
        actual: &Image,
        expected: Option<&Image>,
        report: Option<&Report>,
        fault: &str,
    ) -> Error {
        let actual_path = self.actual.join(format!("{name}.png"));
        let diff_path = self.actual.join(format!("{name}.diff.png"));
        let expected_path = self.expected.join(format!("{name}.png"));

        self.remove_evidence(name);
        let mut saved = std::fs::create_dir_all(&self.actual)
            .map_err(|e| Error::io(&self.actual, &e))
            .and_then(|()| write_png(&actual_path, actual))
            .and_then(|()| write_atomic(self.actual.join(format!("{name}.txt")), format!("{fault}\n").as_bytes()));
        let mut look_at = actual_path.display().to_string();
        if let Some(expected) = expected {
            saved = saved.and_then(|()| write_png(&diff_path, &sheet(expected, actual, report)?));
            look_at = format!("{look_at} and {}", diff_path.display());
        }
        let accept = if self.bless_command.is_empty() {
            format!("copy it to {}", expected_path.display())
        } else {
            self.bless_command.replace("{name}", name)
        };
        let evidence = match saved {
            Ok(()) => format!("look at {look_at}; to accept the new picture: {accept}"),
            Err(error) => format!("the picture could not be saved: {error}"),
        };
        Error::Input {
            path: expected_path.display().to_string(),
            pointer: "picture".into(),
            message: format!("{fault}; {evidence}"),
        }
    }

    /// Evidence of an earlier run must not be taken for that of this one.
    fn remove_evidence(&self, name: &str) {
        for ending in ["png", "diff.png", "txt"] {
            let _ = std::fs::remove_file(self.actual.join(format!("{name}.{ending}")));
        }
    }
}
