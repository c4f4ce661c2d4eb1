//! `hikage sdf preview`: the map on a face, under a sweep of the light, beside the flat masks.

use std::path::PathBuf;

use glam::Vec3;
use hikage::picture::{encode_png, write_atomic};
use hikage::render::Output;
use hikage::scene::{Framing, Image, Scene};
use hikage::sdf::{Mask, Project, ProjectKey, Sides};
use hikage::{Anime, Background, Gpu, Look, Renderer, View, motion::Stance};

use crate::animation::{Animation, Kind};
use crate::failure::{Failure, warn};
use crate::sheet::{BEHIND, GAP, LINE, paper, place, write};
use crate::spinner::Spinner;
use crate::{deadline, setup};

/// Arguments of `hikage sdf preview`.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Project (face.sdf.toml).
    project: PathBuf,
    /// Model: .vrm, .glb or .gltf [default: the built-in character].
    model: Option<PathBuf>,
    /// Sheet (.png) or animation (.webp, .gif) to write; its folder must exist.
    #[arg(short, long, value_name = "OUT.png|webp|gif", value_parser = output)]
    output: PathBuf,
    /// Width of one panel, pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 160, value_parser = clap::value_parser!(u32).range(64..=1024))]
    panel: u32,
    /// Adapter, by a part of its name (`hikage adapters`).
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// Degrees from one panel to the next, of a sheet and of an animation.
const SHEET_STEP: usize = 15;
const FRAME_STEP: usize = 6;
const FRAME_MS: u32 = 70;
/// Of the framing of a head: part of the height that is shown, and part by which the view is lowered.
const CLOSER: f32 = 0.66;
const LOWER: f32 = 0.1;

fn output(text: &str) -> Result<PathBuf, String> {
    let known = [".png", ".webp", ".gif"].iter().any(|ending| text.to_ascii_lowercase().ends_with(ending));
    if known {
        Ok(text.into())
    } else {
        Err("expected a name that ends in .png, .webp or .gif".into())
    }
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let spinner = Spinner::new();
    spinner.step("baking");
    let project = Project::read(&args.project)?;
    let baked = project.bake(true)?;
    if baked.repaired() > 0 {
        warn("keys contradict each other; the map is repaired (`hikage sdf check` names the places)");
    }
    let sides = baked.into_sides();
    spinner.step("loading the model");
    let mut scene = setup::load(args.model.as_deref())?;
    Look::Anime(Anime { face: Some(sides.clone()), ..Anime::default() }).apply(&mut scene);
    if scene.face_maps.is_empty() {
        return Err(Failure::input("the model has no face with texture coordinates of its own for both sides"));
    }
    spinner.step("making pipelines");
    let gpu = setup::gpu(args.adapter.as_deref())?;
    let mut stage = Preview::new(&gpu, scene, &project, sides, args.panel)?;
    let ending = args.output.extension().map(|e| e.to_ascii_lowercase().to_string_lossy().into_owned());
    let bytes = match ending.as_deref() {
        Some("gif") => stage.animation(Kind::Gif, &spinner)?,
        Some("webp") => stage.animation(Kind::Webp, &spinner)?,
        _ => encode_png(&stage.sheet(&spinner)?)?,
    };
    drop(spinner);
    deadline::stop();
    write_atomic(&args.output, &bytes)?;
    Ok(())
}

struct Preview {
    renderer: Renderer,
    stage: hikage::Stage,
    view: View,
    sides: Sides,
    panel: u32,
    /// Angles that are drawn, degrees.
    drawn: Vec<f32>,
    is_mirrored: bool,
}

impl Preview {
    fn new(gpu: &Gpu, mut scene: Scene, project: &Project, sides: Sides, panel: u32) -> Result<Self, Failure> {
        let renderer = Renderer::with_output(gpu, Output::default())?;
        let character = renderer.upload_and_empty_images(&mut scene)?;
        let pose = setup::pose(&scene, Stance::Rest, &[])?;
        let mut framed = View::framed_pose(&scene, &pose, Framing::Face, 0.0, [panel; 2]);
        // From the brows to the chin.
        let camera = &mut framed.camera;
        let height = 2.0 * (camera.eye - camera.target).length() * (camera.fov_y_rad * 0.5).tan();
        let down = Vec3::NEG_Y * height * LOWER;
        (camera.eye, camera.target) = (camera.eye + down, camera.target + down);
        camera.fov_y_rad *= CLOSER;
        let stage = hikage::Stage::of([hikage::Actor::new(&character).posed(pose)]);
        let view = View { background: Background::Color(BEHIND), ..framed };
        let drawn = project.keys.iter().map(ProjectKey::angle).collect();
        Ok(Self { renderer, stage, view, is_mirrored: sides.right.is_none(), sides, panel, drawn })
    }

