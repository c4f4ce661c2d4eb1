//! A small playground: walk with the arrow keys or WASD, run with Shift, the camera follows; the other character looks at you,
//! and waves when you come near.
//!
//! `cargo run --release --example game -- [PLAYER.vrm [OTHER.vrm]] [--auto]` (`--auto` walks by itself)

use std::{collections::HashSet, error::Error, sync::Arc, time::Instant};

use glam::{Mat4, Quat, Vec3};
use hikage::material::{Base, Material, Outline, OutlineWidth, Shading, Toon};
use hikage::motion::{Blink, Clip, GazeTarget, Play, RootMotion, SPRING_STEP_S};
use hikage::scene::{Antialias, Camera, HumanBone, Mesh, Node, Primitive, Role, Scene};
use hikage::{Actor, Anime, Background, Character, Grid, Ground, Look, Renderer, Stage, View, color::Srgb, import};
use winit::application::ApplicationHandler;
use winit::event::{ElementState, WindowEvent};
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::keyboard::{KeyCode, PhysicalKey};
use winit::window::WindowId;

#[path = "screen/mod.rs"]
mod screen;
use screen::Screen;

const SKY: Srgb = Srgb([0xb9, 0xd3, 0xe6]);
/// Boxes: middle of the base and half of the height, metres.
const BOXES: [([f32; 3], f32); 4] =
    [([2.2, 0.0, 1.0], 0.35), ([-2.4, 0.0, -0.6], 0.5), ([-1.6, 0.0, 2.6], 0.25), ([1.4, 0.0, -2.6], 0.45)];
/// Near enough to be waved at, metres.
const NEAR_M: f32 = 2.6;

fn main() -> Result<(), Box<dyn Error>> {
    let (options, models): (Vec<String>, Vec<String>) = std::env::args().skip(1).partition(|a| a.starts_with("--"));
    let mut app = App { models, auto: options.iter().any(|o| o == "--auto"), shown: None, failed: None };
    EventLoop::new()?.run_app(&mut app)?;
    app.failed.map_or(Ok(()), Err)
}

/// A character with the clips that it knows.
struct Cast {
    character: Character,
    clips: [Arc<Clip>; 4],
}

impl Cast {
    fn load(renderer: &Renderer, model: Option<&String>, hair: [f32; 3]) -> Result<Self, Box<dyn Error>> {
        let limits = import::Limits::default();
        let mut scene = match model {
            Some(path) => import::load(path)?,
            None => import::load_bytes("hikage.vrm", &hikage_character::file(), None, &limits)?,
        };
        Look::Anime(Anime::default()).apply(&mut scene);
        for material in scene.materials.iter_mut().filter(|m| m.name.starts_with("Hair") && model.is_none()) {
            (0..3).for_each(|i| material.base.color[i] *= hair[i]);
            if let Shading::Toon(toon) = &mut material.shading {
                (0..3).for_each(|i| toon.shade_color[i] *= hair[i]);
            }
        }
        // Clips of one humanoid fit any other.
        let clip = |name: &str| -> Result<Arc<Clip>, Box<dyn Error>> {
            let made = hikage_character::clips::build(name).ok_or("a clip that does not exist")?;
            let file = import::load_bytes(name, &hikage_character::vrma::write(&made), None, &limits)?;
            Ok(Arc::new(Clip::of(&file, 0, &scene)?))
        };
        let clips = [clip("idle")?, clip("walk")?, clip("run")?, clip("wave")?];
        Ok(Self { character: renderer.upload_and_empty_images(&mut scene)?, clips })
    }

    fn actor(&self, place: [f32; 3], yaw_rad: f32, seed: u64) -> Actor {
        let mut actor = Actor::new(&self.character).at(place, yaw_rad);
        actor.animator.player.play(&self.clips[0]);
        actor.animator.blink = Some(Blink { seed, ..Blink::default() });
        actor
    }
}

