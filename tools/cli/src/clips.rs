//! What moves characters in pictures, as `render` and `animate` name it: clips, gaze, wind; and the poses that come of it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{Mat4, Vec3};
use hikage::import::{Limits, load, load_bytes};
use hikage::motion::{Animator, Blink, Clip, Gaze, GazeTarget, Layer, Play, Pose, RootMotion, Skeleton, Wind};
use hikage::scene::Scene;
use hikage_character::{clips as built_in, vrma};

use crate::args;
use crate::failure::{Failure, warn};

/// Time before a moment in which chains swing in, seconds: then they hang as they do in motion.
pub(crate) const SWING_IN_S: f32 = 2.0;
/// Longest step of the swinging, seconds: that of the springs themselves.
const STEP_S: f32 = hikage::motion::SPRING_STEP_S;
/// Share of the way to what is looked at that the head turns.
const HEAD: f32 = 0.6;
/// Speed over the ground, metres a second, from which on clips keep step with each other.
const WALKS: f32 = 0.05;
/// Angle (radians) and share of the distance to the parent by which the end of a clip may miss its beginning in a loop.
const CLOSE: [f32; 2] = [0.1, 0.05];

/// Bones that a warning names before it counts the rest.
const SHOWN_NAMES: usize = 6;

/// Options of movement.
#[derive(clap::Args)]
pub(crate) struct MotionArgs {
    /// Clip to play: FILE is a .vrma, .glb or .vrm, or idle, walk, run, wave or turn, which every humanoid can play. NAME is
    /// that of one of its animations, or its number from 0; #NAME alone is one of the model. Several share by their weights.
    #[arg(long, value_name = "FILE[#NAME][=WEIGHT]", value_parser = clip)]
    pub(crate) clip: Vec<ClipName>,
    /// Lets clips move the character over the ground; else it walks on the spot.
    #[arg(long)]
    pub(crate) travel: bool,
    /// What is looked at: a point in the world (metres), or the camera. The head turns by 0.6 of the way.
    #[arg(long, value_name = "X,Y,Z|camera", allow_hyphen_values = true, value_parser = look_at)]
    pub(crate) look_at: Option<LookAt>,
    /// Wind on hair and clothes: direction times strength, of which 0.1 stirs and 1 carries hair away.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = args::xyz)]
    pub(crate) wind: Option<[f32; 3]>,
}

/// `--clip`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ClipName {
    /// A file or a built-in clip; empty for the model itself.
    file: String,
    /// Name or number of the animation; empty for the first one.
    animation: String,
    /// Range 0..1.
    weight: f32,
}

/// `--look-at`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LookAt {
    /// Wherever the camera is.
    Camera,
    /// World space, metres.
    Point(Vec3),
}

/// `FILE[#NAME][=WEIGHT]`: files may have `#` and `=` in their own names.
pub(crate) fn clip(text: &str) -> Result<ClipName, String> {
    let weighted = text.rsplit_once('=').and_then(|(name, weight)| Some((name, weight.parse::<f32>().ok()?)));
    let (name, weight) = weighted.unwrap_or((text, 1.0));
    if !(0.0..=1.0).contains(&weight) {
        return Err("weight: expected a number from 0 to 1".into());
    }
    let (file, animation) = if is_file_name(name) {
        (name, "")
    } else {
        name.rsplit_once('#').unwrap_or((name, ""))
    };
    if file.is_empty() && animation.is_empty() {
        return Err("expected FILE, FILE#NAME or #NAME, as walk or moves.glb#Jump=0.5".into());
    }
    Ok(ClipName { file: file.to_owned(), animation: animation.to_owned(), weight })
}

fn is_file_name(text: &str) -> bool {
    let ending = Path::new(text).extension().and_then(|e| e.to_str()).unwrap_or("");
    ["vrma", "vrm", "glb", "gltf"].iter().any(|known| ending.eq_ignore_ascii_case(known))
}

/// `camera` or `X,Y,Z`.
pub(crate) fn look_at(text: &str) -> Result<LookAt, String> {
    if text == "camera" {
        return Ok(LookAt::Camera);
    }
    args::xyz(text).map(|point| LookAt::Point(point.into())).map_err(|e| format!("{e}, nor camera"))
}

