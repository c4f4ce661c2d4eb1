//! `cargo xtask demo`: from a bare machine to the first picture.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use crate::{Outcome, Stop, cargo, driver};

/// Where models are looked for when none is named.
const MODELS: &str = "../shared/models";

pub(crate) fn run(args: &[String]) -> Outcome {
    let model = match args {
        [] => largest_model(Path::new(MODELS))
            .ok_or_else(|| Stop(1, format!("no .vrm file in {MODELS}; name one: cargo xtask demo MODEL")))?,
        [model] if !model.starts_with('-') => PathBuf::from(model),
        _ => return Err(Stop(2, "usage: cargo xtask demo [MODEL]".into())),
    };
    let start = Instant::now();
    let vulkan = driver::ensure()?;
    let hikage = cargo::build_cli(true)?;

    let folder = Path::new("target/demo");
    std::fs::create_dir_all(folder).map_err(|e| Stop(1, format!("{}: {e}", folder.display())))?;
    let stem = model.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let picture = folder.join(format!("{stem}.png"));

    let drawing = Instant::now();
    let mut render = Command::new(&hikage);
    render.arg("render").arg(&model).arg("-o").arg(&picture);
    render.args(["--size", "1024x1024", "--view", "portrait"]);
    vulkan.apply(&mut render);
    cargo::wait(&mut render)?;
    let drawing = drawing.elapsed();

    let shown = std::fs::canonicalize(&picture).unwrap_or(picture);
    println!("\n{}", shown.display());
    println!("  shows    {} in portrait, 1024 x 1024, lit from the upper left", model.display());
    for (name, value) in credits(&hikage, &model) {
        println!("  {name:<8} {value}");
    }
    println!("  drawn in {:.1} s, {:.1} s with the build", drawing.as_secs_f64(), start.elapsed().as_secs_f64());
    Ok(())
}

/// The largest `.vrm` file: in a folder of samples, the full characters are larger than the test shapes.
fn largest_model(folder: &Path) -> Option<PathBuf> {
    let mut models: Vec<(u64, PathBuf)> = std::fs::read_dir(folder)
        .ok()?
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|e| e == "vrm"))
        .filter_map(|path| Some((path.metadata().ok()?.len(), path)))
        .collect();
    models.sort();
    models.pop().map(|(_, path)| path)
}

/// Title, authors and licence as `hikage inspect` tells them.
fn credits(hikage: &Path, model: &Path) -> Vec<(String, String)> {
    let Ok(output) = Command::new(hikage).arg("inspect").arg(model).env("NO_COLOR", "1").output() else {
        return Vec::new();
    };
    String::from_utf8_lossy(&output.stdout)
        .lines()
        .filter_map(|line| line.split_once(' '))
        .filter(|(name, _)| ["title", "authors", "license"].contains(name))
        .map(|(name, value)| (name.to_owned(), value.trim().to_owned()))
        .collect()
}
