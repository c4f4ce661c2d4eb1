//! Eyes and brows through the bangs, on a whole character.

use glam::Mat4;
use hikage::Channel;
use hikage::scene::{EyesThrough, Framing, Image, Scene};

use crate::support::{self, Shot, gpu, render};

fn heroine(through: Option<EyesThrough>) -> Scene {
    let mut scene = support::heroine();
    support::keep(&mut scene, support::HEAD);
    scene.eyes_through = through;
    scene
}

fn seen(opacity: f32) -> Option<EyesThrough> {
    Some(EyesThrough { opacity, ..EyesThrough::default() })
}

fn face(scene: &Scene, yaw_deg: f32) -> Shot {
    Shot::framed(scene, Framing::Face, yaw_deg.to_radians(), [256, 256])
}

/// Pixels that differ.
fn changed(a: &Image, b: &Image) -> Vec<usize> {
    let pairs = a.pixels.chunks(4).zip(b.pixels.chunks(4));
    pairs.enumerate().filter(|(_, (a, b))| a != b).map(|(i, _)| i).collect()
}

#[test]
fn hair_is_the_same_to_the_bit_but_before_eyes_and_brows() {
    let gpu = gpu();
    let bare = heroine(None);
    let view = face(&bare, 0.0);
    let without = render(&gpu, &bare, &view);
    assert_eq!(changed(&without, &render(&gpu, &heroine(seen(0.0)), &view)), [0usize; 0], "opacity 0");
    let half = changed(&without, &render(&gpu, &heroine(seen(0.5)), &view));
    assert!(half.len() > 60, "{} pixels", half.len());
    // Eyes and brows stand between 45 and 75 % of the picture's height; everything else stays.
    for i in &half {
        let (x, y) = (i % 256, i / 256);
        assert!((64..192).contains(&x) && (110..190).contains(&y), "{x}, {y} changed");
    }
    // What changes lies in hair.
    let ids = render(&gpu, &bare, &Shot { channel: Channel::PartId, ..view.clone() });
    let hair: Vec<u8> = bare
        .mesh_nodes()
        .filter(|(_, mesh)| !mesh.primitives.is_empty())
        .enumerate()
        .filter(|(_, (_, mesh))| mesh.name.starts_with("Hair"))
        .map(|(part, _)| part as u8 + 1)
        .collect();
    let beside = |i: usize| [i, i - 1, i + 1, i - 256, i + 256].iter().any(|i| hair.contains(&ids.pixels[i * 4]));
    assert!(half.iter().all(|i| beside(*i)), "something other than hair changed");
    // More opacity, more change; 1 shows them whole.
    let distance = |opacity: f32| -> u64 {
        let image = render(&gpu, &heroine(seen(opacity)), &view);
        image.pixels.iter().zip(&without.pixels).map(|(a, b)| u64::from(a.abs_diff(*b))).sum()
    };
    let [quarter, half, whole] = [0.25, 0.5, 1.0].map(distance);
    assert!(quarter < half && half < whole, "{quarter}, {half}, {whole}");
}

#[test]
fn nothing_is_seen_from_behind_or_through_what_hangs_far_before() {
    let gpu = gpu();
    let (bare, through) = (heroine(None), heroine(seen(1.0)));
    for yaw in [100.0, 180.0, -120.0] {
        let view = face(&bare, yaw);
        let count = changed(&render(&gpu, &bare, &view), &render(&gpu, &through, &view)).len();
        assert_eq!(count, 0, "pixels from {yaw} degrees");
    }
    let view = face(&bare, 0.0);
    let reference = render(&gpu, &bare, &view);
    let near = heroine(Some(EyesThrough { opacity: 1.0, window_m: 0.0005, ..EyesThrough::default() }));
    assert!(
        changed(&reference, &render(&gpu, &near, &view)).len() < 12,
        "hair farther than the window was seen through"
    );

    // A second one, her back to us, stands before the first: her hair hides all.
    let two = |scene: &Scene| {
        let mut view = view.clone();
        let behind = Mat4::from_rotation_y(std::f32::consts::PI);
        view.instances = vec![Mat4::IDENTITY, Mat4::from_translation(glam::Vec3::Z * 0.4) * behind];
        view.camera.eye.z += 0.6;
        render(&gpu, scene, &view)
    };
    assert_eq!(changed(&two(&bare), &two(&through)), [0usize; 0], "seen through another one's hair");
    // The window is not what keeps them apart: each has a number of her own.
    let wide = heroine(Some(EyesThrough { opacity: 1.0, window_m: 0.6, ..EyesThrough::default() }));
    assert_eq!(changed(&two(&bare), &two(&wide)), [0usize; 0], "seen through another one's hair in a wide window");
}

/// It fades to above and below on its own angles.
#[test]
fn from_high_above_nothing_is_seen_through() {
    let gpu = gpu();
    let bare = heroine(None);
    let seen_at = |pitch_deg: f32| {
        let mut view = face(&bare, 0.0);
        let away = view.camera.eye - view.camera.target;
        view.camera.eye = view.camera.target + glam::Quat::from_rotation_x(-pitch_deg.to_radians()) * away;
        changed(&render(&gpu, &bare, &view), &render(&gpu, &heroine(seen(1.0)), &view)).len()
    };
    let [level, raised, high] = [0.0, 30.0, 72.0].map(seen_at);
    assert!(level > 60 && raised > 20 && high == 0, "{level}, {raised}, {high} pixels");
}

/// In a crowd each one's eyes are seen through her own hair, also of those who share a number.
#[test]
fn a_crowd_is_seen_through_like_one() {
    let gpu = gpu();
    let (bare, through) = (heroine(None), heroine(seen(0.5)));
    let mut view = face(&bare, 0.0);
    let alone = changed(&render(&gpu, &bare, &view), &render(&gpu, &through, &view)).len();
    // 69 far to the side, and one before the camera.
    view.instances = (0..70).map(|i| Mat4::from_translation(glam::Vec3::X * i as f32 * 3.0)).collect();
    view.instances.reverse();
    assert_eq!(changed(&render(&gpu, &bare, &view), &render(&gpu, &through, &view)).len(), alone);
}