impl ClipName {
    /// A clip that is built in, by its name.
    pub(crate) fn built_in(name: &str) -> Self {
        Self { file: name.to_owned(), animation: String::new(), weight: 1.0 }
    }

    /// The name as it was given, without the weight.
    pub(crate) fn shown(&self) -> String {
        let Self { file, animation, .. } = self;
        if animation.is_empty() {
            file.clone()
        } else {
            format!("{file}#{animation}")
        }
    }

    /// The file, or a file of the built-in clip; `None` for the model itself.
    fn load(&self) -> Result<Option<Scene>, Failure> {
        if self.file.is_empty() {
            return Ok(None);
        }
        let path = PathBuf::from(&self.file);
        if path.exists() || is_file_name(&self.file) {
            return Ok(Some(load(path)?));
        }
        let Some(clip) = built_in::build(&self.file) else {
            let names = built_in::NAMES.join(", ");
            return Err(Failure::input(format!(
                "--clip {}: is no file, and none of the built-in clips: {names}",
                self.file
            )));
        };
        let file = format!("{}.vrma", self.file);
        Ok(Some(load_bytes(&file, &vrma::write(&clip), None, &Limits::default())?))
    }
}

/// Files of clips, read once for all models.
pub(crate) struct Sources<'a>(Vec<(&'a ClipName, Option<Scene>)>);

impl<'a> Sources<'a> {
    pub(crate) fn load(names: &'a [ClipName]) -> Result<Self, Failure> {
        names.iter().map(|name| Ok((name, name.load()?))).collect::<Result<_, _>>().map(Self)
    }

    /// The clips for a model; warns of what of them it cannot do.
    fn fit(&self, target: &Scene) -> Result<Vec<(Arc<Clip>, f32)>, Failure> {
        let fit = |(name, source): &(&ClipName, Option<Scene>)| {
            let clip = Clip::named(source.as_ref().unwrap_or(target), &name.animation, target)
                .map_err(|e| Failure::input(format!("--clip {}: {e}", name.shown())))?;
            for warning in &clip.warnings {
                warn(&format!("--clip {}: {}", name.shown(), shortened(warning)));
            }
            Ok((Arc::new(clip), name.weight))
        };
        self.0.iter().map(fit).collect()
    }
}

/// A built-in clip for a model; `None` where it has no humanoid bones.
pub(crate) fn built_in_for(name: &str, target: &Scene) -> Result<Option<Arc<Clip>>, Failure> {
    let name = ClipName::built_in(name);
    let clip = name.load()?.and_then(|source| Clip::of(&source, 0, target).ok());
    Ok(clip.map(Arc::new))
}

/// A list of names, the first ones of many.
fn shortened(list: &str) -> String {
    let mut names: Vec<&str> = list.split(", ").collect();
    let more = names.len().saturating_sub(SHOWN_NAMES);
    names.truncate(SHOWN_NAMES);
    let names = names.join(", ");
    if more > 0 {
        format!("{names} and {more} more")
    } else {
        names
    }
}

impl MotionArgs {
    /// Whether anything of it is asked for.
    pub(crate) fn is_some(&self) -> bool {
        !self.clip.is_empty() || self.look_at.is_some() || self.wind.is_some()
    }
}

/// The movement of one model.
pub(crate) struct Motion {
    skeleton: Skeleton,
    /// At the beginning of its clips.
    animator: Animator,
    place: Mat4,
    rest: Pose,
    /// Time after which all clips begin anew, seconds; `None` without clips.
    pub(crate) length_s: Option<f32>,
}

impl Motion {
    /// Of a model that stands at a place in a pose which clips go over.
    pub(crate) fn new(
        scene: &Scene,
        args: &MotionArgs,
        sources: &Sources<'_>,
        base: Pose,
        place: Mat4,
    ) -> Result<Self, Failure> {
        let skeleton = Skeleton::of(scene);
        let clips = sources.fit(scene)?;
        let mut animator = Animator::default();
        animator.base = Some(base);
        animator.springs.wind = args.wind.map(|force| Wind { force: force.into(), ..Wind::default() });
        if let Some(LookAt::Point(point)) = args.look_at {
            animator.gaze = Gaze::at(point).with_head(HEAD);
        }
        let play = |(clip, weight): &(Arc<Clip>, f32)| Play {
            weight: *weight,
            looped: is_loop(&skeleton, scene, clip),
            in_step: clip.ground_speed() > WALKS,
            root_motion: if args.travel {
                RootMotion::Actor
            } else {
                RootMotion::InPlace
            },
            ..Play::new(clip)
        };
        let plays: Vec<Play> = clips.iter().map(play).collect();
        let length_s = length_s(&plays);
        animator.player.layers = vec![Layer { plays, ..Layer::default() }];
        Ok(Self { skeleton, animator, place, rest: Pose::rest(scene), length_s })
    }

