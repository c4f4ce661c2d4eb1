//! Debug channels of shading: each shows its own part of the anime look and nothing else.

use hikage::scene::{Framing, Image};
use hikage::{Channel, Renderer};

use crate::support::{self, Shoot, Shot, anime_heroine, gpu, pixel, staged};

const SHADING: [Channel; 10] = [
    Channel::Look("face-shadow"),
    Channel::Look("shade-ramp"),
    Channel::Look("fur"),
    Channel::Look("face-paint"),
    Channel::Look("highlight"),
    Channel::Look("bangs-shadow"),
    Channel::Look("layer"),
    Channel::Look("depth-rim"),
    Channel::Look("eyes-through"),
    Channel::Look("self-shadow"),
];

/// Share of pixels that are not black.
fn share(image: &Image) -> f64 {
    let bright = image.pixels.chunks(4).filter(|p| p[..3].iter().any(|c| *c > 12)).count();
    bright as f64 / (image.pixels.len() / 4) as f64
}

#[test]
fn every_channel_shows_its_part() {
    let (gpu, scene) = (gpu(), anime_heroine());
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut uploaded = staged(renderer.upload(&scene));
    let mut view = Shot::framed(&scene, Framing::Face, 0.0, [256, 256]);
    view.lights.directional.to_light = glam::Vec3::new(-0.9, 0.3, 0.24).normalize();
    let before = renderer.shoot(&mut uploaded, &view).expect("a picture");
    let pictures =
        SHADING.map(|channel| renderer.shoot(&mut uploaded, &Shot { channel, ..view.clone() }).expect("a channel"));
    // Face, ramp, fur, paint, highlight, bangs, layer, rim, eyes, own shadow: how much of a portrait each covers.
    let ranges = [
        (0.2, 0.9),
        (0.2, 0.9),
        (0.02, 0.2),
        (0.05, 0.4),
        (0.005, 0.2),
        (0.05, 0.4),
        (0.01, 0.08),
        (0.002, 0.12),
        (0.001, 0.05),
        (0.02, 0.9),
    ];
    for ((channel, picture), (low, high)) in SHADING.iter().zip(&pictures).zip(ranges) {
        let share = share(picture);
        assert!((low..high).contains(&share), "{channel:?} covers {share}");
        assert!(picture.pixels.chunks(4).all(|p| p[3] == 255), "{channel:?} has a background");
    }
    for (i, a) in pictures.iter().enumerate() {
        assert!(pictures[..i].iter().all(|b| a.pixels != b.pixels), "{:?} is another channel", SHADING[i]);
    }
    // White in light, dark in shade: the two sides of her face.
    let [lit, dark] = [112, 154].map(|x| pixel(&pictures[0], x, 207)[0]);
    assert!(lit > 240 && dark < 40, "{lit} and {dark}");
    // The picture itself is as it was.
    let after = renderer.shoot(&mut uploaded, &view).expect("a picture");
    assert!(before == after, "a channel has changed the picture");
}

/// Without ramps, light is tinted where it turns into shade.
#[test]
fn the_transition_is_shown_where_no_ramp_is() {
    let (gpu, mut scene) = (gpu(), anime_heroine());
    for material in &mut scene.materials {
        material.transition = material.shade_ramp.take().and(Some(hikage::material::Transition::default()));
    }
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut uploaded = staged(renderer.upload(&scene));
    let view = Shot { channel: Channel::Look("transition"), ..Shot::framed(&scene, Framing::Face, 0.0, [256, 256]) };
    let share = share(&renderer.shoot(&mut uploaded, &view).expect("a channel"));
    assert!((0.05..0.99).contains(&share), "{share}");
}

/// A plain model has none of it.
#[test]
fn a_plain_look_has_empty_channels() {
    let gpu = gpu();
    let scene = support::heroine();
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut uploaded = staged(renderer.upload(&scene));
    let view = Shot::framed(&scene, Framing::Face, 0.0, [96, 96]);
    for channel in SHADING.into_iter().skip(1) {
        let picture = renderer.shoot(&mut uploaded, &Shot { channel, ..view.clone() }).expect("a channel");
        assert_eq!(share(&picture), 0.0, "{channel:?}");
    }
}
