//! Writes `hikage.vrm` and her animation clips.

use std::path::PathBuf;

use clap::Parser;
use hikage_character::head::sdf;
use hikage_character::{clips, glb, vrma};

/// Writes the built-in character as a VRM 1.0 file.
#[derive(Parser)]
#[command(version)]
struct Args {
    /// File to write [default: hikage.vrm; none with --vrma alone].
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Put her animation clips into the file.
    #[arg(long)]
    clips: bool,
    /// Write each clip into this folder, as NAME.vrma.
    #[arg(long, value_name = "DIR")]
    vrma: Option<PathBuf>,
    /// Write her textures into this folder too, and the keys of her face's shadow with their source.
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
}

fn main() -> std::io::Result<()> {
    let args = Args::parse();
    if let Some(folder) = &args.vrma {
        std::fs::create_dir_all(folder)?;
        for clip in clips::all() {
            std::fs::write(folder.join(format!("{}.vrma", clip.name)), vrma::write(&clip))?;
        }
        if args.output.is_none() && args.textures.is_none() && !args.clips {
            return Ok(());
        }
    }
    let model = hikage_character::build();
    let output = args.output.unwrap_or_else(|| PathBuf::from("hikage.vrm"));
    let clips = if args.clips { clips::all() } else { Vec::new() };
    std::fs::write(output, glb::write(&model, &clips))?;
    if let Some(folder) = &args.textures {
        std::fs::create_dir_all(folder)?;
        for texture in &model.textures {
            std::fs::write(folder.join(format!("{}.png", texture.name)), (texture.paint)().png())?;
        }
        std::fs::write(folder.join("face.sdf.toml"), sdf::SOURCE)?;
    }
    Ok(())
}
