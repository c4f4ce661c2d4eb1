//! What an application does wrong is an error that names it: never a panic, never another picture.

use std::collections::BTreeMap;

use hikage::material::{AlphaMode, Hair, Material, Outline, OutlineWidth, Sparkle, StrandDirection, TextureRef};
use hikage::motion::Pose;
use hikage::scene::{Camera, Framing, Node, PunctualLight, Scene, SpotCone, Transform};
use hikage::{Actor, Background, Error, Gpu, Output, Renderer, Stage, View, color::LinearRgb, color::Srgb};

use crate::support::{Shoot, Shot, anime_heroine, gpu, scene, sphere, staged, target, texels, texture, two_tone, view};
use glam::{Mat4, Quat, Vec3};

fn ball() -> Scene {
    let line = Outline { width: OutlineWidth::World { metres: 0.01 }, ..Outline::default() };
    scene(vec![(sphere(0.5, 16, 32), Material { outline: Some(line), ..two_tone() })])
}

type Materials = BTreeMap<usize, Material>;

/// The message of an error in the caller's arguments.
fn argument<T>(result: hikage::Result<T>) -> String {
    match result.err() {
        Some(error @ Error::Argument { .. }) => error.to_string(),
        other => panic!("expected an error of an argument, not {other:?}"),
    }
}

#[test]
fn frames_of_one_submit_keep_their_views_poses_and_colours() {
    let gpu = gpu();
    let scene = ball();
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut stage = staged(renderer.upload(&scene));
    let mut moved = Pose::rest(&scene);
    moved.locals[0].translation.x = 0.4;
    let mut blue = scene.materials[0].clone();
    blue.base.color = [0.1, 0.2, 0.9, 1.0];
    let painted = [(0, blue)].into();
    let mut lit = view(256, 2.0);
    lit.lights.directional.to_light = Vec3::new(1.0, 0.2, 0.1);
    let rest = || Pose::rest(&scene);
    let frames = [
        (rest(), Default::default(), view(256, 2.0)),
        (moved, Default::default(), view(256, 3.0)),
        (rest(), painted, lit),
    ];

    let encode =
        |encoder: &mut wgpu::CommandEncoder, stage: &mut Stage, (pose, materials, shot): &(Pose, Materials, Shot)| {
            let target = target(&gpu, shot.size, Output::default().format, 1);
            stage.actors[0].pose.clone_from(pose);
            stage.actors[0].materials.clone_from(materials);
            shot.set(stage);
            let into = target.create_view(&wgpu::TextureViewDescriptor::default());
            renderer.prepare(encoder, stage).expect("a stage");
            renderer.draw(encoder, stage, &shot.view(), &into).expect("a frame");
            target
        };
    let encoder = || gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut together = encoder();
    let targets: Vec<_> = frames.iter().map(|frame| encode(&mut together, &mut stage, frame)).collect();
    gpu.queue.submit([together.finish()]);
    for (frame, target) in frames.iter().zip(&targets) {
        let mut alone = encoder();
        let single = encode(&mut alone, &mut stage, frame);
        gpu.queue.submit([alone.finish()]);
        assert!(texels(&gpu, target) == texels(&gpu, &single), "another frame's numbers");
    }
}

#[test]
fn every_output_that_is_read_back_gives_the_same_picture() {
    let gpu = gpu();
    let mut scene = ball();
    scene.materials[0].base.color = [0.9, 0.3, 0.1, 1.0];
    for background in [Background::Transparent, Background::Color(Srgb([40, 90, 200]))] {
        let shot = Shot { background, ..view(64, 2.0) };
        // Samples of an encoded target are resolved on encoded values.
        let of = |format| {
            let renderer =
                Renderer::with_output(&gpu, Output { format, samples: 1, ..Output::default() }).expect("a renderer");
            let mut stage = staged(renderer.upload(&scene));
            renderer.shoot(&mut stage, &shot).expect("a picture").pixels
        };
        use wgpu::TextureFormat as F;
        let expected = of(F::Rgba8UnormSrgb);
        assert!(expected == of(F::Bgra8UnormSrgb), "red and blue change places");
        assert!(of(F::Rgba8Unorm) == of(F::Bgra8Unorm), "red and blue change places");
        for format in [F::Rgba8Unorm, F::Rgba16Float] {
            let most = expected.iter().zip(of(format)).map(|(a, b)| a.abs_diff(b)).max();
            assert!(most <= Some(1), "{format:?} differs by {most:?}");
        }
    }
    let format = wgpu::TextureFormat::R8Unorm;
    let renderer = Renderer::with_output(&gpu, Output { format, samples: 1, ..Output::default() }).expect("a renderer");
    let mut stage = staged(renderer.upload(&scene));
    let message = argument(renderer.shoot(&mut stage, &view(64, 2.0)));
    assert!(message.contains("R8Unorm") && message.contains("expected Rgba8Unorm"), "{message}");
}

