//! Actors in the frame of a host: its colour is kept, its depth hides them, and they hide what it draws.

use glam::{Mat4, Vec3};
use hikage::color::Srgb;
use hikage::material::{Alpha, AlphaMode, Base, Blending, Material, Outline, OutlineWidth, Shading};
use hikage::scene::{Antialias, Bloom, Framing, Post, Scene, ToneCurve};
use hikage::{Actor, Background, Error, Far, Gpu, HostDepth, Output, Renderer, Stage, Target, View};

use crate::support::{HEAD, Shot, anime_heroine, cube, gpu, keep, scene, sphere, texels, two_tone, view};

const COLOR: [f32; 4] = [0.1, 0.5, 0.2, 1.0];
const HALF: f32 = 0.25;

/// A ball with a line round it.
fn ball() -> Scene {
    let mut material = two_tone();
    material.outline = Some(Outline { width: OutlineWidth::World { metres: 0.02 }, ..Outline::default() });
    scene(vec![(sphere(0.3, 24, 48), material)])
}

/// The host's cube as a character.
fn cube_inside() -> Scene {
    let base = Base { color: COLOR, texture: None };
    scene(vec![(cube(HALF), Material { base, shading: Shading::Unlit, ..Material::default() })])
}

/// A host that draws a cube of one colour.
struct Host {
    far: f32,
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
    vertices: wgpu::Buffer,
    color: wgpu::Texture,
    depth: wgpu::Texture,
    resolved: wgpu::Texture,
}

impl Host {
    fn new(gpu: &Gpu, output: Output, size: [u32; 2], clip_from_world: Mat4) -> Self {
        use wgpu::util::DeviceExt;
        let device = &gpu.device;
        let HostDepth { format: depth_format, far } = output.depth.expect("a host's depth");
        let (nearer, far) = match far {
            Far::Zero => (wgpu::CompareFunction::Greater, 0.0),
            Far::One => (wgpu::CompareFunction::Less, 1.0),
        };
        let texture = |format, samples, more| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: None,
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: samples,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | more,
                view_formats: &[],
            })
        };
        let [r, g, b, a] = COLOR;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: wgpu::ShaderSource::Wgsl(
                format!(
                    "@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
                     @vertex fn vs(@location(0) at: vec3f) -> @builtin(position) vec4f {{
                         return clip_from_world * vec4f(at, 1.0);
                     }}
                     @fragment fn fs() -> @location(0) vec4f {{ return vec4f({r}, {g}, {b}, {a}); }}"
                )
                .into(),
            ),
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: None,
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(wgpu::VertexBufferLayout {
                    array_stride: 12,
                    step_mode: wgpu::VertexStepMode::Vertex,
                    attributes: &wgpu::vertex_attr_array![0 => Float32x3],
                })],
            },
            primitive: wgpu::PrimitiveState { cull_mode: Some(wgpu::Face::Back), ..Default::default() },
            depth_stencil: Some(wgpu::DepthStencilState {
                format: depth_format,
                depth_write_enabled: Some(true),
                depth_compare: Some(nearer),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState { count: output.samples, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fs"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(output.format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let shape = cube(HALF);
        let corners: Vec<u8> =
            shape.indices.iter().flat_map(|i| shape.positions[*i as usize]).flat_map(f32::to_ne_bytes).collect();
        let numbers: Vec<u8> = clip_from_world.to_cols_array().iter().copied().flat_map(f32::to_ne_bytes).collect();
        let buffer = |contents: &[u8], usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
        };
        let numbers = buffer(&numbers, wgpu::BufferUsages::UNIFORM);
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: numbers.as_entire_binding() }],
        });
        Self {
            far,
            group,
            pipeline,
            vertices: buffer(&corners, wgpu::BufferUsages::VERTEX),
            color: texture(output.format, output.samples, wgpu::TextureUsages::COPY_SRC),
            depth: texture(depth_format, output.samples, wgpu::TextureUsages::empty()),
            resolved: texture(output.format, 1, wgpu::TextureUsages::COPY_SRC),
        }
    }

    fn views(&self) -> [wgpu::TextureView; 3] {
        [&self.color, &self.depth, &self.resolved].map(|t| t.create_view(&wgpu::TextureViewDescriptor::default()))
    }

    /// Its cube, before or after the actors; `is_last` resolves the samples.
    fn draw(&self, encoder: &mut wgpu::CommandEncoder, clears: bool, draws: bool, is_last: bool) {
        let [color, depth, resolved] = self.views();
        let grey = f64::from(0x80u8) / 255.0;
        let linear = ((grey + 0.055) / 1.055).powf(2.4);
        let clear = wgpu::Color { r: linear, g: linear, b: linear, a: 1.0 };
        let has_samples = self.color.sample_count() > 1;
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("host"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &color,
                depth_slice: None,
                resolve_target: Some(&resolved).filter(|_| is_last && has_samples),
                ops: wgpu::Operations {
                    load: if clears {
                        wgpu::LoadOp::Clear(clear)
                    } else {
                        wgpu::LoadOp::Load
                    },
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations {
                    load: if clears {
                        wgpu::LoadOp::Clear(self.far)
                    } else {
                        wgpu::LoadOp::Load
                    },
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: self
                    .depth
                    .format()
                    .has_stencil_aspect()
                    .then_some(wgpu::Operations { load: wgpu::LoadOp::Clear(7), store: wgpu::StoreOp::Store }),
            }),
            ..Default::default()
        });
        if draws {
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            pass.set_vertex_buffer(0, self.vertices.slice(..));
            pass.draw(0..36, 0..1);
        }
    }

    fn finished(&self) -> &wgpu::Texture {
        if self.color.sample_count() > 1 {
            &self.resolved
        } else {
            &self.color
        }
    }
}

