//! Writes `hikage.vrm`.

use std::path::PathBuf;

use clap::Parser;
use hikage_character::head::sdf;

/// Writes the built-in character as a VRM 1.0 file.
#[derive(Parser)]
#[command(version)]
struct Args {
    /// File to write.
    #[arg(short, long, default_value = "hikage.vrm")]
    output: PathBuf,
    /// Write her textures into this folder too, and the keys of her face's shadow with their source.
    #[arg(long, value_name = "DIR")]
    textures: Option<PathBuf>,
}

fn main() -> std::io::Result<()> {
    let args = Args::parse();
    let model = hikage_character::build();
    std::fs::write(&args.output, hikage_character::glb::write(&model))?;
    if let Some(folder) = &args.textures {
        std::fs::create_dir_all(folder)?;
        for texture in &model.textures {
            std::fs::write(folder.join(format!("{}.png", texture.name)), (texture.paint)().png())?;
        }
        std::fs::write(folder.join("face.sdf.toml"), sdf::SOURCE)?;
    }
    Ok(())
}