/// A box with an outline.
fn wooden_box() -> Scene {
    let mut cube = Primitive { role: Role::Other, ..Primitive::default() };
    for (axis, sign) in [0, 1, 2].into_iter().flat_map(|axis| [(axis, -1.0), (axis, 1.0)]) {
        let normal = Vec3::AXES[axis] * sign;
        let (s, t) = (Vec3::AXES[(axis + 1) % 3] * sign, Vec3::AXES[(axis + 2) % 3]);
        let first = cube.positions.len() as u32;
        for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            let corner = normal + s * a + t * b;
            cube.positions.push((corner + Vec3::Y).to_array());
            cube.normals.push(normal.to_array());
            cube.outline_normals.push(corner.normalize().to_array());
        }
        cube.indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
    }
    let material = Material {
        base: Base { color: [0.75, 0.45, 0.24, 1.0], texture: None },
        shading: Shading::Toon(Toon { shade_color: [0.42, 0.2, 0.16], ..Toon::default() }),
        outline: Some(Outline {
            width: OutlineWidth::World { metres: 0.006 },
            color: [0.1, 0.04, 0.03],
            ..Outline::default()
        }),
        ..Material::default()
    };
    Scene {
        nodes: vec![Node { mesh: Some(0), ..Node::default() }],
        meshes: vec![Mesh { primitives: vec![cube], ..Mesh::default() }],
        materials: vec![material],
        ..Scene::default()
    }
}

/// The world: the player stands first on the stage, then the other, then boxes.
struct Game {
    stage: Stage,
    cast: [Cast; 2],
    /// How fast the player wants to go: 0 stands, 1 walks, 2 runs.
    pace: usize,
    has_waved: bool,
    auto: bool,
}

impl Game {
    fn new(renderer: &Renderer, models: &[String], auto: bool) -> Result<Self, Box<dyn Error>> {
        let load = |i: usize, hair| Cast::load(renderer, models.get(i), hair);
        let cast = [load(0, [1.0; 3])?, load(1, [1.0, 0.45, 0.22])?];
        let wood = renderer.upload(&wooden_box())?;
        let crates = BOXES.map(|(place, half)| {
            let mut actor = Actor::new(&wood);
            actor.world = Mat4::from_translation(place.into()) * Mat4::from_scale(Vec3::splat(half));
            actor
        });
        let people = [cast[0].actor([0.0, 0.0, 3.5], std::f32::consts::PI, 1), cast[1].actor([0.6, 0.0, -1.0], 0.2, 2)];
        let mut stage = Stage::of(people.into_iter().chain(crates));
        let green = hikage::color::LinearRgb([0.42, 0.56, 0.38]);
        let grid = Grid { spacing_m: 1.0, color: hikage::color::LinearRgb([0.33, 0.46, 0.3]), ..Grid::default() };
        stage.ground = Some(Ground { radius_m: 14.0, color: green, grid: Some(grid), ..Ground::default() });
        stage.lights.directional.to_light = Vec3::new(0.5, 0.8, 0.45).normalize();
        stage.post.get_or_insert_default().antialias = Antialias::Fxaa;
        Ok(Self { stage, cast, pace: 0, has_waved: false, auto })
    }

    fn update(&mut self, keys: &HashSet<KeyCode>, dt: f32) {
        let held = |list: &[KeyCode]| f32::from(u8::from(list.iter().any(|k| keys.contains(k))));
        use KeyCode::{ArrowDown, ArrowLeft, ArrowRight, ArrowUp, KeyA, KeyD, KeyS, KeyW, ShiftLeft, ShiftRight};
        let mut way = Vec3::new(
            held(&[ArrowRight, KeyD]) - held(&[ArrowLeft, KeyA]),
            0.0,
            held(&[ArrowDown, KeyS]) - held(&[ArrowUp, KeyW]),
        );
        let mut is_fast = held(&[ShiftLeft, ShiftRight]) > 0.0;
        if self.auto {
            // A round of ten seconds: ahead, and back at a run.
            let t = self.stage.time_s % 10.0;
            (way, is_fast) = (
                if t < 2.5 {
                    Vec3::NEG_Z
                } else if t > 7.5 {
                    Vec3::Z
                } else {
                    Vec3::ZERO
                },
                t > 7.5,
            );
        }
        self.go(way, if way == Vec3::ZERO { 0 } else { 1 + usize::from(is_fast) }, dt);
        self.meet();
        self.stage.update(dt);
    }

