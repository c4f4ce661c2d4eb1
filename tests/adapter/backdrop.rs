//! Laws of painted backdrops: what is where, the same each time, under any look.

use hikage::Background;
use hikage::color::Srgb;
use hikage::scene::{Backdrop, Image, Post, ToneCurve};

use crate::support::{Shot, gpu, pixel, render, scene, square, two_tone, view};

const GRADIENT: Backdrop = Backdrop {
    top: Srgb([20, 40, 120]),
    middle: Srgb([120, 90, 160]),
    bottom: Srgb([250, 180, 90]),
    glow: Srgb([0; 3]),
    glow_at: [0.75, 0.25],
    glow_radius: 0.2,
    discs: Srgb([255; 3]),
    disc_count: 0,
    disc_radius: 0.1,
    seed: 1,
};

/// A small square in the middle of a backdrop.
fn drawn(backdrop: Backdrop, post: Option<Post>) -> Image {
    let mut scene = scene(vec![(square([0.0, 0.0], 0.05, 0.0), two_tone())]);
    scene.post = post;
    let shot = Shot { background: Background::Backdrop(backdrop), ..view(64, 10.0) };
    render(&gpu(), &scene, &shot)
}

fn is_near(found: [u8; 4], expected: Srgb) -> bool {
    found.iter().zip(expected.0).all(|(a, b)| a.abs_diff(b) <= 4)
}

#[test]
fn a_gradient_goes_from_top_to_bottom_and_keeps_its_colours() {
    let plain = drawn(GRADIENT, None);
    for (y, color) in [(0, GRADIENT.top), (31, GRADIENT.middle), (63, GRADIENT.bottom)] {
        for x in [0, 63] {
            assert!(is_near(pixel(&plain, x, y), color), "{x} {y}: {:?}, {color:?}", pixel(&plain, x, y));
        }
    }
    let post = Post { exposure_ev: 1.0, tone: ToneCurve::Filmic, ..Post::default() };
    assert_eq!(pixel(&drawn(GRADIENT, Some(post)), 0, 31), pixel(&plain, 0, 31), "exposure leaves it");
    assert!(plain.pixels.chunks(4).all(|p| p[3] == 255));
    assert!(!is_near(pixel(&plain, 32, 32), GRADIENT.middle), "the square is before it");
}

#[test]
fn light_is_added_where_it_is_and_discs_follow_their_seed() {
    let plain = drawn(GRADIENT, None);
    let glowing = drawn(Backdrop { glow: Srgb([200; 3]), ..GRADIENT }, None);
    assert!(pixel(&glowing, 48, 16)[0] > pixel(&plain, 48, 16)[0] + 60);
    assert_eq!(pixel(&glowing, 8, 56), pixel(&plain, 8, 56), "a glow ends");
    let discs = |seed| drawn(Backdrop { disc_count: 30, seed, ..GRADIENT }, None);
    let (one, two) = (discs(1), discs(2));
    assert_eq!(one.pixels, discs(1).pixels);
    assert_ne!(one.pixels, two.pixels);
    let brighter = one.pixels.iter().zip(&plain.pixels).filter(|(a, b)| **a > b.saturating_add(8)).count();
    assert!(brighter > 1000, "{brighter}");
    assert!(one.pixels.iter().zip(&plain.pixels).all(|(a, b)| a.saturating_add(2) >= *b), "light only adds");
}
