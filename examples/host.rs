//! A host with its own pipeline, a field of cubes and a depth buffer, through which two characters walk; frames as PNG files.
//!
//! `cargo run --release --example host`

use hikage::glam::{Mat4, Quat, Vec3};
use hikage::motion::{Pose, Stance};
use hikage::scene::HumanBone;
use hikage::wgpu;
use hikage::{
    Actor, Anime, Error, Far, Gpu, HostDepth, Look, Output, Renderer, Stage, Target, View, import, picture,
    scene::Framing,
};

const SIZE: [u32; 2] = [960, 540];
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;
const SAMPLES: u32 = 4;

const WGSL: &str = "
struct Varying { @builtin(position) clip: vec4f, @location(0) color: vec3f }
@vertex fn vs(@builtin(vertex_index) i: u32, @builtin(instance_index) n: u32) -> Varying {
    // Corners of a cube, face by face; each third turn of the axes is another pair of faces.
    let face = i / 6u;
    let corner = vec2f(f32((0x32u >> (i % 6u)) & 1u), f32((0x1cu >> (i % 6u)) & 1u)) * 2.0 - 1.0;
    let side = select(-1.0, 1.0, face % 2u == 0u);
    let p = vec3f(corner.x * side, corner.y, side);
    let at = array(p.xyz, p.zxy, p.yzx)[face / 2u];
    let place = vec3f(f32(n % 7u) * 0.8 - 2.4, 0.0, f32(n / 7u) * -0.9 + 1.2);
    let height = 0.12 + 0.5 * fract(f32(n) * 0.618);
    let world = place + (at * 0.5 + vec3f(0.0, 0.5, 0.0)) * vec3f(0.3, height, 0.3);
    let light = array(0.75, 1.0, 0.55)[face / 2u];
    return Varying(clip_from_world * vec4f(world, 1.0), vec3f(0.32, 0.4, 0.55) * light);
}
@fragment fn fs(in: Varying) -> @location(0) vec4f { return vec4f(in.color, 1.0); }";

fn main() -> Result<(), Error> {
    // The characters: their renderer draws into the host's formats.
    let gpu = Gpu::headless(None)?;
    let output = Output { format: FORMAT, samples: SAMPLES, depth: Some(HostDepth { format: DEPTH, far: Far::Zero }) };
    let renderer = Renderer::with_output(&gpu, output)?;
    let mut scene = import::load_bytes("hikage.vrm", &hikage_character::file(), None, &import::Limits::default())?;
    Look::Anime(Anime::default()).apply(&mut scene);
    scene.post = None;
    let girl = renderer.upload_and_empty_images(&mut scene)?;
    let mut relaxed = Pose::rest(girl.scene());
    relaxed.set_stance(girl.scene(), Stance::Relaxed);
    let mut stage = Stage::of([(); 2].map(|()| Actor::new(&girl).posed(relaxed.clone())));
    let mut view = View::framed(girl.scene(), Framing::Full, 0.0, SIZE);
    view.camera.eye += Vec3::new(0.0, 0.7, 0.8);
    let clip_from_world = view.camera.clip_from_view(SIZE[0] as f32 / SIZE[1] as f32) * view.camera.view_from_world();

    // The host: its targets, its pipeline, its camera.
    let texture = |format, sample_count, usage| {
        gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | usage,
            view_formats: &[],
        })
    };
    let shown = texture(FORMAT, 1, wgpu::TextureUsages::COPY_SRC);
    let none = wgpu::TextureUsages::empty();
    let [color, depth, resolved] = [&texture(FORMAT, SAMPLES, none), &texture(DEPTH, SAMPLES, none), &shown]
        .map(|t| t.create_view(&wgpu::TextureViewDescriptor::default()));
    // The camera never moves: a constant will do.
    let numbers = clip_from_world.to_cols_array().map(|x| format!("{x:?}")).join(", ");
    let camera = format!("const clip_from_world = mat4x4f({numbers});");
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(format!("{camera}{WGSL}").into()),
    });
    let cubes = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vs"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: wgpu::MultisampleState { count: SAMPLES, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fs"),
            compilation_options: Default::default(),
            targets: &[Some(FORMAT.into())],
        }),
        multiview_mask: None,
        cache: None,
    });
    let host = |encoder: &mut wgpu::CommandEncoder, is_first: bool| {
        let sky = wgpu::Color { r: 0.5, g: 0.66, b: 0.8, a: 1.0 };
        let (load, depth_load) = match is_first {
            true => (wgpu::LoadOp::Clear(sky), wgpu::LoadOp::Clear(0.0)),
            false => (wgpu::LoadOp::Load, wgpu::LoadOp::Load),
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &color,
                depth_slice: None,
                resolve_target: Some(&resolved).filter(|_| !is_first),
                ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth,
                depth_ops: Some(wgpu::Operations { load: depth_load, store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        // Half of the field before the characters, half of it after them: the depth does not mind.
        pass.set_pipeline(&cubes);
        pass.draw(0..36, if is_first { 0..14 } else { 14..35 });
    };

    for frame in 0..3 {
        let step = frame as f32 * 0.45;
        for (i, actor) in stage.actors.iter_mut().enumerate() {
            let side = if i == 0 { 1.0 } else { -1.0 };
            actor.world = Mat4::from_translation(Vec3::new((step - 0.5) * side, 0.0, -0.35 * i as f32))
                * Mat4::from_rotation_y(0.9 * side);
            // Legs swing against each other.
            actor.pose.clone_from(&relaxed);
            for (bone, swing) in [(HumanBone::LeftUpperLeg, 0.5), (HumanBone::RightUpperLeg, -0.5)] {
                actor.pose.turn(girl.scene(), bone, Quat::from_rotation_x(swing * (step * 4.0 + i as f32).sin()));
            }
        }
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        renderer.prepare(&mut encoder, &mut stage)?;
        host(&mut encoder, true);
        renderer.draw(&mut encoder, &stage, &view, Target { color: &color, keeps_color: true, depth: Some(&depth) })?;
        host(&mut encoder, false);
        gpu.queue.submit([encoder.finish()]);
        picture::write_png(format!("host-{frame}.png"), &picture::read_texture(&gpu, &shown)?)?;
    }
    Ok(())
}
