//! Several actors on one stage.

use glam::{Mat4, Quat, Vec3};
use hikage::material::{Alpha, AlphaMode, CastShadow, Glow, Outline, OutlineWidth};
use hikage::motion::Pose;
use hikage::scene::{Bloom, Framing, Image, Post, Role, Scene, SelfShadow};
use hikage::{Actor, Background, Error, Renderer, Stage};

use crate::support::{HEAD, target, texels, with_renderer};
use crate::support::{
    Shoot, Shot, anime_heroine, cube, gpu, keep, pixel, scene, sphere, square, staged, two_tone, view,
};

/// A ball with a line round it.
fn ball(color: [f32; 4]) -> Scene {
    let mut material = two_tone();
    material.base.color = color;
    material.outline =
        Some(Outline { width: OutlineWidth::World { metres: 0.01 }, lighting_mix: 0.0, ..Outline::default() });
    scene(vec![(sphere(0.4, 24, 48), material)])
}

fn wide(distance: f32) -> Shot {
    Shot { size: [192, 96], background: Background::Transparent, ..view(96, distance) }
}

fn at(x: f32, z: f32) -> Mat4 {
    Mat4::from_translation(Vec3::new(x, 0.0, z))
}

/// Where a picture shows something.
fn covered(image: &Image) -> Vec<bool> {
    image.pixels.chunks_exact(4).map(|p| p[3] > 0).collect()
}

#[test]
fn two_characters_look_as_each_does_alone_where_they_do_not_meet() {
    let gpu = gpu();
    let (red, box_) = (ball([0.9, 0.2, 0.2, 1.0]), scene(vec![(cube(0.3), two_tone())]));
    with_renderer(&gpu, |renderer| {
        let shot = wide(3.0);
        let actors = [
            (&red, at(-0.6, 0.0)),
            (&box_, Mat4::from_rotation_translation(Quat::from_rotation_y(0.5), Vec3::X * 0.6)),
        ];
        let drawn = |renderer: &Renderer, which: &[usize]| {
            let actor = |i: &usize| {
                let mut actor = Actor::new(&renderer.upload(actors[*i].0).expect("an upload"));
                actor.world = actors[*i].1;
                actor
            };
            let mut stage = Stage::of(which.iter().map(actor).collect::<Vec<_>>());
            (stage.lights, stage.time_s) = (shot.lights.clone(), 0.0);
            renderer.render(&mut stage, &shot.view()).expect("a picture")
        };
        let both = drawn(renderer, &[0, 1]);
        let alone = [drawn(renderer, &[0]), drawn(renderer, &[1])];
        for (i, image) in alone.iter().enumerate() {
            let mine = covered(image);
            assert!(mine.iter().filter(|c| **c).count() > 500, "actor {i} is not there");
            for (p, _) in mine.iter().enumerate().filter(|(_, c)| **c) {
                assert_eq!(image.pixels[p * 4..p * 4 + 4], both.pixels[p * 4..p * 4 + 4], "actor {i}, pixel {p}");
            }
        }
        // And nothing else is there.
        let count = |image: &Image| covered(image).iter().filter(|c| **c).count();
        assert_eq!(count(&both), count(&alone[0]) + count(&alone[1]));
    });
}

#[test]
fn the_nearer_one_hides_the_other_whatever_their_order() {
    let gpu = gpu();
    let (red, blue) = (ball([1.0, 0.0, 0.0, 1.0]), ball([0.0, 0.0, 1.0, 1.0]));
    with_renderer(&gpu, |renderer| {
        let [red, blue] = [&red, &blue].map(|s| renderer.upload(s).expect("an upload"));
        let shot = view(64, 3.0);
        for (near, hue) in [(&red, 0), (&blue, 2)] {
            let far = if std::ptr::eq(near, &red) { &blue } else { &red };
            for swapped in [false, true] {
                let mut actors =
                    vec![Actor::new(near).at([0.0, 0.0, 0.5], 0.0), Actor::new(far).at([0.0, 0.0, -0.5], 0.0)];
                if swapped {
                    actors.reverse();
                }
                let mut stage = Stage::of(actors);
                stage.lights = shot.lights.clone();
                let image = renderer.render(&mut stage, &shot.view()).expect("a picture");
                let middle = pixel(&image, 32, 32);
                assert!(middle[hue] > 100 && middle[2 - hue] < 100, "{middle:?}");
            }
        }
    });
}

