//! `cargo xtask badinput`: feeds malformed and hostile files to the program, in debug and release.

use std::path::Path;
use std::process::Command;

use crate::{Outcome, Stop, cargo, driver};

/// Corpus below the given folder, endings to use (empty for all), and the command line after the program.
const RUNS: [(&str, &str, &str, &[&str]); 4] = [
    ("models, inspect", "", "gltf,glb,vrm", &["inspect", "{file}"]),
    ("images and shaders, inspect", "", "png,jpg,wgsl", &["inspect", "{file}"]),
    ("glTF-Validator's files, inspect", "validator", "", &["inspect", "{file}"]),
    ("models, render", "", "gltf,glb,vrm", &["render", "{file}", "-o", "{out}", "--size", "128x128"]),
];

pub(crate) fn run(args: &[String]) -> Outcome {
    let folder = match args {
        [] => "../shared/badinput",
        [folder] if !folder.starts_with('-') => folder.as_str(),
        _ => return Err(Stop(2, "usage: cargo xtask badinput [DIR]".into())),
    };
    let script = Path::new(folder).join("run_corpus.py");
    if !script.is_file() {
        return Err(Stop(1, format!("{}: does not exist", script.display())));
    }
    let vulkan = driver::ensure()?;
    let mut failed = Vec::new();
    for release in [false, true] {
        let program = cargo::build_cli(release)?;
        // The script runs it in another folder.
        let program = std::fs::canonicalize(&program).map_err(|e| Stop(1, format!("{}: {e}", program.display())))?;
        for (title, corpus, endings, command) in RUNS {
            let title = format!("{title}, {}", if release { "release" } else { "debug" });
            println!("== {title}");
            let mut python = Command::new("python3");
            python.arg(&script).arg(Path::new(folder).join(corpus));
            if !endings.is_empty() {
                python.args(["--ext", endings]);
            }
            // A graphics driver maps more address space than the limit for plain reading allows.
            if command[0] == "render" {
                python.args(["--as-mb", "0"]);
            }
            python.arg("--").arg(&program).args(command);
            vulkan.apply(&mut python);
            match cargo::wait(&mut python) {
                Ok(()) => {}
                // The script's own word for "not every case passed"; the other runs are still of interest.
                Err(Stop(1, message)) if message.is_empty() => failed.push(title),
                Err(stop) => return Err(stop),
            }
        }
    }
    if failed.is_empty() {
        Ok(())
    } else {
        Err(Stop(1, format!("not all passed: {}", failed.join("; "))))
    }
}
