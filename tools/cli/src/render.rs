//! `hikage render`.

use std::path::{Path, PathBuf};
use std::time::Instant;

use glam::Mat4;
use hikage::motion::{Pose, Stance};
use hikage::picture::{encode_png, write_atomic};
use hikage::scene::Scene;
use hikage::{Actor, Background, Channel, GpuMemory, Ground, Output, Renderer, Stage, View};
use serde::Serialize;

use crate::args::{self, LookName, ViewName};
use crate::clips::{LookAt, MotionArgs, Sources};
use crate::failure::Failure;
use crate::motion::{Motion, Moving};
use crate::placed::{Placed, placed};
use crate::preset::{Preset, PresetName};
use crate::shot::Shot;
use crate::spinner::Spinner;
use crate::{deadline, output, setup};

/// Arguments of `hikage render`.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  hikage render -o heroine.png
  hikage render girl.vrm -o cover.png --preset cover
  hikage render girl.vrm -o girl.png --view bust --yaw 25 --pose relaxed
  hikage render girl.vrm -o icon.png --size 256x256 --background none --expression happy,blink=0.3
  hikage render girl.vrm -o again.png --shot shot.json
  hikage render girl.vrm -o smooth.png --accumulate 16
  hikage render girl.vrm -o step.png --view full --clip walk --time 0.4
  hikage render girl.vrm boy.vrm@0.8,0,-0.2@yaw=-30 -o both.png --view full --ground grid

SHOT.json (every field may be missing; options given here win over it):
  {\"size\": [1024, 1024], \"background\": \"#808080\", \"ambient\": [0.1, 0.1, 0.1],
   \"camera\": {\"eye\": [0, 1.3, 4], \"target\": [0, 1.3, 0], \"up\": [0, 1, 0], \"fov_y_deg\": 20, \"near\": 0.1, \"far\": 50},
   \"light\": {\"to_light\": [0.3, 0.5, 0.8], \"color\": [1, 1, 1], \"intensity\": 1}}
Metres; the character stands at the origin and faces +Z. Colours of light are linear; intensity 1 shows a material's
lit colour exactly.")]
pub(crate) struct Args {
    /// Models: .vrm, .glb or .gltf; each may stand elsewhere (metres) and be turned to its left (degrees). They cast shadows
    /// on each other [default: the built-in character].
    #[arg(value_name = "MODEL[@X,Y,Z][@yaw=DEG]", value_parser = placed)]
    models: Vec<Placed>,
    /// Picture to write; its folder must exist.
    #[arg(short, long, value_name = "OUT.png", value_parser = png_path)]
    output: PathBuf,
    /// Composition: camera, light, backdrop and pose; and the anime look for models that bring none. Options given here win
    /// over it.
    #[arg(long, value_enum, value_name = "NAME")]
    preset: Option<PresetName>,
    /// Size, pixels [default: 1024x1024].
    #[arg(long, value_name = "WxH", value_parser = args::size)]
    size: Option<[u32; 2]>,
    /// What fills the picture [default: portrait].
    #[arg(long, value_enum, value_name = "portrait|bust|full|face", hide_possible_values = true)]
    view: Option<ViewName>,
    /// Turn of the camera round the character, to its left where positive.
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = args::yaw)]
    yaw: Option<f32>,
    /// Direction of the light: 0,0 from the front, positive from the picture's right and from above.
    #[arg(long, value_name = "YAW,PITCH", allow_hyphen_values = true, value_parser = args::light)]
    light: Option<[f32; 2]>,
    /// Which set of shade ramps is shown: 0 warm, 1 cool [default: by the light's colour].
    #[arg(long, value_name = "0..1", value_parser = args::share)]
    coolness: Option<f32>,
    /// Light from all around: an equirectangular picture, or one that is made [default: that of the look].
    #[arg(long, value_name = "FILE.hdr|studio|sky|none", value_parser = args::environment)]
    environment: Option<args::EnvironmentName>,
    /// Turn of it to the character's left.
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = args::yaw)]
    environment_turn: Option<f32>,
    /// Background: none (transparent), environment or #RRGGBB [default: #808080].
    #[arg(long, value_name = "COLOR", value_parser = args::background)]
    background: Option<Background>,
    /// What they stand on: a colour, a grid, or their shadow alone.
    #[arg(long, value_name = "#RRGGBB|grid|shadow", value_parser = args::ground)]
    ground: Option<Ground>,
    /// Samples a pixel.
    #[arg(long, value_name = "1|4", default_value = "4", value_parser = args::samples)]
    samples: u32,
    /// Pictures, each moved by a share of a pixel, of which the mean is taken: as many samples a pixel for every edge, cut and
    /// hashed alpha. 16 are good, 64 with `--samples 1` take long and look it; FXAA is left out.
    #[arg(long, value_name = "N", default_value = "1", value_parser = args::accumulate)]
    accumulate: u32,
    /// Expressions and their weights, 0 to 1.
    #[arg(long, value_name = "NAME=W,...", value_delimiter = ',', value_parser = args::expression)]
    expression: Vec<(String, f32)>,
    /// Pose of the humanoid, which clips go over [default: rest; relaxed for the built-in character, with clips
    /// and with a preset].
    #[arg(long, value_name = "rest|relaxed|bend|offer", value_parser = args::stance)]
    pose: Option<Stance>,
    #[arg(long, value_name = "plain|anime|natural|FILE.look.toml", value_parser = args::look, help = args::LOOK_HELP)]
    look: Option<LookName>,
    /// File with camera, light and background; see below.
    #[arg(long, value_name = "SHOT.json")]
    shot: Option<PathBuf>,
    #[command(flatten)]
    motion: MotionArgs,
    /// Moment of clips and of texture animations. Hair and clothes swing as they do then, two seconds into the movement.
    #[arg(long, value_name = "SECONDS", default_value = "0", value_parser = args::time)]
    time: f32,
    /// What is shown of each pixel: the picture, its geometry (part-id: 16 bits in red (low) and green (high), 0 for
    /// background), or one part of a look.
    #[arg(long, value_name = "CHANNEL", default_value = "final", value_parser = args::channel())]
    channel: Channel,
    /// Adapter, by a part of its name (`hikage adapters`).
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
    /// Write timings, sizes and warnings here as JSON.
    #[arg(long, value_name = "REPORT.json")]
    report: Option<PathBuf>,
}