#[test]
fn each_actor_has_its_own_pose_and_colours() {
    let gpu = gpu();
    let red = ball([0.9, 0.2, 0.2, 1.0]);
    with_renderer(&gpu, |renderer| {
        let character = renderer.upload(&red).expect("an upload");
        let shot = wide(3.0);
        let mut raised = Pose::rest(&red);
        raised.locals[0].translation.y = 0.2;
        let mut green = red.materials[0].clone();
        green.base.color = [0.1, 0.8, 0.2, 1.0];
        let [left, right] = [[-0.6, 0.0, 0.0], [0.6, 0.0, 0.0]];
        let painted = |mut actor: Actor| {
            actor.materials.insert(0, green.clone());
            actor
        };
        let stage_of = |actors: Vec<Actor>| {
            let mut stage = Stage::of(actors);
            stage.lights = shot.lights.clone();
            stage
        };
        let mut both = stage_of(vec![
            Actor::new(&character).at(left, 0.0),
            painted(Actor::new(&character).at(right, 0.0).posed(raised.clone())),
        ]);
        let image = renderer.render(&mut both, &shot.view()).expect("a picture");
        for (actor, half) in [
            (Actor::new(&character).at(left, 0.0), 0),
            (painted(Actor::new(&character).at(right, 0.0).posed(raised)), 1),
        ] {
            let alone = renderer.render(&mut stage_of(vec![actor]), &shot.view()).expect("a picture");
            for y in 0..96 {
                for x in (half * 96)..(half * 96 + 96) {
                    assert_eq!(pixel(&image, x, y), pixel(&alone, x, y), "{x}, {y}");
                }
            }
        }
        // Back at rest, it is as its character was uploaded.
        both.actors[1].pose = Pose::rest(&red);
        both.actors[1].materials.clear();
        let image = renderer.render(&mut both, &shot.view()).expect("a picture");
        let (mine, its) = (pixel(&image, 48, 48), pixel(&image, 144, 48));
        assert!(mine[0] > mine[1] && its[0] > its[1], "{mine:?} {its:?}");
    });
}

/// A board that casts on a wall that receives.
#[test]
fn actors_cast_shadows_on_each_other() {
    let gpu = gpu();
    let with_shadow = |part, casts: bool| {
        let mut material = two_tone();
        material.cast_shadow = Some(CastShadow { casts, received: 1.0 });
        let mut scene = scene(vec![(part, material)]);
        scene.self_shadow = Some(SelfShadow::default());
        scene
    };
    let (wall, board) =
        (with_shadow(square([0.0, 0.0], 0.6, 0.0), true), with_shadow(square([0.0, 0.0], 0.15, 0.0), true));
    with_renderer(&gpu, |renderer| {
        let [wall, board] = [&wall, &board].map(|s| renderer.upload(s).expect("an upload"));
        let mut shot = view(96, 3.0);
        // From the right: the shadow lies to the left of the board.
        shot.lights.directional.to_light = Vec3::new(1.0, 0.0, 1.0).normalize();
        let draw = |renderer: &Renderer, actors: Vec<Actor>| {
            let mut stage = Stage::of(actors);
            stage.lights = shot.lights.clone();
            renderer.render(&mut stage, &shot.view()).expect("a picture")
        };
        let bare = draw(renderer, vec![Actor::new(&wall)]);
        let both = draw(renderer, vec![Actor::new(&wall), Actor::new(&board).at([0.0, 0.0, 0.4], 0.0)]);
        // 0.4 m before the wall and light at 45 degrees: 0.4 m to the left, 1.06 m are half of the picture's height.
        let x = 48 - (0.4 / 0.529 * 48.0) as u32;
        assert!(pixel(&both, x, 48)[0] + 50 < pixel(&bare, x, 48)[0], "no shadow: {:?}", pixel(&both, x, 48));
        assert_eq!(pixel(&both, x, 10), pixel(&bare, x, 10), "a shadow where none falls");
        let far = draw(renderer, vec![Actor::new(&wall), Actor::new(&board).at([0.0, 0.0, 60.0], 0.0)]);
        assert_eq!(pixel(&far, x, 10), pixel(&bare, x, 10));
        // Maps are made anew for more actors, and what is in them with them.
        let mut stage = Stage::of([Actor::new(&wall), Actor::new(&board).at([0.0, 0.0, 0.4], 0.0)]);
        stage.lights = shot.lights.clone();
        let before = renderer.render(&mut stage, &shot.view()).expect("a picture");
        stage.actors.push(Actor::new(&board).at([0.0, 0.0, -60.0], 0.0));
        let after = renderer.render(&mut stage, &shot.view()).expect("a picture");
        assert!(
            before.pixels == both.pixels && after.pixels == both.pixels,
            "the shadow goes where another actor comes"
        );
    });
}