#[test]
fn targets_and_scenes_that_do_not_fit_are_refused() {
    let gpu = gpu();
    let scene = ball();
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut stage = staged(renderer.upload(&scene));
    let format = Output::default().format;
    let other = wgpu::TextureFormat::Bgra8Unorm;
    for (target, word) in [
        (target(&gpu, [64, 32], format, 1), "target: size: has 64 x 32; expected 64 x 64"),
        (target(&gpu, [64, 64], other, 1), "target: format: has Bgra8Unorm; expected Rgba8UnormSrgb"),
        (target(&gpu, [64, 64], format, 4), "target: samples: has 4"),
    ] {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let target = target.create_view(&wgpu::TextureViewDescriptor::default());
        renderer.prepare(&mut encoder, &mut stage).expect("a stage");
        let message = argument(renderer.draw(&mut encoder, &stage, &view(64, 2.0).view(), &target));
        assert!(message.contains(word), "{message}");
    }
    let single = Renderer::with_output(&gpu, Output { samples: 1, ..Output::default() }).expect("a renderer");
    let message = argument(single.shoot(&mut stage, &view(64, 2.0)));
    assert!(message.contains("another output") && message.contains("upload it"), "{message}");
    let elsewhere = Gpu::headless(Some(&gpu.info().name)).expect("a second device");
    let there = Renderer::new(&elsewhere).expect("a renderer");
    let message = argument(there.shoot(&mut stage, &view(64, 2.0)));
    assert!(message.contains("another device"), "{message}");
}

#[test]
fn scenes_made_in_code_are_checked_at_their_upload() {
    type Break = fn(&mut Scene);
    let cases: [(&str, Break); 15] = [
        ("nodes[0].parent: is 0", |s| s.nodes[0].parent = Some(0)),
        ("nodes[0].parent: is 1", |s| {
            s.nodes.push(Node::default());
            s.nodes[0].parent = Some(1);
        }),
        ("nodes[0].mesh: refers to 7; there are 1", |s| s.nodes[0].mesh = Some(7)),
        ("nodes[0].skin: refers to 0; there are 0", |s| s.nodes[0].skin = Some(0)),
        ("nodes[0].transform: is not finite", |s| s.nodes[0].transform.translation.y = f32::NAN),
        ("primitives[0].material: refers to 999", |s| s.meshes[0].primitives[0].material = 999),
        ("primitives[0].indices: refers to 1000000", |s| s.meshes[0].primitives[0].indices[4] = 1_000_000),
        ("primitives[0].indices: has", |s| s.meshes[0].primitives[0].indices.truncate(4)),
        ("primitives[0].positions[3]: is not finite", |s| s.meshes[0].primitives[0].positions[3][1] = f32::INFINITY),
        ("primitives[0].normals: has 5", |s| s.meshes[0].primitives[0].normals.truncate(5)),
        ("primitives[0].influences.joints: has 0", |s| s.meshes[0].primitives[0].influences.per_vertex = 4),
        ("primitives[0].morphs: has 0; expected 1", |s| s.meshes[0].morph_names.push("aa".to_owned())),
        ("base.texture: refers to 999", |s| {
            s.materials[0].base.texture = Some(TextureRef { texture: 999, ..TextureRef::default() });
        }),
        ("textures[0].image: refers to 3", |s| {
            s.materials[0].base.texture = Some(texture(s, 2, 2, |_, _| [255; 4]));
            s.textures[0].image = 3;
        }),
        ("is 2x2 with 7 bytes", |s| {
            s.materials[0].base.texture = Some(texture(s, 2, 2, |_, _| [255; 4]));
            s.images[0].pixels.truncate(7);
        }),
    ];
    let gpu = gpu();
    let renderer = Renderer::new(&gpu).expect("a renderer");
    for (words, broken) in cases {
        let mut scene = ball();
        broken(&mut scene);
        let message = argument(renderer.upload(&scene));
        assert!(message.contains(words), "{message}; expected {words}");
    }
}

