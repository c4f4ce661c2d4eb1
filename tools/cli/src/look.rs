//! `hikage look`: a look file to start from.

use std::path::PathBuf;

use hikage::picture::write_atomic;
use hikage::{Anime, Look, LookFile};

use crate::failure::Failure;
use crate::setup;

/// Arguments of `hikage look`.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  hikage look girl.vrm -o girl.look.toml
  hikage render girl.vrm -o girl.png          (uses girl.look.toml beside it)

The file holds the anime look of this model with every number. Keep what you change and delete the rest: what a look
file does not name stays as it is. Names and units: the documentation of hikage::LookFile.")]
pub(crate) struct Args {
    /// Model: .vrm, .glb or .gltf [default: the built-in character].
    model: Option<PathBuf>,
    /// Look file to write; its folder must exist.
    #[arg(short, long, value_name = "NAME.look.toml", value_parser = toml_path)]
    output: PathBuf,
}

fn toml_path(text: &str) -> Result<PathBuf, String> {
    if text.ends_with(".toml") {
        Ok(text.into())
    } else {
        Err("expected a name that ends in .toml".into())
    }
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let mut scene = setup::load(args.model.as_deref())?;
    Look::Anime(Anime::default()).apply(&mut scene);
    write_atomic(&args.output, LookFile::template(&scene).as_bytes())?;
    Ok(())
}