#[test]
fn each_face_has_the_shadow_of_its_own_bangs() {
    let gpu = gpu();
    let mut scene = anime_heroine();
    keep(&mut scene, HEAD);
    assert!(scene.bangs.is_some());
    // The maps of the bangs alone: SwiftShader draws a texel on the border of a cast shadow otherwise beside a second map.
    scene.self_shadow = None;
    with_renderer(&gpu, |renderer| {
        let character = renderer.upload(&scene).expect("an upload");
        let alone = |renderer: &Renderer, turn: f32, x: f32| {
            let mut stage = Stage::of([Actor::new(&character).at([x, 0.0, 0.0], turn)]);
            let mut framed = Shot::framed(&scene, Framing::Face, 0.0, [96, 96]);
            (framed.camera.eye.x, framed.camera.target.x) = (x, x);
            framed.background = Background::Transparent;
            stage.lights = framed.lights.clone();
            renderer.render(&mut stage, &framed.view()).expect("a picture")
        };
        let views = [(0.35, -3.0), (-0.5, 3.0)];
        let of_views = || views.map(|(turn, x)| Actor::new(&character).at([x, 0.0, 0.0], turn));
        let mut both = Stage::of(of_views());
        // Of more than eight, maps are tiles of one picture, whose corners a rasterizer rounds otherwise.
        let others = (1..9).map(|i| Actor::new(&character).at([0.0, 10.0 * i as f32, 0.0], 0.0));
        let mut crowd = Stage::of(of_views().into_iter().chain(others));
        for (turn, x) in views {
            let mut framed = Shot::framed(&scene, Framing::Face, 0.0, [96, 96]);
            (framed.camera.eye.x, framed.camera.target.x) = (x, x);
            framed.background = Background::Transparent;
            both.lights = framed.lights.clone();
            let together = renderer.render(&mut both, &framed.view()).expect("a picture");
            let alone = alone(renderer, turn, x);
            assert!(together.pixels == alone.pixels, "turned by {turn}");
            crowd.lights = framed.lights.clone();
            let among = renderer.render(&mut crowd, &framed.view()).expect("a picture");
            let off = among.pixels.iter().zip(&alone.pixels).filter(|(a, b)| a != b).count();
            assert!(off <= 8, "turned by {turn}, in a crowd: {off} bytes differ");
        }
    });
}

