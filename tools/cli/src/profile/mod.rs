//! `hikage profile`: diffusion profiles, how light scatters below a surface. Needs no GPU.

mod preview;

use std::path::PathBuf;

use hikage::ProfileFile;
use hikage::picture::write_png;
use hikage::skin::DiffusionProfile;
use serde::Serialize;

use crate::failure::Failure;
use crate::output::{Table, heading, print, print_json};
use crate::render::png_path;

/// Arguments of `hikage profile`.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  hikage profile list
  hikage profile show jade -o jade.png
  hikage profile show ear.profile.toml

A look file refers to a profile by `skin = { profile = \"jade\" }`, or to a file beside it by
`skin = { profile = \"ear.profile.toml\" }`. Keys of such a file: `hikage looks skin`, below profile.")]
pub(crate) struct Args {
    #[command(subcommand)]
    command: Command,
}

#[derive(clap::Subcommand)]
enum Command {
    /// Tell the numbers of a profile, and draw what it does to light.
    Show(Show),
    /// List the profiles that have a name.
    List(List),
}

#[derive(clap::Args)]
struct Show {
    /// Profile file (NAME.profile.toml), or the name of a profile (`hikage profile list`).
    #[arg(value_name = "FILE|NAME")]
    profile: String,
    /// Picture to write: light round a point, light through a slab, and the curves of both; its folder must exist.
    #[arg(short, long, value_name = "OUT.png", value_parser = png_path)]
    output: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

#[derive(clap::Args)]
struct List {
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// A profile with what follows from its numbers.
#[derive(Serialize)]
struct Shown {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    doc: Option<&'static str>,
    /// Radius that holds nearly all of the light, mm.
    max_radius_mm: f32,
    /// Share that is mirrored straight on.
    f0: f32,
    profile: DiffusionProfile,
}

impl Shown {
    fn of(name: String, doc: Option<&'static str>, profile: DiffusionProfile) -> Self {
        Self { name, doc, max_radius_mm: profile.max_radius_mm(), f0: profile.f0(), profile }
    }
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    match &args.command {
        Command::Show(args) => show(args),
        Command::List(args) => list(args),
    }
}

fn show(args: &Show) -> Result<(), Failure> {
    let ProfileFile { name, profile } = profile(&args.profile)?;
    if let Some(output) = &args.output {
        write_png(output, &preview::draw(&name, &profile))?;
    }
    let shown = Shown::of(name, None, profile);
    if args.json {
        return print_json(&shown);
    }
    let radius = digits(shown.max_radius_mm);
    let mut text = heading(&shown.name);
    text += &format!("  d                    {} mm (red, green, blue)\n", distances(&profile));
    text += &format!("  largest radius       {radius} mm\n");
    text += &format!("  index of refraction  {} (mirrors {} straight on)\n", profile.ior, digits(shown.f0));
    print(&text)
}

/// The profile of a name, or that of a file.
fn profile(name: &str) -> Result<ProfileFile, Failure> {
    if name.ends_with(".toml") {
        return Ok(ProfileFile::read(name)?);
    }
    let known = || DiffusionProfile::presets().map(|p| p.name).join(", ");
    let none = || {
        Failure::input(format!("there is no profile {name:?}; there are: {}; or name a .profile.toml file", known()))
    };
    Ok(ProfileFile { name: name.to_owned(), profile: DiffusionProfile::named(name).ok_or_else(none)? })
}

fn list(args: &List) -> Result<(), Failure> {
    let all = DiffusionProfile::presets().map(|p| Shown::of(p.name.to_owned(), Some(p.doc), p.profile));
    if args.json {
        return print_json(&all);
    }
    let mut table = Table::new(&["name", "d, mm", "largest radius, mm", "ior", ""]);
    for of in &all {
        let doc = of.doc.unwrap_or_default().trim_end_matches('.');
        let ior = of.profile.ior.to_string();
        table.row([of.name.clone(), distances(&of.profile), digits(of.max_radius_mm), ior, doc.to_owned()]);
    }
    print(&table.text())
}

/// Burley's d of the three colours.
fn distances(profile: &DiffusionProfile) -> String {
    profile.scattering_distance_mm.map(digits).join(" ")
}

/// A positive number with three digits that count.
fn digits(x: f32) -> String {
    let before = if x > 0.0 { x.log10().floor() as i32 + 1 } else { 1 };
    format!("{x:.*}", usize::try_from(3 - before).unwrap_or(0).min(6))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_three_digits_that_count() {
        assert_eq!(
            [0.757, 7.834, 15.2, 1000.0, 0.001, 0.0].map(digits),
            ["0.757", "7.83", "15.2", "1000", "0.00100", "0.00"]
        );
    }
}
