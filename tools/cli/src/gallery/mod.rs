//! `hikage gallery`: a contact sheet for every look on the built-in character, with a page that explains them.

mod eyes;
mod page;
mod sheets;
mod skin;

use std::path::PathBuf;

use glam::{Mat4, Quat, Vec3};
use hikage::motion::{Pose, Stance};
use hikage::picture::{encode_png, write_atomic};
use hikage::scene::{Framing, HumanBone, Image, PunctualLight, Role, Scene};
use hikage::{Actor, Background, Output, Renderer, Stage, View};

use crate::args::LookName;
use crate::failure::Failure;
use crate::output::make_folder;
use crate::sheet::{BEHIND, GAP, LINE, paper, place, write};
use crate::spinner::Spinner;
use crate::{deadline, setup};
use sheets::{Camera, Change, Panel, Row, Sheet};

/// Arguments of `hikage gallery`.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  hikage gallery -o gallery
  hikage gallery -o gallery --only skin,eyes --model head.glb")]
pub(crate) struct Args {
    /// Folder for the sheets and index.html.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Only these sheets, by name: metal,fire.
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    only: Vec<String>,
    /// Model of the sheets skin and eyes: .vrm, .glb or .gltf [default: the built-in character].
    #[arg(long, value_name = "MODEL")]
    model: Option<PathBuf>,
    /// Height of one panel, pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 384, value_parser = clap::value_parser!(u32).range(64..=1024))]
    panel: u32,
    /// Adapter, by a part of its name (`hikage adapters`).
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let mut sheets = sheets::all();
    if let Some(unknown) = args.only.iter().find(|name| !sheets.iter().any(|s| s.name == name.as_str())) {
        let names: Vec<&str> = sheets.iter().map(|s| s.name).collect();
        return Err(Failure::input(format!("--only: no sheet is named {unknown:?}; there are {}", names.join(", "))));
    }
    sheets.retain(|s| args.only.is_empty() || args.only.iter().any(|name| name == s.name));
    make_folder(&args.output)?;

    let spinner = Spinner::new();
    spinner.step("loading the character");
    let plain = setup::load(None)?;
    let mut scene = plain.clone();
    setup::apply_look(Some(&LookName::Anime), None, &mut scene)?;
    let own = args.model.as_deref().map(|model| setup::load(Some(model))).transpose()?;
    let gpu = setup::gpu(args.adapter.as_deref())?;
    let renderer = Renderer::with_output(&gpu, Output::default())?;
    for (i, sheet) in sheets.iter().enumerate() {
        spinner.step(format!("{} of {}: {}", i + 1, sheets.len(), sheet.title));
        let scenes = match &own {
            Some(model) if [skin::NAME, eyes::NAME].contains(&sheet.name) => [model; 2],
            _ => [&plain, &scene],
        };
        let picture = draw(&renderer, scenes, sheet, args.panel)?;
        write_atomic(args.output.join(format!("{}.png", sheet.name)), &encode_png(&picture)?)?;
    }
    drop(spinner);
    deadline::stop();
    write_atomic(args.output.join("index.html"), page::html(&sheets).as_bytes())?;
    Ok(())
}

/// Draws a sheet; every row has its own scene.
fn draw(renderer: &Renderer, [plain, looked]: [&Scene; 2], sheet: &Sheet, panel: u32) -> Result<Image, Failure> {
    let width = |p: &Panel| (panel as f32 * p.aspect).round() as u32;
    let row_width = |r: &Row| r.panels.iter().map(|p| width(p) + GAP).sum::<u32>() + GAP;
    let height = GAP + sheet.rows.len() as u32 * (panel + LINE + GAP);
    let mut picture = paper(sheet.rows.iter().map(row_width).max().unwrap_or(GAP), height);
    let mut top = GAP;
    for row in &sheet.rows {
        let mut scene = if row.is_plain { plain.clone() } else { looked.clone() };
        (row.change)(&mut scene);
        let mut stage = staged(renderer, &scene)?;
        let lights = stage.lights.clone();
        let mut left = GAP;
        for shown in &row.panels {
            let size = [width(shown), panel];
            stage.lights.clone_from(&lights);
            let drawn = match &shown.variants[..] {
                [] => draw_panel(renderer, &mut stage, &scene, shown, size)?,
                list => draw_variants(renderer, &scene, list, shown, size)?,
            };
            place(&mut picture, &drawn, left, top);
            write(&mut picture, &shown.caption, left, top + panel + 4);
            left += size[0] + GAP;
        }
        top += panel + LINE + GAP;
    }
    Ok(picture)
}

