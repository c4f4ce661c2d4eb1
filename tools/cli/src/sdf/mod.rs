//! `hikage sdf`: threshold maps of painted face shadows. Needs no GPU but for the preview.

mod bake;
mod check;
mod convert;
mod input;
mod new;
mod preview;
mod unpack;
mod watch;

use crate::failure::Failure;

/// Arguments of `hikage sdf`.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  hikage sdf new face --from girl.vrm                  a folder with key drawings made from her mesh, to paint over
  hikage sdf bake face/face.sdf.toml -o face.png       the map for lilToon's channels
  hikage sdf bake --key 0=a.png --key 90=b.png --key 180=c.png --mirror -o face.png --profile liltoon
  hikage sdf check face/face.sdf.toml                  contradictions between keys, seams, coarse steps
  hikage sdf preview face/face.sdf.toml girl.vrm -o sheet.png
  hikage sdf watch face/face.sdf.toml -o face.png      bakes whenever a drawing is saved

Angles are degrees from the front of the face towards the character's left, where light turns the right half of the face in
the picture bright; 0 is in front, 180 behind. Negative angles are for light from her right.")]
pub(crate) struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand)]
enum Command {
    /// Make a folder to start from: a project and its key drawings.
    New(new::Args),
    /// Bake key drawings into a threshold map.
    Bake(bake::Args),
    /// Tell where keys contradict each other, and what will look wrong.
    Check(check::Args),
    /// Take the mask at any angle out of a finished map.
    Unpack(unpack::Args),
    /// Change channels, bits or the measure of a finished map.
    Convert(convert::Args),
    /// Draw a face under a sweep of the light, beside the flat masks.
    Preview(preview::Args),
    /// Bake again whenever a drawing is saved.
    Watch(watch::Args),
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    match &args.command {
        Command::New(args) => new::run(args),
        Command::Bake(args) => bake::run(args),
        Command::Check(args) => check::run(args),
        Command::Unpack(args) => unpack::run(args),
        Command::Convert(args) => convert::run(args),
        Command::Preview(args) => preview::run(args),
        Command::Watch(args) => watch::run(args),
    }
}
