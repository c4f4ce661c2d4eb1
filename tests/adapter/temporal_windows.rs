//! Temporal antialiasing of windows: what stands still becomes as smooth as with many samples, and what moves leaves nothing
//! behind it.

use glam::{Mat4, Quat, Vec3, Vec4};
use hikage::color::linear_from_srgb;
use hikage::material::{AlphaMode, Base, Material, OutlineWidth, Shading};
use hikage::motion::Pose;
use hikage::scene::{Antialias, Framing, HumanBone, Influences, MorphTarget, Node, Post, Primitive, Skin, Transform};
use hikage::{Actor, Background, Far, Gpu, Grid, Ground, HostDepth, Output, Renderer, Stage, Target, View};

use crate::support::{HEAD, anime_heroine, gpu, keep, scene, sphere, square, target, texels, view};
use crate::temporal::{Light, off_lights, output, reference, staged, still_life, veils};

const TEMPORAL: Post =
    Post { bloom: None, exposure_ev: 0.0, tone: hikage::scene::ToneCurve::None, antialias: Antialias::Temporal };

/// Pictures of a window.
struct Window<'a> {
    gpu: &'a Gpu,
    renderer: &'a Renderer,
    texture: wgpu::Texture,
}

impl<'a> Window<'a> {
    fn new(gpu: &'a Gpu, renderer: &'a Renderer, size: [u32; 2]) -> Self {
        Self { gpu, renderer, texture: target(gpu, size, wgpu::TextureFormat::Rgba8UnormSrgb, 1) }
    }

    /// The next picture: premultiplied linear light.
    fn draw(&self, stage: &mut Stage, view: &View) -> Vec<Light> {
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.renderer.prepare(&mut encoder, stage).expect("a stage");
        self.draw_again(encoder, stage, view)
    }

    /// The same of a stage that is prepared.
    fn draw_again(&self, mut encoder: wgpu::CommandEncoder, stage: &Stage, view: &View) -> Vec<Light> {
        let into = self.texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.renderer.draw(&mut encoder, stage, view, &into).expect("a view");
        self.gpu.queue.submit([encoder.finish()]);
        let light = |t: &[u8]| {
            let [r, g, b] = [0, 1, 2].map(|i| linear_from_srgb(f32::from(t[i]) / 255.0));
            [r, g, b, f32::from(t[3]) / 255.0]
        };
        texels(self.gpu, &self.texture).chunks_exact(4).map(light).collect()
    }
}

fn renderer(gpu: &Gpu, samples: u32) -> Renderer {
    Renderer::with_output(gpu, output(samples)).expect("a renderer")
}

/// Standing still, a window of 64 pictures is what a still of many samples is: edges, cuts, lines, ground, alpha.
#[test]
fn what_stands_still_becomes_smooth() {
    let gpu = gpu();
    let scene = still_life(Some(OutlineWidth::Screen { height_ratio: 0.01 }));
    let shot = view(96, 4.0).view();
    let clear = View { background: Background::Transparent, ..shot.clone() };
    let ground = Ground { grid: Some(Grid::default()), middle: Vec3::Y * -0.6, radius_m: 3.0, ..Ground::default() };
    for (name, view, ground) in [("colour", &shot, None), ("clear", &clear, None), ("ground", &shot, Some(ground))] {
        let set = |stage: &mut Stage| (stage.ground, stage.post) = (ground.clone(), Some(TEMPORAL));
        let expected = reference(&gpu, &scene, set, view);
        for samples in [1, 4] {
            let renderer = renderer(&gpu, samples);
            let mut stage = staged(&renderer, &scene);
            set(&mut stage);
            let window = Window::new(&gpu, &renderer, view.size);
            let first = off_lights(&window.draw(&mut stage, view), &expected);
            let mut last = Vec::new();
            let mut worst = 0f32;
            for frame in 1..96 {
                last = window.draw(&mut stage, view);
                if frame >= 64 {
                    worst = worst.max(off_lights(&last, &expected).edges);
                }
            }
            let found = off_lights(&last, &expected);
            println!("{name}, {samples} samples: {first:?} -> {found:?}, worst {worst}");
            assert!(found.mean < 1.5 / 255.0, "{name}, {samples} samples: {found:?}");
            assert!(worst < 0.01 && found.edges < first.edges, "{name}, {samples} samples: {worst}, {found:?}");
        }
    }
}

