//! The warm edge of a toon shade on skin.

use glam::Vec3;
use hikage::color::LinearRgb;
use hikage::material::{Base, CastShadow, FaceShadow, Material, Shading, Skin, Toon};
use hikage::scene::{Ambient, Framing, Image, Role, Scene, SelfShadow};

use super::skin::seen;
use crate::support::{self, Shot, anime_heroine, gpu, pixel, render, scene, sphere, square};

const LIT: [f32; 3] = [0.95, 0.8, 0.7];
const SHADE: [f32; 3] = [0.75, 0.5, 0.45];

fn drawn(edge: f32, edge_steps: u32) -> Skin {
    Skin { natural: 0.0, edge, edge_steps, ..Skin::default() }
}

/// Two flat tones with a hard border.
fn toon(skin: Option<Skin>) -> Material {
    Material {
        base: Base { color: [LIT[0], LIT[1], LIT[2], 1.0], texture: None },
        shading: Shading::Toon(Toon { shade_color: SHADE, toony: 1.0, ..Toon::default() }),
        cast_shadow: Some(CastShadow::default()),
        skin,
        ..Material::default()
    }
}

fn ball(radius: f32, skin: Option<Skin>) -> Scene {
    scene(vec![(sphere(radius, 64, 128), toon(skin))])
}

/// From the front, lit from the right, so that the border is in the middle; so many pixels for the ball.
fn from_the_side(radius: f32, pixels: u32) -> Shot {
    seen([pixels; 2], 2000.0 * radius / pixels as f32, 40.0 * radius, Vec3::X)
}

/// How much redder each pixel of the middle row is than without the band.
fn band(with: &Image, without: &Image) -> Vec<i32> {
    let y = with.height / 2;
    (0..with.width).map(|x| i32::from(pixel(without, x, y)[1]) - i32::from(pixel(with, x, y)[1])).collect()
}

fn count(band: &[i32], least: i32) -> usize {
    band.iter().filter(|d| **d >= least).count()
}

/// Faces and bodies of the anime look have no room for another texture, and keep their bytes; so does a cast shadow's edge.
#[test]
fn without_an_edge_toon_shade_keeps_its_bytes() {
    let gpu = gpu();
    let mut heroine = anime_heroine();
    let shot = Shot::framed(&heroine, Framing::Bust, 0.0, [160, 160]);
    let plain = render(&gpu, &heroine, &shot);
    let mut count = 0;
    let roles: Vec<(usize, Role)> =
        heroine.meshes.iter().flat_map(|m| &m.primitives).map(|p| (p.material, p.role)).collect();
    for (material, _) in roles.into_iter().filter(|(_, role)| [Role::Face, Role::Skin].contains(role)) {
        heroine.materials[material].skin = Some(drawn(0.0, 0));
        count += 1;
    }
    assert!(count >= 2, "a face and a body");
    assert!(render(&gpu, &heroine, &shot).pixels == plain.pixels);
}

#[test]
fn the_band_lies_at_the_border_and_is_redder_than_both_sides() {
    let gpu = gpu();
    let shot = from_the_side(0.03, 200);
    let [with, without] = [Some(drawn(1.0, 0)), None].map(|skin| render(&gpu, &ball(0.03, skin), &shot));
    let found = band(&with, &without);
    let at = (0..200).max_by_key(|x| found[*x]).expect("a band");
    assert!(at.abs_diff(100) <= 4, "at {at}");
    let red = |x: u32| {
        let p = pixel(&with, x, 100);
        f32::from(p[0]) / f32::from(p[1])
    };
    let middle = red(at as u32);
    assert!(middle > 1.2 * red(40) && middle > 1.2 * red(160), "{} {middle} {}", red(40), red(160));
    // On both sides, farther into shade.
    let [dark, bright] = [&found[..100], &found[100..]].map(|side| count(side, 4));
    assert!(bright >= 2 && dark > bright, "{dark} px in shade, {bright} in light");
    assert_eq!(count(&found[..50], 1) + count(&found[150..], 1), 0, "far from the border");
}

/// Of balls that look as large, round the smaller one it takes more of the picture.
#[test]
fn the_band_is_wider_on_a_rounder_surface() {
    let gpu = gpu();
    let width = |radius: f32| {
        let shot = from_the_side(radius, 200);
        let [with, without] = [Some(drawn(1.0, 0)), None].map(|skin| render(&gpu, &ball(radius, skin), &shot));
        count(&band(&with, &without), 8) as f32
    };
    let [small, large] = [width(0.02), width(0.06)];
    assert!(large >= 4.0 && small > 2.0 * large, "{small} px and {large} px");
}

#[test]
fn bands_are_cut_into_as_many_levels() {
    let gpu = gpu();
    for steps in 1..=4u32 {
        let shot = from_the_side(0.02, 600);
        let [with, without] = [Some(drawn(1.0, steps)), None].map(|skin| render(&gpu, &ball(0.02, skin), &shot));
        let found = band(&with, &without);
        // Runs of one level in shade.
        let mut levels: Vec<i32> =
            found[..300].windows(3).filter(|w| w[0] > 0 && w.iter().all(|d| *d == w[0])).map(|w| w[0]).collect();
        levels.dedup();
        assert_eq!(levels.len(), steps as usize, "{levels:?}");
        assert!(levels.is_sorted());
    }
}

