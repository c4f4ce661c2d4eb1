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
fn many_lights_still_cut_one_band() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.5, 96, 192), two_tone())]);
    let mut view = view(256, 4.0);
    for x in [-2.0, 2.0] {
        view.lights.punctual.push(PunctualLight {
            position: Vec3::new(x, 1.0, 3.0),
            color: LinearRgb::WHITE,
            intensity: 3.0,
            range: 0.0,
            spot: None,
        });
    }
    let image = render(&gpu, &scene, &view);
    // Along the middle column the picture goes from light to shade once.
    let reds: Vec<u8> = (40..216).map(|y| pixel(&image, 128, y)[0]).collect();
    let lit = reds[20];
    let turns = reds.windows(2).filter(|w| (w[0] > lit / 2 + 20) != (w[1] > lit / 2 + 20)).count();
    assert!(turns <= 1, "{turns} edges of shade in one column");
}
