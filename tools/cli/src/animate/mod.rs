//! `hikage animate`: a character in motion, as an animated picture, as frames, or as a contact sheet.

mod sink;

use std::path::PathBuf;

use glam::{Mat4, Vec3};
use hikage::motion::Stance;
use hikage::picture::write_atomic;
use hikage::scene::{Image, Scene};
use hikage::{Actor, Background, Ground, Output, Renderer, Stage, View};

use crate::animation::Kind;
use crate::args::{self, LookName, ViewName};
use crate::clips::{ClipName, LookAt, MotionArgs, Sources};
use crate::failure::{Failure, warn};
use crate::motion::{Motion, Moving};
use crate::sheet::{self, BEHIND};
use crate::spinner::Spinner;
use crate::{deadline, output, setup};
use sink::Sink;

/// Most frames of an animation.
const MOST_FRAMES: usize = 3600;
/// Moments of a clip that decide how much room it takes in the picture.
const OUTLINES: usize = 8;
/// Frames a second, moments of a sheet, and seconds without a clip, where nothing is said.
const FPS: u32 = 20;
const MOMENTS: usize = 12;
const SECONDS: f32 = 4.0;

/// Arguments of `hikage animate`.
#[derive(clap::Args)]
#[command(after_help = "\
Examples:
  hikage animate -o idle.webp
  hikage animate girl.vrm --clip walk --ground grid --travel -o walk.webp
  hikage animate girl.vrm --clip walk=0.5 --clip run=0.5 -o jog.gif --yaw 60 --fps 25
  hikage animate girl.vrm --clip dance.vrma --seconds 8 --size 1080x1350 --fps 30 -o frames/
  hikage animate girl.vrm --clip run -o run.png --yaw 0,90")]
pub(crate) struct Args {
    /// Model: .vrm, .glb or .gltf [default: the built-in character, and the clip idle].
    model: Option<PathBuf>,
    /// What to write: a lossless animated .webp, a .gif, a FOLDER/ of frame-0000.png and on, or a .png: a contact sheet of
    /// moments.
    #[arg(short, long, value_name = "OUT.webp|OUT.gif|OUT.png|FOLDER/", value_parser = out)]
    output: Out,
    #[command(flatten)]
    motion: MotionArgs,
    /// Blinks now and then, other seeds at other moments [default: only without clips].
    #[arg(long, value_name = "SEED", num_args = 0..=1, require_equals = true, default_missing_value = "0")]
    blink: Option<u64>,
    /// Length [default: that of the longest clip; 4 without clips].
    #[arg(long, value_name = "S", value_parser = seconds)]
    seconds: Option<f32>,
    /// Frames a second, 1 to 60 [default: 20].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=60))]
    fps: Option<u32>,
    /// Moments on a contact sheet [default: 12].
    #[arg(long, value_name = "N", conflicts_with = "fps", value_parser = moments)]
    frames: Option<usize>,
    /// Size of a frame, pixels [default: 480x600; 320x400 on a contact sheet].
    #[arg(long, value_name = "WxH", value_parser = args::size)]
    size: Option<[u32; 2]>,
    /// What fills the picture.
    #[arg(
        long,
        value_enum,
        value_name = "portrait|bust|full|face",
        hide_possible_values = true,
        default_value = "full"
    )]
    view: ViewName,
    /// Turn of the camera round the character, to its left where positive; of several, the pictures stand side by side.
    #[arg(long, value_name = "DEG,...", allow_hyphen_values = true, default_value = "0", value_delimiter = ',', value_parser = args::yaw)]
    yaw: Vec<f32>,
    /// Direction of the light: 0,0 from the front, positive from the picture's right and from above.
    #[arg(long, value_name = "YAW,PITCH", allow_hyphen_values = true, value_parser = args::light)]
    light: Option<[f32; 2]>,
    #[arg(long, value_name = "plain|anime|natural|FILE.look.toml", value_parser = args::look, help = args::LOOK_HELP)]
    look: Option<LookName>,
    /// Background: none (transparent), environment or #RRGGBB [default: #DFE7EE].
    #[arg(long, value_name = "COLOR", value_parser = args::background)]
    background: Option<Background>,
    /// What it stands on: a colour, a grid, or its shadow alone.
    #[arg(long, value_name = "#RRGGBB|grid|shadow", value_parser = args::ground)]
    ground: Option<Ground>,
    /// Expressions and their weights, 0 to 1.
    #[arg(long, value_name = "NAME=W,...", value_delimiter = ',', value_parser = args::expression)]
    expression: Vec<(String, f32)>,
    /// Adapter, by a part of its name (`hikage adapters`).
    #[arg(long, value_name = "NAME")]
    adapter: Option<String>,
}