fn staged(renderer: &Renderer, scene: &Scene) -> Result<Stage, Failure> {
    Ok(Stage::of([Actor::new(&renderer.upload(scene)?)]))
}

/// A picture of which each variant has a share, from left to right, with lines between them.
fn draw_variants(
    renderer: &Renderer,
    scene: &Scene,
    list: &[Change],
    shown: &Panel,
    size: [u32; 2],
) -> Result<Image, Failure> {
    let mut picture = paper(size[0], size[1]);
    let stride = size[0] as usize * 4;
    for (i, change) in list.iter().enumerate() {
        let mut scene = scene.clone();
        change(&mut scene);
        let drawn = draw_panel(renderer, &mut staged(renderer, &scene)?, &scene, shown, size)?;
        let from = size[0] as usize * i / list.len() * 4;
        for (to, line) in picture.pixels.chunks_exact_mut(stride).zip(drawn.pixels.chunks_exact(stride)) {
            to[from..].copy_from_slice(&line[from..]);
            if i > 0 {
                to[from..from + 4].fill(255);
            }
        }
    }
    Ok(picture)
}

fn draw_panel(
    renderer: &Renderer,
    stage: &mut Stage,
    scene: &Scene,
    panel: &Panel,
    size: [u32; 2],
) -> Result<Image, Failure> {
    let expressions: Vec<(String, f32)> = panel.expression.iter().map(|e| ((*e).to_owned(), 1.0)).collect();
    let stance = match panel.camera {
        Camera::Framed(..) => panel.stance,
        _ => Stance::Rest,
    };
    let mut pose = setup::pose(scene, stance, &expressions)?;
    let mut view = match panel.camera {
        Camera::Framed(framing, yaw) => View::framed_pose(scene, &pose, framing, yaw.to_radians(), size),
        Camera::Close { part, yaw, pitch } => close(scene, part, [yaw, pitch], size),
        Camera::Head { yaw, height } => {
            let points = head(scene)?;
            let (low, high) = bounds(&points);
            let extent = high - low;
            looking_at((low + high) * 0.5, 0.55 * height * extent.y.max(extent.x), [yaw, 0.0], size)
        }
        Camera::Ear { yaw } => {
            let tip = head(scene)?.into_iter().max_by(|a, b| a.x.total_cmp(&b.x)).unwrap_or_default();
            looking_at(tip - Vec3::X * 0.012, 0.045, [yaw, 0.0], size)
        }
        Camera::Eyes { both, yaw } => {
            let (low, high) = eye(scene)?;
            let (middle, wide) = ((low + high) * 0.5, high.x - low.x);
            let (x, half) = if both {
                (0.0, (high.x + 0.4 * wide) / panel.aspect)
            } else {
                (middle.x, 0.8 * wide)
            };
            looking_at(Vec3::new(x, middle.y, high.z), half, [yaw, 0.0], size)
        }
    };
    if let Some(head) = scene.bone_node(HumanBone::Head) {
        pose.locals[head].rotation *= Quat::from_rotation_y(panel.head_deg.to_radians());
    }
    let [yaw, pitch] = panel.light_deg.map(f32::to_radians);
    let lights = &mut stage.lights;
    lights.directional.to_light = Vec3::new(yaw.sin() * pitch.cos(), pitch.sin(), yaw.cos() * pitch.cos());
    lights.directional.intensity *= panel.key;
    lights.coolness = panel.coolness;
    lights.punctual.extend(panel.lamp);
    if let (Some((color, intensity)), Some(hand)) = (panel.flame, scene.bone_node(HumanBone::LeftHand)) {
        // Off the palm, which it would bleach.
        let position = scene.world_from_nodes(&pose.locals)[hand].w_axis.truncate() + Vec3::new(0.0, 0.17, 0.07);
        lights.punctual.push(PunctualLight { position, color, intensity, range: 0.0, spot: None });
    }
    stage.time_s = panel.time_s;
    stage.actors[0].pose = pose;
    view.background = Background::Color(panel.background.unwrap_or(BEHIND));
    Ok(renderer.render(stage, &view)?)
}

