//! `cargo xtask same`: whether two builds of the program draw the same pictures, byte by byte.

mod views;

use std::collections::BTreeSet;
use std::hash::{DefaultHasher, Hasher as _};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use crate::driver::{self, Vulkan};
use crate::{Outcome, Stop, cargo};
use views::{View, Writes};

const USAGE: &str = "usage: cargo xtask same OLD NEW [--only TEXT] [--driver lavapipe|swiftshader]";

/// Drivers: what they are called here, and a part of their adapter's name.
const DRIVERS: [(&str, &str); 2] = [("lavapipe", "llvmpipe"), ("swiftshader", "swiftshader")];

pub(crate) fn run(args: &[String]) -> Outcome {
    let options = options(args)?;
    let vulkan = driver::ensure()?;
    let mut drivers: Vec<(&str, &str)> = DRIVERS.into_iter().filter(|(name, _)| options.uses(name)).collect();
    let vulkan = match driver::swiftshader() {
        Some(library) => {
            make_folder(&cargo::target())?;
            vulkan.with_swiftshader(library)?
        }
        None => {
            drivers.retain(|(name, _)| *name != "swiftshader");
            println!("swiftshader is not here: no browser brought it");
            vulkan
        }
    };
    let programs = [Program::new("OLD", options.old)?, Program::new("NEW", options.new)?];
    let (mut views, missing) = views::all();
    for model in missing {
        println!("{}: is not here, its views are left out", model.display());
    }
    views.retain(|v| options.only.is_none_or(|text| v.name.contains(text)));
    if views.is_empty() || drivers.is_empty() {
        return Err(Stop(2, "no view is left to compare".into()));
    }

    let (mut compared, mut wrong) = (0, 0);
    for &(driver, adapter) in &drivers {
        let views: Vec<&View> = views.iter().filter(|v| v.only_on.is_none_or(|only| only == driver)).collect();
        let mut drawn = Vec::new();
        for program in &programs {
            let job = Job { program, driver, adapter, vulkan: &vulkan };
            drawn.push(job.draw_all(&views)?);
        }
        for (view, (old, new)) in views.iter().zip(drawn[0].iter().zip(&drawn[1])) {
            let findings = compare(old, new)?;
            compared += pictures(new.as_ref().or(old.as_ref()).ok()).len().max(findings.len());
            wrong += findings.len();
            for finding in findings {
                println!("{driver}: {}: {finding}", view.name);
            }
        }
    }
    let on = match drivers[..] {
        [(driver, _)] => format!("{compared} views, {driver}"),
        _ => format!("{compared} views, {} drivers", drivers.len()),
    };
    if wrong == 0 {
        println!("{on}: all the same");
        Ok(())
    } else {
        Err(Stop(1, format!("{wrong} of {compared} differ")))
    }
}

/// The command line.
struct Options<'a> {
    old: &'a str,
    new: &'a str,
    only: Option<&'a str>,
    driver: Option<&'a str>,
}

impl Options<'_> {
    fn uses(&self, driver: &str) -> bool {
        self.driver.is_none_or(|named| named == driver)
    }
}

fn options(args: &[String]) -> Outcome<Options<'_>> {
    let usage = || Stop(2, USAGE.into());
    let (mut programs, mut only, mut driver) = (Vec::new(), None, None);
    let mut words = args.iter().map(String::as_str);
    while let Some(word) = words.next() {
        match word {
            "--only" => only = Some(words.next().ok_or_else(usage)?),
            "--driver" => driver = Some(words.next().ok_or_else(usage)?),
            _ if word.starts_with('-') => return Err(usage()),
            _ => programs.push(word),
        }
    }
    let [old, new] = programs[..] else { return Err(usage()) };
    if driver.is_some_and(|named| DRIVERS.iter().all(|(name, _)| *name != named)) {
        return Err(usage());
    }
    Ok(Options { old, new, only, driver })
}

/// One build.
struct Program {
    /// What it is called here.
    name: &'static str,
    path: PathBuf,
    /// Folder of its pictures: by what the file holds, so that the same build is drawn once only.
    folder: PathBuf,
}

impl Program {
    fn new(name: &'static str, path: &str) -> Outcome<Self> {
        let bytes = std::fs::read(path).map_err(|e| Stop(1, format!("{path}: {e}")))?;
        let path = std::path::absolute(path).map_err(|e| Stop(1, format!("{path}: {e}")))?;
        Ok(Self { name, path, folder: Path::new("target/same").join(format!("{:016x}", hash(&[&bytes]))) })
    }
}

/// What a build draws on one driver.
struct Job<'a> {
    program: &'a Program,
    driver: &'a str,
    adapter: &'a str,
    vulkan: &'a Vulkan,
}

