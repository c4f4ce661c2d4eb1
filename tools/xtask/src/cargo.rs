//! Children: cargo and the program that it built.

use std::path::PathBuf;
use std::process::Command;

use crate::driver::Vulkan;
use crate::{Outcome, Stop};

/// Runs cargo; what it prints goes to the terminal.
pub(crate) fn run(args: &[&str], vulkan: &Vulkan) -> Outcome {
    run_with(args, vulkan, &[])
}

/// Runs cargo with more environment variables.
pub(crate) fn run_with(args: &[&str], vulkan: &Vulkan, variables: &[(&str, &str)]) -> Outcome {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(args).envs(variables.iter().copied());
    vulkan.apply(&mut command);
    wait(&mut command)
}

/// Runs a child; fails where it fails, with its status.
pub(crate) fn wait(command: &mut Command) -> Outcome {
    let program = command.get_program().to_string_lossy().into_owned();
    let status = command.status().map_err(|e| Stop(1, format!("{program}: {e}")))?;
    if status.success() {
        Ok(())
    } else {
        Err(Stop(status.code().unwrap_or(1), String::new()))
    }
}

/// Builds the program `hikage` and returns its path.
pub(crate) fn build_cli(release: bool) -> Outcome<PathBuf> {
    let mut args = vec!["build", "-p", "hikage-cli"];
    if release {
        args.push("--release");
    }
    run(&args, &Vulkan::default())?;
    let name = format!("hikage{}", std::env::consts::EXE_SUFFIX);
    Ok(target().join(if release { "release" } else { "debug" }).join(name))
}

/// Cargo's folder of what it built.
pub(crate) fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| PathBuf::from("target"), PathBuf::from)
}
