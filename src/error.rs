//! The one error type of the library: every variant names the file or element, what was found and what was expected.

use std::path::PathBuf;

/// What can go wrong. The message alone is enough to find the fault: file, element, found, expected, remedy.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read or written.
    #[error("{path}: {reason}")]
    Io {
        /// The file, as the caller named it.
        path: String,
        /// What the system said.
        reason: String,
    },

    /// A file is not what it should be.
    #[error("{path}: {pointer}: {message}")]
    Input {
        /// The file.
        path: String,
        /// JSON pointer of the faulty element (`/meshes/0/primitives/1`), or the part of a binary file (`header`).
        pointer: String,
        /// What was found and what was expected.
        message: String,
    },

    /// A file asks for more than the [`Limits`](crate::import::Limits) allow.
    #[error("{path}: {pointer}: {found} is over the limit of {limit} {unit}")]
    Limit {
        /// The file.
        path: String,
        /// JSON pointer of the element, or the part of the file.
        pointer: String,
        /// How much it asks for.
        found: u64,
        /// How much is allowed.
        limit: u64,
        /// What is counted: `bytes`, `vertices`, `joints`, …
        unit: &'static str,
    },

    /// A value given by the caller is out of its domain.
    #[error("{what}: {message}")]
    Argument {
        /// The parameter.
        what: String,
        /// What was found and what was expected.
        message: String,
    },

    /// No usable graphics adapter.
    #[error("no graphics adapter: {message}")]
    NoAdapter {
        /// What was looked for, and how to install one.
        message: String,
    },

    /// The graphics driver refused or lost something.
    #[error("graphics: {0}")]
    Gpu(String),
}

impl Error {
    /// An [`Error::Io`] with the path shown as the caller gave it.
    pub(crate) fn io(path: impl Into<PathBuf>, error: &std::io::Error) -> Self {
        Self::Io { path: path.into().display().to_string(), reason: error.to_string() }
    }

    /// Whether the fault lies in the input or arguments rather than in the machine's graphics.
    #[must_use]
    pub fn is_gpu(&self) -> bool {
        matches!(self, Self::NoAdapter { .. } | Self::Gpu(_))
    }
}

/// `Result` with [`Error`].
pub type Result<T, E = Error> = std::result::Result<T, E>;
