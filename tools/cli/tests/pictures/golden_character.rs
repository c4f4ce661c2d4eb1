//! The built-in character, looked at from all sides, bent, and with every expression.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use glam::{Quat, Vec3};
use hikage::golden::{Goldens, Tolerance};
use hikage::import::{Limits, load_bytes};
use hikage::motion::{Pose, Stance};
use hikage::picture::read_png;
use hikage::scene::{Framing, HumanBone, Image, Role, Scene};
use hikage::sdf::Project;
use hikage::{Actor, Anime, Background, Channel, Gpu, Look, Output, Renderer, Stage, View, color::Srgb};
use hikage_character::head::sdf;

/// Another driver may round edges and ramps differently, never more. Wider than for spheres: her locks have outlines of a
/// pixel all over the picture, and drivers place those by steps of 1/16 or 1/256 of a pixel.
const TOLERANCE: Tolerance = Tolerance { channel: 8, outliers: 0.008, blob: 20, drift: 1.5 };

/// Pictures are drawn so many times finer than they are kept: hair is all edges, and each driver covers edges in its own
/// way.
const FINER: u32 = 4;

/// The mean of each square of so many pixels a side.
fn shrunk(picture: &Image, finer: u32) -> Image {
    let (width, height) = (picture.width / finer, picture.height / finer);
    let mut sums = vec![0u32; (width * height * 4) as usize];
    for (y, row) in picture.pixels.chunks_exact(picture.width as usize * 4).enumerate() {
        let first = y as u32 / finer * width * 4;
        for (x, pixel) in row.chunks_exact(4).enumerate() {
            let at = (first + x as u32 / finer * 4) as usize;
            sums[at..at + 4].iter_mut().zip(pixel).for_each(|(sum, c)| *sum += u32::from(*c));
        }
    }
    let count = finer * finer;
    let pixels = sums.iter().map(|sum| ((sum + count / 2) / count) as u8).collect();
    Image { width, height, pixels, ..picture.clone() }
}

fn goldens() -> Goldens {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden");
    let bless_command = "cargo xtask goldens --bless {name}".to_owned();
    Goldens { bless_command, ..Goldens::new(folder) }
}

/// The character on the GPU.
struct Studio {
    renderer: Renderer,
    scene: Scene,
    stage: Stage,
    goldens: Goldens,
    faults: Vec<String>,
    /// Yaw and pitch of the light.
    light_deg: [f32; 2],
    /// Turn of the head to her left.
    head_deg: f32,
    /// Distance of the camera, she being as large; that of the framing where `None`.
    distance_m: Option<f32>,
    channel: Channel,
}

impl Studio {
    fn open() -> Self {
        Self::open_with(|_| ())
    }

    /// The character after a change.
    fn open_with(change: impl FnOnce(&mut Scene)) -> Self {
        let gpu = Gpu::headless(std::env::var("HIKAGE_ADAPTER").ok().as_deref()).unwrap_or_else(|e| panic!("{e}"));
        let mut scene =
            load_bytes("hikage.vrm", &hikage_character::file(), None, &Limits::default()).expect("the file is read");
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        change(&mut scene);
        let renderer = Renderer::with_output(&gpu, Output::default()).expect("a renderer");
        let character = renderer.upload_and_empty_images(&mut scene).expect("the scene is uploaded");
        let goldens = goldens();
        Self {
            renderer,
            scene,
            stage: Stage::of([Actor::new(&character)]),
            goldens,
            faults: Vec::new(),
            light_deg: [-24.7, 33.4],
            head_deg: 0.0,
            distance_m: None,
            channel: Channel::Final,
        }
    }

    fn check(
        &mut self,
        name: &str,
        size: [u32; 2],
        framing: Framing,
        yaw_deg: f32,
        stance: Stance,
        expression: Option<&str>,
    ) {
        let mut pose = Pose::rest(&self.scene);
        pose.set_stance(&self.scene, stance);
        let weights: Vec<(String, f32)> = expression.iter().map(|e| ((*e).to_owned(), 1.0)).collect();
        pose.set_expressions(&self.scene, &weights).expect("a known expression");
        let size = size.map(|side| side * FINER);
        let framed = View::framed_pose(&self.scene, &pose, framing, yaw_deg.to_radians(), size);
        if let Some(head) = self.scene.bone_node(HumanBone::Head) {
            pose.locals[head].rotation *= Quat::from_rotation_y(self.head_deg.to_radians());
        }
        self.stage.actors[0].pose = pose;
        let mut view =
            View { channel: self.channel, background: Background::Color(Srgb([0xdf, 0xe7, 0xee])), ..framed };
        let [yaw, pitch] = self.light_deg.map(f32::to_radians);
        let to_light = Vec3::new(yaw.sin() * pitch.cos(), pitch.sin(), yaw.cos() * pitch.cos());
        self.stage.lights.directional.to_light = to_light;
        if framing == Framing::Face {
            // From the brows to the chin.
            view.camera.fov_y_rad *= 0.52;
            view.camera.eye.y -= 0.046;
            view.camera.target.y -= 0.046;
        }
        if let Some(metres) = self.distance_m {
            let camera = &mut view.camera;
            let away = camera.eye - camera.target;
            let half_height = away.length() * (camera.fov_y_rad * 0.5).tan();
            camera.eye = camera.target + away.normalize() * metres;
            camera.fov_y_rad = 2.0 * (half_height / metres).atan();
        }
        let picture = shrunk(&self.renderer.render(&mut self.stage, &view).expect("a picture"), FINER);
        if let Err(fault) = self.goldens.check(&format!("character-{name}"), &picture, &TOLERANCE) {
            self.faults.push(fault.to_string());
        }
    }
}

