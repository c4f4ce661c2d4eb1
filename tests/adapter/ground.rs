//! What a stage stands on, and what it casts: on its ground, on a host's, and with more actors than have maps of their own.

use std::sync::Arc;

use glam::{Mat4, Vec3};
use hikage::color::LinearRgb;
use hikage::material::{Base, CastShadow, Material, Shading};
use hikage::scene::{Image, MOST_SHADOWED, Scene, SelfShadow};
use hikage::{Actor, Background, Error, Grid, Ground, Renderer, Stage, StageShadow, View};

use crate::support::{Shot, cube, gpu, pixel, scene, sphere, square, target, texels, two_tone, view, with_renderer};

/// From above, at an angle.
fn shot() -> Shot {
    let mut shot = Shot { size: [128, 128], background: Background::Transparent, ..view(128, 4.0) };
    shot.camera.eye = Vec3::new(0.0, 3.0, 3.0);
    shot.camera.target = Vec3::ZERO;
    shot.lights.directional.to_light = Vec3::new(1.0, 1.0, 0.0).normalize();
    shot
}

/// A stage under the light of a shot.
fn stage_of(shot: &Shot, actors: Vec<Actor>, ground: Option<Ground>) -> Stage {
    let mut stage = Stage::of(actors);
    stage.lights = shot.lights.clone();
    stage.ground = ground;
    stage
}

/// Pixel of a place of the world.
fn at(shot: &Shot, place: Vec3) -> [u32; 2] {
    let aspect = shot.size[0] as f32 / shot.size[1] as f32;
    let p = (shot.camera.clip_from_view(aspect) * shot.camera.view_from_world()).project_point3(place);
    [((p.x * 0.5 + 0.5) * shot.size[0] as f32) as u32, ((0.5 - p.y * 0.5) * shot.size[1] as f32) as u32]
}

fn seen(image: &Image, shot: &Shot, place: Vec3) -> [u8; 4] {
    let [x, y] = at(shot, place);
    pixel(image, x, y)
}

#[test]
fn actors_stand_on_a_ground_that_takes_their_shadow() {
    let gpu = gpu();
    // Without any look: the ground asks for no section of a character.
    let ball = scene(vec![(sphere(0.2, 24, 48), two_tone())]);
    with_renderer(&gpu, |renderer| {
        let ball = renderer.upload(&ball).expect("an upload");
        let shot = shot();
        let drawn = |ground: Option<Ground>, actors: &[Vec3]| {
            let actors = actors.iter().map(|p| Actor::new(&ball).at(*p, 0.0)).collect();
            renderer.render(&mut stage_of(&shot, actors, ground), &shot.view()).expect("a picture")
        };
        let above = [Vec3::Y * 0.5];
        // Light from the right at 45 degrees: half a metre to the left.
        let (shaded, free) = (Vec3::X * -0.5, Vec3::new(0.3, 0.0, 0.3));
        let plain = Ground { color: LinearRgb([0.5, 0.5, 0.5]), ..Ground::default() };
        let image = drawn(Some(plain.clone()), &above);
        let [dark, light] = [shaded, free].map(|p| seen(&image, &shot, p));
        assert!(dark[0] + 30 < light[0] && dark[2] + 10 < light[2], "{dark:?} {light:?}");
        assert_eq!([dark[3], light[3]], [255, 255]);
        // It hides what is below it, and has gone beyond its radius.
        assert_eq!(
            seen(&drawn(Some(plain.clone()), &[Vec3::Y * -0.5]), &shot, Vec3::Y * -0.5),
            light,
            "seen through it"
        );
        let small = drawn(Some(Ground { radius_m: 0.3, ..plain.clone() }), &above);
        assert_eq!(seen(&small, &shot, Vec3::new(0.5, 0.0, 0.0))[3], 0);
        // The shadow alone: nothing but where it falls.
        let alone = drawn(Some(Ground { shadow_only: true, ..plain.clone() }), &above);
        assert!(seen(&alone, &shot, shaded)[3] > 60, "{:?}", seen(&alone, &shot, shaded));
        assert_eq!(seen(&alone, &shot, free), [0; 4]);
        // Lines where they should be.
        let grid = Grid { spacing_m: 0.5, width_m: 0.06, color: LinearRgb([0.0; 3]) };
        let lined = drawn(Some(Ground { grid: Some(grid), ..plain.clone() }), &above);
        assert!(seen(&lined, &shot, Vec3::new(0.5, 0.0, 0.25))[0] < 20);
        assert_eq!(seen(&lined, &shot, Vec3::new(0.25, 0.0, 0.25)), light);
        // A texture: red to the left, green to the right of each metre.
        let pixels = [[[255, 0, 0, 255u8]; 32], [[0, 255, 0, 255]; 32]].concat().concat();
        let image = Arc::new(Image { width: 64, height: 1, pixels, ..Image::default() });
        let painted = drawn(Some(Ground { texture: Some(image), ..plain }), &above);
        let [left, right] = [0.25, -0.25].map(|x| seen(&painted, &shot, Vec3::new(x, 0.0, 0.4)));
        assert!(left[0] > 150 && left[1] < 60 && right[1] > 150 && right[0] < 60, "{left:?} {right:?}");
        // And nothing at all of it where there is none.
        assert_eq!(seen(&drawn(None, &above), &shot, free), [0; 4]);
    });
}

