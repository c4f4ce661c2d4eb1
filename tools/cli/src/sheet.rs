//! `hikage sheet`: one picture of a character from all sides, with every expression, or over a sweep of light, head or
//! camera.

use std::path::PathBuf;

use glam::{Quat, Vec3};
use hikage::motion::{Pose, Stance};
use hikage::picture::{encode_png, write_atomic};
use hikage::scene::{Framing, HumanBone, Image, Scene};
use hikage::{Actor, Background, Output, Renderer, Stage, View, color::Srgb};
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
    #[arg(long, value_name = "plain|anime|natural|FILE.look.toml", value_parser = args::look, help = args::LOOK_HELP)]
    look: Option<LookName>,
    /// Shows the face over a sweep instead: the light all round at four heights, the head from side to side, or the camera
    /// from 0.5 to 10 m with the face as large.
    #[arg(long, value_enum, value_name = "light|head|distance", hide_possible_values = true)]
    sweep: Option<Sweep>,
    /// Width of one panel, pixels [default: 384; 160 in a sweep].
    #[arg(long, value_name = "PIXELS", value_parser = clap::value_parser!(u32).range(64..=1024))]
    panel: Option<u32>,
    /// Adapter, by a part of its name (`hikage adapters`).
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// `--sweep`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Sweep {
    /// Light from -180 to 180 degrees in steps of 15, at -30, 0, 30 and 60 degrees of height.
    Light,
    /// Head from -90 to 90 degrees in steps of 15.
    Head,
    /// Camera at 0.5 to 10 m.
    Distance,
}

/// Panels in a line, of the sheet and of a sweep.
const COLUMNS: usize = 4;
const SWEEP_COLUMNS: usize = 13;
/// Space between panels, and height of the line under each, pixels.
pub(crate) const GAP: u32 = 8;
pub(crate) const LINE: u32 = 24;
const PAPER: [u8; 3] = [0xf4, 0xf5, 0xf7];
const INK: [u8; 3] = [0x30, 0x34, 0x3c];
pub(crate) const BEHIND: Srgb = Srgb([0xdf, 0xe7, 0xee]);

/// One panel.
struct Panel {
    caption: String,
    framing: Framing,
    yaw_deg: f32,
    stance: Stance,
    expression: Option<String>,
    /// Angles of the light, degrees; that of the look where `None`.
    light_deg: Option<[f32; 2]>,
    /// Turn of the head to the character's left.
    head_deg: f32,
    /// Distance of the camera, the face staying as large.
    distance_m: Option<f32>,
}

impl Default for Panel {
    fn default() -> Self {
        Self {
            caption: String::new(),
            framing: Framing::Face,
            yaw_deg: 0.0,
            stance: Stance::Rest,
            expression: None,
            light_deg: None,
            head_deg: 0.0,
            distance_m: None,
        }
    }
}

