//! Poses of one model over time, by its clips, gaze, wind and springs.

use std::sync::Arc;

use glam::{Mat4, Vec3};
use hikage::motion::{Animator, Blink, Clip, Gaze, GazeTarget, Layer, Play, Pose, RootMotion, Skeleton, Wind};
use hikage::scene::Scene;

use crate::clips::{LookAt, MotionArgs, Sources};
use crate::failure::Failure;

/// Time before a moment in which chains swing in, seconds: then they hang as they do in motion.
const SWING_IN_S: f32 = 2.0;
/// Longest step of the swinging, seconds: that of the springs themselves.
const STEP_S: f32 = hikage::motion::SPRING_STEP_S;
/// Share of the way to what is looked at that the head turns.
const HEAD: f32 = 0.6;
/// Speed over the ground, metres a second, from which on clips keep step with each other.
const WALKS: f32 = 0.05;
/// Angle (radians) and share of the distance to the parent by which the end of a clip may miss its beginning in a loop.
const CLOSE: [f32; 2] = [0.1, 0.05];

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
    use crate::clips::ClipName;
    use hikage_character::clips as built_in;

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
