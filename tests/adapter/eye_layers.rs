//! Flat eyes: cards that lie on one another, lights that stay lit, shadows of lids, and another iris at run time.

use glam::Vec3;
use hikage::Renderer;
use hikage::material::{Base, Layer, Material, Shading, TextureRef, Toon};
use hikage::scene::{Framing, Image, Role, Scene};

use crate::support::{self, Shoot, Shot, gpu, pixel, render, scene, square, staged, texture, view};

const COLORS: [[f32; 3]; 4] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0]];

fn flat(color: [f32; 3], layer: Option<Layer>) -> Material {
    let [r, g, b] = color;
    Material {
        base: Base { color: [r, g, b, 1.0], texture: None },
        shading: Shading::Unlit,
        layer,
        ..Material::default()
    }
}

/// Four cards in one plane, as large as an eye and cut into triangles otherwise; the file's order says nothing.
fn stack(layers: [Option<i32>; 4]) -> Scene {
    let order = [2usize, 0, 3, 1];
    let card = |i: usize| {
        let half = 0.012 - 0.002 * i as f32;
        let mut part = square([0.001 * i as f32, 0.0], half, 0.0);
        if i % 2 == 1 {
            part.indices = vec![1, 2, 3, 1, 3, 0];
        }
        (part, flat(COLORS[i], layers[i].map(|index| Layer { index, stay_lit: 0.0 })))
    };
    scene(order.map(card).into())
}

/// At any distance, from the front and aslant, each card hides the ones below and nothing flickers between them.
#[test]
fn cards_in_one_plane_keep_their_order_at_any_distance() {
    let gpu = gpu();
    let cards = stack([Some(0), Some(1), Some(2), Some(3)]);
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut uploaded = staged(renderer.upload(&cards));
    for distance in [0.3, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0] {
        for yaw in [-60f32, -25.0, 0.0, 40.0] {
            let mut view = view(64, distance);
            view.camera.eye = Vec3::new(yaw.to_radians().sin(), 0.3, yaw.to_radians().cos()).normalize() * distance;
            view.camera.fov_y_rad = 2.0 * (0.014f32 / distance).atan();
            view.camera.near = (distance * 0.05).min(0.1);
            let image = renderer.shoot(&mut uploaded, &view).expect("a picture");
            let is = |p: [u8; 4], c: [f32; 3]| (0..3).all(|i| p[i] == if c[i] > 0.5 { 255 } else { 0 });
            let center = (0..64).flat_map(|y| (0..64).map(move |x| (x, y)));
            let counts = center.fold([0usize; 4], |mut counts, (x, y)| {
                let p = pixel(&image, x, y);
                for (count, color) in counts.iter_mut().zip(COLORS) {
                    *count += usize::from(is(p, color));
                }
                counts
            });
            // The uppermost card is whole, and each below shows its border.
            let area = (yaw.to_radians().cos() * 0.95 * 4096.0 * (0.006f32 / 0.014).powi(2)) as usize;
            assert!(counts[3] * 10 > area * 8, "at {distance} m from {yaw}: {counts:?}, expected {area} on top");
            assert!(counts[..3].iter().all(|c| *c > 20), "at {distance} m from {yaw}: {counts:?}");
            let row: Vec<bool> = (0..64).map(|x| is(pixel(&image, x, 32), COLORS[3])).collect();
            let edges = row.windows(2).filter(|w| w[0] != w[1]).count();
            assert_eq!(edges, 2, "the upper card is broken at {distance} m from {yaw}");
        }
    }
    // Without layers the order of the file decides: the last card drawn, not the uppermost one.
    let unordered = render(&gpu, &stack([None; 4]), &view(64, 0.1));
    assert_ne!(pixel(&unordered, 33, 32)[..3], [255, 255, 0]);
}

/// A layer by itself moves nothing that can be seen.
#[test]
fn a_layer_alone_changes_no_pixel() {
    let gpu = gpu();
    let picture = |layer| {
        render(&gpu, &scene(vec![(square([0.0, 0.0], 0.4, 0.0), flat([0.2, 0.5, 0.7], layer))]), &view(64, 2.0))
    };
    assert!(picture(None) == picture(Some(Layer { index: 3, stay_lit: 0.0 })), "a layer is seen");
}