#[test]
fn a_crowd_has_a_pose_each() {
    let gpu = gpu();
    let mut red = ball([0.9, 0.2, 0.2, 1.0]);
    red.meshes[0].primitives[0].role = Role::Cloth;
    with_renderer(&gpu, |renderer| {
        let character = renderer.upload(&red).expect("an upload");
        let raise = |i: usize| i as f32 * 0.0005;
        let actor = |i: usize| {
            let mut pose = Pose::rest(&red);
            pose.locals[0].translation.y = raise(i);
            pose.locals[0].scale = Vec3::splat(0.1);
            let (column, row) = (i % 10, i / 10);
            Actor::new(&character).at([column as f32 * 0.1 - 0.45, row as f32 * 0.1 - 0.45, 0.0], 0.0).posed(pose)
        };
        let mut stage = Stage::of((0..100).map(actor));
        let shot = view(200, 3.0);
        stage.lights = shot.lights.clone();
        let shown = Shot { background: Background::Transparent, ..shot };
        let together = renderer.render(&mut stage, &shown.view()).expect("a picture");
        for i in [0, 37, 99] {
            let mut alone = Stage::of([actor(i)]);
            alone.lights = shown.lights.clone();
            let alone = renderer.render(&mut alone, &shown.view()).expect("a picture");
            // The middle of each is its own: lines of neighbours may reach over it.
            let world = stage.actors[i].world.w_axis;
            let px = |m: f32| (100.0 + m / 0.529 * 100.0) as u32;
            let (x, y) = (px(world.x), 199 - px(world.y + raise(i)));
            assert_eq!(pixel(&together, x, y), pixel(&alone, x, y), "actor {i}");
            assert!(pixel(&alone, x, y)[3] == 255, "actor {i} is not where it should be");
        }
    });
}

#[test]
fn views_of_one_stage_share_what_is_prepared() {
    let gpu = gpu();
    let red = ball([0.9, 0.2, 0.2, 1.0]);
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut stage = staged(renderer.upload(&red));
    let shots = [view(64, 2.0), view(96, 3.0)];
    stage.lights = shots[0].lights.clone();
    let targets = shots.each_ref().map(|s| target(&gpu, s.size, wgpu::TextureFormat::Rgba8UnormSrgb, 1));
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let unprepared = Stage::of([Actor::new(&stage.actors[0].character)]);
    let view = |i: usize| targets[i].create_view(&wgpu::TextureViewDescriptor::default());
    match renderer.draw(&mut encoder, &unprepared, &shots[0].view(), &view(0)) {
        Err(Error::Argument { what, message }) => assert!(what == "stage" && message.contains("prepare"), "{message}"),
        other => panic!("expected an error, not {other:?}"),
    }
    renderer.prepare(&mut encoder, &mut stage).expect("a stage");
    // As many as were prepared, but another one.
    let prepared = std::mem::replace(&mut stage.actors[0], Actor::new(&unprepared.actors[0].character));
    let error = renderer.draw(&mut encoder, &stage, &shots[0].view(), &view(0)).expect_err("another actor").to_string();
    assert!(error.contains("other actors"), "{error}");
    stage.actors[0] = prepared;
    for (i, shot) in shots.iter().enumerate() {
        renderer.draw(&mut encoder, &stage, &shot.view(), &view(i)).expect("a view");
    }
    gpu.queue.submit([encoder.finish()]);
    for (drawn, shot) in targets.iter().zip(&shots) {
        let expected = renderer.shoot(&mut stage, shot).expect("a picture");
        assert!(expected.pixels == texels(&gpu, drawn), "another view");
    }
}

#[test]
fn an_actor_stands_once_on_a_stage_and_may_leave_it() {
    let gpu = gpu();
    let red = ball([0.9, 0.2, 0.2, 1.0]);
    with_renderer(&gpu, |renderer| {
        let character = renderer.upload(&red).expect("an upload");
        let shot = wide(3.0);
        let mut stage = Stage::of([-0.6, 0.6].map(|x| Actor::new(&character).at([x, 0.0, 0.0], 0.0)));
        stage.lights = shot.lights.clone();
        let both = renderer.render(&mut stage, &shot.view()).expect("a picture");
        let left = stage.actors.pop();
        let one = renderer.render(&mut stage, &shot.view()).expect("a picture");
        assert!(covered(&one).iter().filter(|c| **c).count() * 2 == covered(&both).iter().filter(|c| **c).count());
        stage.actors.extend(left);
        assert!(renderer.render(&mut stage, &shot.view()).expect("a picture").pixels == both.pixels);
        stage.actors.clear();
        let empty = renderer.render(&mut stage, &shot.view()).expect("an empty picture");
        assert!(!covered(&empty).contains(&true));
    });
}