/// A flat wall has no border of its own.
#[test]
fn a_cast_shadow_has_a_band_along_its_border() {
    let gpu = gpu();
    let wall = |skin| {
        let parts = vec![(square([0.0, 0.0], 0.03, 0.06), toon(None)), (square([0.0, 0.0], 0.16, 0.0), toon(skin))];
        let shadow = SelfShadow { soft_width_m: 0.01, ..SelfShadow::default() };
        Scene { self_shadow: Some(shadow), ..scene(parts) }
    };
    let shot = seen([320, 320], 1.0, 2.0, Vec3::ONE.normalize());
    let [with, without] = [Some(drawn(1.0, 0)), None].map(|skin| render(&gpu, &wall(skin), &shot));
    near_the_border(&with, &without, [0..320, 0..320], 6, 8);
}

/// Where the anime look's map draws the border, whatever the normals say.
#[test]
fn the_band_follows_the_map_of_a_face() {
    let gpu = gpu();
    let mut heroine = anime_heroine();
    support::keep(&mut heroine, &[Role::Face]);
    for material in &mut heroine.materials {
        (material.bangs_shadow, material.highlight, material.depth_rim) = (None, None, None);
        (material.transition, material.shade_ramp, material.face_paint) = (None, None, None);
        // A border of one pixel, and no painted lines.
        material.face_shadow = material.face_shadow.map(|f| FaceShadow { softness: 0.001, ..f });
        material.base.texture = None;
    }
    let mut drawn_face = heroine.clone();
    for material in drawn_face.materials.iter_mut().filter(|m| m.face_shadow.is_some()) {
        material.skin = Some(drawn(1.0, 0));
    }
    let mut shot = Shot::framed(&support::heroine(), Framing::Face, 0.0, [384, 384]);
    shot.lights.ambient = Ambient::uniform(LinearRgb::splat(0.1));
    for degrees in [50.0f32, 75.0] {
        let (s, c) = degrees.to_radians().sin_cos();
        shot.lights.directional.to_light = Vec3::new(s, 0.0, c);
        let [with, without] = [&drawn_face, &heroine].map(|scene| render(&gpu, scene, &shot));
        // A temple.
        near_the_border(&with, &without, [124..190, 130..225], 8, 8);
    }
}

/// That pixels are redder along the border between two tones and nowhere else: in a part of a picture, x and y, no farther than
/// `reach` pixels from it, and along most of it, by `least` codes.
fn near_the_border(with: &Image, without: &Image, part: [std::ops::Range<u32>; 2], reach: u32, least: i32) {
    let [xs, ys] = part;
    let green = |image: &Image, x: u32, y: u32| i32::from(pixel(image, x, y)[1]);
    let redder = |x: u32, y: u32| green(without, x, y) - green(with, x, y);
    let places: Vec<[u32; 2]> = ys.flat_map(|y| xs.clone().map(move |x| [x, y])).collect();
    let inside = |x: u32, y: u32| x > 0 && y > 0 && pixel(without, x, y)[3] == 255;
    let border: Vec<[u32; 2]> = places
        .iter()
        .filter(|[x, y]| inside(*x, *y))
        .filter(|[x, y]| {
            let here = green(without, *x, *y);
            here.abs_diff(green(without, x - 1, *y)) > 10 || here.abs_diff(green(without, *x, y - 1)) > 10
        })
        .copied()
        .collect();
    assert!(border.len() > 30, "{} pixels of border", border.len());
    let is_near = |a: &[u32; 2], b: &[u32; 2]| a[0].abs_diff(b[0]) <= reach && a[1].abs_diff(b[1]) <= reach;
    let band: Vec<[u32; 2]> = places.into_iter().filter(|[x, y]| redder(*x, *y) >= least).collect();
    let astray = band.iter().filter(|p| !border.iter().any(|b| is_near(p, b))).count();
    assert!(astray * 50 <= band.len(), "{astray} of {} pixels lie elsewhere", band.len());
    let along = border.iter().filter(|b| band.iter().any(|p| is_near(p, b))).count();
    assert!(along * 10 >= border.len() * 8, "along {along} of {} pixels of the border", border.len());
}

/// A ball of 6 cm radius, whose band of 4 mm has a quarter of a pixel and then eight.
#[test]
fn it_fades_where_it_would_be_narrower_than_a_pixel() {
    let gpu = gpu();
    let strongest = |pixels: u32| {
        let shot = from_the_side(0.06, pixels);
        let [with, without] = [Some(drawn(1.0, 0)), None].map(|skin| render(&gpu, &ball(0.06, skin), &shot));
        with.pixels.iter().zip(&without.pixels).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
    };
    let [far, near] = [8, 240].map(strongest);
    assert!(far <= 1 && near > 60, "{far}, {near}");
}