/// Report of a rendering.
#[derive(Serialize)]
struct Report<'a> {
    model: String,
    output: String,
    adapter: AdapterReport<'a>,
    options: OptionsReport<'a>,
    ms: Timings,
    draws: usize,
    triangles: usize,
    gpu_bytes: GpuMemory,
    warnings: &'a [hikage::scene::Warning],
}

#[derive(Serialize)]
struct AdapterReport<'a> {
    name: &'a str,
    backend: &'a str,
    kind: &'a str,
    driver: &'a str,
}

/// The view as it was drawn, in the terms of a shot file.
#[derive(Serialize)]
struct OptionsReport<'a> {
    size: [u32; 2],
    samples: u32,
    accumulate: u32,
    channel: &'static str,
    time_s: f32,
    background: String,
    expressions: &'a [(String, f32)],
    eye: [f32; 3],
    target: [f32; 3],
    up: [f32; 3],
    fov_y_deg: f32,
    near: f32,
    to_light: [f32; 3],
}

/// Wall clock, milliseconds.
#[derive(Default, Serialize)]
struct Timings {
    load: f64,
    adapter: f64,
    pipelines: f64,
    upload: f64,
    first_frame: f64,
    encode: f64,
    total: f64,
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    let start = Instant::now();
    let mut ms = Timings::default();
    for path in [Some(&args.output), args.report.as_ref()].into_iter().flatten() {
        setup::check_writable(path)?;
    }
    let shot = args.shot.as_deref().map(Shot::read).transpose()?.unwrap_or_default();
    let preset = args.preset.map(PresetName::preset);

    let spinner = Spinner::new();
    spinner.step("loading the model");
    let built_in = [Placed::default()];
    let models = if args.models.is_empty() {
        &built_in[..]
    } else {
        &args.models
    };
    let mut scenes = Vec::with_capacity(models.len());
    for model in models {
        let scene = timed(&mut ms.load, || setup::load(model.path.as_deref()))?;
        setup::show_warnings(&scene.warnings);
        scenes.push(scene);
    }
    for (model, scene) in models.iter().zip(&mut scenes) {
        let other = if preset.is_some() {
            LookName::Anime
        } else {
            LookName::Plain
        };
        setup::apply_look_or(args.look.as_ref(), other, model.path.as_deref(), scene)?;
    }
    let moved = moved(args, preset.as_ref());
    let mut motions = motions(args, preset.as_ref(), &moved, models, &scenes)?;