/// What is written, by the end of its name.
#[derive(Clone, Debug, PartialEq)]
struct Out {
    path: PathBuf,
    form: Form,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Animation(Kind),
    Folder,
    Sheet,
}

fn out(text: &str) -> Result<Out, String> {
    let path = PathBuf::from(text);
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    let form = match ending.as_str() {
        _ if text.ends_with(['/', std::path::MAIN_SEPARATOR]) || path.is_dir() => Form::Folder,
        "webp" => Form::Animation(Kind::Webp),
        "gif" => Form::Animation(Kind::Gif),
        "png" => Form::Sheet,
        _ => return Err("expected a name that ends in .webp, .gif, .png, or in / for a folder of frames".into()),
    };
    Ok(Out { path, form })
}

fn seconds(text: &str) -> Result<f32, String> {
    args::time(text).ok().filter(|s| *s > 0.0).ok_or_else(|| "expected a number above 0, up to 86400".into())
}

fn moments(text: &str) -> Result<usize, String> {
    let count = text.parse().ok().filter(|count| (1..=240).contains(count));
    count.ok_or_else(|| "expected a number from 1 to 240".into())
}

impl Args {
    /// Size of the picture from one side.
    fn frame_size(&self) -> [u32; 2] {
        self.size.unwrap_or(match self.output.form {
            Form::Sheet => [320, 400],
            _ => [480, 600],
        })
    }
}

pub(crate) fn run(args: &Args) -> Result<(), Failure> {
    if args.frames.is_some() && args.output.form != Form::Sheet {
        return Err(Failure::input(
            "--frames is for a contact sheet (-o NAME.png); frames of others follow from --seconds and --fps",
        ));
    }
    match args.output.form {
        Form::Folder => output::make_folder(&args.output.path)?,
        _ => setup::check_writable(&args.output.path)?,
    }
    let spinner = Spinner::new();
    spinner.step("loading the model");
    let mut scene = setup::load(args.model.as_deref())?;
    setup::show_warnings(&scene.warnings);
    setup::apply_look(args.look.as_ref(), args.model.as_deref(), &mut scene)?;
    let mut motion = motion(args, &scene)?;
    let times = Times::of(args, &motion)?;
    blink(args, &scene, &mut motion, times.seconds)?;
    let [width, height] = args.frame_size();
    let mut sink = Sink::new(&args.output, &times, [width * args.yaw.len() as u32, height])?;

    spinner.step("making pipelines");
    let gpu = setup::gpu(args.adapter.as_deref())?;
    let renderer = Renderer::with_output(&gpu, Output::default())?;
    let mut drawing = Drawing::new(args, &renderer, &mut scene, &motion)?;
    let sees = args.motion.look_at == Some(LookAt::Camera);
    if sees {
        motion.look_at(drawing.eye(&Mat4::IDENTITY));
    }
    let mut moving = motion.from(0.0);
    for frame in 0..times.count {
        spinner.progress(frame, times.count);
        if frame > 0 {
            moving.advance(times.step());
        }
        if sees {
            moving.look_at(drawing.eye(&moving.world));
        }
        let time_s = times.at(frame);
        sink.add(&drawing.draw(&renderer, &moving, time_s)?, frame, time_s)?;
    }
    let bytes = sink.finish(times.count)?;
    drop(spinner);
    deadline::stop();
    if let Some(bytes) = bytes {
        write_atomic(&args.output.path, &bytes)?;
    }
    Ok(())
}

/// What the model does; an error where that is nothing.
fn motion(args: &Args, scene: &Scene) -> Result<Motion, Failure> {
    let idle = [ClipName::built_in("idle")];
    let clips = if args.model.is_none() && args.motion.clip.is_empty() {
        &idle[..]
    } else {
        &args.motion.clip
    };
    let base = setup::pose(scene, Stance::Relaxed, &[])?;
    let mut motion = Motion::new(scene, &args.motion, &Sources::load(clips)?, base, Mat4::IDENTITY)?;
    motion.express(&args.expression)?;
    Ok(motion)
}

/// Lets it blink where that is asked for, or nothing else moves it.
fn blink(args: &Args, scene: &Scene, motion: &mut Motion, seconds: f32) -> Result<(), Failure> {
    let character = scene.character.as_ref();
    let can_blink = character.is_some_and(|c| c.expressions.iter().any(|e| e.name.starts_with("blink")));
    let is_still = motion.length_s.is_none();
    if can_blink && (args.blink.is_some() || is_still) {
        motion.blink(args.blink.unwrap_or(0), seconds);
    } else if args.blink.is_some() {
        warn("--blink: the model has no expression for it");
    }
    let can_swing = args.motion.wind.is_some() && character.is_some_and(|c| !c.springs.is_empty());
    if is_still && !can_blink && !can_swing {
        let own: Vec<String> = scene.animations.iter().map(|a| format!("--clip '#{}'", a.name)).collect();
        let own = if own.is_empty() {
            String::new()
        } else {
            format!(", or one of its own: {}", own.join(", "))
        };
        return Err(Failure::input(format!("nothing of the model moves; name a clip (--clip FILE){own}")));
    }
    Ok(())
}

