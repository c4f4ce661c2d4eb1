//! A character in a window of the application's own device: drag to orbit, scroll to come nearer, drop a file to load it, click
//! right to switch temporal antialiasing.
//!
//! `cargo run --release --example window -- MODEL.vrm`

use std::{error::Error, path::Path, sync::Arc, time::Instant};

use glam::{Quat, Vec3};
use hikage::{
    Actor, Background, Gpu, Output, Renderer, Stage, View,
    color::Srgb,
    import,
    scene::{Antialias, Camera, Framing, Scene},
};
use winit::{
    application::ApplicationHandler,
    dpi::PhysicalSize,
    event::{ElementState, MouseButton, MouseScrollDelta, WindowEvent},
    event_loop::{ActiveEventLoop, EventLoop},
    window::{Window, WindowId},
};

fn main() -> Result<(), Box<dyn Error>> {
    let model = std::env::args().nth(1).ok_or("usage: window MODEL.vrm")?;
    let scene = import::load(Path::new(&model))?;
    let mut app = App { scene, shown: None, failed: None };
    EventLoop::new()?.run_app(&mut app)?;
    app.failed.map_or(Ok(()), Err)
}

struct App {
    scene: Scene,
    shown: Option<Shown>,
    failed: Option<Box<dyn Error>>,
}

/// Everything that exists only while the window does.
struct Shown {
    window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    gpu: Gpu,
    renderer: Renderer,
    stage: Stage,
    orbit: Orbit,
    start: Instant,
}

/// Camera around a point.
struct Orbit {
    yaw_rad: f32,
    pitch_rad: f32,
    distance: f32,
    target: Vec3,
    near: f32,
    dragging: bool,
    cursor: [f64; 2],
}

impl Orbit {
    fn around(scene: &Scene) -> Self {
        let camera = View::framed(scene, Framing::Portrait, 0.0, [1, 1]).camera;
        let distance = (camera.eye - camera.target).length();
        Self {
            yaw_rad: 0.3,
            pitch_rad: 0.05,
            distance,
            target: camera.target,
            near: camera.near,
            dragging: false,
            cursor: [0.0; 2],
        }
    }

    fn eye(&self) -> Vec3 {
        self.target
            + Quat::from_rotation_y(self.yaw_rad) * Quat::from_rotation_x(-self.pitch_rad) * Vec3::Z * self.distance
    }
}

impl Shown {
    fn new(event_loop: &ActiveEventLoop, scene: &Scene) -> Result<Self, Box<dyn Error>> {
        let attributes = Window::default_attributes().with_title("Hikage").with_inner_size(PhysicalSize::new(800, 800));
        let window = Arc::new(event_loop.create_window(attributes)?);
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let surface = instance.create_surface(window.clone())?;
        let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions {
            compatible_surface: Some(&surface),
            ..Default::default()
        }))?;
        let (device, queue) = pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor {
            required_limits: Gpu::required_limits(&adapter),
            required_features: Gpu::wanted_features(&adapter),
            ..Default::default()
        }))?;
        let gpu = Gpu::from_parts(&adapter, device, queue);
        let size = window.inner_size();
        let mut config = surface
            .get_default_config(&adapter, size.width.max(1), size.height.max(1))
            .ok_or("the adapter cannot show this window")?;
        let formats = surface.get_capabilities(&adapter).formats;
        config.format = formats.into_iter().find(wgpu::TextureFormat::is_srgb).unwrap_or(config.format);
        surface.configure(&gpu.device, &config);
        let renderer = Renderer::with_output(&gpu, Output { format: config.format, ..Output::default() })?;
        let stage = Stage::of([Actor::new(&renderer.upload(scene)?)]);
        let orbit = Orbit::around(scene);
        Ok(Self { window, surface, config, gpu, renderer, stage, orbit, start: Instant::now() })
    }

    fn load(&mut self, path: &Path) -> Result<Scene, Box<dyn Error>> {
        let scene = import::load(path)?;
        self.stage = Stage::of([Actor::new(&self.renderer.upload(&scene)?)]);
        self.orbit = Orbit::around(&scene);
        Ok(scene)
    }

    fn view(&self) -> View {
        let Orbit { target, near, .. } = self.orbit;
        View {
            size: [self.config.width, self.config.height],
            camera: Camera { eye: self.orbit.eye(), target, near, ..Camera::default() },
            background: Background::Color(Srgb([0x9f, 0xb4, 0xc7])),
            ..View::default()
        }
    }

    fn draw(&mut self) -> Result<(), Box<dyn Error>> {
        use wgpu::CurrentSurfaceTexture as Current;
        let frame = match self.surface.get_current_texture() {
            Current::Success(frame) | Current::Suboptimal(frame) => frame,
            Current::Outdated | Current::Lost => {
                self.surface.configure(&self.gpu.device, &self.config);
                return Ok(());
            }
            Current::Timeout | Current::Occluded => return Ok(()),
            Current::Validation => return Err("the window's surface is invalid".into()),
        };
        let target = frame.texture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let view = self.view();
        self.stage.time_s = self.start.elapsed().as_secs_f32();
        self.renderer.prepare(&mut encoder, &mut self.stage)?;
        self.renderer.draw(&mut encoder, &self.stage, &view, &target)?;
        self.gpu.queue.submit([encoder.finish()]);
        self.window.pre_present_notify();
        self.gpu.queue.present(frame);
        Ok(())
    }
}

