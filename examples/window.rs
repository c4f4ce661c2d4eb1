//! A character in a window of the application's own device: drag to orbit, scroll to come nearer, drop a file to load it, click
//! right to switch temporal antialiasing.
//!
//! `cargo run --release --example window -- MODEL.vrm`

use std::{error::Error, path::Path, time::Instant};

use glam::{Quat, Vec3};
use hikage::{
    Actor, Background, Renderer, Stage, View,
    color::Srgb,
    import,
    scene::{Antialias, Camera, Framing, Scene},
};
use winit::{
    application::ApplicationHandler,
    event::{ElementState, MouseButton, MouseScrollDelta, WindowEvent},
    event_loop::{ActiveEventLoop, EventLoop},
    window::WindowId,
};

#[path = "screen/mod.rs"]
mod screen;
use screen::Screen;

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
    screen: Screen,
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
        let screen = Screen::open(event_loop, [800, 800])?;
        let renderer = Renderer::with_output(&screen.gpu, screen.output())?;
        let stage = Stage::of([Actor::new(&renderer.upload(scene)?)]);
        Ok(Self { screen, renderer, stage, orbit: Orbit::around(scene), start: Instant::now() })
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
            size: self.screen.size(),
            camera: Camera { eye: self.orbit.eye(), target, near, ..Camera::default() },
            background: Background::Color(Srgb([0x9f, 0xb4, 0xc7])),
            ..View::default()
        }
    }

    fn draw(&mut self) -> Result<(), Box<dyn Error>> {
        let view = self.view();
        let Self { screen, renderer, stage, start, .. } = self;
        stage.time_s = start.elapsed().as_secs_f32();
        screen.show(|encoder, target| {
            renderer.prepare(encoder, stage)?;
            renderer.draw(encoder, stage, &view, target)
        })
    }
}

impl App {
    fn try_event(&mut self, event_loop: &ActiveEventLoop, event: WindowEvent) -> Result<(), Box<dyn Error>> {
        let Some(shown) = &mut self.shown else { return Ok(()) };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Resized(size) => shown.screen.resize(size),
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
                shown.screen.window.request_redraw();
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