#[test]
fn grounds_that_are_none_are_refused() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let broken: [(&str, Ground); 4] = [
            ("ground.radius_m", Ground { radius_m: 0.0, ..Ground::default() }),
            ("ground.middle", Ground { middle: Vec3::NAN, ..Ground::default() }),
            (
                "ground.grid.spacing_m",
                Ground { grid: Some(Grid { spacing_m: -1.0, ..Grid::default() }), ..Ground::default() },
            ),
            ("ground.color", Ground { color: LinearRgb([-1.0; 3]), ..Ground::default() }),
        ];
        for (words, ground) in broken {
            let mut stage = stage_of(&shot(), Vec::new(), Some(ground));
            match renderer.render(&mut stage, &shot().view()) {
                Err(e @ Error::Argument { .. }) => assert!(e.to_string().contains(words), "{e}"),
                other => panic!("expected an error of {words}, not {:?}", other.map(|i| i.width)),
            }
        }
    });
}

/// A host's plane at y = 0 that reads the shadow: white where light arrives, black where none does.
fn host_plane(gpu: &hikage::Gpu, shadow: StageShadow<'_>, view: &View) -> Vec<u8> {
    use wgpu::util::DeviceExt;
    let clip_from_world = view.camera.clip_from_view(1.0) * view.camera.view_from_world();
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(
            [
                StageShadow::WGSL,
                "struct Host { clip_from_world: mat4x4f, shadow: StageShadow }
                 @group(0) @binding(0) var<uniform> host: Host;
                 @group(0) @binding(1) var map: texture_depth_2d_array;
                 @group(0) @binding(2) var map_sampler: sampler_comparison;
                 struct Out { @builtin(position) clip: vec4f, @location(0) world: vec3f }
                 @vertex fn vs(@builtin(vertex_index) i: u32) -> Out {
                     let world = vec3f(f32(i % 2u) * 4.0 - 2.0, 0.0, f32(i / 2u) * 4.0 - 2.0);
                     return Out(host.clip_from_world * vec4f(world, 1.0), world);
                 }
                 @fragment fn fs(in: Out) -> @location(0) vec4f {
                     let lit = stage_shadow(host.shadow, map, map_sampler, in.world, vec3f(0.0, 1.0, 0.0));
                     return vec4f(vec3f(lit), 1.0);
                 }",
            ]
            .concat()
            .into(),
        ),
    });
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vs"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState { topology: wgpu::PrimitiveTopology::TriangleStrip, ..Default::default() },
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fs"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let numbers: Vec<u8> = clip_from_world
        .to_cols_array()
        .into_iter()
        .chain(shadow.numbers().into_iter().flatten())
        .flat_map(f32::to_ne_bytes)
        .collect();
    let uniform = gpu.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: None,
        contents: &numbers,
        usage: wgpu::BufferUsages::UNIFORM,
    });
    let sampler = StageShadow::sampler(gpu);
    let entries = [
        wgpu::BindGroupEntry { binding: 0, resource: uniform.as_entire_binding() },
        wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(shadow.map) },
        wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&sampler) },
    ];
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &pipeline.get_bind_group_layout(0),
        entries: &entries,
    });
    let into = target(gpu, view.size, format, 1);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let color = into.create_view(&wgpu::TextureViewDescriptor::default());
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: &color,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::WHITE), store: wgpu::StoreOp::Store },
        })],
        ..Default::default()
    });
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.draw(0..4, 0..1);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    texels(gpu, &into)
}

