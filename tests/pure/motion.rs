//! Laws of motion: springs (no drift, constant length, symmetry, independence of the display's rate), and of blending. The
//! characters are the generated ones of the reference scenarios.

use std::path::Path;
use std::sync::Arc;

use hikage::glam::{Mat4, Quat, Vec3};
use hikage::import::load;
use hikage::motion::{
    Animator, Blink, Clip, Curve, Gaze, Layer, Mask, Play, Pose, RootMotion, SPRING_STEP_S, Skeleton, Wind,
};
use hikage::scene::{
    Animation, AnimationChannel, AnimationValues, Character, HumanBone, Interpolation, Node, Scene, Transform,
};

fn model(name: &str) -> Scene {
    load(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/oracles/motion/models").join(name)).expect("a model")
}

/// A character that moves, in its place.
struct Mover {
    scene: Scene,
    skeleton: Skeleton,
    animator: Animator,
    world: Mat4,
    pose: Pose,
}

impl Mover {
    fn of(scene: Scene) -> Self {
        let (skeleton, pose) = (Skeleton::of(&scene), Pose::rest(&scene));
        Self { scene, skeleton, animator: Animator::default(), world: Mat4::IDENTITY, pose }
    }

    fn playing(mut self, clip: &Scene) -> Self {
        let clip = Clip::of(clip, 0, &self.scene).expect("a clip");
        self.animator.player.play(&Arc::new(clip));
        self
    }

    fn update(&mut self, dt: f32) {
        self.animator.update(&self.skeleton, &mut self.world, &mut self.pose, dt);
    }

    fn go_on(&mut self, frames: usize, dt: f32) {
        (0..frames).for_each(|_| self.update(dt));
    }

    fn places(&self) -> Vec<Mat4> {
        self.scene.world_from_nodes(&self.pose.locals).into_iter().map(|m| self.world * m).collect()
    }

    /// Pairs of neighbours in its chains.
    fn pairs(&self) -> Vec<(usize, usize)> {
        let springs = &self.scene.character.as_ref().expect("a character").springs;
        springs.iter().flat_map(|s| s.joints.windows(2)).map(|pair| (pair[0].node, pair[1].node)).collect()
    }
}

/// Greatest distance between two sets of places, metres.
fn apart(a: &[Mat4], b: &[Mat4]) -> f32 {
    a.iter().zip(b).map(|(a, b)| a.w_axis.distance(b.w_axis)).fold(0.0, f32::max)
}

#[test]
fn chains_come_to_rest_and_stay_there() {
    for name in ["springs.vrm", "everything.vrm"] {
        let mut mover = Mover::of(model(name));
        mover.go_on(3000, SPRING_STEP_S);
        let before = mover.places();
        mover.go_on(3000, SPRING_STEP_S);
        assert!(apart(&before, &mover.places()) < 2e-5, "{name} drifts by {} m", apart(&before, &mover.places()));
    }
}

#[test]
fn bones_keep_their_length() {
    let mut mover = Mover::of(model("springs.vrm"));
    let lengths = |m: &Mover| -> Vec<f32> {
        let places = m.places();
        m.pairs().iter().map(|(a, b)| places[*a].w_axis.distance(places[*b].w_axis)).collect()
    };
    let rest = lengths(&mover);
    for frame in 0..240 {
        let time = frame as f32 / 60.0;
        mover.world = Mat4::from_rotation_translation(Quat::from_rotation_y(time * 3.0), Vec3::X * (time * 9.0).sin());
        mover.update(SPRING_STEP_S);
        for (now, rest) in lengths(&mover).iter().zip(&rest) {
            assert!((now - rest).abs() < 1e-5, "{now} m, at rest {rest} m");
        }
    }
}

#[test]
fn turning_the_world_about_the_vertical_turns_the_swinging_with_it() {
    let run = |turn: Mat4| {
        let mut mover = Mover::of(model("everything.vrm"));
        for frame in 0..120 {
            let time = frame as f32 / 60.0;
            mover.world = turn * Mat4::from_translation(Vec3::new((time * 8.0).sin() * 0.2, 0.0, time * 1.5));
            mover.update(SPRING_STEP_S);
        }
        mover.places()
    };
    let turn = Mat4::from_rotation_y(2.1);
    let turned: Vec<Mat4> = run(Mat4::IDENTITY).into_iter().map(|m| turn * m).collect();
    assert!(apart(&turned, &run(turn)) < 2e-4, "{} m", apart(&turned, &run(turn)));
}

#[test]
fn far_from_the_origin_hair_swings_as_near_it() {
    let run = |origin: Vec3| {
        let mut mover = Mover::of(model("everything.vrm"));
        for frame in 0..120 {
            let x = (frame as f32 / 60.0 * 8.0).sin() * 0.25;
            // Places that both can say exactly.
            mover.world = Mat4::from_translation(origin + Vec3::X * (x * 64.0).round() / 64.0);
            mover.update(SPRING_STEP_S);
        }
        mover.pose
    };
    let (near, far) = (run(Vec3::ZERO), run(Vec3::new(4096.0, 0.0, -2048.0)));
    for (a, b) in near.locals.iter().zip(&far.locals) {
        assert!(a.rotation.abs_diff_eq(b.rotation, 1e-4), "{} {}", a.rotation, b.rotation);
    }
}

#[test]
fn a_small_character_swings_as_a_large_one() {
    let run = |size: f32| {
        let mut mover = Mover::of(model("springs.vrm"));
        for frame in 0..90 {
            let x = (frame as f32 / 60.0 * 7.0).sin() * 0.1;
            mover.world = Mat4::from_translation(Vec3::X * x * size) * Mat4::from_scale(Vec3::splat(size));
            mover.update(SPRING_STEP_S);
        }
        mover.pose
    };
    for (a, b) in run(1.0).locals.iter().zip(&run(0.25).locals) {
        assert!(a.rotation.abs_diff_eq(b.rotation, 1e-4), "{} {}", a.rotation, b.rotation);
    }
}

#[test]
fn the_rate_of_the_display_does_not_matter() {
    let clip = model("moves.vrma");
    let run = |rate: usize| {
        let mut mover = Mover::of(model("everything.vrm")).playing(&clip);
        for frame in 0..rate * 2 {
            let time = (frame + 1) as f32 / rate as f32;
            mover.world = Mat4::from_translation(Vec3::X * (0.15 * (time * 6.0).sin()));
            mover.update(1.0 / rate as f32);
        }
        mover.places()
    };
    let at_60 = run(60);
    for (rate, most) in [(30, 0.02), (90, 0.01), (144, 0.01), (240, 0.01)] {
        let gap = apart(&at_60, &run(rate));
        assert!(gap < most, "{rate} Hz: {gap} m from 60 Hz");
    }
}

#[test]
fn two_together_are_each_alone_and_a_clone_goes_on_as_its_original() {
    let clip = model("moves.vrma");
    let fresh = || {
        let mut mover = Mover::of(model("everything.vrm")).playing(&clip);
        mover.animator.blink = Some(Blink { seed: 3, ..Blink::default() });
        mover.animator.gaze = Gaze::at([0.4, 1.2, 2.0]).with_head(0.5);
        mover.animator.gaze.saccades = Some(5);
        mover.animator.springs.wind = Some(Wind { force: Vec3::X * 0.2, ..Wind::default() });
        mover
    };
    let (mut alone, mut first, mut second) = (fresh(), fresh(), fresh());
    second.world = Mat4::from_translation(Vec3::Z);
    alone.go_on(50, 0.013);
    for _ in 0..50 {
        first.update(0.013);
        second.update(0.02);
    }
    assert_eq!(alone.pose, first.pose);
    assert_ne!(first.pose, second.pose);

    let (saved, pose, world) = (first.animator.clone(), first.pose.clone(), first.world);
    first.go_on(40, 0.017);
    let mut loaded = Mover { animator: saved, pose, world, ..fresh() };
    loaded.go_on(40, 0.017);
    assert_eq!(loaded.pose, first.pose);
    assert_eq!(loaded.animator, first.animator);
}

#[test]
fn time_that_stands_still_moves_nothing() {
    let mut mover = Mover::of(model("everything.vrm")).playing(&model("moves.vrma"));
    mover.go_on(30, SPRING_STEP_S);
    let before = mover.pose.clone();
    for dt in [0.0, -1.0, f32::NAN] {
        mover.update(dt);
        assert_eq!(mover.pose, before, "dt {dt}");
    }
}

#[test]
fn hair_comes_along_where_its_character_jumps() {
    let mut mover = Mover::of(model("springs.vrm"));
    mover.go_on(120, SPRING_STEP_S);
    let before = mover.pose.clone();
    let to = Mat4::from_rotation_translation(Quat::from_rotation_y(2.0), Vec3::new(40.0, 3.0, -9.0));
    let turned = |a: &Pose, b: &Pose| {
        let angles = a.locals.iter().zip(&b.locals).map(|(a, b)| a.rotation.angle_between(b.rotation));
        angles.fold(0.0, f32::max)
    };
    let mut thrown =
        Mover { animator: mover.animator.clone(), pose: before.clone(), ..Mover::of(model("springs.vrm")) };
    thrown.world = to;
    thrown.update(SPRING_STEP_S);
    thrown.update(SPRING_STEP_S);
    assert!(turned(&thrown.pose, &before) > 0.5);
    mover.animator.warp(&mover.skeleton, &mover.world, &to);
    mover.world = to;
    mover.update(SPRING_STEP_S);
    mover.update(SPRING_STEP_S);
    // One chain is pulled sideways, by a direction of the world.
    assert!(turned(&mover.pose, &before) < 0.3, "{}", turned(&mover.pose, &before));
}

#[test]
fn springs_that_are_off_leave_the_pose_alone() {
    let mut mover = Mover::of(model("springs.vrm"));
    mover.animator.springs.on = false;
    mover.world = Mat4::from_translation(Vec3::X);
    mover.go_on(10, SPRING_STEP_S);
    assert_eq!(mover.pose.locals, Pose::rest(&mover.scene).locals);
}

/// Two bones of a body, one turned by each clip, and a morph.
fn body() -> Scene {
    let node = |name: &str, parent, y: f32| Node {
        name: name.to_owned(),
        parent,
        transform: Transform { translation: Vec3::Y * y, rotation: Quat::from_rotation_z(0.3), ..Transform::default() },
        morph_weights: vec![0.25],
        ..Node::default()
    };
    let turns = |angle: f32| {
        let key = |a: f32| (Quat::from_rotation_z(0.3) * Quat::from_rotation_x(a)).to_array();
        let channel = |node, values| AnimationChannel {
            node,
            times: vec![0.0, 1.0],
            interpolation: Interpolation::Linear,
            values,
        };
        Animation {
            name: format!("turn {angle}"),
            channels: vec![
                channel(0, AnimationValues::Rotation(vec![key(0.0), key(angle)])),
                channel(1, AnimationValues::Rotation(vec![key(angle), key(0.0)])),
                channel(0, AnimationValues::Translation(vec![[0.0, 1.0, 0.0], [0.0, 1.0, angle]])),
                channel(1, AnimationValues::MorphWeights(vec![0.0, angle])),
            ],
        }
    };
    Scene {
        nodes: vec![node("hips", None, 1.0), node("spine", Some(0), 0.2)],
        animations: vec![turns(0.8), turns(-0.6)],
        character: Some(Character {
            bones: [(HumanBone::Hips, 0), (HumanBone::Spine, 1)].into(),
            ..Character::default()
        }),
        ..Scene::default()
    }
}

fn clips(scene: &Scene) -> [Arc<Clip>; 2] {
    [0, 1].map(|i| Arc::new(Clip::of(scene, i, scene).expect("a clip")))
}

fn at(clip: &Arc<Clip>, time_s: f64) -> Play {
    Play { time_s, ..Play::new(clip) }
}

/// The pose of some layers, over rest.
fn sampled(scene: &Scene, layers: Vec<Layer>) -> Pose {
    let (skeleton, mut pose) = (Skeleton::of(scene), Pose::rest(scene));
    let mut animator = Animator::default();
    animator.player.layers = layers;
    animator.play(&skeleton, &mut pose);
    pose
}

#[test]
fn weights_of_nothing_and_of_all_are_exact() {
    let scene = body();
    let [a, b] = clips(&scene);
    let of = |plays: Vec<Play>| Layer { plays, ..Layer::default() };
    let only = sampled(&scene, vec![of(vec![at(&a, 0.37)])]);
    let with_nothing = Play { weight: 0.0, ..at(&b, 0.9) };
    assert_eq!(sampled(&scene, vec![of(vec![with_nothing.clone()])]), Pose::rest(&scene));
    for plays in [vec![at(&a, 0.37), with_nothing.clone()], vec![with_nothing, at(&a, 0.37)]] {
        assert_eq!(sampled(&scene, vec![of(plays)]), only);
    }
    // A layer at full weight hides all below it.
    assert_eq!(sampled(&scene, vec![of(vec![at(&b, 0.2)]), of(vec![at(&a, 0.37)])]), only);
}

#[test]
fn half_of_a_clip_is_half_of_the_way_from_what_is_below() {
    let scene = body();
    let [a, _] = clips(&scene);
    let half = sampled(&scene, vec![Layer { plays: vec![Play { weight: 0.5, ..at(&a, 0.999) }], ..Layer::default() }]);
    let whole = sampled(&scene, vec![Layer { plays: vec![at(&a, 0.999)], ..Layer::default() }]);
    let rest = Pose::rest(&scene);
    let angle = |p: &Pose| rest.locals[0].rotation.angle_between(p.locals[0].rotation);
    assert!((angle(&half) * 2.0 - angle(&whole)).abs() < 1e-4);
    let mean = (rest.morph_weights[1][0] + whole.morph_weights[1][0]) * 0.5;
    assert!((half.morph_weights[1][0] - mean).abs() < 1e-6);
}

#[test]
fn what_is_added_at_its_reference_is_nothing() {
    let scene = body();
    let [a, b] = clips(&scene);
    let below = || Layer { plays: vec![at(&a, 0.6)], ..Layer::default() };
    let on_top = |time, weight| {
        let mut layer = Layer::additive();
        layer.plays.push(Play { weight, ..at(&b, time) });
        sampled(&scene, vec![below(), layer])
    };
    let alone = sampled(&scene, vec![below()]);
    for (added, plain) in on_top(0.0, 1.0).locals.iter().zip(&alone.locals) {
        assert!(added.rotation.angle_between(plain.rotation) < 1e-3 && added.translation == plain.translation);
    }
    assert_eq!(on_top(0.7, 0.0).locals, alone.locals);
    assert!(on_top(0.7, 1.0).locals[0].rotation.angle_between(alone.locals[0].rotation) > 0.3);
}

#[test]
fn masks_keep_to_their_bones() {
    let scene = body();
    let [a, b] = clips(&scene);
    let mask = Arc::new(Mask::below(&Skeleton::of(&scene), HumanBone::Spine));
    let layers = vec![
        Layer { plays: vec![at(&a, 0.5)], ..Layer::default() },
        Layer { plays: vec![Play { mask: Some(mask), ..at(&b, 0.5) }], ..Layer::default() },
    ];
    let pose = sampled(&scene, layers);
    let of = |clip| sampled(&scene, vec![Layer { plays: vec![at(clip, 0.5)], ..Layer::default() }]);
    assert_eq!((pose.locals[0], pose.locals[1]), (of(&a).locals[0], of(&b).locals[1]));
}

#[test]
fn cross_fades_do_not_jump_even_when_broken_off() {
    let scene = body();
    let [a, b] = clips(&scene);
    for curve in [Curve::Linear, Curve::Smooth] {
        let mut mover = Mover::of(scene.clone());
        mover.animator.player.base().plays.push(Play::once(&a));
        let mut last = None::<Pose>;
        for frame in 0..240 {
            let next = match frame {
                30 | 66 => Some(&b),
                50 | 130 => Some(&a),
                _ => None,
            };
            if let Some(clip) = next {
                mover.animator.player.base().cross_fade(Play::once(clip), 0.4, curve);
            }
            mover.update(SPRING_STEP_S);
            if let Some(last) = &last {
                for (now, before) in mover.pose.locals.iter().zip(&last.locals) {
                    assert!(now.rotation.angle_between(before.rotation) < 0.1, "frame {frame}");
                    assert!(now.translation.distance(before.translation) < 0.09, "frame {frame}");
                }
            }
            last = Some(mover.pose.clone());
            let weights: f32 = mover.animator.player.layers[0].plays.iter().map(|p| p.weight).sum();
            assert!((weights - 1.0).abs() < 1e-5, "frame {frame}: weights sum to {weights}");
        }
        assert_eq!(mover.animator.player.layers[0].plays.len(), 1);
    }
}

#[test]
fn clips_in_step_stay_in_step() {
    let scene = body();
    let [a, b] = clips(&scene);
    let mut long = (*b).clone();
    long.length_s = 2.0;
    let long = Arc::new(long);
    let mut mover = Mover::of(scene);
    mover.animator.player.base().plays.push(Play { in_step: true, time_s: 0.3, ..Play::new(&a) });
    mover.animator.player.base().cross_fade(Play { in_step: true, ..Play::new(&long) }, 0.5, Curve::Linear);
    for _ in 0..25 {
        mover.update(SPRING_STEP_S);
        let [one, two] = &mover.animator.player.layers[0].plays[..] else { panic!("one has gone") };
        let phase = |p: &Play| p.clip_time() / f64::from(p.clip.length_s);
        assert!((phase(one) - phase(two)).abs() < 1e-5);
    }
}

#[test]
fn the_way_of_the_hips_becomes_the_actors_loop_after_loop() {
    let mut scene = body();
    // Half a metre ahead and a quarter turn in a second.
    let quarter = std::f32::consts::FRAC_PI_2;
    let channel =
        |values| AnimationChannel { node: 0, times: vec![0.0, 1.0], interpolation: Interpolation::Linear, values };
    let turned = (Quat::from_rotation_y(quarter) * Quat::from_rotation_z(0.3)).to_array();
    let straight = Quat::from_rotation_z(0.3).to_array();
    for turns in [false, true] {
        let rotations = vec![straight, if turns { turned } else { straight }];
        scene.animations = vec![Animation {
            name: "walk".to_owned(),
            channels: vec![
                channel(AnimationValues::Translation(vec![[0.0, 1.0, 0.0], [0.1, 1.0, 0.5]])),
                channel(AnimationValues::Rotation(rotations)),
            ],
        }];
        let clip = Arc::new(Clip::of(&scene, 0, &scene).expect("a clip"));
        assert!((clip.ground_speed() - 0.26f32.sqrt()).abs() < 1e-5);
        let run = |root_motion, frames| {
            let mut mover = Mover::of(scene.clone());
            mover.animator.player.base().plays.push(Play { root_motion, ..Play::new(&clip) });
            let mut places = Vec::new();
            for _ in 0..frames {
                mover.update(0.04);
                places.push((mover.places()[0], mover.world));
            }
            places
        };
        // Within the first loop, nothing moves but what says so.
        let (kept, moved) = (run(RootMotion::Keep, 24), run(RootMotion::Actor, 110));
        for ((kept, _), (moved, _)) in kept.iter().zip(&moved) {
            assert!(kept.abs_diff_eq(*moved, 1e-4), "{kept} {moved}");
        }
        // After it, the way goes on without a jump.
        for pair in moved.windows(2) {
            let step = pair[0].0.w_axis.distance(pair[1].0.w_axis);
            assert!((0.015..0.026).contains(&step), "a step of {step} m");
        }
        let heading = moved[99].1.transform_vector3(Vec3::Z);
        if turns {
            assert!(heading.distance(Vec3::Z) < 1e-3, "four quarters are whole: {heading}");
        } else {
            assert!(moved[99].1.w_axis.truncate().distance(Vec3::new(0.4, 0.0, 2.0)) < 1e-3);
        }
        let in_place = run(RootMotion::InPlace, 50);
        assert!(
            in_place.iter().all(|(hips, world)| {
                *world == Mat4::IDENTITY && (hips.w_axis.truncate() - Vec3::Y).length() < 0.01
            })
        );
    }
}

#[test]
fn names_of_another_tool_carry_a_clip_over() {
    // Arms that hang down at rest, bones that lie along other axes, and centimetres.
    let lie = Quat::from_rotation_x(0.7);
    let node = |name: &str, parent, at: [f32; 3]| Node {
        name: name.to_owned(),
        parent,
        transform: Transform { translation: at.into(), ..Transform::default() },
        ..Node::default()
    };
    let mut source = Scene {
        nodes: vec![
            node("mixamorig:Hips", None, [0.0, 100.0, 0.0]),
            node("mixamorig:Head", Some(0), [0.0, 60.0, 0.0]),
            node("mixamorig:LeftUpLeg", Some(0), [10.0, 0.0, 0.0]),
            node("mixamorig:RightUpLeg", Some(0), [-10.0, 0.0, 0.0]),
            node("mixamorig:LeftArm", Some(0), [20.0, 40.0, 0.0]),
            node("mixamorig:LeftForeArm", Some(4), [0.0, -25.0, 0.0]),
            node("mixamorig:RightArm", Some(0), [-20.0, 40.0, 0.0]),
            node("mixamorig:RightForeArm", Some(6), [0.0, -25.0, 0.0]),
        ],
        ..Scene::default()
    };
    source.nodes[4].transform.rotation = lie;
    source.nodes[5].transform.translation = lie.inverse() * Vec3::new(0.0, -25.0, 0.0);
    // The left arm swings ahead by a quarter, the hips rise by a tenth of their height.
    let ahead = Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2);
    let channel =
        |node, values| AnimationChannel { node, times: vec![0.0, 1.0], interpolation: Interpolation::Linear, values };
    source.animations = vec![Animation {
        name: "reach".to_owned(),
        channels: vec![
            channel(4, AnimationValues::Rotation(vec![lie.to_array(), (ahead * lie).to_array()])),
            channel(0, AnimationValues::Translation(vec![[0.0, 100.0, 0.0], [0.0, 110.0, 0.0]])),
        ],
    }];
    let target = model("rig.vrm");
    let clip = Arc::new(Clip::of(&source, 0, &target).expect("a clip"));
    let reach = |time_s| {
        let play = Play { time_s, looped: false, ..Play::new(&clip) };
        let pose = sampled(&target, vec![Layer { plays: vec![play], ..Layer::default() }]);
        let places = target.world_from_nodes(&pose.locals);
        let of = |bone| places[target.bone_node(bone).expect("a bone")].w_axis.truncate();
        let arm = of(HumanBone::LeftLowerArm) - of(HumanBone::LeftUpperArm);
        (arm.normalize(), of(HumanBone::Hips).y)
    };
    let ((down, low), (out, high)) = (reach(0.0), reach(1.0));
    assert!(down.distance(Vec3::NEG_Y) < 1e-3, "arms hang at rest: {down}");
    assert!(out.distance(Vec3::Z) < 1e-3, "and swing ahead: {out}");
    assert!((high / low - 1.1).abs() < 1e-4, "hips rise by their height: {low} {high}");
}