#[test]
fn draws_of_a_crowd_are_those_of_one() {
    let gpu = gpu();
    let mut glass = ball([0.9, 0.2, 0.2, 0.5]);
    glass.materials[0].alpha = Alpha { mode: AlphaMode::Blend, write_depth: true, ..Alpha::default() };
    let red = ball([0.9, 0.2, 0.2, 1.0]);
    with_renderer(&gpu, |renderer| {
        for scene in [&red, &glass] {
            let character = renderer.upload(scene).expect("an upload");
            let actor = |i: usize| {
                let mut actor = Actor::new(&character);
                let (column, row) = (i % 4, i / 4);
                let place = Vec3::new(column as f32 * 0.24 - 0.36, row as f32 * 0.24 - 0.24, i as f32 * -0.02);
                actor.world = Mat4::from_scale_rotation_translation(Vec3::splat(0.2), Quat::IDENTITY, place);
                actor
            };
            let shot = Shot { background: Background::Transparent, ..view(160, 3.0) };
            let mut crowd = Stage::of((0..12).map(actor));
            crowd.lights = shot.lights.clone();
            let single = Stage::of([actor(0)]).draw_count();
            assert_eq!(crowd.draw_count(), single, "draws grow with actors");
            let together = renderer.render(&mut crowd, &shot.view()).expect("a picture");
            for i in 0..12 {
                let mut alone = Stage::of([actor(i)]);
                alone.lights = shot.lights.clone();
                let alone = renderer.render(&mut alone, &shot.view()).expect("a picture");
                let mine: Vec<usize> = (0..covered(&alone).len()).filter(|p| covered(&alone)[*p]).collect();
                assert!(mine.len() > 100, "actor {i} is not there");
                for p in mine {
                    assert_eq!(alone.pixels[p * 4..p * 4 + 4], together.pixels[p * 4..p * 4 + 4], "actor {i}");
                }
            }
        }
    });
}

#[test]
fn a_stage_may_bloom_that_did_not_at_the_upload() {
    let gpu = gpu();
    let mut lamp = ball([0.2, 0.2, 0.2, 1.0]);
    lamp.materials[0].emission.color = [1.0; 3];
    lamp.materials[0].glow = Some(Glow::default());
    let post = Post { bloom: Some(Bloom::default()), ..Post::default() };
    with_renderer(&gpu, |renderer| {
        let shot = Shot { background: Background::Transparent, ..view(96, 4.0) };
        let mut drawn = |at_upload: Option<Post>, later: Option<Post>| {
            lamp.post = at_upload;
            let mut stage = staged(renderer.upload(&lamp));
            stage.lights = shot.lights.clone();
            stage.post = later;
            renderer.render(&mut stage, &shot.view())
        };
        let [before, later, never] =
            [(Some(post), Some(post)), (None, Some(post)), (None, None)].map(|(a, b)| drawn(a, b).expect("a picture"));
        assert!(before.pixels == later.pixels, "another picture");
        let count = |image: &Image| covered(image).iter().filter(|c| **c).count();
        assert!(count(&later) > count(&never) + 200, "no light spreads");
        let wild = Post { bloom: Some(Bloom { strength: -1.0, ..Bloom::default() }), ..post };
        let error = drawn(None, Some(wild)).expect_err("out of its range").to_string();
        assert!(error.contains("post.bloom.strength"), "{error}");
    });
}