#[test]
fn a_hosts_ground_takes_the_shadow_of_all_actors() {
    let gpu = gpu();
    let ball = scene(vec![(sphere(0.2, 24, 48), two_tone())]);
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let ball = renderer.upload(&ball).expect("an upload");
    let shot = shot();
    let places = [Vec3::new(0.4, 0.5, 0.4), Vec3::new(-0.2, 0.5, -0.5)];
    let mut stage = stage_of(&shot, places.map(|p| Actor::new(&ball).at(p, 0.0)).into(), None);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    renderer.prepare(&mut encoder, &mut stage).expect("a stage");
    assert!(stage.shadow().is_none(), "nobody has asked for it");
    stage.casts_on_world = true;
    renderer.prepare(&mut encoder, &mut stage).expect("a stage");
    gpu.queue.submit([encoder.finish()]);
    let shadow = stage.shadow().expect("a shadow");
    let pixels = host_plane(&gpu, shadow, &shot.view());
    let lit = |place: Vec3| {
        let [x, y] = at(&shot, place);
        pixels[((y * shot.size[0] + x) * 4) as usize]
    };
    for place in places {
        // Half a metre above the ground, under light at 45 degrees from the right.
        let foot = place - Vec3::new(0.5, 0.5, 0.0);
        assert_eq!(lit(foot), 0, "no shadow of {place}");
        for beside in [Vec3::X * 0.4, Vec3::Z * 0.3, Vec3::Z * -0.3] {
            assert_eq!(lit(foot + beside), 255, "{beside} of the shadow of {place}");
        }
        let on_map = shadow.map_from_world().project_point3(foot);
        let above = shadow.map_from_world().project_point3(place);
        assert!(on_map.abs_diff_eq(above.with_z(on_map.z), 1e-4) && above.z < on_map.z, "{on_map} {above}");
    }
}

/// A wall that receives, with a board before it.
fn wall_and_board() -> [Scene; 2] {
    [(0.6, 0.0), (0.15, 0.0)].map(|(half, z)| {
        let mut material = two_tone();
        material.cast_shadow = Some(CastShadow { casts: true, received: 1.0 });
        let mut scene = scene(vec![(square([0.0, 0.0], half, z), material)]);
        scene.self_shadow = Some(SelfShadow::default());
        scene
    })
}

#[test]
fn actors_without_a_map_of_their_own_share_one() {
    let gpu = gpu();
    let [wall, board] = wall_and_board();
    with_renderer(&gpu, |renderer| {
        let [wall, board] = [&wall, &board].map(|s| renderer.upload(s).expect("an upload"));
        let mut shot = view(96, 3.0);
        shot.lights.directional.to_light = Vec3::new(1.0, 0.0, 1.0).normalize();
        let place = |i: usize| Vec3::new(0.0, i as f32 * 2.0, 0.0);
        let walls = MOST_SHADOWED as usize + 2;
        let actors = || {
            let pair = |i| [Actor::new(&wall).at(place(i), 0.0), Actor::new(&board).at(place(i) + Vec3::Z * 0.4, 0.0)];
            (0..walls).flat_map(pair).collect::<Vec<_>>()
        };
        let x = 48 - (0.4 / 0.529 * 48.0) as u32;
        for focus in [None, Some(place(walls - 1))] {
            let mut stage = stage_of(&shot, actors(), None);
            stage.focus = focus;
            for i in 0..walls {
                let mut seen = shot.clone();
                seen.camera.eye += place(i);
                seen.camera.target += place(i);
                let image = renderer.render(&mut stage, &seen.view()).expect("a picture");
                let (dark, light) = (pixel(&image, x, 48), pixel(&image, x, 10));
                assert!(dark[0] + 50 < light[0], "wall {i}, focus {focus:?}: {dark:?} {light:?}");
            }
        }
    });
}

#[test]
fn a_host_may_shade_an_actor() {
    let gpu = gpu();
    let [wall, _] = wall_and_board();
    let free =
        scene(vec![(cube(0.3), Material { shading: Shading::Unlit, base: Base::default(), ..Material::default() })]);
    with_renderer(&gpu, |renderer| {
        let [wall, free] = [&wall, &free].map(|s| renderer.upload(s).expect("an upload"));
        let mut shot = view(64, 3.0);
        shot.lights.directional.to_light = Vec3::Z;
        let mut stage = stage_of(&shot, vec![Actor::new(&wall), Actor::new(&free)], None);
        stage.actors[1].world = Mat4::from_translation(Vec3::new(0.0, 5.0, 0.0));
        let mut drawn = |key_light: f32| {
            stage.actors[0].key_light = key_light;
            renderer.render(&mut stage, &shot.view())
        };
        let [lit, half, dark] = [1.0, 0.5, 0.0].map(|k| pixel(&drawn(k).expect("a picture"), 32, 32)[0]);
        assert!(dark + 20 < half && half + 20 < lit, "{dark} {half} {lit}");
        assert!(drawn(1.5).is_err_and(|e| e.to_string().contains("actors[0].key_light")));
    });
}
