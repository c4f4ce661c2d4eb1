//! `hikage sdf check`.

use std::path::PathBuf;

use hikage::picture::write_png;
use hikage::scene::Image;
use hikage::sdf::{Baked, BakedSides, check};

use super::input::Input;
use crate::failure::Failure;
use crate::output::print;
use crate::render::png_path;

/// Arguments of `hikage sdf check`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    input: Input,
    /// Draw the map in grey, and red where keys contradict each other; beside it, on the left, that of light from the
    /// right where it has keys of its own.
    #[arg(short, long, value_name = "PICTURE.png", value_parser = png_path)]
    output: Option<PathBuf>,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let project = args.input.project()?;
    let baked = project.bake(true)?;
    let remarks = check(&project, &baked)?;
    if let Some(output) = &args.output {
        write_png(output, &drawn(&baked))?;
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

/// The maps in grey, that of light from the right first where it has keys of its own, with what contradicts in red.
fn drawn(baked: &BakedSides) -> Image {
    let sides: Vec<&Baked> = baked.right.iter().chain([&baked.left]).collect();
    let (width, height) = (baked.left.map.width as usize, baked.left.map.height as usize);
    let stride = width * sides.len();
    let mut pixels = vec![[0, 0, 0, 255]; stride * height];
    for (side, Baked { map, wrong, .. }) in sides.into_iter().enumerate() {
        let at = |i: usize| i / width * stride + side * width + i % width;
        for (i, code) in map.codes.iter().enumerate() {
            let grey = (u32::from(*code) * 255 / u32::from(map.depth.max())) as u8;
            pixels[at(i)] = [grey, grey, grey, 255];
        }
        for i in wrong {
            pixels[at(*i as usize)] = [255, 40, 40, 255];
        }
    }
    Image { width: stride as u32, height: height as u32, pixels: pixels.into_flattened(), ..Image::default() }
}