/// A view from the side, in which the cube hides one ball and the other ball hides the cube.
fn shot() -> Shot {
    let mut shot = Shot { size: [128, 96], ..view(96, 3.0) };
    shot.camera.eye = Vec3::new(0.4, 0.3, 3.0);
    shot
}

/// Cameras of hosts.
#[derive(Clone, Copy, Debug)]
enum Lens {
    /// That of the view.
    Camera,
    /// A host's matrices, with a far plane and a picture that is shifted sideways.
    Planes(Far),
}

impl Lens {
    fn far(self) -> Far {
        match self {
            Self::Camera => Far::Zero,
            Self::Planes(far) => far,
        }
    }

    /// The view through it, and its matrix.
    fn of(self, view: &View) -> (View, Mat4) {
        let aspect = view.size[0] as f32 / view.size[1] as f32;
        let (view_from_world, mut clip_from_view) = (view.camera.view_from_world(), view.camera.clip_from_view(aspect));
        let view = match self {
            Self::Camera => view.clone(),
            Self::Planes(far) => {
                let (near, end) = (0.2f32, 40.0f32);
                let (a, b) = match far {
                    Far::One => (end / (end - near), -near * end / (end - near)),
                    Far::Zero => (-near / (end - near), near * end / (end - near)),
                };
                (clip_from_view.z_axis.z, clip_from_view.w_axis.z) = (-a, b);
                clip_from_view.z_axis.x = 0.1;
                View { background: view.background, ..View::of_matrices(view_from_world, clip_from_view, view.size) }
            }
        };
        (view, clip_from_view * view_from_world)
    }
}

fn actors(renderer: &Renderer, with_cube: bool) -> Stage {
    actors_of(renderer, &ball(), with_cube)
}

fn actors_of(renderer: &Renderer, ball: &Scene, with_cube: bool) -> Stage {
    let ball = renderer.upload(ball).expect("an upload");
    let mut actors = vec![Actor::new(&ball).at([-0.1, 0.1, 0.5], 0.0), Actor::new(&ball).at([0.15, -0.1, -0.6], 0.0)];
    if with_cube {
        actors.push(Actor::new(&renderer.upload(&cube_inside()).expect("an upload")));
    }
    let mut stage = Stage::of(actors);
    stage.lights = shot().lights;
    stage
}