/// Hashed alpha is smooth in a window, too. What covers less than a quarter is thinned there: where none of it is about a pixel,
/// its history is taken for a ghost.
#[test]
fn hashed_alpha_becomes_smooth() {
    let gpu = gpu();
    let view = View { background: Background::Transparent, ..view(96, 4.0).view() };
    let renderer = renderer(&gpu, 1);
    for alpha in [0.3, 0.5, 0.7, 0.8, 0.9] {
        let mut stage = staged(&renderer, &veils(1, alpha, AlphaMode::Mask));
        stage.post = Some(TEMPORAL);
        let window = Window::new(&gpu, &renderer, view.size);
        let last = (0..64).map(|_| window.draw(&mut stage, &view)).last().expect("a picture");
        let mean = last.iter().map(|l| l[3]).sum::<f32>() / last.len() as f32;
        let spread = (last.iter().map(|l| (l[3] - mean).powi(2)).sum::<f32>() / last.len() as f32).sqrt();
        println!("{alpha}: {mean} +- {spread}");
        assert!((mean - alpha).abs() < 0.02 && spread < 0.12, "{alpha}: {mean} +- {spread}");
    }
}

/// Where neither a picture nor its neighbours within `reach` pixels have any of what was there.
fn clear_of(expected: &[(Light, f32)], size: usize, reach: i32, is_clear: impl Fn(&Light) -> bool) -> Vec<bool> {
    let at = |x: i32, y: i32| {
        let inside = x >= 0 && y >= 0 && x < size as i32 && y < size as i32;
        !inside || is_clear(&expected[y as usize * size + x as usize].0)
    };
    (0..(size * size) as i32)
        .map(|i| {
            let (x, y) = (i % size as i32, i / size as i32);
            (-reach..=reach).all(|dy| (-reach..=reach).all(|dx| at(x + dx, y + dy)))
        })
        .collect()
}

/// A head that turns by 30 degrees a second at 60 pictures a second leaves nothing where it was: a pixel and more from where it
/// is now, nothing of it is seen in the very next picture; and what is seen is nearer to the truth than one picture alone.
#[test]
fn a_turning_head_leaves_no_ghost() {
    let gpu = gpu();
    let mut scene = anime_heroine();
    keep(&mut scene, HEAD);
    scene.post = None;
    // Thin lines are a pixel wide in a picture of any size: the fine one would not tell where they end.
    scene.materials.iter_mut().for_each(|m| m.outline = None);
    let renderer = renderer(&gpu, 1);
    let mut stage = staged(&renderer, &scene);
    let view = View { background: Background::Transparent, ..View::framed(&scene, Framing::Face, 0.0, [128, 128]) };
    let window = Window::new(&gpu, &renderer, view.size);
    let turned = |frame: u32| {
        let mut pose = Pose::rest(&scene);
        let yaw = (frame as f32 * 0.5).to_radians();
        assert!(pose.turn(&scene, HumanBone::Head, Quat::from_rotation_y(yaw)));
        pose
    };
    let (mut ghost, mut smooth, mut rough) = (0f32, 0f32, 0f32);
    for frame in 0..40 {
        stage.post = Some(TEMPORAL);
        stage.actors[0].pose = turned(frame);
        let found = window.draw(&mut stage, &view);
        if frame % 8 == 7 {
            stage.post = None;
            let fine = View { size: [1024; 2], ..view.clone() };
            let expected = crate::temporal::boxed(&renderer.render(&mut stage, &fine).expect("a picture"), view.size);
            let once = renderer.render(&mut stage, &view).expect("a picture");
            let once: Vec<Light> = once.pixels.chunks_exact(4).map(crate::temporal::light_of).collect();
            let clear = clear_of(&expected, 128, 1, |l| l[3] == 0.0);
            let left = found.iter().zip(&clear).filter(|(_, clear)| **clear).map(|(l, _)| l[3]).fold(0.0, f32::max);
            (ghost, smooth) = (ghost.max(left), smooth.max(off_lights(&found, &expected).edges));
            rough = rough.max(off_lights(&once, &expected).edges);
            // The window goes on as if nobody had looked elsewhere.
            stage.post = Some(TEMPORAL);
            window.draw(&mut stage, &view);
        }
    }
    println!("ghost {ghost}, edges {smooth}; alone {rough}");
    assert!(ghost <= 2.0 / 255.0, "{ghost} of the head is seen where it was");
    // Contours of what turns do not move as its surface does: they are softer than what stands still.
    assert!(smooth < 0.006 && smooth < rough * 0.85, "edges are off by {smooth}; of one picture alone by {rough}");
}