/// When frames are.
struct Times {
    count: usize,
    seconds: f32,
}

impl Times {
    fn of(args: &Args, motion: &Motion) -> Result<Self, Failure> {
        let seconds = args.seconds.or(motion.length_s).unwrap_or(SECONDS);
        if seconds <= 0.0 {
            return Err(Failure::input("the clip has no length; say how long with --seconds"));
        }
        let fps = args.fps.unwrap_or(FPS) as f32;
        let count = match args.output.form {
            Form::Sheet => return Ok(Self { count: args.frames.unwrap_or(MOMENTS), seconds }),
            // Frames of a GIF stay for whole hundredths, and browsers mistrust the shortest.
            Form::Animation(Kind::Gif) => seconds / ((100.0 / fps).round().max(2.0) / 100.0),
            _ => seconds * fps,
        };
        let count = (count.round() as usize).max(1);
        if count > MOST_FRAMES {
            let what =
                format!("{count} frames are over the limit of {MOST_FRAMES}; say fewer --seconds or a lower --fps");
            return Err(Failure::input(what));
        }
        Ok(Self { count, seconds })
    }

    /// The end of the last frame is the beginning of the first one.
    fn step(&self) -> f32 {
        self.seconds / self.count as f32
    }

    fn at(&self, frame: usize) -> f32 {
        self.seconds * frame as f32 / self.count as f32
    }
}

/// What is drawn, from one or several sides.
struct Drawing {
    stage: Stage,
    /// Of the character where it begins; they go along with it.
    views: Vec<View>,
}

impl Drawing {
    fn new(args: &Args, renderer: &Renderer, scene: &mut Scene, motion: &Motion) -> Result<Self, Failure> {
        let character = renderer.upload_and_empty_images(scene)?;
        let outline = Stage::of(motion.outline(OUTLINES).into_iter().map(|pose| Actor::new(&character).posed(pose)));
        let view = |yaw: &f32| View {
            background: args.background.unwrap_or(Background::Color(BEHIND)),
            ..View::framed_stage(&outline, args.view.into(), yaw.to_radians(), args.frame_size())
        };
        let views: Vec<View> = args.yaw.iter().map(view).collect();
        let mut stage = Stage::of([Actor::new(&character)]);
        if let Some(degrees) = args.light {
            stage.lights.directional.to_light = setup::to_light(degrees);
        }
        stage.ground.clone_from(&args.ground);
        if let (Some(ground), Some(view)) = (&mut stage.ground, views.first()) {
            ground.radius_m = ground.radius_m.max(view.camera.eye.distance(view.camera.target));
        }
        if args.background == Some(Background::Environment) && stage.lights.environment.is_none() {
            return Err(Failure::input("the background is the environment, and there is none; add --look natural"));
        }
        Ok(Self { stage, views })
    }

    /// Where the first camera is while the character is elsewhere.
    fn eye(&self, world: &Mat4) -> Vec3 {
        self.views.first().map_or(Vec3::Z, |view| view.camera.eye) + world.w_axis.truncate()
    }

    /// A frame.
    fn draw(&mut self, renderer: &Renderer, moving: &Moving<'_>, time_s: f32) -> Result<Image, Failure> {
        let Self { stage, views } = self;
        let gone = moving.world.w_axis.truncate();
        stage.time_s = time_s;
        if let Some(ground) = &mut stage.ground {
            ground.middle = gone.with_y(0.0);
        }
        for actor in &mut stage.actors {
            (actor.world, actor.pose) = (moving.world, moving.pose.clone());
        }
        let mut pictures = Vec::with_capacity(views.len());
        for view in views {
            let mut view = view.clone();
            view.camera.eye += gone;
            view.camera.target += gone;
            pictures.push(renderer.render(stage, &view)?);
        }
        Ok(side_by_side(pictures))
    }
}

/// Pictures of one size as one.
fn side_by_side(mut pictures: Vec<Image>) -> Image {
    if pictures.len() == 1 {
        return pictures.remove(0);
    }
    let height = pictures.first().map_or(0, |p| p.height);
    let mut whole = sheet::paper(pictures.iter().map(|p| p.width).sum(), height);
    let mut left = 0;
    for picture in pictures {
        sheet::place(&mut whole, &picture, left, 0);
        left += picture.width;
    }
    whole
}