#[test]
fn a_hosts_cube_hides_and_is_hidden_as_one_drawn_inside() {
    use wgpu::TextureFormat as F;
    let gpu = gpu();
    let own_view = shot().view();
    for (format, samples, depth, lens) in [
        (F::Rgba8UnormSrgb, 4, F::Depth32Float, Lens::Camera),
        (F::Rgba8UnormSrgb, 1, F::Depth24Plus, Lens::Camera),
        (F::Rgba8UnormSrgb, 4, F::Depth24PlusStencil8, Lens::Camera),
        (F::Rgba16Float, 4, F::Depth32Float, Lens::Camera),
        (F::Rgba8UnormSrgb, 4, F::Depth32Float, Lens::Planes(Far::Zero)),
        (F::Rgba8UnormSrgb, 4, F::Depth32Float, Lens::Planes(Far::One)),
        (F::Rgba8UnormSrgb, 1, F::Depth24Plus, Lens::Planes(Far::One)),
        (F::Rgba16Float, 1, F::Depth32Float, Lens::Planes(Far::One)),
    ] {
        let (view, clip_from_world) = lens.of(&own_view);
        let output = Output { format, samples, depth: Some(HostDepth { format: depth, far: lens.far() }) };
        // The same inside of a picture of its own, with the host's kind of depth.
        let own = Renderer::with_output(&gpu, Output { depth: None, ..output }).expect("a renderer");
        let mut stage = actors(&own, true);
        let inside = Host::new(&gpu, output, view.size, clip_from_world);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        own.prepare(&mut encoder, &mut stage).expect("a stage");
        own.draw(&mut encoder, &stage, &view, &inside.views()[2]).expect("a view");
        gpu.queue.submit([encoder.finish()]);
        let expected = texels(&gpu, &inside.resolved);

        let renderer = Renderer::with_output(&gpu, output).expect("a renderer");
        let mut stage = actors(&renderer, false);
        for cube_first in [true, false] {
            let host = Host::new(&gpu, output, view.size, clip_from_world);
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            host.draw(&mut encoder, true, cube_first, false);
            renderer.prepare(&mut encoder, &mut stage).expect("a stage");
            let [color, depth, _] = host.views();
            let target = Target { color: &color, keeps_color: true, depth: Some(&depth) };
            renderer.draw(&mut encoder, &stage, &view, target).expect("a view");
            host.draw(&mut encoder, false, !cube_first, true);
            gpu.queue.submit([encoder.finish()]);
            let found = texels(&gpu, host.finished());
            let off = if format == F::Rgba8UnormSrgb {
                expected.iter().zip(&found).filter(|(a, b)| a.abs_diff(**b) > 1).count()
            } else {
                expected.iter().zip(&found).filter(|(a, b)| a != b).count()
            };
            assert!(found.chunks_exact(4).any(|p| p != &found[..4]), "nothing is drawn");
            // At edges that cross, samples of other depths may fall on the other side.
            let most = if matches!(depth.texture().format(), F::Depth32Float) && matches!(lens, Lens::Camera) {
                0
            } else {
                8
            };
            assert!(
                off <= most,
                "{format:?}, {samples} samples, {lens:?}, {:?}, cube first {cube_first}: {off} bytes differ",
                output.depth
            );
        }
    }
}

/// A ball of three skins: a core in the lower half, what is seen through above it.
fn skins(blending: Blending) -> Scene {
    let parts = [0.3, 0.25, 0.2].map(|radius| {
        let mut skin = sphere(radius, 24, 48);
        skin.colors =
            skin.uvs[0].iter().map(|uv| [1.0 - uv[1], radius, uv[1], if uv[1] > 0.6 { 1.0 } else { 0.5 }]).collect();
        let alpha = Alpha { mode: AlphaMode::Blend, blending, ..Alpha::default() };
        (skin, Material { alpha, shading: Shading::Unlit, double_sided: true, ..Material::default() })
    });
    scene(parts.into())
}

