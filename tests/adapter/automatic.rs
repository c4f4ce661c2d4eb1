//! What the anime look makes of characters that nobody prepared: a face stays readable, a band stays small.

use std::path::{Path, PathBuf};

use glam::{Vec2, Vec3};
use hikage::color::LinearRgb;
use hikage::motion::Pose;
use hikage::scene::{Camera, Framing, Image, Role, Scene};
use hikage::sdf::{FaceStyle, Guide, KEPT, Landmarks};
use hikage::{Anime, Channel, Look, Renderer, import};

use crate::support::{self, Shoot, Shot, gpu, staged};

const SIDE: u32 = 256;
/// Contrast that a picture of eight bits does not tell from none.
const NOISE: f32 = 0.006;

/// Shared characters with a face, and the built-in one.
fn characters() -> Vec<(String, Scene)> {
    let mut found = vec![("built-in".to_owned(), support::heroine())];
    let folders = ["../shared/models", "../shared/real/models"].map(Path::new);
    for folder in folders {
        let Ok(entries) = std::fs::read_dir(folder) else {
            eprintln!("NOT RUN on the models of {}: there is no such folder", folder.display());
            continue;
        };
        let mut paths: Vec<PathBuf> = entries.map(|e| e.expect("an entry").path()).collect();
        paths.sort();
        for path in paths.iter().filter(|p| p.extension().is_some_and(|e| e == "vrm" || e == "glb")) {
            let Ok(scene) = import::load(path) else { continue };
            if face(&scene).is_some() {
                found.push((path.display().to_string(), scene));
            }
        }
    }
    found
}

/// What is found on the first face that has a material of its own.
fn face(scene: &Scene) -> Option<Landmarks> {
    let mut parts = scene.meshes.iter().flat_map(|m| &m.primitives).filter(|p| p.role == Role::Face);
    parts.find_map(|p| Guide::new(scene, p.material, FaceStyle::default())?.landmarks().copied())
}

/// A long lens straight in front of the face, whose picture is as high as the face.
fn in_front(face: &Landmarks) -> Camera {
    let middle = Vec3::from(face.foot_m) + Vec3::Y * (0.5 * face.height_m);
    let distance = 12.0 * face.height_m;
    Camera {
        eye: middle + Vec3::Z * distance,
        target: middle,
        fov_y_rad: 2.0 * (0.5f32 / 12.0).atan(),
        ..Camera::default()
    }
}

/// Luminance of the picture at places of the face: shares of its height from the middle line and from its lower edge.
fn luminance(image: &Image, place: Vec2) -> f32 {
    let x = (0.5 + place.x) * SIDE as f32;
    let y = (1.0 - place.y) * SIDE as f32;
    let [r, g, b, _] = support::pixel(image, (x as u32).min(SIDE - 1), (y as u32).min(SIDE - 1));
    LinearRgb([r, g, b].map(|c| hikage::color::linear_from_srgb(f32::from(c) / 255.0))).luminance()
}

/// Root mean square of what stands out from a plane through the luminance of a box, share of the mean.
fn deviation(image: &Image, middle: Vec2, half: Vec2) -> f32 {
    let steps = 24;
    let at = |i: i32| Vec2::new((i % steps) as f32, (i / steps) as f32) / (steps - 1) as f32 * 2.0 - 1.0;
    let values: Vec<(Vec2, f32)> =
        (0..steps * steps).map(|i| (at(i), luminance(image, middle + at(i) * half))).collect();
    let count = values.len() as f32;
    let mean = values.iter().map(|(_, v)| v).sum::<f32>() / count;
    let slope = values.iter().map(|(p, v)| *p * (v - mean)).sum::<Vec2>();
    let square = values.iter().map(|(p, _)| *p * *p).sum::<Vec2>();
    let slope = slope / square;
    let off = values.iter().map(|(p, v)| (v - mean - slope.dot(*p)).powi(2)).sum::<f32>();
    (off / count).sqrt() / mean.max(1e-3)
}

