//! `hikage sdf convert`, and reading finished maps.

use std::path::{Path, PathBuf};

use hikage::picture::write_atomic;
use hikage::sdf::{Depth, Layout, MaskFile, Profile, Sides};

use super::input::{bits, profile};
use crate::failure::{Failure, warn};
use crate::render::png_path;

/// A finished map and how it is to be read.
#[derive(clap::Args)]
pub(super) struct Map {
    /// Threshold map, PNG.
    map: PathBuf,
    /// Its channels [default: liltoon, single for a grey picture].
    #[arg(long, value_name = "LAYOUT")]
    from_layout: Option<Layout>,
    /// What its shader compares with [default: linear].
    #[arg(long, value_name = "PROFILE", value_parser = profile)]
    from_profile: Option<Profile>,
}

impl Map {
    pub(super) fn read(&self) -> Result<(Sides, Layout), Failure> {
        let texels = hikage::import::image::load_texels(&self.map)?;
        if tagged_srgb(&self.map) {
            warn(&format!(
                "{}: is tagged sRGB, though a map holds plain numbers; engines that obey the tag bend its thresholds \
                 (`hikage sdf convert` writes it tagged linear)",
                self.map.display()
            ));
        }
        let is_grey = texels.rgba.iter().all(|[r, g, b, a]| r == g && g == b && *a == u16::MAX);
        let layout = self.from_layout.clone().unwrap_or(if is_grey { Layout::Single } else { Layout::Liltoon });
        let sides = Sides::from_texels(&texels, &layout, &self.from_profile.clone().unwrap_or_default())?;
        Ok((sides, layout))
    }
}

/// Whether a PNG says before its pixels that it is sRGB, or has a gamma other than 1.
fn tagged_srgb(path: &Path) -> bool {
    let Ok(bytes) = std::fs::read(path) else { return false };
    let mut rest = bytes.get(8..).unwrap_or_default();
    while let (Some((length, _)), Some(name)) = (rest.split_first_chunk::<4>(), rest.get(4..8)) {
        let length = u32::from_be_bytes(*length) as usize;
        match name {
            b"sRGB" => return true,
            b"gAMA" => return rest.get(8..12) != Some(&100_000u32.to_be_bytes()[..]),
            b"IDAT" => return false,
            _ => {}
        }
        rest = rest.get(length.saturating_add(12)..).unwrap_or_default();
    }
    false
}

/// Arguments of `hikage sdf convert`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    map: Map,
    /// Map to write; its folder must exist.
    #[arg(short, long, value_name = "MAP.png", value_parser = png_path)]
    output: PathBuf,
    /// Channels: liltoon, single, or four of left, right, a number and a grey picture, as left,right,area.png,1 [default:
    /// those that it has].
    #[arg(long, value_name = "LAYOUT")]
    layout: Option<Layout>,
    /// What the shader compares with [default: what it has].
    #[arg(long, value_name = "PROFILE", value_parser = profile)]
    profile: Option<Profile>,
    /// Bits of a value [default: what it has].
    #[arg(long, value_name = "8|16", value_parser = bits)]
    bits: Option<u8>,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let (sides, own) = args.map.read()?;
    let depth = match args.bits {
        Some(8) => Depth::Eight,
        Some(_) => Depth::Sixteen,
        None => sides.left.depth,
    };
    let profile = args.profile.clone().unwrap_or_else(|| sides.left.profile.clone());
    let convert = |map: &hikage::sdf::ThresholdMap| map.converted(&profile, depth);
    let sides = Sides { left: convert(&sides.left), right: sides.right.as_ref().map(convert) };
    let layout = args.layout.clone().unwrap_or(own);
    let png = sides.encode(&layout, |file| MaskFile::new(file).load())?;
    write_atomic(&args.output, &png)?;
    Ok(())
}