/// A ball that crosses before a wall by two and a half pixels a picture uncovers the wall as it is.
#[test]
fn what_is_uncovered_is_seen_at_once() {
    let gpu = gpu();
    let unlit = |color: [f32; 4]| Material {
        shading: Shading::Unlit,
        base: Base { color, texture: None },
        ..Material::default()
    };
    let renderer = renderer(&gpu, 1);
    let wall = renderer.upload(&scene(vec![(square([0.0, 0.0], 2.0, -0.5), unlit([0.1, 0.6, 0.1, 1.0]))]));
    let ball = renderer.upload(&scene(vec![(sphere(0.2, 24, 48), unlit([0.9, 0.1, 0.1, 1.0]))]));
    let mut stage = Stage::of([wall, ball].map(|c| Actor::new(&c.expect("an upload"))));
    stage.post = Some(TEMPORAL);
    let view = view(96, 4.0).view();
    let px_m = 2.0 * 4.0 * 10f32.to_radians().tan() / 96.0;
    let window = Window::new(&gpu, &renderer, view.size);
    let mut most = 0f32;
    for frame in 0..24 {
        stage.actors[1].world = Mat4::from_translation(Vec3::X * (frame as f32 - 12.0) * 2.5 * px_m);
        let found = window.draw(&mut stage, &view);
        let middle = 47.5 + (frame as f32 - 12.0) * 2.5;
        let radius = 0.2 / px_m + 2.5;
        for (i, l) in found.iter().enumerate() {
            let (x, y) = ((i % 96) as f32, (i / 96) as f32);
            if (x - middle).hypot(y - 47.5) > radius {
                most = most.max(l[0]);
            }
        }
    }
    let red = linear_from_srgb(hikage::color::srgb_from_linear(0.1));
    println!("red of the wall: {most}; of itself {red}");
    assert!(most < red + 0.01, "{most} of red is left on the wall, which has {red}");
}

/// Who comes is whole at once, who goes has gone at once, and a cut is one.
#[test]
fn actors_come_and_go_and_views_are_cut() {
    let gpu = gpu();
    let renderer = renderer(&gpu, 1);
    let view = View { background: Background::Transparent, ..view(96, 4.0).view() };
    let window = Window::new(&gpu, &renderer, view.size);
    let mut stage = staged(&renderer, &still_life(None));
    stage.post = Some(TEMPORAL);
    let full = |lights: &[Light]| lights.iter().filter(|l| l[3] > 0.99).count();
    let draw = |stage: &mut Stage, times: usize| (0..times).map(|_| window.draw(stage, &view)).last().expect("one");
    let smooth = draw(&mut stage, 20);
    let gone = stage.actors.pop();
    assert_eq!(draw(&mut stage, 1).iter().filter(|l| l[3] > 0.0).count(), 0, "somebody who has gone is still seen");
    draw(&mut stage, 5);
    stage.actors.extend(gone);
    let back = draw(&mut stage, 1);
    assert!(full(&back) as f32 > 0.97 * full(&smooth) as f32, "{} of {}", full(&back), full(&smooth));
    draw(&mut stage, 20);
    // A cut to another place, and the same without saying so.
    let mut other = View { is_cut: true, ..view.clone() };
    other.camera.eye += Vec3::new(1.0, 0.5, 0.0);
    let cut = window.draw(&mut stage, &other);
    let alone = Window::new(&gpu, &renderer, view.size).draw(&mut stage, &View { history: 5, ..other });
    assert!(cut == alone, "a cut is a picture by itself");
}

