//! `hikage sdf unpack`.

use std::path::PathBuf;

use hikage::picture::write_png;
use hikage::scene::Image;
use hikage::sdf::Mask;

use super::convert::Map;
use crate::failure::Failure;
use crate::output::make_folder;

/// Arguments of `hikage sdf unpack`.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    map: Map,
    /// Angles of the light, degrees; negative for light from the right.
    #[arg(long, value_name = "ANGLE,...", value_delimiter = ',', allow_hyphen_values = true, required = true, value_parser = angle)]
    angles: Vec<f32>,
    /// Folder for the masks, which are named by their angles (022.5.png).
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
}

fn angle(text: &str) -> Result<f32, String> {
    let angle = text.trim().parse().ok().filter(|a| (-180.0..=180.0).contains(a));
    angle.ok_or_else(|| "expected degrees from -180 to 180".into())
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let (sides, _) = args.map.read()?;
    make_folder(&args.output)?;
    for &angle in &args.angles {
        let side = match (&sides.right, angle < 0.0) {
            (_, false) => sides.left.clone(),
            (Some(right), true) => right.clone(),
            (None, true) => sides.left.flipped(),
        };
        write_png(args.output.join(file_name(angle)), &picture(&side.mask(angle.abs().to_radians())))?;
    }
    Ok(())
}

/// A name that sorts by angle: `-045.png`, `022.5.png`.
pub(super) fn file_name(angle: f32) -> String {
    let whole = angle.abs().trunc();
    let rest = (angle.abs() - whole).to_string();
    format!("{}{whole:03}{}.png", if angle < 0.0 { "-" } else { "" }, rest.trim_start_matches('0'))
}

/// A mask in grey.
pub(super) fn picture(mask: &Mask) -> Image {
    let pixels = mask.coverage.iter().flat_map(|c| [*c, *c, *c, 255]).collect();
    Image { width: mask.width, height: mask.height, pixels, ..Image::default() }
}

#[cfg(test)]
mod tests {
    use super::file_name;

    #[test]
    fn names_sort_by_angle() {
        assert_eq!([0.0, 22.5, -45.0, 180.0].map(file_name), ["000.png", "022.5.png", "-045.png", "180.png"]);
    }
}