/// Middle and half size of each feature.
fn features(face: &Landmarks) -> [(&'static str, Vec2, Vec2); 4] {
    let [eye, half] = [Vec2::from(face.eye), Vec2::from(face.eye_half)];
    let span = face.eye[1] - face.chin;
    [
        ("eyes", eye, half * 1.1),
        ("brows", eye + Vec2::new(0.0, 2.1 * half.y), Vec2::new(half.x, 0.7 * half.y)),
        ("nose", Vec2::new(0.0, face.nose - 0.04 * span), Vec2::new(0.5 * face.eye[0], 0.17 * span)),
        ("mouth", Vec2::new(0.0, face.mouth), Vec2::new(0.9 * face.mouth_half, 0.1 * span)),
    ]
}

/// Eyes, brows, nose and mouth keep most of the contrast that they have by the file, under twelve lights before the face.
#[test]
fn a_face_stays_readable_under_every_light() {
    let gpu = gpu();
    let mut faults = Vec::new();
    for (name, mut scene) in characters() {
        let found = face(&scene).expect("a face");
        let mut automatic = scene.clone();
        Look::Anime(Anime::default()).apply(&mut automatic);
        // Hair and hats before them, and what these cast, are no matter of eyes and brows.
        for part in [&mut scene, &mut automatic].into_iter().flat_map(|s| &mut s.meshes) {
            part.primitives.retain(|p| !matches!(p.role, Role::Hair | Role::HairFront | Role::Accessory));
        }
        let renderer = Renderer::new(&gpu).expect("a renderer");
        let mut uploaded = [&scene, &automatic].map(|scene| {
            let mut stage = staged(renderer.upload(scene));
            stage.actors[0].pose = Pose::rest(scene);
            stage
        });
        for i in 0..12 {
            let yaw = (i as f32 / 11.0 * 2.0 - 1.0) * 1.44;
            let mut view = Shot { camera: in_front(&found), size: [SIDE; 2], ..Shot::default() };
            view.lights.directional.to_light = Vec3::new(yaw.sin() * 0.955, 0.296, yaw.cos() * 0.955);
            let [before, after] = uploaded.each_mut().map(|stage| renderer.shoot(stage, &view).expect("a picture"));
            for (feature, middle, half) in features(&found) {
                let [before, after] = [&before, &after].map(|image| deviation(image, middle, half));
                if after + NOISE < KEPT * before {
                    faults.push(format!(
                        "{name}: {feature}, light from {:.0} degrees: {before:.3} becomes {after:.3}",
                        yaw.to_degrees()
                    ));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A band is one row of marks on the front of the hair, and nothing behind.
#[test]
fn a_band_lies_over_the_forehead_and_not_behind() {
    let path = Path::new("../shared/models/Seed-san_rebuilt.vrm");
    if !path.exists() {
        eprintln!("NOT RUN: there is no {}", path.display());
        return;
    }
    let mut scene = import::load(path).expect("a model");
    Look::Anime(Anime::default()).apply(&mut scene);
    let lent = gpu();
    let shares = [0.0, std::f32::consts::PI].map(|yaw| {
        let mut view = Shot::framed(&scene, Framing::Face, yaw, [128; 2]);
        view.channel = Channel::Look("highlight");
        let picture = support::render(&lent, &scene, &view);
        let marked = picture.pixels.chunks_exact(4).filter(|p| p[0] > 40).count();
        marked as f32 / (128.0 * 128.0)
    });
    assert!((0.004..0.06).contains(&shares[0]) && shares[1] < 0.001, "{shares:?}");
}

/// What has turned dark stays dark, and light from the other side is the mirror image, on every face.
#[test]
fn maps_from_meshes_are_nested_and_mirrored() {
    for (name, scene) in characters() {
        let parts = scene.meshes.iter().flat_map(|m| &m.primitives).filter(|p| p.role == Role::Face);
        for style in [FaceStyle::Soft, FaceStyle::Classic, FaceStyle::Minimal] {
            let guide = parts.clone().find_map(|p| Guide::new(&scene, p.material, style)).expect("a face");
            let map = guide.over_relief();
            let (width, texels) = (map.width as usize, &map.front[0]);
            for row in texels.chunks_exact(width) {
                for (a, b) in row.iter().zip(row.iter().rev()) {
                    assert!(a[0].abs_diff(b[1]) <= 1 && a[2].abs_diff(b[2]) <= 1, "{name}: {a:?} and {b:?}");
                }
            }
            // Of one side 181 lights: how much is lit only falls.
            let lit = |degrees: u32| texels.iter().filter(|t| u32::from(t[1]) * 180 > degrees * 65535).count();
            let counts: Vec<usize> = (0..=180).map(lit).collect();
            assert!(counts.is_sorted_by(|a, b| a >= b), "{name}");
            assert!(counts[0] > counts[90] && counts[90] > counts[180], "{name}: {counts:?}");
        }
    }
}