/// Views that share a number in one frame are drawn by themselves; each with its own becomes smooth.
#[test]
fn two_views_have_two_histories() {
    let gpu = gpu();
    let renderer = renderer(&gpu, 1);
    let left = View { background: Background::Transparent, ..view(64, 4.0).view() };
    let mut right = View { history: 1, ..left.clone() };
    right.camera.eye += Vec3::X * 1.5;
    let window = Window::new(&gpu, &renderer, left.size);
    let mut stage = staged(&renderer, &still_life(None));
    stage.post = Some(TEMPORAL);
    let encoder = || gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let both = |stage: &mut Stage, right: &View| {
        let first = window.draw(stage, &left);
        (first, window.draw_again(encoder(), stage, right))
    };
    let (mut last, mut alone) = (Default::default(), Default::default());
    for _ in 0..20 {
        last = both(&mut stage, &right);
    }
    let shared = View { history: 0, ..right.clone() };
    for _ in 0..20 {
        alone = both(&mut stage, &shared);
    }
    let partly = |lights: &[Light]| lights.iter().filter(|l| l[3] > 0.02 && l[3] < 0.98).count();
    let counts = [&last.0, &last.1, &alone.0, &alone.1].map(|l| partly(l));
    assert!(counts[0] > 50 && counts[1] > 50, "{counts:?}");
    assert_eq!(counts[2..], [0, 0], "views that share a history are not mixed");
}

/// A still by itself knows of no window, and a window that asks for nothing keeps nothing.
#[test]
fn stills_follow_nothing() {
    let gpu = gpu();
    let renderer = renderer(&gpu, 1);
    let view = view(64, 4.0).view();
    let mut stage = staged(&renderer, &still_life(None));
    stage.post = Some(Post { antialias: Antialias::None, ..TEMPORAL });
    let plain = renderer.render(&mut stage, &view).expect("a picture").pixels;
    assert!(renderer.motion().is_none(), "movement is drawn for nobody");
    stage.post = Some(TEMPORAL);
    for _ in 0..3 {
        assert!(renderer.render(&mut stage, &view).expect("a picture").pixels == plain);
    }
    assert!(renderer.motion().is_none(), "movement is drawn for a still");
}

/// A sheet that fills a good part of the picture, of two triangles.
fn sheet() -> Primitive {
    square([0.0, 0.0], 0.5, 0.0)
}

/// Of the third picture after the first: the third place of Sobol's sequence.
const JITTER_PX: [f64; 2] = [0.25 + 0.03125 - 0.5, 0.75 + 0.03125 - 0.5];

/// Movement of each pixel by the places of the sheet's corners, now and before.
fn moved_by_hand(now: &[Vec3; 4], before: &[Vec3; 4], views: [&View; 2], px: [u32; 2]) -> Option<[f32; 2]> {
    let clip = |view: &View| {
        let aspect = view.size[0] as f32 / view.size[1] as f32;
        view.camera.clip_from_view(aspect).as_dmat4() * view.camera.view_from_world().as_dmat4()
    };
    let [width, height] = views[0].size.map(f64::from);
    let place = |view: &View, p: Vec3| {
        let c = clip(view) * p.as_dvec3().extend(1.0);
        (glam::DVec2::new((c.x / c.w * 0.5 + 0.5) * width, (0.5 - c.y / c.w * 0.5) * height), c.w)
    };
    let at = glam::DVec2::new(f64::from(px[0]) + 0.5 - JITTER_PX[0], f64::from(px[1]) + 0.5 - JITTER_PX[1]);
    for t in [[0, 1, 2], [0, 2, 3]] {
        let corners = t.map(|i: usize| place(views[0], now[i]));
        let [a, b, c] = corners.map(|(p, _)| p);
        let area = (b - a).perp_dot(c - a);
        let flat = [(b - at).perp_dot(c - at), (c - at).perp_dot(a - at), (a - at).perp_dot(b - at)].map(|x| x / area);
        // A little inside, where no rounding decides between triangles.
        if flat.iter().all(|w| *w > 0.02) {
            let weights: [f64; 3] = std::array::from_fn(|i| flat[i] / corners[i].1);
            let sum: f64 = weights.iter().sum();
            let was: glam::DVec3 = (0..3).map(|i| before[t[i]].as_dvec3() * (weights[i] / sum)).sum();
            let moved = at - place(views[1], was.as_vec3()).0;
            return Some(moved.to_array().map(|x| x as f32));
        }
    }
    None
}