impl App {
    fn try_event(&mut self, event_loop: &ActiveEventLoop, event: WindowEvent) -> Result<(), Box<dyn Error>> {
        let Some(shown) = &mut self.shown else { return Ok(()) };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Resized(size) => {
                [shown.config.width, shown.config.height] = [size.width.max(1), size.height.max(1)];
                shown.surface.configure(&shown.gpu.device, &shown.config);
            }
            WindowEvent::DroppedFile(path) => match shown.load(&path) {
                Ok(scene) => self.scene = scene,
                Err(e) => eprintln!("{e}"),
            },
            WindowEvent::MouseInput { state, button: MouseButton::Left, .. } => {
                shown.orbit.dragging = state == ElementState::Pressed;
            }
            WindowEvent::MouseInput { state: ElementState::Pressed, button: MouseButton::Right, .. } => {
                let post = shown.stage.post.get_or_insert_default();
                post.antialias = match post.antialias {
                    Antialias::Temporal => Antialias::Fxaa,
                    _ => Antialias::Temporal,
                };
            }
            WindowEvent::CursorMoved { position, .. } => {
                let moved = [position.x - shown.orbit.cursor[0], position.y - shown.orbit.cursor[1]];
                shown.orbit.cursor = [position.x, position.y];
                if shown.orbit.dragging {
                    shown.orbit.yaw_rad -= moved[0] as f32 * 0.008;
                    shown.orbit.pitch_rad = (shown.orbit.pitch_rad + moved[1] as f32 * 0.008).clamp(-1.4, 1.4);
                }
            }
            WindowEvent::MouseWheel { delta, .. } => {
                let notches = match delta {
                    MouseScrollDelta::LineDelta(_, y) => y,
                    MouseScrollDelta::PixelDelta(p) => p.y as f32 / 60.0,
                };
                shown.orbit.distance = (shown.orbit.distance * 0.9f32.powf(notches)).clamp(0.2, 30.0);
            }
            WindowEvent::RedrawRequested => {
                shown.draw()?;
                shown.window.request_redraw();
            }
            _ => {}
        }
        Ok(())
    }
}

impl ApplicationHandler for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        match Shown::new(event_loop, &self.scene) {
            Ok(shown) => self.shown = Some(shown),
            Err(e) => {
                self.failed = Some(e);
                event_loop.exit();
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        if let Err(e) = self.try_event(event_loop, event) {
            self.failed = Some(e);
            event_loop.exit();
        }
    }
}
