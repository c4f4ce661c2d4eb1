//! Chores of this repository: `cargo xtask TASK`. Standard library only, so that it builds in a second.

mod apt;
mod badinput;
mod cargo;
mod demo;
mod driver;
mod goldens;
mod lint;
mod same;
mod test;
mod vrm_check;

use std::path::PathBuf;
use std::process::exit;

const HELP: &str = "\
cargo xtask TASK

  demo [MODEL] [--sheet]    check the graphics driver, build, draw a character, say where the picture is; with
                            --sheet from all sides and with every expression
  test [ARGS…]              check the graphics driver, run all tests; ARGS go to `cargo test`. Without them, those of
                            pictures run again on SwiftShader where a browser brought it
  lint                      format, clippy, docs, words that must not be in the tree
  goldens                   run the golden tests and list what differs
  goldens --bless NAME…     accept these pictures, after looking at them
  goldens --bless --all     accept all pictures that differ
  same OLD NEW [--only TEXT] [--driver lavapipe|swiftshader]
                            draw some 400 views on both drivers with two builds of `hikage` and compare them byte by
                            byte; the pictures of a build are kept, so that OLD is drawn once only
  compare-references [DIR] [--write OUTDIR] [--only TEXT] [--json]
                            compare with pictures of another renderer (DIR: ../shared/models)
  compare-real hair|skin|eye [DIR] [--only GLOB] [--method NAME] [--json]
                            compare real hair, skin or eyes with pictures of a path tracer (DIR: ../shared/real; needs Python
                            with numpy, scipy and pillow)
  vrm-check                 the built-in character in glTF-Validator and three-vrm (needs npm and Chromium)
  badinput [DIR]            feed the corpus of malformed files to `hikage` (DIR: ../shared/badinput)
";

/// What ends a task early: exit status and message. An empty message means that a child has said it already.
pub(crate) struct Stop(pub(crate) i32, pub(crate) String);

pub(crate) type Outcome<T = ()> = Result<T, Stop>;

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let (task, rest) = args.split_first().map_or(("", &[][..]), |(task, rest)| (task.as_str(), rest));
    let Err(Stop(status, message)) = run(task, rest) else { return };
    if !message.is_empty() {
        eprintln!("xtask: {}", message.trim_end());
    }
    exit(status);
}

fn run(task: &str, args: &[String]) -> Outcome {
    // Tasks work from the repository's folder, wherever they are called; a path that they are given stays what it was.
    let args: Vec<String> = match task {
        "demo" | "same" | "badinput" | "compare-references" | "compare-real" => {
            args.iter().map(|arg| full_path(arg)).collect()
        }
        _ => args.to_vec(),
    };
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::env::set_current_dir(&root).map_err(|e| Stop(1, format!("{}: {e}", root.display())))?;

    match task {
        "demo" => demo::run(&args),
        "test" => test::run(&args),
        "lint" => lint::run(),
        "goldens" => goldens::run(&args),
        "same" => same::run(&args),
        "compare-references" => {
            let mut command = vec!["run", "--quiet", "--release", "-p", "hikage-cli", "--", "compare-references"];
            if args.first().is_none_or(|first| first.starts_with('-')) {
                command.push("../shared/models");
            }
            cargo::run(&with(&command, &args), &driver::ensure()?)
        }
        "compare-real" => {
            let mut command = vec!["run", "--quiet", "--release", "-p", "hikage-cli", "--", "compare-real"];
            let what = args.first().filter(|first| !first.starts_with('-')).ok_or_else(|| {
                Stop(2, "compare-real: say what is compared: cargo xtask compare-real hair|skin|eye [FOLDER]".into())
            })?;
            command.push(what);
            if args.get(1).is_none_or(|folder| folder.starts_with('-')) {
                command.push("../shared/real");
            }
            cargo::run(&with(&command, &args[1..]), &driver::ensure()?)
        }
        "vrm-check" => vrm_check::run(args.as_slice()),
        "badinput" => badinput::run(&args),
        "" | "help" | "-h" | "--help" => {
            print!("{HELP}");
            Ok(())
        }
        _ => Err(Stop(2, format!("no task {task:?}\n\n{HELP}"))),
    }
}

fn with<'a>(command: &[&'a str], args: &'a [String]) -> Vec<&'a str> {
    command.iter().copied().chain(args.iter().map(String::as_str)).collect()
}

/// The absolute form of what is the path of something; anything else as it is.
fn full_path(arg: &str) -> String {
    std::path::absolute(arg)
        .ok()
        .filter(|path| path.exists())
        .and_then(|path| path.into_os_string().into_string().ok())
        .unwrap_or_else(|| arg.to_owned())
}