    spinner.step("opening the adapter");
    let gpu = timed(&mut ms.adapter, || setup::gpu(args.adapter.as_deref()))?;
    spinner.step("making pipelines");
    let output = Output { samples: args.samples, ..Output::default() };
    let renderer = timed(&mut ms.pipelines, || Renderer::with_output(&gpu, output))?;
    spinner.step("uploading");
    let figures = preset.as_ref().map_or(1, Preset::figures);
    let mut actors = Vec::with_capacity(models.len() * figures);
    for (scene, posed) in scenes.iter_mut().zip(&motions) {
        let character = timed(&mut ms.upload, || renderer.upload_and_empty_images(scene))?;
        actors.extend((0..figures).map(|_| posed.put(Actor::new(&character), args.time)));
    }
    if let Some(preset) = &preset {
        preset.place(&mut actors);
    }
    let mut stage = Stage::of(actors);
    stage.ground.clone_from(&args.ground);
    let view = seen(args, preset.as_ref(), &shot, &mut stage)?;
    // The figures of a row each look ahead.
    if moved.look_at == Some(LookAt::Camera) && figures == 1 {
        look_at_camera(&mut motions, args.time, &mut stage, &view);
    }
    spinner.step("drawing");
    let picture = timed(&mut ms.first_frame, || {
        // One picture is smoothed as the look says.
        if args.accumulate == 1 {
            renderer.render(&mut stage, &view)
        } else {
            renderer.render_accumulated(&mut stage, &view, args.accumulate)
        }
    })?;
    let png = timed(&mut ms.encode, || encode_png(&picture))?;
    drop(spinner);

    deadline::stop();
    write_atomic(&args.output, &png)?;
    if let Some(path) = &args.report {
        let info = gpu.info();
        ms.total = start.elapsed().as_secs_f64() * 1e3;
        let report = Report {
            model: models.iter().map(Placed::name).collect::<Vec<_>>().join(", "),
            output: args.output.display().to_string(),
            adapter: AdapterReport { name: &info.name, backend: &info.backend, kind: &info.kind, driver: &info.driver },
            options: options_report(args, &view, &stage),
            ms,
            draws: stage.draw_count(),
            triangles: stage.actors.iter().map(|a| a.character.triangle_count()).sum(),
            gpu_bytes: stage.actors.iter().map(|a| a.character.memory()).sum(),
            warnings: &scenes.iter().flat_map(|s| s.warnings.clone()).collect::<Vec<_>>(),
        };
        write_atomic(path, output::json(&report)?.as_bytes())?;
    }
    Ok(())
}

/// How a model stands: still, or in a movement.
enum Posed {
    Still(Mat4, Box<Pose>),
    Moved(Box<Motion>),
}

impl Posed {
    /// The actor in its place and pose.
    fn put(&self, mut actor: Actor, time_s: f32) -> Actor {
        match self {
            Self::Still(world, pose) => {
                actor.world = *world;
                actor.posed((**pose).clone())
            }
            Self::Moved(motion) => {
                let Moving { world, pose, .. } = motion.from(time_s);
                actor.world = world;
                actor.posed(pose)
            }
        }
    }
}

/// How models move: as a preset says where the options do not.
fn moved(args: &Args, preset: Option<&Preset>) -> MotionArgs {
    let mut moved = args.motion.clone();
    if let Some(preset) = preset {
        moved.wind = moved.wind.or(preset.wind);
        moved.look_at = moved.look_at.or(preset.looks_at_camera.then_some(LookAt::Camera));
    }
    moved
}

/// Poses of all models. Of several, each shows the expressions that it has.
fn motions(
    args: &Args,
    preset: Option<&Preset>,
    moved: &MotionArgs,
    models: &[Placed],
    scenes: &[Scene],
) -> Result<Vec<Posed>, Failure> {
    let has = |scene: &Scene, name: &str| scene.character.iter().flat_map(|c| &c.expressions).any(|e| e.name == name);
    let somebody_has = |name: &str| scenes.iter().any(|scene| has(scene, name));
    let sources = Sources::load(&args.motion.clip)?;
    let posed = |(model, scene): (&Placed, &Scene)| {
        let is_at_ease = model.path.is_none() || !args.motion.clip.is_empty() || preset.is_some();
        let stance = args.pose.unwrap_or(if is_at_ease { Stance::Relaxed } else { Stance::Rest });
        let mut expressions: Vec<(String, f32)> =
            args.expression.iter().filter(|(name, _)| has(scene, name) || !somebody_has(name)).cloned().collect();
        if args.expression.is_empty() {
            let of_preset = preset.iter().flat_map(|p| p.expressions).filter(|(name, _)| has(scene, name));
            expressions.extend(of_preset.map(|(name, weight)| ((*name).to_owned(), *weight)));
        }
        if !moved.is_some() {
            return Ok(Posed::Still(model.world(), Box::new(setup::pose(scene, stance, &expressions)?)));
        }
        let base = setup::pose(scene, stance, &[])?;
        let mut motion = Motion::new(scene, moved, &sources, base, model.world())?;
        motion.express(&expressions)?;
        Ok(Posed::Moved(Box::new(motion)))
    };
    models.iter().zip(scenes).map(posed).collect()
}