/// Movement of what is placed, turned, skinned and morphed, and of the camera, against the same by hand: within a hundredth of
/// a pixel.
#[test]
fn movement_is_what_it_is_by_hand() {
    let gpu = gpu();
    let renderer = renderer(&gpu, 1);
    let mut made = scene(vec![(sheet(), Material::default())]);
    // Node 0 carries the sheet; 1 and 2 are joints.
    made.nodes.extend([Node::default(), Node::default()]);
    made.nodes[0].skin = Some(0);
    made.nodes[0].morph_weights = vec![0.0];
    made.skins = vec![Skin { joints: vec![1, 2], joint_from_mesh: vec![Mat4::IDENTITY; 2], ..Skin::default() }];
    made.meshes[0].morph_names = vec!["up".into()];
    let weights = [[1.0, 0.0], [0.75, 0.25], [0.5, 0.5], [0.75, 0.25]];
    let shifts = [[0.0, 0.0, 0.0], [0.02, 0.0, 0.1], [0.0, 0.05, 0.0], [-0.03, 0.0, 0.05]];
    let p = &mut made.meshes[0].primitives[0];
    p.influences = Influences {
        per_vertex: 4,
        joints: [[0, 1, 0, 0]; 4].concat(),
        weights: weights.iter().flat_map(|[a, b]| [*a, *b, 0.0, 0.0]).collect(),
    };
    p.morphs =
        vec![MorphTarget { vertices: vec![1, 2, 3], positions: shifts[1..].to_vec(), normals: vec![[0.0; 3]; 3] }];
    let rest: [Vec3; 4] = std::array::from_fn(|i| Vec3::from(p.positions[i]));

    struct State {
        world: Mat4,
        joints: [Transform; 2],
        weight: f32,
        eye: Vec3,
    }
    let joint = |yaw: f32, x: f32| Transform {
        rotation: Quat::from_euler(glam::EulerRot::XYZ, yaw * 0.5, yaw, yaw * 0.3),
        translation: Vec3::new(x, -x * 0.5, x),
        ..Transform::default()
    };
    let state = |world: Mat4, yaw: f32, x: f32, weight: f32, eye: Vec3| State {
        world,
        joints: [joint(yaw, x), joint(-yaw * 0.5, x * 2.0)],
        weight,
        eye,
    };
    let (still, eye) = (Mat4::IDENTITY, Vec3::new(0.1, 0.2, 4.0));
    let turned = Mat4::from_rotation_translation(Quat::from_rotation_y(0.1), Vec3::new(0.04, -0.03, 0.1));
    let cases = [
        ("stands still", state(still, 0.0, 0.0, 0.0, eye), state(still, 0.0, 0.0, 0.0, eye)),
        ("placed and turned", state(still, 0.0, 0.0, 0.0, eye), state(turned, 0.0, 0.0, 0.0, eye)),
        ("skinned", state(turned, 0.02, 0.0, 0.0, eye), state(turned, 0.1, 0.02, 0.0, eye)),
        ("morphed", state(still, 0.0, 0.0, 0.1, eye), state(still, 0.0, 0.0, 0.9, eye)),
        ("camera", state(still, 0.1, 0.0, 0.3, eye), state(still, 0.1, 0.0, 0.3, eye + Vec3::new(0.1, -0.05, 0.1))),
        ("all", state(still, 0.0, 0.0, 0.2, eye), state(turned, 0.06, 0.01, 0.7, eye + Vec3::new(0.03, 0.02, -0.1))),
    ];
    let mut stage = staged(&renderer, &made);
    stage.post = Some(TEMPORAL);
    let window = Window::new(&gpu, &renderer, [96, 80]);
    for (name, before, now) in &cases {
        let seen = |of: &State| {
            let mut seen = View { size: [96, 80], ..view(96, 4.0).view() };
            seen.camera.eye = of.eye;
            seen
        };
        for (i, of) in [before, before, before, now].into_iter().enumerate() {
            let actor = &mut stage.actors[0];
            actor.world = of.world;
            actor.pose.locals[1..].copy_from_slice(&of.joints);
            actor.pose.morph_weights[0] = vec![of.weight];
            window.draw(&mut stage, &View { is_cut: i == 0, ..seen(of) });
        }
        let placed = |of: &State| -> [Vec3; 4] {
            let joints = of.joints.map(|j| j.matrix());
            std::array::from_fn(|i| {
                let p = (rest[i] + Vec3::from(shifts[i]) * of.weight).extend(1.0);
                // Weights have 16 bits.
                let [a, b] = weights[i].map(|w: f32| (w * 65535.0).round() / 65535.0);
                let p: Vec4 = joints[0] * p * a + joints[1] * p * b;
                of.world.transform_point3(p.truncate())
            })
        };
        let motion = renderer.motion().expect("movement");
        let found = texels(&gpu, &motion);
        let (mut count, mut worst, mut farthest) = (0, 0f32, 0f32);
        for (i, t) in found.chunks_exact(4).enumerate() {
            let px = [i as u32 % 96, i as u32 / 96];
            let Some(expected) = moved_by_hand(&placed(now), &placed(before), [&seen(now), &seen(before)], px) else {
                continue;
            };
            count += 1;
            for axis in 0..2 {
                let x = half::f16::from_le_bytes([t[2 * axis], t[2 * axis + 1]]).to_f32();
                worst = worst.max((x - expected[axis]).abs());
                farthest = farthest.max(expected[axis].abs());
            }
        }
        println!("{name}: {count} pixels, up to {farthest} px, off by {worst}");
        assert!(count > 800 && worst <= 0.01, "{name}: {count} pixels, off by {worst} px of {farthest}");
        assert!(farthest < 8.0 && (farthest > 0.3 || *name == "stands still"), "{name}: {farthest} px");
    }
}