#[test]
fn the_anime_look_is_as_before() {
    let project = Project::parse("face.sdf.toml", sdf::SOURCE).expect("her keys");
    let painted = project.bake(false).expect("her keys are nested").into_sides();
    let mut studio =
        Studio::open_with(|scene| Look::Anime(Anime { face: Some(painted), ..Anime::default() }).apply(scene));
    for degrees in [-120, -75, -40, 0, 40, 75, 120] {
        studio.light_deg = [degrees as f32, 25.0];
        let name = format!("anime-light-{degrees}");
        studio.check(&name, [192; 2], Framing::Face, 0.0, Stance::Rest, None);
    }
    // The band on the hair, from where it is seen.
    for (name, yaw, light) in [("front", 0.0, -30.0), ("left", 50.0, 20.0), ("back", 180.0, 160.0)] {
        studio.light_deg = [light, 35.0];
        studio.check(&format!("anime-portrait-{name}"), [256; 2], Framing::Portrait, yaw, Stance::Relaxed, None);
    }
    // Her whole body in its own shadow.
    for (name, yaw, light) in [("left", 25.0, -45.0), ("right", -25.0, 60.0)] {
        studio.light_deg = [light, 40.0];
        studio.check(&format!("anime-full-{name}"), [192, 384], Framing::Full, yaw, Stance::Relaxed, None);
    }
    // Light from below and from high above.
    for pitch in [-30, 60] {
        studio.light_deg = [-60.0, pitch as f32];
        studio.check(&format!("anime-pitch-{pitch}"), [192; 2], Framing::Face, 0.0, Stance::Rest, None);
    }
    // Her head turns under the same light: highlights of nose and lips, the line of the nose, eyes through hair.
    studio.light_deg = [-30.0, 25.0];
    for turn in [-65, -35, 35, 65] {
        studio.head_deg = turn as f32;
        studio.check(&format!("anime-head-{turn}"), [192; 2], Framing::Face, 0.0, Stance::Rest, None);
    }
    studio.head_deg = 0.0;
    studio.distance_m = Some(10.0);
    studio.check("anime-far", [192; 2], Framing::Portrait, 20.0, Stance::Relaxed, None);
    studio.distance_m = None;
    studio.light_deg = [-60.0, 25.0];
    for (name, channel) in [
        ("face-shadow", Channel::Look("face-shadow")),
        ("shade-ramp", Channel::Look("shade-ramp")),
        ("self-shadow", Channel::Look("self-shadow")),
        ("face-paint", Channel::Look("face-paint")),
        ("highlight", Channel::Look("highlight")),
        ("bangs-shadow", Channel::Look("bangs-shadow")),
        ("layer", Channel::Look("layer")),
        ("depth-rim", Channel::Look("depth-rim")),
        ("eyes-through", Channel::Look("eyes-through")),
    ] {
        studio.channel = channel;
        let framing = if matches!(
            channel,
            Channel::Look("highlight") | Channel::Look("depth-rim") | Channel::Look("self-shadow")
        ) {
            Framing::Portrait
        } else {
            Framing::Face
        };
        studio.check(&format!("channel-{name}"), [160; 2], framing, 0.0, Stance::Rest, None);
    }
    assert!(studio.faults.is_empty(), "{}", studio.faults.join("\n"));
}

#[test]
fn the_natural_look_is_as_before() {
    let mut studio = Studio::open_with(|scene| Look::Natural.apply(scene));
    for (name, yaw, light) in
        [("front", 0.0, -30.0), ("left", 50.0, 20.0), ("back", 180.0, 160.0), ("behind", 0.0, 165.0)]
    {
        studio.light_deg = [light, 35.0];
        studio.check(&format!("natural-portrait-{name}"), [256; 2], Framing::Portrait, yaw, Stance::Relaxed, None);
    }
    studio.light_deg = [-30.0, 40.0];
    studio.check("natural-full", [192, 384], Framing::Full, 25.0, Stance::Relaxed, None);
    for channel in ["strands", "hair-primary", "hair-secondary", "hair-indirect"] {
        studio.channel = Channel::Look(channel);
        studio.check(&format!("channel-{channel}"), [160; 2], Framing::Portrait, 0.0, Stance::Rest, None);
    }
    assert!(studio.faults.is_empty(), "{}", studio.faults.join("\n"));
}

