//! Packages of Debian and its kin, fetched without asking where that is possible.

use std::path::Path;
use std::process::Command;

use crate::{Outcome, Stop, cargo};

/// Whether packages can be installed: apt is there, and this is root.
pub(crate) fn is_usable() -> bool {
    let is_root = Command::new("id").arg("-u").output().is_ok_and(|o| o.stdout.trim_ascii() == b"0");
    is_root && Path::new("/usr/bin/apt-get").exists()
}

/// Says what it installs, and installs it.
pub(crate) fn install(packages: &[&str]) -> Outcome {
    eprintln!("xtask: installing {} with apt-get", packages.join(" "));
    let apt = |args: &[&str]| {
        let mut command = Command::new("apt-get");
        // Progress goes to standard error, so that what a task prints stays its own.
        command.args(args).env("DEBIAN_FRONTEND", "noninteractive").stdout(std::io::stderr());
        cargo::wait(&mut command).map_err(|Stop(status, _)| Stop(status, format!("apt-get {} failed", args.join(" "))))
    };
    apt(&["-q", "update"])?;
    apt(&[&["-q", "install", "-y", "--no-install-recommends"], packages].concat())
}