#[test]
fn poses_places_and_lights_that_are_none_are_refused() {
    let gpu = gpu();
    let scene = ball();
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut stage = staged(renderer.upload(&scene));
    let rest = Pose::rest(&scene);
    let mut turned = rest.clone();
    turned.locals[0].rotation = Quat::from_xyzw(f32::NAN, 0.0, 0.0, 1.0);
    let mut stranger = rest.clone();
    stranger.locals.push(Transform::default());
    for (pose, words) in [(turned, "pose.locals[0]"), (stranger, "pose.locals: has 2 nodes; the scene has 1")] {
        stage.actors[0].pose = pose;
        let message = argument(renderer.shoot(&mut stage, &view(64, 2.0)));
        assert!(message.contains("actors[0].") && message.contains(words), "{message}");
    }
    stage.actors[0].pose = rest;

    type Edit = fn(&mut Actor);
    let edits: [(&str, Edit); 6] = [
        ("materials[9]: is not there", |a| drop(a.materials.insert(9, two_tone()))),
        ("rim.fresnel_power", |a| a.edit(0).expect("a material").rim.fresnel_power = f32::NAN),
        ("materials[0] \"\": sparkle is on; it was off", |a| {
            a.edit(0).expect("a material").sparkle = Some(Sparkle::default());
        }),
        ("outline is none; it was some", |a| a.edit(0).expect("a material").outline = None),
        ("base has other textures", |a| {
            a.edit(0).expect("a material").base.texture = Some(TextureRef::default());
        }),
        ("alpha mode", |a| a.edit(0).expect("a material").alpha.mode = AlphaMode::Blend),
    ];
    for (words, edit) in edits {
        edit(&mut stage.actors[0]);
        let refused = renderer.shoot(&mut stage, &view(64, 2.0));
        assert!(refused.is_err(), "taken: {words}");
        let message = argument(refused);
        assert!(message.contains("actors[0].") && message.contains(words), "{message}");
        stage.actors[0].materials.clear();
    }

    type Break = fn(&mut Shot);
    let lamp = PunctualLight {
        position: Vec3::ONE,
        color: LinearRgb::WHITE,
        intensity: 1.0,
        range: 0.0,
        spot: Some(SpotCone { direction: Vec3::ZERO, inner_rad: 0.1, outer_rad: 0.2 }),
    };
    let cases: [(&str, Break); 6] = [
        ("directional light: has no direction", |v| v.lights.directional.to_light = Vec3::ZERO),
        ("lights: a colour", |v| v.lights.directional.intensity = f32::NAN),
        ("actors[0].world: is not finite", |v| v.instances[0] = Mat4::from_scale(Vec3::splat(f32::NAN))),
        ("actors[0].world: is not finite, or flat", |v| v.instances[0] = Mat4::ZERO),
        ("time: is NaN", |v| v.time_s = f32::NAN),
        ("camera: eye", |v| v.camera = Camera { eye: v.camera.target, ..v.camera }),
    ];
    for (words, broken) in cases {
        let mut view = view(64, 2.0);
        broken(&mut view);
        let message = argument(renderer.shoot(&mut stage, &view));
        assert!(message.contains(words), "{message}");
    }
    let mut spotted = view(64, 2.0);
    spotted.lights.punctual = vec![lamp];
    assert!(argument(renderer.shoot(&mut stage, &spotted)).contains("punctual light 0"));
    spotted.lights.punctual = vec![PunctualLight { spot: None, ..lamp }; 5];
    assert!(argument(renderer.shoot(&mut stage, &spotted)).contains("at most 4"));
}