/// What is laid over a host's colour, before and behind its depth, is as smooth, and the host's colour stays where nobody is.
#[test]
fn a_hosts_frame_is_smooth_too() {
    let gpu = gpu();
    let scene = still_life(None);
    let blue = hikage::color::Srgb([40, 60, 200]);
    let view = View { background: Background::Color(blue), ..view(96, 4.0).view() };
    let expected = reference(&gpu, &scene, |_| (), &view);
    let host = HostDepth { format: wgpu::TextureFormat::Depth32Float, far: Far::Zero };
    for depth in [None, Some(host)] {
        let renderer = Renderer::with_output(&gpu, Output { depth, ..output(1) }).expect("a renderer");
        let mut stage = staged(&renderer, &scene);
        stage.post = Some(TEMPORAL);
        let color = target(&gpu, view.size, wgpu::TextureFormat::Rgba8UnormSrgb, 1);
        let far = target(&gpu, view.size, host.format, 1);
        let [into, far] = [&color, &far].map(|t| t.create_view(&wgpu::TextureViewDescriptor::default()));
        for _ in 0..48 {
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            let [r, g, b] = blue.to_linear().0.map(f64::from);
            let load = wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a: 1.0 });
            drop(encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: &into,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
                })],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: &far,
                    depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
                    stencil_ops: None,
                }),
                ..Default::default()
            }));
            renderer.prepare(&mut encoder, &mut stage).expect("a stage");
            let laid = Target { color: &into, keeps_color: true, depth: depth.map(|_| &far) };
            renderer.draw(&mut encoder, &stage, &view, laid).expect("a view");
            gpu.queue.submit([encoder.finish()]);
        }
        let pixels = texels(&gpu, &color);
        let lights: Vec<Light> = pixels.chunks_exact(4).map(crate::temporal::light_of).collect();
        let found = off_lights(&lights, &expected);
        println!("{depth:?}: {found:?}");
        assert!(found.mean < 1.5 / 255.0 && found.edges < 0.01, "{depth:?}: {found:?}");
        let outside = pixels.chunks_exact(4).zip(&expected).filter(|(_, (_, spread))| *spread == 0.0);
        assert!(outside.clone().any(|(p, _)| p[..3] == blue.0), "{depth:?}: the host's colour is gone");
    }
}
