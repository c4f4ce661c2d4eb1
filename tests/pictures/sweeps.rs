//! Sweeps of light, head and camera over the whole anime look: nothing pops between neighbouring frames.

use glam::{Quat, Vec3};
use hikage::motion::Pose;
use hikage::scene::{Framing, HumanBone, Image, Scene};
use hikage::{Background, Renderer, Stage, color::Srgb};

use crate::support::{self, Lent, Shoot, Shot, gpu, staged};

/// Pictures are drawn this much finer and averaged, so that what moves by less than a pixel changes by as much.
const FINER: u32 = 3;
const SIDE: u32 = 96;

struct Sweep {
    /// Kept from other tests meanwhile.
    _gpu: Lent,
    scene: Scene,
    renderer: Renderer,
    uploaded: Stage,
    view: Shot,
}

impl Sweep {
    fn new() -> Self {
        let gpu = gpu();
        let mut scene = support::anime_heroine();
        // Facets are there to flash.
        for material in &mut scene.materials {
            (material.diamond, material.sparkle) = (None, None);
        }
        let renderer = Renderer::new(&gpu).expect("a renderer");
        let uploaded = staged(renderer.upload(&scene));
        let mut view = Shot::framed(&scene, Framing::Face, 0.0, [SIDE * FINER; 2]);
        view.background = Background::Color(Srgb([0xdf, 0xe7, 0xee]));
        Self { _gpu: gpu, scene, renderer, uploaded, view }
    }

    fn picture(&mut self, view: &Shot) -> Vec<u8> {
        averaged(&self.renderer.shoot(&mut self.uploaded, view).expect("a picture"))
    }
}

fn averaged(image: &Image) -> Vec<u8> {
    let at = |x: u32, y: u32, c: u32| u32::from(image.pixels[((y * image.width + x) * 4 + c) as usize]);
    let mut out = Vec::new();
    for y in 0..SIDE {
        for x in 0..SIDE {
            for c in 0..3 {
                let sum: u32 = (0..FINER * FINER).map(|i| at(x * FINER + i % FINER, y * FINER + i / FINER, c)).sum();
                out.push((sum / (FINER * FINER)) as u8);
            }
        }
    }
    out
}

/// Largest change of a channel of a pixel, and the mean change.
fn change(a: &[u8], b: &[u8]) -> (u8, f64) {
    let apart = || a.iter().zip(b).map(|(a, b)| a.abs_diff(*b));
    (apart().max().unwrap_or(0), apart().map(f64::from).sum::<f64>() / a.len() as f64)
}

/// Steps of 1 degree of the light, all round at one height. The soft border of the face is 4.3 degrees wide, and ramps pass
/// through their terminator in as little: a pixel may go a third of the way at once; nothing goes further.
#[test]
fn light_changes_no_pixel_by_much_in_a_degree() {
    let mut sweep = Sweep::new();
    let (mut largest, mut mean) = (0, 0.0f64);
    let mut last: Option<(i32, Vec<u8>)> = None;
    for degrees in -180..=180 {
        let mut view = sweep.view.clone();
        let yaw = (degrees as f32).to_radians();
        view.lights.directional.to_light = Vec3::new(yaw.sin(), 0.36, yaw.cos()).normalize();
        let now = sweep.picture(&view);
        if let Some((before, picture)) = &last
            && *before + 1 == degrees
        {
            let (step, average) = change(picture, &now);
            (largest, mean) = (largest.max(step), mean.max(average));
        }
        last = Some((degrees, now));
    }
    println!("light: at most {largest}/255 a pixel, {mean:.2}/255 on average, in 1 degree");
    assert!(largest <= 48 && mean < 0.5, "{largest}/255 a pixel, {mean}/255 on average in 1 degree");
}

/// Steps of 1 degree of the head move edges by less than a pixel: what changes more than an edge does would pop.
#[test]
fn a_turning_head_does_not_pop() {
    let mut sweep = Sweep::new();
    let head = sweep.scene.bone_node(HumanBone::Head).expect("a head");
    let mut mean = Vec::new();
    let mut last: Option<Vec<u8>> = None;
    for degrees in -90..=90 {
        let mut pose = Pose::rest(&sweep.scene);
        pose.locals[head].rotation = Quat::from_rotation_y((degrees as f32).to_radians());
        sweep.uploaded.actors[0].pose = pose.clone();
        let view = sweep.view.clone();
        let now = sweep.picture(&view);
        if let Some(last) = &last {
            mean.push(change(last, &now).1);
        }
        last = Some(now);
    }
    // A pop is a step much larger than its neighbours.
    let worst = mean.windows(3).map(|w| w[1] / (w[0].max(w[2]) + 0.2)).fold(0.0, f64::max);
    let largest = mean.iter().copied().fold(0.0, f64::max);
    println!("head: at most {largest:.2}/255 on average in 1 degree, {worst:.2} times its neighbours");
    assert!(worst < 1.3 && largest < 4.5, "{worst} times the step beside it, {largest}/255");
}

/// From half a metre to ten, the face being as large: the picture changes by perspective alone, in small steps.
#[test]
fn distance_changes_little() {
    let mut sweep = Sweep::new();
    let away = sweep.view.camera.eye - sweep.view.camera.target;
    let half = away.length() * (sweep.view.camera.fov_y_rad * 0.5).tan();
    let mut last: Option<Vec<u8>> = None;
    let mut largest = 0.0f64;
    let mut metres = 0.5f32;
    while metres <= 10.0 {
        let mut view = sweep.view.clone();
        view.camera.eye = view.camera.target + away.normalize() * metres;
        view.camera.fov_y_rad = 2.0 * (half / metres).atan();
        let now = sweep.picture(&view);
        if let Some(last) = &last {
            largest = largest.max(change(last, &now).1);
        }
        last = Some(now);
        metres *= 1.05;
    }
    println!("distance: at most {largest:.2}/255 on average in 5 %");
    assert!(largest < 3.0, "{largest}/255 on average in 5 % of the distance");
}