#[test]
fn layers_are_in_a_hosts_frame_what_they_are_alone() {
    use wgpu::TextureFormat as F;
    let gpu = gpu();
    let own_view = View { background: Background::Color(Srgb([0x80; 3])), ..shot().view() };
    for blending in [Blending::ThreePass, Blending::DoubleLayer, Blending::Weighted] {
        for (samples, depth, lens, post) in [
            (4, F::Depth32Float, Lens::Camera, false),
            (1, F::Depth24Plus, Lens::Planes(Far::One), false),
            (4, F::Depth24PlusStencil8, Lens::Planes(Far::One), false),
            (4, F::Depth32Float, Lens::Planes(Far::Zero), true),
            (1, F::Depth32Float, Lens::Camera, true),
        ] {
            let (view, clip_from_world) = lens.of(&own_view);
            let plain = Post { bloom: None, exposure_ev: 0.0, tone: ToneCurve::None, antialias: Antialias::None };
            let own = Renderer::with_output(&gpu, Output { samples, ..Output::default() }).expect("a renderer");
            let mut stage = actors_of(&own, &skins(blending), true);
            stage.post = post.then_some(plain);
            let expected = own.render(&mut stage, &view).expect("a picture").pixels;

            let output =
                Output { samples, depth: Some(HostDepth { format: depth, far: lens.far() }), ..Output::default() };
            let renderer = Renderer::with_output(&gpu, output).expect("a renderer");
            let mut stage = actors_of(&renderer, &skins(blending), false);
            stage.post = post.then_some(plain);
            let host = Host::new(&gpu, output, view.size, clip_from_world);
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            host.draw(&mut encoder, true, true, false);
            renderer.prepare(&mut encoder, &mut stage).expect("a stage");
            let [color, depth_view, _] = host.views();
            let target = Target { color: &color, keeps_color: true, depth: Some(&depth_view) };
            renderer.draw(&mut encoder, &stage, &view, target).expect("a view");
            host.draw(&mut encoder, false, false, true);
            gpu.queue.submit([encoder.finish()]);
            let found = texels(&gpu, host.finished());
            // Where samples cross, depths of fewer bits fall on either side.
            let off = expected.iter().zip(&found).filter(|(a, b)| a.abs_diff(**b) > 2).count();
            // A finished picture is resolved before it is laid over the cube.
            let most = if post && samples == 4 { 500 } else { 24 };
            assert!(
                off <= most,
                "{blending:?}, {samples} samples, {depth:?}, {lens:?}, post {post}: {off} bytes differ"
            );
        }
    }
}

#[test]
fn what_a_host_hands_in_must_fit() {
    use wgpu::TextureFormat as F;
    let gpu = gpu();
    let view = shot().view();
    let of = |format| Some(HostDepth { format, far: Far::Zero });
    let output = Output { depth: of(F::Depth32Float), ..Output::default() };
    let renderer = Renderer::with_output(&gpu, output).expect("a renderer");
    let mut stage = actors(&renderer, false);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    renderer.prepare(&mut encoder, &mut stage).expect("a stage");
    let host = Host::new(&gpu, output, view.size, Mat4::IDENTITY);
    let other = Host::new(&gpu, Output { depth: of(F::Depth24Plus), ..output }, view.size, Mat4::IDENTITY);
    let [color, depth, resolved] = host.views();
    let whole = Target { color: &color, keeps_color: true, depth: Some(&depth) };
    for (target, words) in [
        (Target { color: &resolved, ..whole }, "samples: has 1; expected 4"),
        (Target { depth: None, ..whole }, "expected 1"),
        (Target { depth: Some(&other.views()[1]), ..whole }, "depth format: has Depth24Plus; expected Depth32Float"),
        (Target { color: &resolved, depth: None, keeps_color: false }, "target: depth: has none"),
    ] {
        match renderer.draw(&mut encoder, &stage, &view, target) {
            Err(e @ Error::Argument { .. }) => assert!(e.to_string().contains(words), "{e}; expected {words}"),
            other => panic!("expected an error of {words}, not {other:?}"),
        }
    }
    let far = View { size: [64, 64], ..view };
    assert!(renderer.draw(&mut encoder, &stage, &far, whole).is_err_and(|e| e.to_string().contains("size")));
    let strange = Output { depth: of(F::Depth16Unorm), ..output };
    assert!(Renderer::with_output(&gpu, strange).is_err_and(|e| e.to_string().contains("Depth16Unorm")));
    let (other_way, _) = Lens::Planes(Far::One).of(&view);
    let error = renderer.draw(&mut encoder, &stage, &other_way, whole).expect_err("the other direction").to_string();
    assert!(error.contains("Far::Zero"), "{error}");
    let flat = View::of_matrices(view.camera.view_from_world(), Mat4::IDENTITY, view.size);
    assert!(renderer.draw(&mut encoder, &stage, &flat, whole).is_err_and(|e| e.to_string().contains("perspective")));
}