/// What a sweep shows.
fn sweep_rows(sweep: Sweep) -> Vec<Rows> {
    let degrees = |from: i32, to: i32| (from..=to).step_by(15).map(|d| d as f32);
    let row = |panels: Vec<Panel>| Rows { aspect: 1.0, panels };
    match sweep {
        Sweep::Light => [-30.0, 0.0, 30.0, 60.0]
            .map(|pitch| {
                let panel = |yaw: f32| Panel {
                    caption: format!("{yaw:.0}, {pitch:.0}"),
                    light_deg: Some([yaw, pitch]),
                    ..Panel::default()
                };
                row(degrees(-180, 180).map(panel).collect())
            })
            .into(),
        Sweep::Head => {
            let panel = |turn: f32| Panel { caption: format!("head {turn:.0}"), head_deg: turn, ..Panel::default() };
            vec![row(degrees(-90, 90).map(panel).collect())]
        }
        Sweep::Distance => {
            let panel = |metres: f32| Panel {
                caption: format!("{metres} m"),
                distance_m: Some(metres),
                yaw_deg: 20.0,
                ..Panel::default()
            };
            vec![row([0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0].map(panel).into())]
        }
    }
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
            ..Panel::default()
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
    let panel = |name: String| Panel { caption: name.clone(), expression: Some(name), ..Panel::default() };
    rows.push(Rows { aspect: 1.0, panels: names.map(panel).collect() });
    rows
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let spinner = Spinner::new();
    spinner.step("loading the model");
    let mut scene = setup::load(args.model.as_deref())?;
    setup::apply_look(args.look.as_ref(), args.model.as_deref(), &mut scene)?;
    let (rows, columns, panel) = match args.sweep {
        Some(sweep) => (sweep_rows(sweep), SWEEP_COLUMNS, args.panel.unwrap_or(160)),
        None => (rows(&scene), COLUMNS, args.panel.unwrap_or(384)),
    };
    spinner.step("making pipelines");
    let gpu = setup::gpu(args.adapter.as_deref())?;
    let renderer = Renderer::with_output(&gpu, Output::default())?;
    let mut stage = Stage::of([Actor::new(&renderer.upload_and_empty_images(&mut scene)?)]);
    let lights = stage.lights.clone();

    let panel_height = |row: &Rows| (panel as f32 * row.aspect).round() as u32;
    let lines = |row: &Rows| row.panels.len().div_ceil(columns) as u32;
    let height = GAP + rows.iter().map(|r| lines(r) * (panel_height(r) + LINE + GAP)).sum::<u32>();
    let mut sheet = paper(columns as u32 * (panel + GAP) + GAP, height);
    let (count, mut done, mut top) = (rows.iter().map(|r| r.panels.len()).sum::<usize>(), 0, GAP);
    for row in &rows {
        let size = [panel, panel_height(row)];
        for line in row.panels.chunks(columns) {
            for (column, shown) in line.iter().enumerate() {
                done += 1;
                spinner.step(format!("{done} of {count}: {}", shown.caption));
                let expressions: Vec<(String, f32)> = shown.expression.iter().map(|e| (e.clone(), 1.0)).collect();
                let mut pose = setup::pose(&scene, shown.stance, &expressions)?;
                let view = view(&scene, shown, &pose, size);
                if let Some(head) = scene.bone_node(HumanBone::Head) {
                    let turn = Quat::from_rotation_y(shown.head_deg.to_radians());
                    pose.locals[head].rotation *= turn;
                }
                stage.actors[0].pose = pose;
                stage.lights.clone_from(&lights);
                if let Some(degrees) = shown.light_deg {
                    stage.lights.directional.to_light = setup::to_light(degrees);
                }
                let picture = renderer.render(&mut stage, &view)?;
                let left = GAP + column as u32 * (panel + GAP);
                place(&mut sheet, &picture, left, top);
                write(&mut sheet, &shown.caption, left, top + size[1] + 4);
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

/// The view of a panel, of the pose before its head turns.
fn view(scene: &Scene, shown: &Panel, pose: &Pose, size: [u32; 2]) -> View {
    let framed = View::framed_pose(scene, pose, shown.framing, shown.yaw_deg.to_radians(), size);
    let mut view = View { background: Background::Color(BEHIND), ..framed };
    if let Some(metres) = shown.distance_m {
        let camera = &mut view.camera;
        let away = camera.eye - camera.target;
        let half_height = away.length() * (camera.fov_y_rad * 0.5).tan();
        camera.eye = camera.target + away.normalize_or(Vec3::Z) * metres;
        camera.fov_y_rad = 2.0 * (half_height / metres).atan();
    }
    view
}

pub(crate) fn paper(width: u32, height: u32) -> Image {
    let [r, g, b] = PAPER;
    let pixels = [r, g, b, 255].repeat(width as usize * height as usize);
    Image { width, height, pixels, format: "png", source_bits: 8, ..Image::default() }
}

/// Copies a picture onto the sheet.
pub(crate) fn place(sheet: &mut Image, picture: &Image, left: u32, top: u32) {
    let (stride, width) = (sheet.width as usize * 4, picture.width as usize * 4);
    for (y, line) in picture.pixels.chunks_exact(width).enumerate() {
        let at = (top as usize + y) * stride + left as usize * 4;
        sheet.pixels[at..at + width].copy_from_slice(line);
    }
}

/// Writes one line, as far as the sheet is wide. Characters that the font lacks are shown as `?`.
pub(crate) fn write(sheet: &mut Image, text: &str, left: u32, top: u32) {
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
