//! `hikage texture`: maps for looks, painted by rule. Needs no GPU.

mod fur;

use crate::failure::Failure;

/// Arguments of `hikage texture`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand)]
enum Command {
    /// Fur: colours, and detail normals of the same strands.
    Fur(fur::Args),
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    match &args.command {
        Command::Fur(args) => fur::run(args),
    }
}