/// A view that a part of the character at rest fills: what of it lies on her left, so that pairs show one of both.
fn close(scene: &Scene, part: &str, [yaw, pitch]: [f32; 2], size: [u32; 2]) -> View {
    let is_named = |index: usize| scene.materials.get(index).is_some_and(|m| m.name == part);
    let of_mesh = |mesh: &'_ hikage::scene::Mesh| mesh.name == part;
    let points =
        scene.meshes.iter().flat_map(|m| m.primitives.iter().filter(move |p| of_mesh(m) || is_named(p.material)));
    let left: Vec<Vec3> =
        points.flat_map(|p| &p.positions).map(|p| Vec3::from_array(*p)).filter(|p| p.x > -0.02).collect();
    let (low, high) = bounds(&left);
    let aspect = size[0] as f32 / size[1] as f32;
    let extent = (high - low).max(Vec3::ZERO);
    let half = 0.58 * extent.y.max(extent.x.hypot(extent.z) * 0.9 / aspect);
    looking_at((low + high) * 0.5, half, [yaw, pitch], size)
}

fn bounds(points: &[Vec3]) -> (Vec3, Vec3) {
    points.iter().fold((Vec3::MAX, Vec3::MIN), |(l, h), p| (l.min(*p), h.max(*p)))
}

/// Heights of heads, metres: of a drawn face, whose chin its neck hides from the bounds, and of a real one.
const HEADS: [(Role, f32); 2] = [(Role::Face, 0.25), (Role::Skin, 0.22)];

/// Skin within a head's height of its top, at rest; that of the face alone where it is known.
fn head(scene: &Scene) -> Result<Vec<Vec3>, Failure> {
    let heads = HEADS.map(|(role, height)| {
        let mut points = points_of(scene, role);
        let top = bounds(&points).1.y;
        points.retain(|p| p.y > top - height);
        points
    });
    heads.into_iter().find(|points| !points.is_empty()).ok_or_else(|| lacks("skin"))
}

/// Bounds of the left eye at rest.
fn eye(scene: &Scene) -> Result<(Vec3, Vec3), Failure> {
    let mut points = points_of(scene, Role::Eye);
    points.retain(|p| p.x > 0.0);
    (!points.is_empty()).then(|| bounds(&points)).ok_or_else(|| lacks("eye"))
}

fn lacks(role: &str) -> Failure {
    Failure::input(format!("--model: the model has no part that is known as {role} (`hikage inspect`)"))
}

/// Vertices of a role at rest.
fn points_of(scene: &Scene, role: Role) -> Vec<Vec3> {
    let world = scene.world_from_nodes(&Pose::rest(scene).locals);
    let parts = scene.mesh_nodes().flat_map(|(node, mesh)| {
        // Joints, not its node, place what is skinned.
        let matrix = if scene.nodes[node].skin.is_some() {
            Mat4::IDENTITY
        } else {
            world[node]
        };
        mesh.primitives.iter().map(move |p| (matrix, p))
    });
    let parts = parts.filter(|(_, p)| p.role == role);
    parts.flat_map(|(m, p)| p.positions.iter().map(move |p| m.transform_point3(Vec3::from_array(*p)))).collect()
}

/// A view from 0.6 m to a target, whose half height fills half of the picture's.
fn looking_at(target: Vec3, half: f32, [yaw, pitch]: [f32; 2], size: [u32; 2]) -> View {
    let (yaw, pitch) = (yaw.to_radians(), pitch.to_radians());
    let away = Vec3::new(yaw.sin() * pitch.cos(), pitch.sin(), yaw.cos() * pitch.cos());
    let (eye, fov_y_rad) = (target + away * 0.6, 2.0 * (half / 0.6).atan());
    View {
        size,
        camera: hikage::scene::Camera { target, eye, near: 0.02, fov_y_rad, ..Default::default() },
        ..View::default()
    }
}

/// Her face, at ease.
impl Default for Panel {
    fn default() -> Self {
        Self {
            caption: String::new(),
            camera: Camera::Framed(Framing::Face, 0.0),
            aspect: 1.0,
            stance: Stance::Relaxed,
            expression: None,
            light_deg: [-30.0, 30.0],
            lamp: None,
            flame: None,
            key: 1.0,
            head_deg: 0.0,
            coolness: None,
            time_s: 0.0,
            background: None,
            variants: Vec::new(),
        }
    }
}
