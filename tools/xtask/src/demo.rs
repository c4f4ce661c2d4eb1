//! `cargo xtask demo`: from a bare machine to the first picture.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use crate::{Outcome, Stop, cargo, driver};

pub(crate) fn run(args: &[String]) -> Outcome {
    let sheet = args.iter().any(|a| a == "--sheet");
    let rest: Vec<&String> = args.iter().filter(|a| *a != "--sheet").collect();
    let model = match rest[..] {
        [] => None,
        [model] if !model.starts_with('-') => Some(PathBuf::from(model)),
        _ => return Err(Stop(2, "usage: cargo xtask demo [MODEL] [--sheet]".into())),
    };
    let start = Instant::now();
    let vulkan = driver::ensure()?;
    let hikage = cargo::build_cli(true)?;

    let folder = Path::new("target/demo");
    std::fs::create_dir_all(folder).map_err(|e| Stop(1, format!("{}: {e}", folder.display())))?;
    let name = model.as_deref().map_or("the built-in character".into(), Path::to_string_lossy);
    let stem = model.as_deref().and_then(Path::file_stem).map_or("hikage".into(), |s| s.to_string_lossy());
    let (command, ending, options, shows): (_, _, &[&str], _) = if sheet {
        ("sheet", "-sheet", &[], "from all sides and with every expression")
    } else {
        let options =
            &["--look", "anime", "--size", "1024x1024", "--view", "portrait", "--yaw", "20", "--light", "-30,35"];
        ("render", "", options, "in portrait, 1024 x 1024, lit from the upper left")
    };
    let picture = folder.join(format!("{stem}{ending}.png"));

    let drawing = Instant::now();
    let mut draw = Command::new(&hikage);
    draw.arg(command).args(&model).arg("-o").arg(&picture).args(options);
    vulkan.apply(&mut draw);
    cargo::wait(&mut draw)?;
    let drawing = drawing.elapsed();

    let shown = std::fs::canonicalize(&picture).unwrap_or(picture);
    println!("\n{}", shown.display());
    println!("  shows    {name} {shows}");
    for (name, value) in model.iter().flat_map(|m| credits(&hikage, m)) {
        println!("  {name:<8} {value}");
    }
    println!("  drawn in {:.1} s, {:.1} s with the build", drawing.as_secs_f64(), start.elapsed().as_secs_f64());
    Ok(())
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