    /// The face under level light from an angle, degrees to the character's left.
    fn face(&mut self, angle: f32) -> Result<Image, Failure> {
        let (sin, cos) = angle.to_radians().sin_cos();
        self.stage.lights.directional.to_light = Vec3::new(sin, 0.0, cos);
        Ok(self.renderer.render(&mut self.stage, &self.view)?)
    }

    /// The flat mask at that angle, as large as a panel.
    fn mask(&self, angle: f32) -> Image {
        let map = match (&self.sides.right, angle < 0.0) {
            (Some(right), true) => right.mask(angle.abs().to_radians()),
            _ => self.sides.left.mask(angle.abs().to_radians()),
        };
        let flip = angle < 0.0 && self.sides.right.is_none();
        shrunk(&map, self.panel, flip)
    }

    /// Two rows for light from the character's left and two for light from the right: the face, and the mask below.
    fn sheet(&mut self, spinner: &Spinner) -> Result<Image, Failure> {
        let angles: Vec<f32> = (0..=180).step_by(SHEET_STEP).map(|a| a as f32).collect();
        let pitch = self.panel + GAP;
        let mut sheet = paper(angles.len() as u32 * pitch + GAP, 2 * (2 * pitch + LINE) + GAP);
        for (row, sign) in [1.0f32, -1.0].into_iter().enumerate() {
            let top = GAP + row as u32 * (2 * pitch + LINE);
            for (column, angle) in angles.iter().enumerate() {
                spinner.progress(row * angles.len() + column, 2 * angles.len());
                let left = GAP + column as u32 * pitch;
                let angle = if *angle == 0.0 { 0.0 } else { angle * sign };
                place(&mut sheet, &self.face(angle)?, left, top);
                place(&mut sheet, &self.mask(angle), left, top + pitch);
                let is_drawn = self.drawn.iter().any(|d| *d == angle || self.is_mirrored && *d == angle.abs());
                let side = ["right", "", "left"][usize::from(angle >= 0.0) + usize::from(angle > 0.0)];
                let key = if is_drawn { "key" } else { "" };
                let caption = format!("{:.0}\u{b0} {side} {key}", angle.abs()).replace("  ", " ");
                write(&mut sheet, caption.trim_end(), left, top + 2 * pitch - 4);
            }
        }
        Ok(sheet)
    }

    /// The light once round the head; the face beside the mask.
    fn animation(&mut self, kind: Kind, spinner: &Spinner) -> Result<Vec<u8>, Failure> {
        let (width, height) = (2 * self.panel + GAP, self.panel);
        let mut animation = Animation::new(kind, width, height, FRAME_MS).map_err(Failure::input)?;
        let angles: Vec<usize> = (0..360).step_by(FRAME_STEP).collect();
        for (done, angle) in angles.iter().enumerate() {
            spinner.progress(done, angles.len());
            let angle = *angle as f32 - 180.0;
            let mut frame = paper(width, height);
            place(&mut frame, &self.face(angle)?, 0, 0);
            place(&mut frame, &self.mask(angle), self.panel + GAP, 0);
            animation.add(&frame.pixels).map_err(Failure::input)?;
        }
        animation.finish().map_err(Failure::input)
    }
}

/// A mask as a square picture of a side: the mean of the texels under each pixel.
fn shrunk(mask: &Mask, side: u32, flip: bool) -> Image {
    let span = |i: u32, texels: u32| {
        let from = (u64::from(i) * u64::from(texels) / u64::from(side)) as u32;
        from..((u64::from(i) + 1) * u64::from(texels)).div_ceil(u64::from(side)) as u32
    };
    let mut pixels = Vec::with_capacity(side as usize * side as usize * 4);
    for y in 0..side {
        for x in 0..side {
            let x = if flip { side - 1 - x } else { x };
            let (mut sum, mut count) = (0u64, 0u64);
            for row in span(y, mask.height) {
                for column in span(x, mask.width) {
                    sum += u64::from(mask.coverage[row as usize * mask.width as usize + column as usize]);
                    count += 1;
                }
            }
            let grey = (sum / count.max(1)) as u8;
            pixels.extend([grey, grey, grey, 255]);
        }
    }
    Image { width: side, height: side, pixels, ..Image::default() }
}