#[test]
fn clips_that_do_not_fit_say_so() {
    let (scene, rig) = (body(), model("rig.vrm"));
    let error = Clip::of(&scene, 7, &scene).expect_err("no such").to_string();
    assert!(error.contains("animation 7") && error.contains("has 2 animations"), "{error}");
    let error = Clip::named(&scene, "dance", &scene).expect_err("no such").to_string();
    assert!(error.contains("turn 0.8, turn -0.6"), "{error}");
    let mut strange = body();
    strange.character = None;
    strange.nodes[0].name = "wheel".to_owned();
    strange.nodes[1].name = "axle".to_owned();
    let error = Clip::of(&strange, 0, &rig).expect_err("nothing fits").to_string();
    assert!(error.contains("nothing of it fits"), "{error}");
}

#[test]
fn a_head_follows_smoothly_and_eyes_do_the_rest() {
    let mut mover = Mover::of(model("rig.vrm"));
    let head = mover.scene.bone_node(HumanBone::Head).expect("a head");
    mover.update(SPRING_STEP_S);
    let start = mover.places()[head];
    let target = start.w_axis.truncate() + Vec3::new(1.0, 0.06, 1.0);
    mover.animator.gaze = Gaze::at(target).with_head(0.6);
    let turned = |m: &Mover| {
        let turn = m.places()[head] * start.inverse();
        turn.transform_vector3(Vec3::Z).x.asin()
    };
    let mut last = 0.0;
    for _ in 0..240 {
        mover.update(SPRING_STEP_S);
        let now = turned(&mover);
        assert!((now - last).abs() < 0.06, "from {last} to {now}");
        last = now;
    }
    let whole = std::f32::consts::FRAC_PI_4;
    assert!((last - 0.6 * whole).abs() < 0.12, "the head has turned by {last}");
    let eyes = mover.animator.gaze_angles().expect("a gaze")[0];
    assert!((last + eyes - whole).abs() < 0.05, "head {last} and eyes {eyes}");
}

#[test]
fn expressions_are_asked_for_by_name() {
    let mut mover = Mover::of(model("expressions.vrm"));
    mover.animator.set_expression(&mover.skeleton, "happy", 0.5).expect("known");
    mover.update(0.0);
    let shown = |m: &Mover, name: &str| m.animator.shown(&m.skeleton).find(|(n, _)| *n == name).map(|(_, w)| w);
    assert_eq!(shown(&mover, "happy"), Some(0.5));
    let error = mover.animator.set_expression(&mover.skeleton, "hapy", 1.0).expect_err("unknown").to_string();
    assert!(error.contains("happy"), "{error}");
    mover.animator.blink = Some(Blink::default());
    let closed = (0..600).map(|_| {
        mover.update(SPRING_STEP_S);
        shown(&mover, "blink").unwrap_or(0.0)
    });
    assert!(closed.fold(0.0, f32::max) > 0.4);
}
