//! Compositions: camera, light, backdrop and pose by one name, for a first picture that can be shown.

mod camera;

use hikage::color::{LinearRgb, Srgb};
use hikage::scene::{Ambient, Backdrop, DirectionalLight, Lights, Post, PunctualLight};
use hikage::{Actor, Background, Ground, Stage, View};

use crate::args::ViewName;
use crate::setup;

/// `--preset`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum PresetName {
    /// Cover of a magazine: to the knees from a tilted camera, wind in the hair, a rim of light, lights out of focus.
    Cover,
    /// Head and shoulders in soft light before a calm gradient.
    Portrait,
    /// Front, three-quarter, side and back of the whole character in one wide picture.
    Turnaround,
    /// Moonlight with a warm rim before the lights of a city.
    Night,
    /// Low warm light before an evening sky, wide, the character aside.
    Sunset,
}

/// A composition. Angles are in degrees, to the character's left and upwards.
pub(crate) struct Preset {
    pub(crate) size: [u32; 2],
    /// Expressions, of those that a model has.
    pub(crate) expressions: &'static [(&'static str, f32)],
    pub(crate) wind: Option<[f32; 3]>,
    pub(crate) looks_at_camera: bool,
    pub(crate) ground: bool,
    shot: Shot,
    key: Lamp,
    /// Light from above and from below, linear.
    ambient: [[f32; 3]; 2],
    /// Light from behind, on edges.
    rim: Option<Lamp>,
    backdrop: Backdrop,
}

/// Where the camera is.
struct Shot {
    view: ViewName,
    yaw: f32,
    pitch: f32,
    roll: f32,
    /// Times the height that `view` shows; the top of the picture stays.
    zoom: f32,
    /// How far the character stands from the middle, share of the picture's width, to the right.
    aside: f32,
    /// Turns of the figures of each model, which stand in a row; one by itself where empty.
    row: &'static [f32],
}

/// A light: where it is, its linear colour and its strength.
struct Lamp {
    yaw: f32,
    pitch: f32,
    color: [f32; 3],
    intensity: f32,
}

const STILL: Shot = Shot { view: ViewName::Portrait, yaw: 0.0, pitch: 0.0, roll: 0.0, zoom: 1.0, aside: 0.0, row: &[] };

impl PresetName {
    pub(crate) fn preset(self) -> Preset {
        match self {
            Self::Cover => Preset {
                size: [1024, 1440],
                expressions: &[("relaxed", 0.3)],
                wind: Some([0.16, 0.02, 0.05]),
                looks_at_camera: true,
                ground: false,
                shot: Shot { view: ViewName::Bust, yaw: -24.0, pitch: -4.0, roll: -5.0, zoom: 1.24, ..STILL },
                key: Lamp { yaw: -16.0, pitch: 34.0, color: [1.0, 0.97, 0.94], intensity: 1.0 },
                ambient: [[0.11, 0.11, 0.14], [0.1, 0.09, 0.1]],
                rim: Some(Lamp { yaw: 148.0, pitch: 24.0, color: [1.0, 0.9, 0.8], intensity: 0.7 }),
                backdrop: backdrop(
                    ["#6ea3ee", "#b9c4fa", "#ffd3dc"],
                    ("#a89a88", [0.5, 0.28], 0.6),
                    ("#fff4e4", 30, 0.075, 11),
                ),
            },
            Self::Portrait => Preset {
                size: [1024, 1280],
                expressions: &[("relaxed", 0.25)],
                wind: Some([0.05, 0.0, 0.02]),
                looks_at_camera: true,
                ground: false,
                shot: Shot { yaw: 14.0, pitch: 2.0, zoom: 1.12, ..STILL },
                key: Lamp { yaw: 32.0, pitch: 32.0, color: [1.0, 0.985, 0.965], intensity: 1.0 },
                ambient: [[0.14, 0.14, 0.15], [0.13, 0.12, 0.12]],
                rim: None,
                backdrop: backdrop(
                    ["#b7c6da", "#d9dde6", "#f3e4da"],
                    ("#8c8a88", [0.5, 0.4], 0.6),
                    ("#ffffff", 0, 0.08, 0),
                ),
            },
            Self::Turnaround => Preset {
                size: [1920, 1080],
                expressions: &[],
                wind: None,
                looks_at_camera: false,
                ground: true,
                shot: Shot { view: ViewName::Full, pitch: 5.0, row: &[0.0, 45.0, 90.0, 180.0], ..STILL },
                key: Lamp { yaw: -18.0, pitch: 46.0, color: [1.0, 0.99, 0.98], intensity: 1.0 },
                ambient: [[0.13, 0.13, 0.14], [0.11, 0.11, 0.12]],
                rim: None,
                backdrop: backdrop(
                    ["#dfe5ee", "#eceef3", "#cfd5e0"],
                    ("#808080", [0.5, 0.45], 0.9),
                    ("#ffffff", 0, 0.08, 0),
                ),
            },
            Self::Night => Preset {
                size: [1080, 1350],
                expressions: &[("relaxed", 0.2)],
                wind: Some([-0.1, 0.02, 0.05]),
                looks_at_camera: true,
                ground: false,
                shot: Shot { view: ViewName::Bust, yaw: 22.0, pitch: 3.0, roll: 2.0, zoom: 0.86, ..STILL },
                key: Lamp { yaw: 14.0, pitch: 36.0, color: [0.68, 0.76, 1.0], intensity: 0.9 },
                ambient: [[0.05, 0.06, 0.14], [0.05, 0.045, 0.1]],
                rim: Some(Lamp { yaw: -138.0, pitch: 14.0, color: [1.0, 0.52, 0.22], intensity: 0.9 }),
                backdrop: backdrop(
                    ["#060a20", "#131c47", "#33275f"],
                    ("#2c4a9c", [0.74, 0.2], 0.55),
                    ("#ffb070", 38, 0.062, 4),
                ),
            },
            Self::Sunset => Preset {
                size: [1440, 960],
                expressions: &[("relaxed", 0.35)],
                wind: Some([-0.2, 0.02, 0.0]),
                looks_at_camera: true,
                ground: false,
                shot: Shot { view: ViewName::Bust, yaw: -18.0, pitch: -2.0, zoom: 0.74, aside: -0.17, ..STILL },
                key: Lamp { yaw: 26.0, pitch: 16.0, color: [1.0, 0.76, 0.56], intensity: 1.0 },
                ambient: [[0.16, 0.11, 0.2], [0.16, 0.09, 0.1]],
                rim: Some(Lamp { yaw: 140.0, pitch: 10.0, color: [1.0, 0.6, 0.25], intensity: 1.1 }),
                backdrop: backdrop(
                    ["#4a3a8c", "#e4738c", "#ffb862"],
                    ("#ffd78a", [0.76, 0.66], 0.75),
                    ("#ffc890", 22, 0.085, 7),
                ),
            },
        }
    }
}