/// Poses all anew with their eyes on the camera, which was placed by how they stood without.
fn look_at_camera(motions: &mut [Posed], time_s: f32, stage: &mut Stage, view: &View) {
    for (posed, actor) in motions.iter_mut().zip(&mut stage.actors) {
        if let Posed::Moved(motion) = posed {
            motion.look_at(view.camera.eye);
            Moving { world: actor.world, pose: actor.pose, .. } = motion.from(time_s);
        }
    }
}

/// What is drawn: the framing or the preset, then the shot, then the options of the command line.
fn seen(args: &Args, preset: Option<&Preset>, shot: &Shot, stage: &mut Stage) -> Result<View, Failure> {
    let size = args.size.or(shot.size).unwrap_or(preset.map_or([1024, 1024], |p| p.size));
    let framed = match preset {
        Some(preset) => preset.view(stage, args.view, args.yaw, size),
        None => {
            let framing = args.view.unwrap_or(ViewName::Portrait).into();
            let view = View::framed_stage(stage, framing, args.yaw.unwrap_or(0.0).to_radians(), size);
            View { background: Background::Color(hikage::color::Srgb([0x80; 3])), ..view }
        }
    };
    let mut view = framed.clone();
    let lights = &mut stage.lights;
    shot.apply(&mut view, lights).map_err(|what| {
        let file = args.shot.as_deref().unwrap_or(Path::new(""));
        Failure::input(format!("{}: {what}", file.display()))
    })?;
    if args.view.is_some() || args.yaw.is_some() {
        view.camera = framed.camera;
    }
    if let Some(degrees) = args.light {
        lights.directional.to_light = setup::to_light(degrees);
    }
    if let Some(name) = &args.environment {
        lights.environment = setup::environment(name)?;
    }
    if let Some(turn) = args.environment_turn {
        let none = || Failure::input("--environment-turn: there is no environment; add --environment studio");
        lights.environment.as_mut().ok_or_else(none)?.turn_rad = turn.to_radians();
    }
    lights.coolness = args.coolness.or(lights.coolness);
    stage.time_s = args.time;
    if let Some(background) = args.background {
        view.background = background;
    }
    if view.background == Background::Environment && stage.lights.environment.is_none() {
        return Err(Failure::input("the background is the environment, and there is none; add --environment studio"));
    }
    view.channel = args.channel;
    if let Some(ground) = &mut stage.ground {
        // It begins to fade where the picture of a whole character ends.
        ground.radius_m = ground.radius_m.max(view.camera.eye.distance(view.camera.target));
    }
    Ok(view)
}

fn options_report<'a>(args: &'a Args, view: &View, stage: &Stage) -> OptionsReport<'a> {
    OptionsReport {
        size: view.size,
        samples: args.samples,
        accumulate: args.accumulate,
        channel: args.channel.name(),
        time_s: stage.time_s,
        background: match &view.background {
            Background::Environment => "environment".to_owned(),
            Background::Backdrop(_) => "backdrop".to_owned(),
            Background::Color(hikage::color::Srgb([r, g, b])) => format!("#{r:02x}{g:02x}{b:02x}"),
            _ => "none".into(),
        },
        expressions: &args.expression,
        eye: view.camera.eye.into(),
        target: view.camera.target.into(),
        up: view.camera.up.into(),
        fov_y_deg: view.camera.fov_y_rad.to_degrees(),
        near: view.camera.near,
        to_light: stage.lights.directional.to_light.into(),
    }
}

fn timed<T>(ms: &mut f64, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    *ms = start.elapsed().as_secs_f64() * 1e3;
    result
}

/// A name for a picture.
pub(crate) fn png_path(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_png = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
    if is_png {
        Ok(path)
    } else {
        Err("expected a name that ends in .png".into())
    }
}
