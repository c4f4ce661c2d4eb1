//! `hikage sheet`: one picture of a character from all sides, with every expression.

use std::path::PathBuf;

use hikage::motion::Stance;
use hikage::picture::{encode_png, write_atomic};
use hikage::scene::{Framing, Image, Scene};
use hikage::{Background, Output, Renderer, View, color::Srgb};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster};

use crate::args::{self, LookName};
use crate::failure::Failure;
use crate::render::png_path;
use crate::spinner::Spinner;
use crate::{deadline, setup};

/// Arguments of `hikage sheet`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Model: .vrm, .glb or .gltf [default: the built-in character].
    model: Option<PathBuf>,
    /// Picture to write; its folder must exist.
    #[arg(short, long, value_name = "OUT.png", value_parser = png_path)]
    output: PathBuf,
    /// What is made of the model: plain as in the file, an anime head, or what a look file says [default: the look file
    /// beside the model (girl.look.toml beside girl.vrm), else plain].
    #[arg(long, value_name = "plain|anime|FILE.look.toml", value_parser = args::look)]
    look: Option<LookName>,
    /// Width of one panel, pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 384, value_parser = clap::value_parser!(u32).range(64..=1024))]
    panel: u32,
    /// Adapter, by a part of its name (`hikage adapters`).
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// Panels in a row.
const COLUMNS: usize = 4;
/// Space between panels, and height of the line under each, pixels.
const GAP: u32 = 8;
const LINE: u32 = 24;
const PAPER: [u8; 3] = [0xf4, 0xf5, 0xf7];
const INK: [u8; 3] = [0x30, 0x34, 0x3c];
const BEHIND: Srgb = Srgb([0xdf, 0xe7, 0xee]);

/// One panel.
struct Panel {
    caption: String,
    framing: Framing,
    yaw_deg: f32,
    stance: Stance,
    expression: Option<String>,
}

/// Panels of the same shape, four in a row.
struct Rows {
    /// Height over width.
    aspect: f32,
    panels: Vec<Panel>,
}

/// What the sheet shows of a scene.
fn rows(scene: &Scene) -> Vec<Rows> {
    let has_bones = scene.character.as_ref().is_some_and(|c| !c.bones.is_empty());
    let at_ease = if has_bones { Stance::Relaxed } else { Stance::Rest };
    let turns = [("front", 0.0), ("three-quarter", 35.0), ("profile", 90.0), ("back", 180.0)];
    let around = |what: &str, framing: Framing, stance: Stance| -> Vec<Panel> {
        let panel = |(turn, yaw_deg): (&str, f32)| Panel {
            caption: format!("{what}, {turn}"),
            framing,
            yaw_deg,
            stance,
            expression: None,
        };
        turns.into_iter().map(panel).collect()
    };
    let mut rows = vec![
        Rows { aspect: 1.0, panels: around("portrait", Framing::Portrait, at_ease) },
        Rows { aspect: 1.75, panels: around("whole", Framing::Full, at_ease) },
    ];
    if has_bones {
        rows.push(Rows { aspect: 1.25, panels: around("joints at 90\u{b0}", Framing::Full, Stance::Bend) });
    }
    let names = scene.character.iter().flat_map(|c| &c.expressions).map(|e| e.name.clone());
    let panel = |name: String| Panel {
        caption: name.clone(),
        framing: Framing::Face,
        yaw_deg: 0.0,
        stance: Stance::Rest,
        expression: Some(name),
    };
    rows.push(Rows { aspect: 1.0, panels: names.map(panel).collect() });
    rows
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let spinner = Spinner::new();
    spinner.step("loading the model");
    let mut scene = setup::load(args.model.as_deref())?;
    setup::apply_look(args.look.as_ref(), args.model.as_deref(), &mut scene)?;
    let rows = rows(&scene);
    spinner.step("making pipelines");
    let gpu = setup::gpu(args.adapter.as_deref())?;
    let mut renderer = Renderer::with_output(&gpu, Output::default())?;
    let mut gpu_scene = renderer.upload_and_empty_images(&mut scene)?;

    let panel_height = |row: &Rows| (args.panel as f32 * row.aspect).round() as u32;
    let lines = |row: &Rows| row.panels.len().div_ceil(COLUMNS) as u32;
    let height = GAP + rows.iter().map(|r| lines(r) * (panel_height(r) + LINE + GAP)).sum::<u32>();
    let mut sheet = paper(COLUMNS as u32 * (args.panel + GAP) + GAP, height);
    let (count, mut done, mut top) = (rows.iter().map(|r| r.panels.len()).sum::<usize>(), 0, GAP);
    for row in &rows {
        let size = [args.panel, panel_height(row)];
        for line in row.panels.chunks(COLUMNS) {
            for (column, panel) in line.iter().enumerate() {
                done += 1;
                spinner.step(format!("{done} of {count}: {}", panel.caption));
                let expressions: Vec<(String, f32)> = panel.expression.iter().map(|e| (e.clone(), 1.0)).collect();
                let pose = setup::pose(&scene, panel.stance, &expressions)?;
                gpu_scene.set_pose(&gpu, &scene, &pose);
                let framed = View::framed_pose(&scene, &pose, panel.framing, panel.yaw_deg.to_radians(), size);
                let view = View { background: Background::Color(BEHIND), ..framed };
                let picture = renderer.render(&mut gpu_scene, &view)?;
                let left = GAP + column as u32 * (args.panel + GAP);
                place(&mut sheet, &picture, left, top);
                write(&mut sheet, &panel.caption, left, top + size[1] + 4);
            }
            top += size[1] + LINE + GAP;
        }
    }
    let png = encode_png(&sheet)?;
    drop(spinner);
    deadline::stop();
    write_atomic(&args.output, &png)?;
    Ok(())
}

fn paper(width: u32, height: u32) -> Image {
    let [r, g, b] = PAPER;
    let pixels = [r, g, b, 255].repeat(width as usize * height as usize);
    Image { width, height, pixels, format: "png", source_bits: 8, ..Image::default() }
}

/// Copies a picture onto the sheet.
fn place(sheet: &mut Image, picture: &Image, left: u32, top: u32) {
    let (stride, width) = (sheet.width as usize * 4, picture.width as usize * 4);
    for (y, line) in picture.pixels.chunks_exact(width).enumerate() {
        let at = (top as usize + y) * stride + left as usize * 4;
        sheet.pixels[at..at + width].copy_from_slice(line);
    }
}

/// Writes one line, as far as the sheet is wide. Characters that the font lacks are shown as `?`.
fn write(sheet: &mut Image, text: &str, left: u32, top: u32) {
    let glyph = |c| get_raster(c, FontWeight::Regular, RasterHeight::Size16);
    let mut left = left as usize;
    for raster in text.chars().filter_map(|c| glyph(c).or_else(|| glyph('?'))) {
        if left + raster.width() > sheet.width as usize {
            break;
        }
        for (y, line) in raster.rows().enumerate() {
            for (x, cover) in line.iter().enumerate() {
                let at = ((top as usize + y) * sheet.width as usize + left + x) * 4;
                for (channel, ink) in sheet.pixels[at..at + 3].iter_mut().zip(INK) {
                    let (under, ink, cover) = (u32::from(*channel), u32::from(ink), u32::from(*cover));
                    *channel = ((under * (255 - cover) + ink * cover) / 255) as u8;
                }
            }
        }
        left += raster.width();
    }
}