#[test]
fn lights_stay_lit_on_request() {
    let gpu = gpu();
    let shaded = |stay_lit: f32| {
        let material = Material {
            layer: Some(Layer { index: 1, stay_lit }),
            shading: Shading::Toon(Toon { shade_color: [0.0; 3], ..Toon::default() }),
            ..Material::default()
        };
        let mut view = view(16, 2.0);
        view.lights.directional.to_light = Vec3::NEG_Z;
        pixel(&render(&gpu, &scene(vec![(square([0.0, 0.0], 0.9, 0.0), material)]), &view), 8, 8)[0]
    };
    let [dark, half, lit] = [0.0, 0.5, 1.0].map(shaded);
    assert!(dark == 0 && lit == 255 && (150..220).contains(&half), "{dark}, {half}, {lit}");
}

#[test]
fn another_picture_takes_the_place_of_a_card() {
    let gpu = gpu();
    let mut cards = scene(vec![
        (square([0.0, 0.0], 0.9, 0.0), flat([1.0; 3], None)),
        (square([9.0, 0.0], 0.1, 0.0), flat([1.0; 3], None)),
    ]);
    let map: TextureRef = texture(&mut cards, 4, 4, |_, _| [255, 0, 0, 255]);
    cards.materials[0].base.texture = Some(map);
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut uploaded = staged(renderer.upload(&cards));
    let look = |renderer: &Renderer, uploaded: &mut hikage::Stage| {
        pixel(&renderer.shoot(uploaded, &view(16, 2.0)).expect("a picture"), 8, 8)
    };
    assert_eq!(look(&renderer, &mut uploaded), [255, 0, 0, 255]);
    let green = Image { width: 2, height: 2, pixels: [0, 255, 0, 255].repeat(4), ..Image::default() };
    renderer.replace_base_texture(&mut uploaded, 0, 0, &green).expect("another picture");
    assert_eq!(look(&renderer, &mut uploaded), [0, 255, 0, 255]);
    let fault = |result: hikage::Result<()>| result.expect_err("refused").to_string();
    assert!(fault(renderer.replace_base_texture(&mut uploaded, 0, 1, &green)).contains("no base texture"));
    assert!(fault(renderer.replace_base_texture(&mut uploaded, 0, 7, &green)).contains("is not there"));
    let torn = Image { width: 3, ..green };
    assert!(fault(renderer.replace_base_texture(&mut uploaded, 0, 0, &torn)).contains("width * height"));
}

/// Lids and lashes darken the upper part of the eyes, and nothing else.
#[test]
fn lids_shade_the_eyes() {
    let gpu = gpu();
    let mut with = support::anime_heroine();
    // How much of an eye hair lets through goes by its brightness.
    with.eyes_through = None;
    let mut without = with.clone();
    for material in &mut without.materials {
        let is_eye = material.bangs_shadow.is_some_and(|b| b.lids);
        let off = material.bangs_shadow.map(|b| hikage::material::BangsShadow { strength: 0.0, ..b });
        material.bangs_shadow = if is_eye { off } else { material.bangs_shadow };
    }
    // Hair casts no shadow here: what is left is that of the lids.
    for scene in [&mut with, &mut without] {
        for part in scene.meshes.iter_mut().flat_map(|m| &mut m.primitives) {
            if part.role == Role::HairFront {
                part.role = Role::Hair;
            }
        }
    }
    let mut view = Shot::framed(&with, Framing::Face, 0.0, [256, 256]);
    view.lights.directional.to_light = Vec3::new(0.1, 0.7, 0.7).normalize();
    let [with, without] = [&with, &without].map(|scene| render(&gpu, scene, &view));
    let darker: Vec<u32> = (0..256 * 256u32)
        .filter(|i| {
            let (a, b) = (pixel(&with, i % 256, i / 256), pixel(&without, i % 256, i / 256));
            assert!((0..3).all(|c| a[c] <= b[c].saturating_add(1)), "a shadow that lights at {}, {}", i % 256, i / 256);
            (0..3).any(|c| b[c] - a[c].min(b[c]) > 8)
        })
        .collect();
    assert!(darker.len() > 40, "{} pixels lie in the shadow of lids", darker.len());
    // Between brows and cheeks.
    assert!(darker.iter().all(|i| (130..185).contains(&(i / 256))), "something else is darker");
}
