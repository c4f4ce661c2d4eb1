//! Channels, formats, repeated pictures, and views that are refused.

use glam::Vec3;
use hikage::material::{Alpha, AlphaMode, Material, Outline, OutlineWidth};
use hikage::scene::Scene;
use hikage::{Channel, Output, Renderer};

use super::close;
use crate::support::{Shoot, Shot, gpu, pixel, render, render_with, scene, sphere, square, staged, two_tone, view};

#[test]
fn parts_are_numbered_in_the_order_of_nodes() {
    let gpu = gpu();
    let glass = Material { alpha: Alpha { mode: AlphaMode::Blend, ..Alpha::default() }, ..two_tone() };
    let scene = scene(vec![(square([-0.3, 0.0], 0.2, 0.0), glass), (square([0.3, 0.0], 0.2, 0.0), two_tone())]);
    let mut ids = view(128, 4.0);
    ids.channel = Channel::PartId;
    let image = render(&gpu, &scene, &ids);
    assert_eq!(pixel(&image, 40, 64), [1, 0, 0, 255], "the first part, although it is drawn last");
    assert_eq!(pixel(&image, 90, 64), [2, 0, 0, 255]);
    assert_eq!(pixel(&image, 2, 2), [0, 0, 0, 255]);
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let uploaded = renderer.upload(&scene).expect("an upload");
    assert_eq!((uploaded.part_material(0), uploaded.part_material(1)), (Some(0), Some(1)));
}

#[test]
fn depth_and_normal_channels_show_the_surface() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.5, 64, 128), two_tone())]);
    let mut channel = view(128, 4.0);
    channel.channel = Channel::Normal;
    let normal = render(&gpu, &scene, &channel);
    close(&pixel(&normal, 64, 64)[..3], &[128, 128, 255], 3, "the middle faces the camera");
    channel.channel = Channel::Depth;
    let depth = render(&gpu, &scene, &channel);
    assert!(pixel(&depth, 64, 64)[0] > pixel(&depth, 40, 64)[0], "the middle is nearest");
    assert_eq!(pixel(&depth, 1, 1), [0; 4]);
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let gpu = gpu();
    let mut material = two_tone();
    material.rim.color = [0.6, 0.7, 0.8];
    let width = OutlineWidth::World { metres: 0.01 };
    material.outline = Some(Outline { width, ..Outline::default() });
    let scene = scene(vec![(sphere(0.5, 64, 128), material)]);
    let first = render(&gpu, &scene, &view(256, 4.0));
    for run in 0..10 {
        assert!(render(&gpu, &scene, &view(256, 4.0)) == first, "run {run} differs");
    }
}

#[test]
fn targets_that_do_not_encode_show_the_same_colours() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.5, 64, 128), two_tone())]);
    let plain = Output { format: wgpu::TextureFormat::Rgba8Unorm, samples: 1, ..Output::default() };
    let encoded = Output { format: wgpu::TextureFormat::Rgba8UnormSrgb, samples: 1, ..Output::default() };
    let a = render_with(&gpu, &scene, &view(128, 4.0), plain);
    let b = render_with(&gpu, &scene, &view(128, 4.0), encoded);
    let worst = a.pixels.iter().zip(&b.pixels).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(worst <= Some(1), "{worst:?}");
}

#[test]
fn views_without_sense_are_refused_with_their_reason() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.5, 8, 16), two_tone())]);
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut uploaded = staged(renderer.upload(&scene));
    let mut refuse = |change: fn(&mut Shot), word: &str| {
        let mut view = view(64, 4.0);
        change(&mut view);
        let error = renderer.shoot(&mut uploaded, &view).expect_err(word).to_string();
        assert!(error.contains(word), "{error}");
    };
    refuse(|v| v.size = [0, 10], "size");
    refuse(|v| v.size = [10, 100_000], "size");
    refuse(|v| v.camera.fov_y_rad = 0.0, "field of view");
    refuse(|v| v.camera.near = f32::NAN, "near");
    refuse(|v| v.camera.target = v.camera.eye, "camera");
    refuse(|v| v.camera.up = Vec3::Z, "camera");
    let wrong = Output { samples: 3, ..Output::default() };
    assert!(Renderer::with_output(&gpu, wrong).is_err());
}

#[test]
fn an_empty_scene_is_its_background() {
    let image = render(&gpu(), &Scene::default(), &view(16, 4.0));
    assert!(image.pixels.chunks_exact(4).all(|p| p == [0x80, 0x80, 0x80, 255]));
}