#[test]
fn the_preview_sheet_of_her_face_shadow_is_as_before() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let [project, sheet] = ["preview.sdf.toml", "preview.png"].map(|name| folder.join(name));
    std::fs::write(&project, sdf::SOURCE).expect("writes");
    let mut command = Command::new(env!("CARGO_BIN_EXE_hikage"));
    command.args(["sdf", "preview"]).arg(&project).arg("-o").arg(&sheet).args(["--panel", "384"]);
    if let Ok(adapter) = std::env::var("HIKAGE_ADAPTER") {
        command.args(["--adapter", &adapter]);
    }
    let output = command.output().expect("runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let sheet = read_png(&sheet).expect("a sheet");
    // Small heads are edges all over.
    let finer = 2 * FINER;
    assert!(sheet.width % finer == 0 && sheet.height % finer == 0, "{} x {}", sheet.width, sheet.height);
    goldens()
        .check("character-face-shadow-sheet", &shrunk(&sheet, finer), &TOLERANCE)
        .unwrap_or_else(|e| panic!("{e}"));
}

/// What each mesh is taken for. No look file says so: names, bones and morphs do.
const ROLES: &[(Role, &[&str])] = &[
    (Role::Skin, &["Skin"]),
    (
        Role::Cloth,
        &["Stockings", "Boots", "Shorts", "Blouse", "Jacket", "JacketLining", "FurCollar", "FurCuffs", "Skirt", "Bow"],
    ),
    (
        Role::Accessory,
        &["Buckles", "Belt", "Brooch", "BeltBuckle", "PendantCord", "Pendant", "HairPin", "HairPinDiamond", "Flame"],
    ),
    (Role::Face, &["Face"]),
    (Role::Mouth, &["Mouth"]),
    (Role::EyeWhite, &["EyeWhite", "EyeballSclera"]),
    (Role::Eye, &["EyeIris", "EyeballIris", "EyeballCornea"]),
    (Role::EyeHighlight, &["EyeHighlight1", "EyeHighlight2"]),
    (Role::Lash, &["EyelashShadow", "EyelashUpper", "EyelashLower"]),
    (Role::Brow, &["Brow"]),
    (Role::HairFront, &["HairFront", "HairSide"]),
    (Role::Hair, &["HairBack", "HairCards"]),
];

#[test]
fn roles_are_guessed_right() {
    let scene =
        load_bytes("hikage.vrm", &hikage_character::file(), None, &Limits::default()).expect("the file is read");
    let expected: BTreeMap<&str, Role> =
        ROLES.iter().flat_map(|(role, meshes)| meshes.iter().map(|m| (*m, *role))).collect();
    let found: BTreeMap<&str, Role> =
        scene.meshes.iter().flat_map(|m| m.primitives.iter().map(|p| (m.name.as_str(), p.role))).collect();
    assert_eq!(found, expected);
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn the_character_looks_as_before() {
    let mut studio = Studio::open();
    for (name, yaw) in [("front", 0.0), ("three-quarter", 35.0), ("profile", 90.0), ("back", 180.0)] {
        studio.check(&format!("portrait-{name}"), [256; 2], Framing::Portrait, yaw, Stance::Relaxed, None);
    }
    for (name, yaw) in [("front", 0.0), ("three-quarter", 35.0), ("back", 180.0)] {
        studio.check(&format!("full-{name}"), [192, 384], Framing::Full, yaw, Stance::Relaxed, None);
    }
    for (name, yaw) in [("front", 0.0), ("three-quarter", 35.0), ("profile", 90.0)] {
        studio.check(&format!("bend-{name}"), [256, 320], Framing::Full, yaw, Stance::Bend, None);
    }
    studio.check("offer", [256; 2], Framing::Bust, 20.0, Stance::Offer, Some("flame"));
    let expressions: Vec<String> =
        studio.scene.character.iter().flat_map(|c| &c.expressions).map(|e| e.name.clone()).collect();
    // The flame burns over the hand, out of this view.
    for name in expressions.iter().filter(|name| *name != "flame") {
        studio.check(&format!("face-{name}"), [192; 2], Framing::Face, 0.0, Stance::Rest, Some(name));
    }
    assert!(studio.faults.is_empty(), "{}", studio.faults.join("\n"));
}
