//! Rim by depth: its width in pixels, its side, and where there is none.

use glam::Vec3;
use hikage::material::{Base, DepthRim, Material, Shading, Toon};
use hikage::scene::Image;
use hikage::{Background, Channel, color::Srgb};

use crate::support::{Lent, Shot, gpu, pixel, render, scene, sphere, square, view};

fn rimmed(width_px: f32) -> Material {
    let depth_rim = Some(DepthRim { color: [1.0; 3], width_px, light_side: [-1.5, -1.2], ..DepthRim::default() });
    Material { depth_rim, shading: Shading::Toon(Toon::default()), ..Material::default() }
}

fn channel(gpu: &Lent, material: Material, view: &Shot, radius: f32) -> Image {
    let view =
        Shot { channel: Channel::Look("depth-rim"), background: Background::Color(Srgb([0; 3])), ..view.clone() };
    render(gpu, &scene(vec![(sphere(radius, 96, 192), material)]), &view)
}

/// Length of the bright run at the left of the middle row.
fn width(image: &Image) -> f32 {
    let row = image.height / 2;
    (0..image.width / 2).map(|x| f32::from(pixel(image, x, row)[0]) / 255.0).map(linear).sum()
}

fn linear(code: f32) -> f32 {
    hikage::color::linear_from_srgb(code)
}

/// From half a metre to twenty, near and far characters have rims of the same width.
#[test]
fn the_width_is_in_pixels_at_any_distance() {
    let gpu = gpu();
    for distance in [0.5f32, 1.0, 3.0, 8.0, 20.0] {
        for width_px in [3.0, 6.0] {
            // The ball stays as large in the picture.
            let mut view = view(512, distance);
            view.camera.fov_y_rad = 2.0 * (0.15f32 / distance).atan();
            view.camera.near = 0.02;
            let found = width(&channel(&gpu, rimmed(width_px), &view, 0.1));
            // The picture is half as high as the one that widths are given for.
            let expected = width_px * 0.5;
            assert!((found - expected).abs() <= 1.0, "{found} px at {distance} m, expected {expected}");
        }
    }
}

/// Only the side of the light has one; a face seen before a near wall has none, as creases have none.
#[test]
fn the_rim_is_on_the_side_of_the_light_and_on_contours_alone() {
    let gpu = gpu();
    let mut lit = view(256, 1.0);
    lit.camera.fov_y_rad = 0.3;
    lit.lights.directional.to_light = Vec3::NEG_X;
    let mut material = rimmed(8.0);
    if let Some(rim) = &mut material.depth_rim {
        rim.light_side = [0.0, 0.3];
    }
    let image = channel(&gpu, material.clone(), &lit, 0.1);
    let bright = |columns: std::ops::Range<u32>| columns.filter(|x| pixel(&image, *x, 128)[0] > 128).count();
    assert!(bright(0..128) >= 1 && bright(128..256) == 0, "{} and {}", bright(0..128), bright(128..256));

    // A plate whose surface looks to the right, two centimetres before a wall: less than the threshold of four.
    let before = |gap: f32| {
        let mut plate = square([0.0, 0.0], 0.05, 0.0);
        plate.normals = vec![[0.8, 0.0, 0.6]; 4];
        let parts = vec![(plate, rimmed(8.0)), (square([0.0, 0.0], 0.5, -gap), Material::default())];
        let shown = Shot { channel: Channel::Look("depth-rim"), ..lit.clone() };
        let image = render(&gpu, &scene(parts), &shown);
        (0..256).filter(|x| pixel(&image, *x, 128)[0] > 128).collect::<Vec<u32>>()
    };
    assert_eq!(before(0.02), [0u32; 0]);
    let contour = before(0.2);
    assert!((1..=3).contains(&contour.len()) && contour[0] > 128, "{contour:?}");
}

/// Without the section nothing is drawn twice, and strength 0 is the same to the bit.
#[test]
fn no_strength_is_no_rim() {
    let gpu = gpu();
    let picture = |depth_rim| {
        let base = Base { color: [0.2, 0.2, 0.2, 1.0], texture: None };
        let material = Material { depth_rim, base, ..Material::default() };
        render(&gpu, &scene(vec![(sphere(0.6, 24, 48), material)]), &view(256, 3.0))
    };
    let none = picture(None);
    assert!(none == picture(Some(DepthRim { strength: 0.0, ..DepthRim::default() })), "a rim of no strength");
    assert!(none != picture(Some(DepthRim { width_px: 16.0, ..DepthRim::default() })), "no rim");
}