/// Three colours from top to bottom; a glow with its middle and radius; lights out of focus with their number, radius and
/// seed.
fn backdrop(
    [top, middle, bottom]: [&str; 3],
    (glow, glow_at, glow_radius): (&str, [f32; 2], f32),
    (discs, disc_count, disc_radius, seed): (&str, u32, f32, u32),
) -> Backdrop {
    let srgb = |hex| Srgb::from_hex(hex).unwrap_or_default();
    Backdrop {
        top: srgb(top),
        middle: srgb(middle),
        bottom: srgb(bottom),
        glow: srgb(glow),
        glow_at,
        glow_radius,
        discs: srgb(discs),
        disc_count,
        disc_radius,
        seed,
    }
}

impl Preset {
    /// Figures of each model.
    pub(crate) fn figures(&self) -> usize {
        self.shot.row.len().max(1)
    }

    /// Places the figures of all models.
    pub(crate) fn place(&self, actors: &mut [Actor]) {
        camera::place(&self.shot, actors);
    }

    /// The view, before a shot file and options change it; lights and what is done to the picture are set.
    pub(crate) fn view(&self, stage: &mut Stage, view: Option<ViewName>, yaw: Option<f32>, size: [u32; 2]) -> View {
        let mut seen = camera::view(&self.shot, stage, view, yaw, size);
        seen.background = Background::Backdrop(self.backdrop);
        let distance = seen.camera.eye.distance(seen.camera.target);
        let Lamp { yaw, pitch, color, intensity } = self.key;
        let [sky, ground] = self.ambient.map(LinearRgb);
        stage.lights = Lights {
            directional: DirectionalLight {
                to_light: setup::to_light([yaw, pitch]),
                color: LinearRgb(color),
                intensity,
            },
            ambient: Ambient { sky, ground },
            environment: stage.lights.environment.take(),
            ..Lights::default()
        };
        if let Some(Lamp { yaw, pitch, color, intensity }) = self.rim {
            // Far enough to shine on all of them alike.
            let away = distance * 3.0;
            stage.lights.punctual.push(PunctualLight {
                position: seen.camera.target + setup::to_light([yaw, pitch]) * away,
                color: LinearRgb(color),
                intensity: intensity * away * away,
                range: 0.0,
                spot: None,
            });
        }
        let post = stage.post.unwrap_or_default();
        stage.post = Some(Post { bloom: Some(post.bloom.unwrap_or_default()), ..post });
        if self.ground && stage.ground.is_none() {
            stage.ground = Some(Ground { shadow_only: true, ..Ground::default() });
        }
        seen
    }
}
