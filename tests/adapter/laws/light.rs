//! Directional, ambient and punctual light.

use glam::Vec3;
use hikage::color::LinearRgb;
use hikage::material::{Base, Material, Shading, Toon};
use hikage::scene::{Ambient, Lights, PunctualLight, SpotCone};

use super::{close, srgb};
use crate::support::{gpu, pixel, render, scene, sphere, two_tone, view};

#[test]
fn light_of_intensity_one_shows_lit_and_shade_colours_exactly() {
    let material = two_tone();
    let scene = scene(vec![(sphere(0.5, 64, 128), material)]);
    let image = render(&gpu(), &scene, &view(256, 4.0));
    close(&pixel(&image, 90, 90)[..3], &srgb([0.9, 0.3, 0.25]), 1, "lit");
    close(&pixel(&image, 188, 188)[..3], &srgb([0.3, 0.12, 0.4]), 1, "shade");
}

#[test]
fn ambient_light_adds_its_share_of_the_lit_colour_and_equalizes() {
    let gpu = gpu();
    let at_top_and_bottom = |equalization: f32| {
        let toon = Toon { gi_equalization: equalization, ..Toon::default() };
        let base = Base { color: [0.5, 0.5, 0.5, 1.0], texture: None };
        let material = Material { base, shading: Shading::Toon(toon), ..Material::default() };
        let scene = scene(vec![(sphere(0.5, 64, 128), material)]);
        let mut view = view(256, 4.0);
        view.lights.directional.intensity = 0.0;
        view.lights.ambient = Ambient { sky: LinearRgb::splat(0.8), ground: LinearRgb::splat(0.2) };
        let image = render(&gpu, &scene, &view);
        [pixel(&image, 128, 50), pixel(&image, 128, 128), pixel(&image, 128, 205)].map(|p| p[0])
    };
    let even = at_top_and_bottom(1.0);
    close(&even, &srgb([0.25; 3]), 1, "equalized ambient light is the mean everywhere");
    let directed = at_top_and_bottom(0.0);
    assert!(directed[0] > directed[1] + 10 && directed[1] > directed[2] + 10, "sky above ground: {directed:?}");
}

#[test]
fn one_direction_of_light_by_lamp_or_sun_is_the_same() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.5, 64, 128), two_tone())]);
    let mut sun = view(128, 4.0);
    let mut lamp = sun.clone();
    sun.lights.directional.to_light = Vec3::Z;
    lamp.lights = Lights { ambient: sun.lights.ambient, ..Lights::default() };
    lamp.lights.directional.intensity = 0.0;
    lamp.lights.punctual.push(PunctualLight {
        position: Vec3::Z * 200.0,
        color: LinearRgb::WHITE,
        intensity: 200.0 * 200.0,
        range: 0.0,
        spot: Some(SpotCone { direction: Vec3::NEG_Z, inner_rad: 0.2, outer_rad: 0.3 }),
    });
    let (a, b) = (render(&gpu, &scene, &sun), render(&gpu, &scene, &lamp));
    let off = a.pixels.iter().zip(&b.pixels).filter(|(a, b)| a.abs_diff(**b) > 8).count();
    assert!(off < 300, "{off} channels differ");
    // Outside of its cone the lamp does nothing.
    lamp.lights.punctual[0].spot = Some(SpotCone { direction: Vec3::X, inner_rad: 0.2, outer_rad: 0.3 });
    assert_eq!(pixel(&render(&gpu, &scene, &lamp), 64, 64)[..3], [0; 3]);
}

#[test]
fn each_lamp_has_a_band_of_its_own_and_none_shines_through() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.5, 96, 192), two_tone())]);
    let mut view = view(256, 4.0);
    view.lights.ambient = Ambient::uniform(LinearRgb::splat(0.0));
    view.lights.directional.to_light = Vec3::Y;
    let lamp = |position: Vec3, color| PunctualLight {
        position,
        color: LinearRgb(color),
        intensity: 8.0,
        range: 0.0,
        spot: None,
    };
    let alone = render(&gpu, &scene, &view);
    // One behind, to the left: what does not face it is as it was, to the byte.
    view.lights.punctual = vec![lamp(Vec3::new(-3.0, 0.0, -1.0), [0.0, 0.3, 1.0])];
    let behind = render(&gpu, &scene, &view);
    for x in [110, 128, 180, 200] {
        for y in [60, 100, 140, 180] {
            assert_eq!(pixel(&alone, x, y), pixel(&behind, x, y), "{x}, {y}");
        }
    }
    assert!(pixel(&behind, 46, 128)[2] > pixel(&alone, 46, 128)[2] + 20, "its own side is lit");
    // One to each side: two edges, and between them what neither reaches.
    view.lights.punctual =
        vec![lamp(Vec3::new(-3.0, 0.0, -1.0), [0.0, 0.3, 1.0]), lamp(Vec3::new(3.0, 0.0, -1.0), [0.0, 0.3, 1.0])];
    let both = render(&gpu, &scene, &view);
    let blues: Vec<u8> = (40..216).map(|x| pixel(&both, x, 150)[2]).collect();
    let middle = blues[88];
    let edges = blues.windows(2).filter(|w| (w[0] > middle + 10) != (w[1] > middle + 10)).count();
    assert_eq!((edges, pixel(&both, 128, 150)), (2, pixel(&alone, 128, 150)), "{blues:?}");
}