impl Job<'_> {
    /// Draws what is not there yet, one view on each core; a path for each view, or why there is none.
    fn draw_all(&self, views: &[&View]) -> Outcome<Vec<Result<PathBuf, String>>> {
        let start = Instant::now();
        let folder = self.program.folder.join(self.driver);
        make_folder(&folder)?;
        let (next, drawn) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let work = || {
            let mut done = Vec::new();
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                let Some(view) = views.get(index) else { return done };
                let path = folder.join(file_name(view));
                let outcome = if path.exists() {
                    Ok(())
                } else {
                    drawn.fetch_add(1, Ordering::Relaxed);
                    self.draw(view, &path)
                };
                done.push((index, outcome.map(|()| path)));
            }
        };
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let mut done: Vec<_> = std::thread::scope(|scope| {
            let workers: Vec<_> = (0..cores).map(|_| scope.spawn(work)).collect();
            workers.into_iter().filter_map(|w| w.join().ok()).flatten().collect()
        });
        if done.len() != views.len() {
            return Err(Stop(1, "a thread that draws ended early".into()));
        }
        done.sort_by_key(|(index, _)| *index);
        let (drawn, seconds) = (drawn.into_inner(), start.elapsed().as_secs());
        println!("{} on {}: {drawn} of {} commands run, {seconds} s", self.program.name, self.driver, views.len());
        Ok(done.into_iter().map(|(_, outcome)| outcome).collect())
    }

    /// Runs the command of a view; what it wrote is moved to its place once it is whole.
    fn draw(&self, view: &View, path: &Path) -> Result<(), String> {
        let partial = path.with_extension("partial.png");
        let fault = |e: std::io::Error| format!("{}: {e}", partial.display());
        clear(&partial).map_err(fault)?;
        if view.writes == Writes::Folder {
            std::fs::create_dir(&partial).map_err(fault)?;
        }
        let mut command = Command::new(&self.program.path);
        command.args(&view.args).arg("-o").arg(&partial);
        if view.draws {
            command.args(["--adapter", self.adapter]);
        }
        if let Some(look) = view.look {
            command.arg("--look").arg(write_look(look).map_err(|e| format!("look file: {e}"))?);
        }
        self.vulkan.apply(&mut command);
        let output = command.stdin(Stdio::null()).output().map_err(|e| e.to_string())?;
        if !output.status.success() {
            let told = String::from_utf8_lossy(&output.stderr);
            let line = told.lines().find(|l| l.starts_with("error")).or(told.lines().next()).unwrap_or("no message");
            return Err(format!("{} fails ({}): {line}", self.program.name, output.status));
        }
        std::fs::rename(&partial, path).map_err(fault)
    }
}

/// What a view's output is called: another name for another command, look or model.
fn file_name(view: &View) -> String {
    let slug: String = view.name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    let files = view.args.iter().filter_map(|arg| std::fs::metadata(arg).ok());
    let sizes: Vec<u8> = files.flat_map(|m| m.len().to_le_bytes()).collect();
    let words = view.args.join("\n");
    let look = view.look.map(|text| look_hash(text).to_le_bytes());
    let mark = hash(&[words.as_bytes(), &sizes, look.as_ref().map_or(&[], |l| &l[..])]);
    format!("{}-{mark:016x}.png", slug.chars().take(80).collect::<String>())
}

/// A look and the map beside it.
fn look_hash(text: &str) -> u64 {
    hash(&[text.as_bytes(), &std::fs::read(views::MAP).unwrap_or_default()])
}

/// Writes a look file with the map beside it, and returns its path.
fn write_look(text: &str) -> std::io::Result<PathBuf> {
    let folder = Path::new("target/same/looks").join(format!("{:016x}", look_hash(text)));
    let path = folder.join("view.look.toml");
    // Another thread may write the same.
    if !path.exists() {
        std::fs::create_dir_all(&folder)?;
        std::fs::copy(views::MAP, folder.join("map.png"))?;
        let partial = folder.join(format!("{:?}.partial", std::thread::current().id()));
        std::fs::write(&partial, text)?;
        std::fs::rename(partial, &path)?;
    }
    Ok(path)
}

/// What is wrong with a view.
fn compare(old: &Result<PathBuf, String>, new: &Result<PathBuf, String>) -> Outcome<Vec<String>> {
    let (old, new) = match (old, new) {
        (Ok(old), Ok(new)) => (old, new),
        (Err(why), Err(also)) => return Ok(vec![format!("{why}; {also}")]),
        (Err(why), _) | (_, Err(why)) => return Ok(vec![why.clone()]),
    };
    if old == new {
        return Ok(Vec::new());
    }
    let (of_old, of_new) = (pictures(Some(old)), pictures(Some(new)));
    let names: BTreeSet<&PathBuf> = of_old.union(&of_new).collect();
    let mut findings = Vec::new();
    for name in names {
        let (of_folder, [left, right]) = if name.as_os_str().is_empty() {
            (String::new(), [old.clone(), new.clone()])
        } else {
            (format!("{} ", name.display()), [old.join(name), new.join(name)])
        };
        if !of_old.contains(name) || !of_new.contains(name) {
            findings.push(format!("{of_folder}missing"));
        } else if read(&left)? != read(&right)? {
            findings.push(format!("{of_folder}differs: {} {}", left.display(), right.display()));
        }
    }
    Ok(findings)
}

/// The files of an output: those in a folder, or nothing more than itself.
fn pictures(output: Option<&PathBuf>) -> BTreeSet<PathBuf> {
    let Some(output) = output else { return BTreeSet::new() };
    match std::fs::read_dir(output) {
        Ok(entries) => entries.flatten().map(|e| PathBuf::from(e.file_name())).collect(),
        Err(_) => BTreeSet::from([PathBuf::new()]),
    }
}

fn read(path: &Path) -> Outcome<Vec<u8>> {
    std::fs::read(path).map_err(|e| Stop(1, format!("{}: {e}", path.display())))
}

fn make_folder(path: &Path) -> Outcome {
    std::fs::create_dir_all(path).map_err(|e| Stop(1, format!("{}: {e}", path.display())))
}

/// Removes what an earlier run left.
fn clear(path: &Path) -> std::io::Result<()> {
    let outcome = if path.is_dir() {
        std::fs::remove_dir_all(path)
    } else {
        std::fs::remove_file(path)
    };
    outcome.or_else(|e| {
        if e.kind() == ErrorKind::NotFound {
            Ok(())
        } else {
            Err(e)
        }
    })
}

fn hash(parts: &[&[u8]]) -> u64 {
    let mut hasher = DefaultHasher::new();
    for part in parts {
        hasher.write_usize(part.len());
        hasher.write(part);
    }
    hasher.finish()
}
