//! The profile file: how light scatters below a surface, to be shared by looks.

use std::path::Path;

use toml::{Table, Value};

use super::look_file::{line_of, read_text};
use super::values::{nearest, not_finite};
use crate::material::out_of_range;
use crate::skin::DiffusionProfile;
use crate::{Error, Result};

/// A diffusion profile in a file: `NAME.profile.toml`.
///
/// ```toml
/// name = "Ear wax"                             # for people; the file's name where it is missing
/// scattering_distance_mm = [2.2, 1.5, 0.95]    # Burley's d of red, green and blue
/// ior = 1.5
/// ```
///
/// Keys are those of [`DiffusionProfile`]; what a file does not name has its default. A look file refers to it by
/// `skin = { profile = "NAME.profile.toml" }`.
#[derive(Clone, Debug, PartialEq)]
pub struct ProfileFile {
    /// What people call it.
    pub name: String,
    /// Its numbers.
    pub profile: DiffusionProfile,
}

impl ProfileFile {
    /// Reads a profile file.
    ///
    /// # Errors
    /// The file cannot be read or is over 1 MiB; and those of [`ProfileFile::parse`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        Self::parse(path, &read_text(path)?)
    }

    /// Reads the text of a profile file; `path` stands in errors and gives its name where the text has none.
    ///
    /// # Errors
    /// The text is not TOML, has a key that does not exist, or a value of another type or out of its range.
    pub fn parse(path: impl AsRef<Path>, text: &str) -> Result<Self> {
        let path = path.as_ref();
        let fault = |pointer: &str, message: String| Error::Input {
            path: path.display().to_string(),
            pointer: pointer.to_owned(),
            message,
        };
        let mut table: Table =
            toml::from_str(text).map_err(|e| fault(&line_of(text, e.span()), nearest(e.message())))?;
        let name = match table.remove("name") {
            Some(Value::String(name)) => name,
            Some(_) => return Err(fault("name", "expected a text".to_owned())),
            None => {
                let file = path.file_name().unwrap_or_default().to_string_lossy();
                file.trim_end_matches(".toml").trim_end_matches(".profile").to_owned()
            }
        };
        if let Some(bad) = not_finite(&table) {
            return Err(fault(&bad, "is not finite; expected a number".to_owned()));
        }
        // A key at a time: the message of a wrong type does not name it.
        for (key, value) in &table {
            let alone = Table::from_iter([(key.clone(), value.clone())]);
            Value::Table(alone)
                .try_into::<DiffusionProfile>()
                .map_err(|e: toml::de::Error| fault(key, nearest(e.message())))?;
        }
        let mut profile: DiffusionProfile =
            Value::Table(table).try_into().map_err(|e: toml::de::Error| fault("file", nearest(e.message())))?;
        match out_of_range(&mut profile) {
            Some((key, message)) => Err(fault(&key, message)),
            None => Ok(Self { name, profile }),
        }
    }
}
