//! Actors that move: together as alone, at full rate and at lower ones.

use std::path::Path;
use std::sync::Arc;

use hikage::motion::{Blink, Clip, Play, Pose, RootMotion, SPRING_STEP_S};
use hikage::scene::Scene;
use hikage::{Actor, Character, Stage, View};

use crate::support::{gpu, with_renderer};

fn file(name: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracles/motion/models");
    hikage::import::load(folder.join(name)).expect("a model")
}

/// Actors in a row, each at its own moment of a clip.
fn cast(character: &Character, clip: &Arc<Clip>, count: usize) -> Vec<Actor> {
    let actor = |i: usize| {
        let mut actor = Actor::new(character).at([i as f32, 0.0, 0.0], 0.1 * i as f32);
        actor.animator.blink = Some(Blink { seed: i as u64, ..Blink::default() });
        let play = Play { time_s: i as f64 * 0.3, root_motion: RootMotion::Actor, ..Play::new(clip) };
        actor.animator.player.base().plays.push(play);
        actor
    };
    (0..count).map(actor).collect()
}

fn poses(actors: &[Actor]) -> Vec<(Pose, glam::Mat4)> {
    actors.iter().map(|a| (a.pose.clone(), a.world)).collect()
}

#[test]
fn many_actors_move_as_each_alone() {
    let gpu = gpu();
    let (scene, moves) = (file("everything.vrm"), file("moves.vrma"));
    with_renderer(&gpu, |renderer| {
        let character = renderer.upload(&scene).expect("an upload");
        let clip = Arc::new(Clip::of(&moves, 0, character.scene()).expect("a clip"));
        let mut alone = cast(&character, &clip, 12);
        let mut stage = Stage::of(cast(&character, &clip, 12));
        for frame in 0..40 {
            let dt = 0.01 + 0.0007 * (frame % 5) as f32;
            stage.update(dt);
            alone.iter_mut().for_each(|actor| actor.update(dt));
        }
        assert_eq!(poses(&stage.actors), poses(&alone));
        assert!(stage.time_s > 0.4);
        // What moves can be drawn.
        let view = View::framed_stage(&stage, hikage::scene::Framing::Full, 0.0, [32, 32]);
        renderer.render(&mut stage, &view).expect("a picture");
    });
}

#[test]
fn small_actors_take_turns_and_lose_no_time() {
    let gpu = gpu();
    let (scene, moves) = (file("everything.vrm"), file("moves.vrma"));
    with_renderer(&gpu, |renderer| {
        let character = renderer.upload(&scene).expect("an upload");
        let clip = Arc::new(Clip::of(&moves, 0, character.scene()).expect("a clip"));
        let mut stage = Stage::of(cast(&character, &clip, 4));
        for (actor, z) in stage.actors.iter_mut().zip([0.0, -12.0, -25.0, -80.0]) {
            actor.world.w_axis.z = z;
        }
        let mut view = View { size: [1280, 720], ..View::default() };
        view.camera.eye.z = 4.0;
        stage.calm_far(&view);
        let every: Vec<u32> = stage.actors.iter().map(|a| a.every).collect();
        assert_eq!(every[0], 1, "{every:?}");
        assert!(every.is_sorted() && every[3] == 4, "{every:?}");

        let mut changes = [0; 4];
        let mut last = poses(&stage.actors);
        for _ in 0..24 {
            stage.update(SPRING_STEP_S);
            let now = poses(&stage.actors);
            for (changes, (now, last)) in changes.iter_mut().zip(now.iter().zip(&last)) {
                *changes += usize::from(now != last);
            }
            last = now;
        }
        assert_eq!(changes.map(|n| 24 / n), [every[0], every[1], every[2], every[3]].map(|n| n as usize));
        // Each has lived through the same time but for the turn that it waits for.
        for actor in &stage.actors {
            let waited = 24.0 * f64::from(SPRING_STEP_S) - actor.animator.time_s();
            assert!((-1e-4..f64::from(actor.every) / 60.0).contains(&waited), "{waited} s");
        }
    });
}

#[test]
fn a_posed_actor_keeps_its_pose_below_its_clips() {
    let gpu = gpu();
    let scene = file("everything.vrm");
    with_renderer(&gpu, |renderer| {
        let character = renderer.upload(&scene).expect("an upload");
        let mut pose = Pose::rest(character.scene());
        pose.turn(character.scene(), hikage::scene::HumanBone::LeftUpperArm, glam::Quat::from_rotation_z(0.7));
        let mut actor = Actor::new(&character).posed(pose.clone());
        actor.animator.springs.on = false;
        actor.update(SPRING_STEP_S);
        let arm = character.scene().bone_node(hikage::scene::HumanBone::LeftUpperArm).expect("an arm");
        assert_eq!(actor.pose.locals[arm], pose.locals[arm]);
    });
}
