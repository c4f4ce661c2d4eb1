//! `cargo xtask test`: all tests on the default adapter, then those of pictures on a second driver where one is found.

use std::process::{Command, Stdio};

use crate::{Outcome, Stop, apt, cargo, driver, with};

/// A virtual X server and what winit opens at run time, for tests/window.rs.
const WINDOW_PACKAGES: [&str; 5] = ["xvfb", "libxkbcommon-x11-0", "libx11-xcb1", "libxcursor1", "libxi6"];

/// Test modules of pictures that are accepted by name; all stand in binaries named `pictures`.
pub(crate) const GOLDENS: [&str; 4] = ["golden::", "golden_looks::", "golden_natural::", "golden_character::"];

/// Other test modules, all of the binary `adapter`, that say something about a driver. Each part of the look has its
/// pictures among the goldens of the character.
const ON_SECOND_DRIVER: [&str; 12] = [
    "adapters::",
    "body_looks::",
    "depth_rim::",
    "host::",
    "laws::",
    "layers::",
    "natural::",
    "oracles::",
    "self_shadow::",
    "stage::",
    "strips::",
    "temporal",
];

/// Tells llvmpipe not to optimise its machine code: the first frame takes about 40 % less, and the bytes are the same.
pub(crate) const QUICK_LLVMPIPE: [(&str, &str); 1] = [("GALLIVM_PERF", "nopt")];

pub(crate) fn run(args: &[String]) -> Outcome {
    let vulkan = driver::ensure()?;
    ensure_virtual_screen();
    cargo::run_with(&with(&["test", "--workspace"], args), &vulkan, &QUICK_LLVMPIPE)?;
    match driver::swiftshader() {
        // Arguments choose tests of their own.
        Some(library) if args.is_empty() => {
            println!("== on SwiftShader, {}", library.display());
            let vulkan = vulkan.with_swiftshader(library)?;
            // Of the whole workspace, so that nothing is built anew.
            let binaries = ["test", "--workspace", "--test", "adapter", "--test", "pictures", "--"];
            let tests = [&binaries[..], &ON_SECOND_DRIVER[..], &GOLDENS[..]].concat();
            cargo::run_with(&tests, &vulkan, &[("HIKAGE_ADAPTER", "swiftshader")])
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

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{GOLDENS, ON_SECOND_DRIVER};

    /// A module that is not there would run no test, and nothing would say so.
    #[test]
    fn chosen_modules_are_there() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let is_there = |folder: &str, filter: &str| {
            let module = root.join(folder).join(filter.trim_end_matches("::"));
            module.with_extension("rs").is_file() || module.join("mod.rs").is_file()
        };
        for filter in ON_SECOND_DRIVER {
            assert!(is_there("tests/adapter", filter), "{filter}");
        }
        for filter in GOLDENS {
            assert!(is_there("tests/pictures", filter) || is_there("tools/cli/tests/pictures", filter), "{filter}");
        }
    }
}