/// A head with everything that reads what other passes have drawn.
#[test]
fn rims_lines_and_eyes_through_hair_are_in_a_hosts_frame_what_they_are_alone() {
    use wgpu::TextureFormat as F;
    let gpu = gpu();
    let mut scene = anime_heroine();
    keep(&mut scene, HEAD);
    scene.post = None;
    assert!(scene.materials.iter().any(|m| m.depth_rim.is_some()), "she has no rim");
    scene.materials.iter_mut().for_each(|m| m.inner_lines = Some(Default::default()));
    let own_view =
        View { background: Background::Color(Srgb([0x80; 3])), ..View::framed(&scene, Framing::Face, 0.3, [128, 128]) };
    for (depth, lens, most) in [
        (F::Depth32FloatStencil8, Lens::Camera, 60),
        (F::Depth24PlusStencil8, Lens::Camera, 60),
        (F::Depth24PlusStencil8, Lens::Planes(Far::One), 300),
        (F::Depth24PlusStencil8, Lens::Planes(Far::Zero), 300),
    ] {
        let (view, clip_from_world) = lens.of(&own_view);
        let output = Output { depth: Some(HostDepth { format: depth, far: lens.far() }), ..Output::default() };
        let drawn = |output: Output, hosted: bool| {
            let renderer = Renderer::with_output(&gpu, output).expect("a renderer");
            let mut stage = Stage::of([Actor::new(&renderer.upload(&scene).expect("an upload"))]);
            if !hosted {
                return renderer.render(&mut stage, &view).expect("a picture").pixels;
            }
            let host = Host::new(&gpu, output, view.size, clip_from_world);
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            renderer.prepare(&mut encoder, &mut stage).expect("a stage");
            host.draw(&mut encoder, true, false, false);
            let [color, depth, _] = host.views();
            let target = Target { color: &color, keeps_color: true, depth: Some(&depth) };
            renderer.draw(&mut encoder, &stage, &view, target).expect("a view");
            host.draw(&mut encoder, false, false, true);
            gpu.queue.submit([encoder.finish()]);
            texels(&gpu, host.finished())
        };
        let (alone, hosted) = (drawn(Output::default(), false), drawn(output, true));
        let off = alone.iter().zip(&hosted).filter(|(a, b)| a.abs_diff(**b) > 1).count();
        assert!(off <= most, "{lens:?}: {off} bytes differ");
    }
}

/// What finishes whole pictures, and samples of our own, are drawn apart and laid over the host's colour.
#[test]
fn finished_pictures_are_laid_over_what_is_kept() {
    let gpu = gpu();
    let view = View { background: Background::Color(Srgb([0x80; 3])), ..shot().view() };
    let clip_from_world =
        view.camera.clip_from_view(view.size[0] as f32 / view.size[1] as f32) * view.camera.view_from_world();
    let post =
        Post { bloom: Some(Bloom::default()), exposure_ev: 0.0, tone: ToneCurve::Filmic, antialias: Antialias::None };
    let depth = HOST;
    for (post, samples, depth) in
        [(Some(post), 4, depth), (Some(post), 1, depth), (Some(post), 4, None), (None, 4, None), (None, 1, None)]
    {
        let own = Renderer::with_output(&gpu, Output { samples, ..Output::default() }).expect("a renderer");
        let mut stage = actors(&own, false);
        stage.post = post;
        let expected = own.render(&mut stage, &view).expect("a picture").pixels;

        let output = Output { samples, depth, ..Output::default() };
        let renderer = Renderer::with_output(&gpu, output).expect("a renderer");
        let mut stage = actors(&renderer, false);
        stage.post = post;
        let of_host =
            Output { samples: if depth.is_some() { samples } else { 1 }, depth: output.depth.or(HOST), ..output };
        let host = Host::new(&gpu, of_host, view.size, clip_from_world);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        renderer.prepare(&mut encoder, &mut stage).expect("a stage");
        host.draw(&mut encoder, true, false, false);
        let [color, host_depth, _] = host.views();
        let target = Target { color: &color, keeps_color: true, depth: depth.map(|_| &host_depth) };
        renderer.draw(&mut encoder, &stage, &view, target).expect("a view");
        host.draw(&mut encoder, false, false, true);
        gpu.queue.submit([encoder.finish()]);
        let found = texels(&gpu, host.finished());
        let off = expected.iter().zip(&found).map(|(a, b)| a.abs_diff(*b)).max();
        // Smoothed edges see what is behind them.
        let most = if samples == 1 && post.is_some() { 12 } else { 1 };
        assert!(off <= Some(most), "post {}, {samples} samples, {depth:?}: {off:?}", post.is_some());
    }
}

const HOST: Option<HostDepth> = Some(HostDepth { format: wgpu::TextureFormat::Depth32Float, far: Far::Zero });