    /// Asks for expressions all the time.
    pub(crate) fn express(&mut self, expressions: &[(String, f32)]) -> Result<(), Failure> {
        for (name, weight) in expressions {
            self.animator.set_expression(&self.skeleton, name, *weight)?;
        }
        Ok(())
    }

    /// Lets it blink; in a movement that begins anew after `length_s`, blinks do too: none is cut off.
    pub(crate) fn blink(&mut self, seed: u64, length_s: f32) {
        let usual = Blink::default().every_s;
        let every_s = length_s / (length_s / usual).round().max(1.0);
        self.animator.blink = Some(Blink { seed, every_s });
    }

    /// Makes it look at a point from now on.
    pub(crate) fn look_at(&mut self, point: Vec3) {
        self.animator.gaze = Gaze::at(point).with_head(HEAD);
    }

    /// The movement from a moment of its clips on, swung in.
    pub(crate) fn from(&self, moment_s: f32) -> Moving<'_> {
        let mut moving = self.still_from(moment_s - self.swing_in_s());
        moving.update(0.0);
        moving.advance(self.swing_in_s());
        moving
    }

    /// Poses over the whole movement, without what swings: how much room it takes.
    pub(crate) fn outline(&self, count: usize) -> Vec<Pose> {
        let step = self.length_s.unwrap_or(0.0) / count as f32;
        let mut moving = self.still_from(0.0);
        moving.animator.springs.on = false;
        let pose = |_| {
            moving.update(0.0);
            let pose = moving.pose.clone();
            moving.animator.player.advance(step);
            pose
        };
        (0..count).map(pose).collect()
    }

    /// Whole blinks, so that a movement which begins anew finds itself where it was.
    fn swing_in_s(&self) -> f32 {
        let part = self.animator.blink.map_or(SWING_IN_S, |blink| blink.every_s);
        part * (SWING_IN_S / part).ceil()
    }

    fn still_from(&self, moment_s: f32) -> Moving<'_> {
        let mut animator = self.animator.clone();
        animator.player.advance(moment_s);
        let world = self.place * animator.player.take_root_motion();
        Moving { skeleton: &self.skeleton, animator, world, pose: self.rest.clone() }
    }
}

/// A movement at a moment.
pub(crate) struct Moving<'a> {
    skeleton: &'a Skeleton,
    animator: Animator,
    pub(crate) world: Mat4,
    pub(crate) pose: Pose,
}

impl Moving<'_> {
    /// Moves time on, in steps that lose nothing of the swinging.
    pub(crate) fn advance(&mut self, seconds: f32) {
        let steps = (seconds / STEP_S - 1e-3).ceil().max(1.0);
        for _ in 0..steps as u32 {
            self.update(seconds / steps);
        }
    }

    /// Moves the point that it looks at.
    pub(crate) fn look_at(&mut self, point: Vec3) {
        self.animator.gaze.target = Some(GazeTarget::Point(point));
    }

    fn update(&mut self, dt: f32) {
        self.animator.update(self.skeleton, &mut self.world, &mut self.pose, dt);
    }
}

/// Time after which all clips begin anew: the longest, where those that keep step take their common time.
fn length_s(plays: &[Play]) -> Option<f32> {
    let (in_step, alone): (Vec<&Play>, Vec<&Play>) = plays.iter().partition(|p| p.in_step && p.looped);
    let weight = |p: &Play| p.weight.max(1e-6);
    let cycles_a_s: f32 = in_step.iter().map(|p| weight(p) / p.clip.length_s).sum();
    let common = (!in_step.is_empty()).then(|| in_step.iter().map(|p| weight(p)).sum::<f32>() / cycles_a_s);
    alone.iter().map(|p| p.clip.length_s).chain(common).reduce(f32::max)
}

