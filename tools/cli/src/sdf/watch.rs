//! `hikage sdf watch`: bakes again whenever a drawing is saved.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::{Duration, Instant, SystemTime};

use hikage::picture::write_atomic;
use hikage::sdf::{Project, check};
use notify::{RecursiveMode, Watcher as _};

use super::input::Input;
use crate::failure::{Failure, warn};
use crate::output::print;
use crate::render::png_path;

/// Arguments of `hikage sdf watch`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    input: Input,
    /// Map to write; its folder must exist.
    #[arg(short, long, value_name = "MAP.png", value_parser = png_path)]
    output: PathBuf,
    /// Stop after so many bakes.
    #[arg(long, hide = true)]
    times: Option<u32>,
}

/// Programs save a file in several steps: wait until nothing more comes.
const QUIET: Duration = Duration::from_millis(60);

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let (sender, events) = mpsc::channel();
    let fail = |e: notify::Error| Failure::input(format!("cannot watch the drawings: {e}"));
    let mut watcher = notify::recommended_watcher(move |event| drop(sender.send(event))).map_err(fail)?;
    let mut folders = Vec::new();
    let mut seen = BTreeMap::new();
    let mut times = 0;
    loop {
        // A project that cannot be read is mended in the editor that is open; the first one must be there.
        match args.input.project() {
            Ok(project) => {
                for folder in folders_of(&project)? {
                    if !folders.contains(&folder) {
                        watcher.watch(&folder, RecursiveMode::NonRecursive).map_err(fail)?;
                        folders.push(folder);
                    }
                }
                let changed = changes(&project, &mut seen)?;
                if !changed.is_empty() {
                    match bake(&project, &args.output, &changed) {
                        Ok(line) => print(&line)?,
                        Err(failure) if times == 0 => return Err(failure),
                        Err(failure) => warn(&failure.to_string()),
                    }
                    times += 1;
                }
            }
            Err(failure) if times == 0 => return Err(failure),
            Err(failure) => warn(&failure.to_string()),
        }
        if args.times.is_some_and(|most| times >= most) {
            return Ok(());
        }
        if events.recv().is_err() {
            return Ok(());
        }
        while events.recv_timeout(QUIET).is_ok() {}
    }
}

/// Folders of all files of a project: editors replace files, so that the files themselves cannot be watched.
fn folders_of(project: &Project) -> Result<Vec<PathBuf>, Failure> {
    let folder = |file: &PathBuf| match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_path_buf(),
        _ => PathBuf::from("."),
    };
    Ok(project.files()?.iter().map(folder).collect())
}

/// Files that have another time or size than when they were last seen.
fn changes(
    project: &Project,
    seen: &mut BTreeMap<PathBuf, Option<(SystemTime, u64)>>,
) -> Result<Vec<PathBuf>, Failure> {
    let mut changed = Vec::new();
    for file in project.files()? {
        let now = std::fs::metadata(&file).ok().and_then(|m| Some((m.modified().ok()?, m.len())));
        if seen.insert(file.clone(), now) != Some(now) {
            changed.push(file);
        }
    }
    Ok(changed)
}

/// Bakes what can be baked; contradictions are repaired in the map, and told.
fn bake(project: &Project, output: &Path, changed: &[PathBuf]) -> Result<String, Failure> {
    let start = Instant::now();
    let baked = project.bake(true)?;
    let remarks = check(project, &baked)?;
    write_atomic(output, &project.encode(&baked.into_sides())?)?;
    let names: Vec<_> = changed.iter().filter_map(|f| Some(f.file_name()?.to_string_lossy())).collect();
    let mut text =
        format!("{}: {} in {:.0} ms\n", names.join(", "), output.display(), start.elapsed().as_secs_f64() * 1e3);
    for remark in remarks.iter().filter(|r| r.is_fault) {
        text += &format!("  {}\n", remark.message);
    }
    Ok(text)
}
