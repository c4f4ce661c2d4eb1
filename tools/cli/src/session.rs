//! A runtime folder where the session has none, as in containers: the driver's selection of a device complains on standard
//! error without one, twice in every command.

use std::fs::{DirBuilder, metadata, symlink_metadata};
use std::os::unix::fs::{DirBuilderExt as _, MetadataExt as _};
use std::os::unix::process::CommandExt as _;
use std::path::{Path, PathBuf};
use std::process::Command;

const VARIABLE: &str = "XDG_RUNTIME_DIR";

/// Starts the program again in its own place, with the variable, where that is missing. Threads may read the environment,
/// so that it is not changed in place. What does not work out leaves things as they are.
pub(crate) fn ensure_runtime_folder() {
    if std::env::var_os(VARIABLE).is_some_and(|value| Path::new(&value).is_absolute()) {
        return;
    }
    let mut args = std::env::args_os();
    let (Some(name), Ok(program)) = (args.next(), std::env::current_exe()) else { return };
    // Started by something else, a loader say, that would take these arguments for its own.
    if program.file_name() != Path::new(&name).file_name() {
        return;
    }
    if let Some(folder) = private_folder(&std::env::temp_dir()) {
        // Comes back only where it fails.
        let _ = Command::new(program).arg0(&name).args(args).env(VARIABLE, folder).exec();
    }
}

/// A folder that is this user's alone; `None` where it cannot be had.
fn private_folder(temporary: &Path) -> Option<PathBuf> {
    let user = metadata("/proc/self").ok()?.uid();
    let folder = std::path::absolute(temporary).ok()?.join(format!("hikage-{user}"));
    // Where it is there already, the next lines say whose it is.
    let _ = DirBuilder::new().mode(0o700).create(&folder);
    let found = symlink_metadata(&folder).ok()?;
    (found.is_dir() && found.uid() == user && found.mode() & 0o077 == 0).then_some(folder)
}
