//! `hikage inspect`: what a file holds, without a GPU.

mod checks;
mod memory;
mod model;
mod text;

use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use hikage::import::{image, load};
use hikage::scene::Scene;
use serde::Serialize;

use crate::args::LookName;
use crate::failure::Failure;
use crate::output::{print, print_json};
use crate::setup::{self, read_small};

/// Arguments of `hikage inspect`.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  hikage inspect girl.vrm
  hikage inspect girl.vrm --json | jq .materials
  hikage inspect mask.png
  hikage inspect effect.wgsl
  hikage inspect girl.vrm --look anime --wgsl Face

The ending of the name decides what a file is; without a known one, its first bytes do.")]
pub(crate) struct Args {
    /// Model or clips (.vrm, .glb, .gltf, .vrma), image (.png, .jpg, .webp) or shader (.wgsl).
    file: PathBuf,
    /// Print JSON.
    #[arg(long)]
    json: bool,
    /// Print the shaders of a material, by its name: the generated page, then the text of each pass.
    #[arg(long, value_name = "MATERIAL", conflicts_with = "json")]
    wgsl: Option<String>,
    /// With --wgsl: plain, anime or a look file.
    #[arg(long, value_name = "plain|anime|natural|FILE.look.toml", value_parser = crate::args::look, requires = "wgsl")]
    look: Option<LookName>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Model,
    Image,
    Shader,
}

#[derive(Serialize)]
struct ImageSummary {
    kind: &'static str,
    file: String,
    format: &'static str,
    width: u32,
    height: u32,
    bits: u8,
}

#[derive(Serialize)]
struct ShaderSummary {
    kind: &'static str,
    file: String,
    entry_points: Vec<String>,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let path = &args.file;
    match kind(path)? {
        Kind::Model if args.wgsl.is_some() => {
            let mut scene = load(path)?;
            setup::apply_look(args.look.as_ref(), Some(path), &mut scene)?;
            print(&shaders(&scene, args.wgsl.as_deref().unwrap_or_default())?)
        }
        Kind::Model => {
            let scene = load(path)?;
            let bytes = std::fs::metadata(path).map(|m| m.len()).unwrap_or(0);
            let summary = model::summarize(&scene, bytes);
            if args.json {
                print_json(&summary)
            } else {
                print(&text::model(&summary))
            }
        }
        Kind::Image => {
            let found = image::load(path)?;
            let summary = ImageSummary {
                kind: "image",
                file: path.display().to_string(),
                format: found.format,
                width: found.width,
                height: found.height,
                bits: found.source_bits,
            };
            if args.json {
                return print_json(&summary);
            }
            let ImageSummary { format, width, height, bits, .. } = summary;
            print(&format!("{format}, {width} x {height} pixels, {bits} bits a channel\n"))
        }
        Kind::Shader => {
            let file = path.display().to_string();
            let found = hikage::shaders::check(&file, &read_small(path)?)?;
            let summary = ShaderSummary { kind: "shader", file, entry_points: found.entry_points };
            if args.json {
                return print_json(&summary);
            }
            let names = summary.entry_points.iter().map(|n| crate::failure::printable(n)).collect::<Vec<_>>();
            print(&format!(
                "valid WGSL, entry points: {}\n",
                if names.is_empty() {
                    "none".into()
                } else {
                    names.join(", ")
                }
            ))
        }
    }
}

/// What draws a material, as the driver gets it.
fn shaders(scene: &Scene, name: &str) -> Result<String, Failure> {
    let Some(material) = scene.materials.iter().position(|m| m.name == name) else {
        let names: Vec<&str> = scene.materials.iter().map(|m| m.name.as_str()).collect();
        return Err(Failure::input(format!("there is no material {name:?}; there are: {}", names.join(", "))));
    };
    let mut text = String::new();
    for shader in hikage::shaders::of_material(scene, material)? {
        text.push_str(&format!("// ==== pass {}: its page\n\n{}\n", shader.pass, shader.page));
        text.push_str(&format!("// ==== pass {}: the whole text, {} bytes\n\n", shader.pass, shader.text.len()));
        text.push_str(&shader.text);
        text.push('\n');
    }
    Ok(text)
}

fn kind(path: &Path) -> Result<Kind, Failure> {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    match ending.as_str() {
        "vrm" | "glb" | "gltf" | "vrma" => return Ok(Kind::Model),
        "png" | "jpg" | "jpeg" | "webp" => return Ok(Kind::Image),
        "wgsl" => return Ok(Kind::Shader),
        _ => {}
    }
    let fail = |what: &dyn std::fmt::Display| Failure::input(format!("{}: {what}", path.display()));
    let metadata = std::fs::metadata(path).map_err(|e| fail(&e))?;
    // Opening a pipe would wait for ever.
    if !metadata.is_file() {
        return Err(fail(&"is not a regular file"));
    }
    let mut start = Vec::new();
    File::open(path).and_then(|f| f.take(12).read_to_end(&mut start)).map_err(|e| fail(&e))?;
    let is_image = start.starts_with(b"\x89PNG")
        || start.starts_with(b"\xff\xd8\xff")
        || (start.starts_with(b"RIFF") && start.ends_with(b"WEBP"));
    Ok(if is_image { Kind::Image } else { Kind::Model })
}