/// The upload lays the direction of strands into vertices; their other numbers change as they like.
#[test]
fn strands_run_as_they_were_uploaded() {
    let gpu = gpu();
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let combed = Material { name: "Locks".to_owned(), hair: Some(Hair::default()), ..two_tone() };
    let mut stage = staged(renderer.upload(&scene(vec![(sphere(0.5, 16, 32), combed)])));
    let before = renderer.shoot(&mut stage, &view(64, 2.0)).expect("a picture");
    for direction in [StrandDirection::UvU, StrandDirection::UvV, StrandDirection::Mesh] {
        let material = stage.actors[0].edit(0).expect("a material");
        material.hair = Some(Hair { direction, ..Hair::default() });
        let refused = renderer.shoot(&mut stage, &view(64, 2.0));
        assert!(refused.is_err(), "taken: {direction:?}");
        let message = argument(refused);
        for words in ["actors[0].", "materials[0] \"Locks\"", "directions of its hair", "at the upload"] {
            assert!(message.contains(words), "{message}");
        }
        stage.actors[0].materials.clear();
    }
    let fibre = &mut stage.actors[0].edit(0).expect("a material").hair.as_mut().expect("hair").fibre;
    (fibre.eumelanin, fibre.pheomelanin) = (0.0, 0.0);
    let white = renderer.shoot(&mut stage, &view(64, 2.0)).expect("a picture");
    assert!(white.pixels != before.pixels, "its pigment changes nothing");
}

#[test]
fn a_device_that_is_too_small_is_told_what_it_lacks() {
    let lent = gpu();
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let adapters = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
    let adapter = adapters.into_iter().find(|a| a.get_info().name == lent.info().name).expect("that of the tests");
    let device = |limits| {
        pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            required_features: Gpu::wanted_features(&adapter),
            required_limits: limits,
            ..Default::default()
        }))
        .expect("a device")
    };
    let few = wgpu::Limits { max_sampled_textures_per_shader_stage: 8, ..wgpu::Limits::default() };
    let (small, queue) = device(few);
    let message = Renderer::new(&Gpu::from_parts(&adapter, small, queue)).expect_err("too small").to_string();
    for word in ["max_sampled_textures_per_shader_stage is 8", "Gpu::required_limits"] {
        assert!(message.contains(word), "{message}");
    }
    // Two renderers on one device of an application.
    let (shared, queue) = device(Gpu::required_limits(&adapter));
    let shared = Gpu::from_parts(&adapter, shared, queue);
    let scene = anime_heroine();
    let view = View::framed(&scene, Framing::Face, 0.2, [64, 64]);
    let renderers = [1, 2].map(|_| Renderer::new(&shared).expect("a renderer"));
    let mut stages = renderers.each_ref().map(|r| Stage::of([Actor::new(&r.upload(&scene).expect("an upload"))]));
    let drawn = |(r, stage): (&Renderer, &mut Stage)| r.render(stage, &view).expect("a picture").pixels;
    let pictures: Vec<_> = renderers.iter().zip(&mut stages).map(drawn).collect();
    assert!(pictures[0] == pictures[1], "another picture");
}

#[test]
fn a_lost_device_says_so() {
    let gpu = Gpu::headless(Some(&gpu().info().name)).expect("a device of its own");
    let scene = ball();
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut stage = staged(renderer.upload(&scene));
    renderer.shoot(&mut stage, &view(64, 2.0)).expect("a picture");
    gpu.device.destroy();
    for result in [renderer.shoot(&mut stage, &view(64, 2.0)).map(|_| ()), renderer.upload(&scene).map(|_| ())] {
        let error = result.expect_err("there is no device any more");
        assert!(matches!(&error, Error::Gpu(m) if m.contains("lost")), "{error}");
    }
}

/// One thread draws frames while another uploads the next character.
#[test]
fn uploads_do_not_stop_frames() {
    let gpu = gpu();
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let scene = ball();
    let mut stage = staged(renderer.upload(&scene));
    let shot = view(64, 2.0);
    stage.lights = shot.lights.clone();
    let before = renderer.render(&mut stage, &shot.view()).expect("a picture");
    let next = anime_heroine();
    let uploaded = std::thread::scope(|threads| {
        let uploading = threads.spawn(|| renderer.upload(&next));
        let mut frames = 0;
        while frames < 3 || !uploading.is_finished() {
            let image = renderer.render(&mut stage, &shot.view()).expect("a picture");
            assert!(image.pixels == before.pixels, "another picture while something is uploaded");
            frames += 1;
        }
        uploading.join().expect("no panic").expect("an upload")
    });
    stage.actors[0] = Actor::new(&uploaded);
    let after = renderer.render(&mut stage, &shot.view()).expect("a picture");
    assert!(after.pixels != before.pixels, "the new character is not there");
}