    /// Turns the player to where it wants to go; its clips move it.
    fn go(&mut self, way: Vec3, pace: usize, dt: f32) {
        let player = &mut self.stage.actors[0];
        if pace != self.pace {
            let mut play = Play::new(&self.cast[0].clips[pace]);
            play.root_motion = RootMotion::Actor;
            play.in_step = pace > 0;
            player.animator.player.cross_fade(play, 0.25);
            self.pace = pace;
        }
        let (_, heading, place) = player.world.to_scale_rotation_translation();
        let ahead = heading * Vec3::Z;
        if let Some(way) = way.try_normalize() {
            let left = ahead.cross(way).y.atan2(ahead.dot(way));
            let heading = Quat::from_rotation_y(left.clamp(-8.0 * dt, 8.0 * dt)) * heading;
            player.world = Mat4::from_rotation_translation(heading, place);
        }
        // Out of boxes and out of each other.
        let other = self.stage.actors[1].world.w_axis.truncate();
        let solid = BOXES.iter().map(|(p, half)| (Vec3::from(*p), half * 1.2 + 0.2)).chain([(other, 0.5)]);
        let player = &mut self.stage.actors[0].world;
        for (middle, radius) in solid {
            let gap = (player.w_axis.truncate() - middle) * Vec3::new(1.0, 0.0, 1.0);
            if gap.length() < radius {
                let out = middle + gap.normalize_or(Vec3::Z) * radius;
                (player.w_axis.x, player.w_axis.z) = (out.x, out.z);
            }
        }
    }

    /// The other looks at the player, and greets once.
    fn meet(&mut self) {
        let [player, other, ..] = &mut self.stage.actors[..] else { return };
        let head = player.character.scene().bone_node(HumanBone::Head);
        let eyes =
            head.map_or(Vec3::Y * 1.4, |node| player.character.skeleton().places(&player.pose, &player.world)[node].0);
        (other.animator.gaze.target, other.animator.gaze.head) = (Some(GazeTarget::Point(eyes)), 0.6);
        let gap = player.world.w_axis.distance(other.world.w_axis);
        let [idle, .., wave] = &self.cast[1].clips;
        let clips = &mut other.animator.player;
        if gap < NEAR_M && !self.has_waved {
            clips.cross_fade(Play::once(wave), 0.3);
            self.has_waved = true;
        } else if clips.base().plays.iter().any(|p| !p.is_leaving && p.is_over()) {
            clips.fade_to(idle, 0.3);
        }
        self.has_waved &= gap < NEAR_M * 1.8;
    }

    /// From behind, over the shoulder.
    fn view(&self, size: [u32; 2]) -> View {
        let place = self.stage.actors[0].world.w_axis.truncate();
        let target = place + Vec3::Y * 1.15;
        let eye = target + Vec3::new(0.35, 0.55, 3.6);
        let camera = Camera { eye, target, fov_y_rad: 45f32.to_radians(), ..Camera::default() };
        View { size, camera, background: Background::Color(SKY), ..View::default() }
    }
}

struct App {
    models: Vec<String>,
    auto: bool,
    shown: Option<Shown>,
    failed: Option<Box<dyn Error>>,
}

/// Everything that exists only while the window does.
struct Shown {
    screen: Screen,
    renderer: Renderer,
    game: Game,
    keys: HashSet<KeyCode>,
    last: Instant,
}

impl Shown {
    fn new(event_loop: &ActiveEventLoop, app: &App) -> Result<Self, Box<dyn Error>> {
        let screen = Screen::open(event_loop, [960, 600])?;
        let renderer = Renderer::with_output(&screen.gpu, screen.output())?;
        let game = Game::new(&renderer, &app.models, app.auto)?;
        Ok(Self { screen, renderer, game, keys: HashSet::new(), last: Instant::now() })
    }

    fn draw(&mut self) -> Result<(), Box<dyn Error>> {
        let Self { screen, renderer, game, keys, last } = self;
        let dt = last.elapsed().as_secs_f32().min(4.0 * SPRING_STEP_S);
        *last = Instant::now();
        game.update(keys, dt);
        let view = game.view(screen.size());
        screen.show(|encoder, target| {
            renderer.prepare(encoder, &mut game.stage)?;
            renderer.draw(encoder, &game.stage, &view, target)
        })?;
        screen.window.request_redraw();
        Ok(())
    }
}

impl ApplicationHandler for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        match Shown::new(event_loop, self) {
            Ok(shown) => self.shown = Some(shown),
            Err(e) => {
                self.failed = Some(e);
                event_loop.exit();
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(shown) = &mut self.shown else { return };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::Resized(size) => shown.screen.resize(size),
            WindowEvent::KeyboardInput { event, .. } => {
                if let PhysicalKey::Code(key) = event.physical_key {
                    if event.state == ElementState::Pressed {
                        shown.keys.insert(key);
                    } else {
                        shown.keys.remove(&key);
                    }
                }
            }
            WindowEvent::Focused(false) => shown.keys.clear(),
            WindowEvent::RedrawRequested => {
                if let Err(e) = shown.draw() {
                    self.failed = Some(e);
                    event_loop.exit();
                }
            }
            _ => {}
        }
    }
}
