//! The program `hikage`: draws, inspects and measures VRM and glTF characters.

mod adapters;
mod animate;
mod animation;
mod args;
mod bench;
mod clips;
mod compare_real;
mod compare_references;
mod deadline;
mod failure;
mod gallery;
mod inspect;
mod look;
mod looks;
mod motion;
mod output;
mod placed;
mod pose;
mod preset;
mod profile;
mod reference;
mod render;
mod sdf;
#[cfg(target_os = "linux")]
mod session;
mod setup;
mod sheet;
mod shot;
mod spinner;
mod texture;

use std::panic::AssertUnwindSafe;

use clap::{Parser, Subcommand};

use crate::failure::Failure;

/// Draws anime characters (VRM, glTF) as toon pictures, with or without a GPU.
#[derive(Parser)]
#[command(name = "hikage", version, max_term_width = 100, arg_required_else_help = true, after_help = AFTER_HELP)]
struct Program {
    #[command(subcommand)]
    command: Command,

    /// Give up after so many seconds.
    #[arg(long, global = true, display_order = 900, value_name = "SECONDS", value_parser = args::timeout)]
    timeout: Option<f64>,

    /// Say more on standard error.
    #[arg(short, long, global = true, display_order = 901)]
    verbose: bool,
}

const AFTER_HELP: &str = "\
Examples:
  hikage render girl.vrm -o girl.png
  hikage inspect girl.vrm
  hikage animate girl.vrm --clip walk -o walk.webp
  hikage render girl.vrm -o smile.png --view face --expression happy=0.8 --light 30,40

Exit status: 0 done, 1 bad input, 2 wrong usage, 3 no usable graphics.
Colours are left out where NO_COLOR is set or the output is no terminal.";

#[derive(Subcommand)]
enum Command {
    /// Draw a model into a PNG.
    Render(render::Args),
    /// Draw a character from all sides and with every expression, on one sheet.
    Sheet(sheet::Args),
    /// Draw a character in motion: an animated WebP or GIF, frames, or a contact sheet.
    Animate(animate::Args),
    /// Draw every look on the built-in character: contact sheets and a page that explains them.
    Gallery(gallery::Args),
    /// Write a look file with every number of the anime look, to start from. Needs no GPU.
    Look(look::Args),
    /// List what a look file can set: every section with its fields, ranges and defaults. Needs no GPU.
    Looks(looks::Args),
    /// Show diffusion profiles: how light scatters in skin, wax, jade. Needs no GPU.
    Profile(profile::Args),
    /// Author threshold maps of painted face shadows.
    Sdf(sdf::Args),
    /// Paint maps for looks by rule. Needs no GPU.
    Texture(texture::Args),
    /// Tell what a model, an image or a shader holds, and what will look wrong. Needs no GPU.
    Inspect(inspect::Args),
    /// Measure the time of a frame, against the same meshes drawn unlit.
    Bench(bench::Args),
    /// Replay a scenario of motion and write what becomes of it as numbers. Needs no GPU.
    #[command(hide = true)]
    Pose(pose::Args),
    /// List the graphics adapters.
    Adapters(adapters::Args),
    /// Compare with reference pictures of another renderer.
    #[command(hide = true)]
    CompareReferences(compare_references::Args),
    /// Compare with pictures of real assets by a path tracer.
    #[command(hide = true)]
    CompareReal(compare_real::Args),
}

fn main() {
    #[cfg(target_os = "linux")]
    session::ensure_runtime_folder();
    let program = Program::parse();
    let level = if program.verbose {
        tracing_subscriber::filter::LevelFilter::DEBUG
    } else {
        ERRORS_ONLY
    };
    tracing_subscriber::fmt()
        .with_max_level(level)
        .with_writer(anstream::stderr)
        .with_ansi(false)
        .without_time()
        .init();
    if let Some(seconds) = program.timeout {
        deadline::start(seconds);
    }
    // A panic is a fault of this program; the message stands above, and the status stays one of the documented four.
    let outcome = std::panic::catch_unwind(AssertUnwindSafe(|| run(program.command)))
        .unwrap_or_else(|_| Err(Failure::input("internal fault; please report it with the model")));
    let status = match outcome {
        Ok(()) => 0,
        Err(failure) => {
            failure.print();
            failure.status()
        }
    };
    // Does not wait for the driver's threads, which may hang after a fault.
    std::process::exit(status);
}

const ERRORS_ONLY: tracing_subscriber::filter::LevelFilter = tracing_subscriber::filter::LevelFilter::ERROR;

fn run(command: Command) -> Result<(), Failure> {
    match command {
        Command::Render(args) => render::run(&args),
        Command::Sheet(args) => sheet::run(&args),
        Command::Animate(args) => animate::run(&args),
        Command::Gallery(args) => gallery::run(&args),
        Command::Look(args) => look::run(&args),
        Command::Looks(args) => looks::run(&args),
        Command::Profile(args) => profile::run(&args),
        Command::Sdf(args) => sdf::run(&args),
        Command::Texture(args) => texture::run(&args),
        Command::Inspect(args) => inspect::run(&args),
        Command::Bench(args) => bench::run(&args),
        Command::Pose(args) => pose::run(&args),
        Command::Adapters(args) => adapters::run(&args),
        Command::CompareReferences(args) => compare_references::run(&args),
        Command::CompareReal(args) => compare_real::run(&args),
    }
}
