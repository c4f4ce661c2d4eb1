//! `cargo xtask test`: all tests on the default adapter, then those of pictures on a second driver where one is found.

use std::process::{Command, Stdio};

use crate::{Outcome, Stop, apt, cargo, driver, with};

/// A virtual X server and what winit opens at run time, for tests/window.rs.
const WINDOW_PACKAGES: [&str; 5] = ["xvfb", "libxkbcommon-x11-0", "libx11-xcb1", "libxcursor1", "libxi6"];

/// Tests that say something about a driver; of the whole workspace, so that nothing is built anew. Each part of the look has
/// its pictures among the goldens of the character.
const ON_SECOND_DRIVER: [&str; 20] = [
    "test",
    "--workspace",
    "--test",
    "adapters",
    "--test",
    "body_looks",
    "--test",
    "depth_rim",
    "--test",
    "golden",
    "--test",
    "golden_looks",
    "--test",
    "golden_character",
    "--test",
    "laws",
    "--test",
    "oracles",
    "--test",
    "self_shadow",
];

pub(crate) fn run(args: &[String]) -> Outcome {
    let vulkan = driver::ensure()?;
    ensure_virtual_screen();
    cargo::run(&with(&["test", "--workspace"], args), &vulkan)?;
    match driver::swiftshader() {
        // Arguments choose tests of their own.
        Some(library) if args.is_empty() => {
            println!("== on SwiftShader, {}", library.display());
            let vulkan = vulkan.with_swiftshader(library)?;
            cargo::run_with(&ON_SECOND_DRIVER, &vulkan, &[("HIKAGE_ADAPTER", "swiftshader")])
        }
        _ => Ok(()),
    }
}

/// Without it the window test says that it was not run, so no failure here is fatal.
fn ensure_virtual_screen() {
    let has_xvfb = || Command::new("Xvfb").arg("-help").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok();
    if !cfg!(target_os = "linux") || has_xvfb() || !apt::is_usable() {
        return;
    }
    eprintln!("xtask: no virtual screen for the window test");
    if let Err(Stop(_, message)) = apt::install(&WINDOW_PACKAGES) {
        eprintln!("xtask: {message}; the window test will not run");
    }
}
