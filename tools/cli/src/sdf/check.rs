//! `hikage sdf check`.

use std::path::PathBuf;

use hikage::picture::write_png;
use hikage::scene::Image;
use hikage::sdf::check;

use super::input::Input;
use crate::failure::Failure;
use crate::output::print;
use crate::render::png_path;

/// Arguments of `hikage sdf check`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    input: Input,
    /// Draw the map of light from the left in grey, and red where keys contradict each other.
    #[arg(short, long, value_name = "PICTURE.png", value_parser = png_path)]
    output: Option<PathBuf>,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let project = args.input.project()?;
    let baked = project.bake(true)?;
    let remarks = check(&project, &baked)?;
    if let Some(output) = &args.output {
        let map = &baked.left.map;
        let grey = |code: &u16| (u32::from(*code) * 255 / u32::from(map.depth.max())) as u8;
        let mut pixels: Vec<[u8; 4]> = map.codes.iter().map(grey).map(|g| [g, g, g, 255]).collect();
        for i in &baked.left.wrong {
            pixels[*i as usize] = [255, 40, 40, 255];
        }
        let pixels = pixels.into_flattened();
        write_png(output, &Image { width: map.width, height: map.height, pixels, ..Image::default() })?;
    }
    for remark in &remarks {
        print(&format!("{}: {}\n", if remark.is_fault { "fault" } else { "hint" }, remark.message))?;
    }
    let faults = remarks.iter().filter(|r| r.is_fault).count();
    if faults > 0 {
        return Err(Failure::input(format!("{faults} contradictions between keys")));
    }
    if remarks.is_empty() {
        print("nothing to remark\n")?;
    }
    Ok(())
}
