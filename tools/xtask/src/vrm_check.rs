//! `cargo xtask vrm-check`: the built-in character in other VRM software. For developers: needs npm and Chromium.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::{Outcome, Stop, cargo, driver};

/// What runs in Node and in the browser.
const SCRIPTS: [&str; 3] = ["package.json", "check.mjs", "page.html"];

const BROWSERS: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "chrome"];

pub(crate) fn run(args: &[String]) -> Outcome {
    if !args.is_empty() {
        return Err(Stop(2, "usage: cargo xtask vrm-check".into()));
    }
    let vulkan = driver::ensure()?;
    let browser = BROWSERS.into_iter().find(|name| answers(name)).ok_or_else(|| missing("Chromium", "chromium"))?;
    if !answers("npm") {
        return Err(missing("npm", "npm"));
    }
    let folder = cargo::target().join("vrm-check");
    let fault = |path: &Path, e: std::io::Error| Stop(1, format!("{}: {e}", path.display()));
    std::fs::create_dir_all(&folder).map_err(|e| fault(&folder, e))?;
    for name in SCRIPTS {
        let from = Path::new("tools/xtask/vrm-check").join(name);
        std::fs::copy(&from, folder.join(name)).map_err(|e| fault(&from, e))?;
    }
    cargo::wait(Command::new("npm").args(["install", "--no-audit", "--no-fund", "--silent"]).current_dir(&folder))?;

    let model = folder.join("hikage.vrm");
    let written = model.to_string_lossy().into_owned();
    cargo::run(&["run", "--quiet", "--release", "-p", "hikage-character", "--", "-o", &written], &vulkan)?;
    let browser = which(browser);
    let mut node = Command::new("node");
    node.arg(folder.join("check.mjs")).arg(&model).arg(folder.join("reference")).arg(browser);
    cargo::wait(&mut node)?;
    let folder = folder.to_string_lossy().into_owned();
    let pictures = format!("{folder}/pictures");
    let compare = ["run", "--quiet", "--release", "-p", "hikage-cli", "--", "compare-references"];
    cargo::run(&[&compare[..], &[&folder, "--write", &pictures]].concat(), &vulkan)?;
    println!("reference | ours | difference: {pictures}");
    Ok(())
}

fn answers(program: &str) -> bool {
    let mut command = Command::new(program);
    command.arg("--version").stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|s| s.success())
}

/// The file that the shell would start.
fn which(program: &str) -> PathBuf {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).map(|f| f.join(program)).find(|f| f.is_file()).unwrap_or_else(|| program.into())
}

fn missing(what: &str, package: &str) -> Stop {
    Stop(1, format!("{what} is not here; on Debian: apt-get install {package}"))
}
