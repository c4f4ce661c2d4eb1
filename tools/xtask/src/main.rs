//! Chores of this repository: `cargo xtask TASK`. Standard library only, so that it builds in a second.

mod badinput;
mod cargo;
mod demo;
mod driver;
mod goldens;
mod lint;

use std::path::PathBuf;
use std::process::exit;

const HELP: &str = "\
cargo xtask TASK

  demo [MODEL]              check the graphics driver, build, draw a character, say where the picture is
  test [ARGS…]              check the graphics driver, run all tests; ARGS go to `cargo test`
  lint                      format, clippy, docs, words that must not be in the tree
  goldens                   run the golden tests and list what differs
  goldens --bless NAME…     accept these pictures, after looking at them
  goldens --bless --all     accept all pictures that differ
  compare-references [DIR]  compare with pictures of another renderer (default ../shared/models)
  badinput [DIR]            feed the corpus of malformed files to `hikage` (default ../shared/badinput)
";

/// What ends a task early: exit status and message. An empty message means that a child has said it already.
pub(crate) struct Stop(pub(crate) i32, pub(crate) String);

pub(crate) type Outcome<T = ()> = Result<T, Stop>;

fn main() {
    // Paths in tasks and in what they print are relative to the repository.
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let args: Vec<String> = std::env::args().skip(1).collect();
    let (task, rest) = args.split_first().map_or(("", &[][..]), |(task, rest)| (task.as_str(), rest));
    let outcome =
        std::env::set_current_dir(&root).map_err(|e| Stop(1, format!("{}: {e}", root.display()))).and_then(|()| {
            match task {
                "demo" => demo::run(rest),
                "test" => driver::ensure().and_then(|vulkan| {
                    let mut args = vec!["test", "--workspace"];
                    args.extend(rest.iter().map(String::as_str));
                    cargo::run(&args, &vulkan)
                }),
                "lint" => lint::run(),
                "goldens" => goldens::run(rest),
                "compare-references" => driver::ensure().and_then(|vulkan| {
                    let default = ["../shared/models".to_owned()];
                    let given = if rest.iter().any(|a| !a.starts_with('-')) {
                        &[][..]
                    } else {
                        &default[..]
                    };
                    let mut args = vec!["run", "--quiet", "--release", "-p", "hikage-cli", "--", "compare-references"];
                    args.extend(given.iter().chain(rest).map(String::as_str));
                    cargo::run(&args, &vulkan)
                }),
                "badinput" => badinput::run(rest),
                "" | "help" | "-h" | "--help" => {
                    print!("{HELP}");
                    Ok(())
                }
                _ => Err(Stop(2, format!("no task {task:?}\n\n{HELP}"))),
            }
        });
    if let Err(Stop(status, message)) = outcome {
        if !message.is_empty() {
            eprintln!("xtask: {}", message.trim_end());
        }
        exit(status);
    }
}