/// Whether a clip ends where it began, but for its way over the ground.
fn is_loop(skeleton: &Skeleton, scene: &Scene, clip: &Arc<Clip>) -> bool {
    let at = |time_s: f32| {
        let mut animator = Animator::default();
        animator.player.base().plays =
            vec![Play { time_s: f64::from(time_s), root_motion: RootMotion::InPlace, ..Play::once(clip) }];
        let mut pose = Pose::rest(scene);
        animator.play(skeleton, &mut pose);
        pose
    };
    let (start, end) = (at(0.0), at(clip.length_s));
    start.locals.iter().zip(&end.locals).all(|(a, b)| {
        let apart = a.translation.distance(b.translation);
        a.rotation.angle_between(b.rotation) <= CLOSE[0] && apart <= CLOSE[1] * a.translation.length().max(0.1)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clip_is_a_file_an_animation_and_a_weight() {
        let name = |file: &str, animation: &str, weight| {
            Ok(ClipName { file: file.into(), animation: animation.into(), weight })
        };
        assert_eq!(clip("walk"), name("walk", "", 1.0));
        assert_eq!(clip("walk=0.25"), name("walk", "", 0.25));
        assert_eq!(clip("a b.glb#Jump.001=1"), name("a b.glb", "Jump.001", 1.0));
        assert_eq!(clip("#2"), name("", "2", 1.0));
        assert_eq!(clip("take#3=b.vrma"), name("take#3=b.vrma", "", 1.0));
        for (text, said) in
            [("walk=2", "weight"), ("walk=-1", "weight"), ("walk=nan", "weight"), ("", "FILE"), ("=1", "FILE")]
        {
            assert!(clip(text).is_err_and(|e| e.contains(said)), "{text}");
        }
        assert_eq!(look_at("camera"), Ok(LookAt::Camera));
        assert_eq!(look_at("-1, 2,0.5"), Ok(LookAt::Point(Vec3::new(-1.0, 2.0, 0.5))));
        assert!(look_at("left").is_err_and(|e| e.contains("camera")));
    }

    #[test]
    fn a_loop_ends_where_it_began_with_its_hair_and_its_lids() {
        let scene = crate::setup::load(None).unwrap();
        for name in ["walk", "idle"] {
            let args = MotionArgs { clip: vec![ClipName::built_in(name)], travel: true, look_at: None, wind: None };
            let sources = Sources::load(&args.clip).unwrap();
            let mut motion = Motion::new(&scene, &args, &sources, Pose::rest(&scene), Mat4::IDENTITY).unwrap();
            let length_s = motion.length_s.unwrap();
            motion.blink(1, length_s);
            let mut moving = motion.from(0.0);
            let first = moving.pose.clone();
            assert!(moving.world.abs_diff_eq(Mat4::IDENTITY, 1e-3), "{name}: {}", moving.world);
            for _ in 0..20 {
                moving.advance(length_s / 20.0);
            }
            for (node, (a, b)) in first.locals.iter().zip(&moving.pose.locals).enumerate() {
                let angle = a.rotation.angle_between(b.rotation).to_degrees();
                assert!(angle < 3.0, "{name}: {}, {angle}", scene.nodes[node].name);
            }
            let weights = first.morph_weights.iter().flatten().zip(moving.pose.morph_weights.iter().flatten());
            assert!(weights.clone().all(|(a, b)| (a - b).abs() < 0.02), "{name}");
            assert_eq!(name == "walk", moving.world.w_axis.z > 0.3);
        }
    }

    #[test]
    fn long_lists_are_counted() {
        assert_eq!(shortened("no bones: a, b"), "no bones: a, b");
        assert_eq!(shortened("lacks: a, b, c, d, e, f, g, h"), "lacks: a, b, c, d, e, f and 2 more");
    }

    #[test]
    fn every_built_in_clip_is_found_and_fits_the_built_in_character() {
        let scene = crate::setup::load(None).unwrap();
        for name in built_in::NAMES {
            let names = [ClipName::built_in(name)];
            let clips = Sources::load(&names).unwrap().fit(&scene).unwrap();
            assert!(clips[0].0.length_s > 0.5, "{name}");
            assert_eq!(clips[0].0.warnings, [""; 0], "{name}");
            assert!(is_loop(&Skeleton::of(&scene), &scene, &clips[0].0), "{name}");
        }
    }
}
