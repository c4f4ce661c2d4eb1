//! The shadow of a character on itself.

use glam::{Mat4, Vec3};
use hikage::Channel;
use hikage::color::LinearRgb;
use hikage::material::{CastShadow, Material};
use hikage::scene::{Ambient, Framing, Image, Scene, SelfShadow};

use crate::support::{Shoot, Shot, anime_heroine, gpu, pixel, render, scene, sphere, square, staged, two_tone, view};

fn with_shadow(received: f32, casts: bool) -> Material {
    Material { cast_shadow: Some(CastShadow { casts, received }), ..two_tone() }
}

/// A wall with a small square before it, in the middle of the picture.
fn wall(caster: Material, wall: Material) -> Scene {
    let parts = vec![(square([0.0, 0.0], 0.15, 0.3), caster), (square([0.0, 0.0], 0.8, 0.0), wall)];
    Scene { self_shadow: Some(SelfShadow::default()), ..scene(parts) }
}

/// From the front, with light that throws a shadow to the left and downwards by as much as the caster is away.
fn before_the_wall() -> Shot {
    let mut view = view(256, 8.0);
    view.camera.fov_y_rad = 2.0 * (0.8f32 / 8.0).atan();
    view.lights.directional.to_light = Vec3::new(1.0, 1.0, 1.0).normalize();
    view
}

fn srgb(linear: [f32; 3]) -> [u8; 3] {
    LinearRgb(linear).to_srgb().0
}

/// Pixels of exactly the shade's colour.
fn shaded(image: &Image) -> Vec<[u32; 2]> {
    let shade = srgb([0.3, 0.12, 0.4]);
    let at = |i: u32| [i % image.width, i / image.width];
    let is_shade = |p: [u8; 4]| p[..3].iter().zip(shade).all(|(a, b)| a.abs_diff(b) <= 1);
    (0..image.width * image.height).map(at).filter(|[x, y]| is_shade(pixel(image, *x, *y))).collect()
}

/// The shadow lies where the light puts it, is as large as its caster, and has the colour of shade, exactly.
#[test]
fn a_shadow_lies_where_the_light_puts_it() {
    let image = render(&gpu(), &wall(with_shadow(1.0, true), with_shadow(1.0, true)), &before_the_wall());
    let dark = shaded(&image);
    // 160 pixels a metre: the caster is 48 wide, its shadow 0.3 m to the left and below.
    let mean = |axis: usize| dark.iter().map(|p| f64::from(p[axis])).sum::<f64>() / dark.len().max(1) as f64;
    let middle = [mean(0), mean(1)];
    // What the caster does not hide.
    assert!((1500..2400).contains(&dark.len()), "{} pixels", dark.len());
    assert!((middle[0] - 80.0).abs() < 8.0 && (middle[1] - 176.0).abs() < 8.0, "round {middle:?}");
    let others = image.pixels.chunks(4).filter(|p| {
        let near = |c: [f32; 3]| p.iter().zip(srgb(c)).all(|(a, b)| a.abs_diff(b) <= 1);
        !near([0.3, 0.12, 0.4]) && !near([0.9, 0.3, 0.25])
    });
    assert!(others.count() < 1200, "an edge of many pixels");
}

#[test]
fn materials_say_whether_they_cast_and_receive() {
    let gpu = gpu();
    let count = |caster, receiver| shaded(&render(&gpu, &wall(caster, receiver), &before_the_wall())).len();
    assert_eq!(count(with_shadow(1.0, false), with_shadow(1.0, true)), 0, "does not cast");
    assert_eq!(count(with_shadow(1.0, true), with_shadow(0.0, true)), 0, "does not receive");
    assert_eq!(count(two_tone(), two_tone()), 0, "have no part in it");
    let scene = Scene { self_shadow: None, ..wall(with_shadow(1.0, true), with_shadow(1.0, true)) };
    assert_eq!(shaded(&render(&gpu, &scene, &before_the_wall())).len(), 0, "there is none");
}

/// Round shapes do not shade themselves: on the lit side not a pixel is darker than without the shadow.
#[test]
fn a_round_shape_has_no_stripes() {
    let gpu = gpu();
    for to_light in [Vec3::new(0.3, 0.4, 1.0), Vec3::new(-1.0, 0.5, 0.4), Vec3::new(0.1, 1.0, 0.05)] {
        let ball = |shadow| Scene { self_shadow: shadow, ..scene(vec![(sphere(0.5, 48, 96), with_shadow(1.0, true))]) };
        let mut view = view(256, 4.0);
        view.lights.directional.to_light = to_light.normalize();
        let (with, without) =
            (render(&gpu, &ball(Some(SelfShadow::default())), &view), render(&gpu, &ball(None), &view));
        let darker = with.pixels.iter().zip(&without.pixels).filter(|(a, b)| b.saturating_sub(**a) > 24).count();
        assert!(darker < 60, "{darker} numbers under light from {to_light}");
    }
}

/// Every character of a crowd has its own, however it is turned; those beyond the maps have none, and nothing breaks.
#[test]
fn each_of_a_crowd_casts_on_itself() {
    let gpu = gpu();
    let scene = wall(with_shadow(1.0, true), with_shadow(1.0, true));
    let mut view = before_the_wall();
    view.camera.fov_y_rad = 2.0 * (5.0f32 / 8.0).atan();
    let alone = shaded(&render(&gpu, &scene, &view)).len();
    let place = |i: i32| Mat4::from_translation(Vec3::new((i % 3) as f32 * 3.0 - 3.0, (i / 3) as f32 * 3.0 - 3.0, 0.0));
    view.instances = (0..9).map(place).collect();
    let crowd = shaded(&render(&gpu, &scene, &view)).len();
    assert!(alone > 20 && crowd.abs_diff(8 * alone) < 4 * alone, "{alone} pixels alone, {crowd} of nine");
}

/// Maps are drawn again when anything that they show has changed, so that a scene that is used again draws as a new one does.
#[test]
fn maps_follow_light_pose_and_places() {
    let gpu = gpu();
    let scene = anime_heroine();
    let mut view = Shot::framed(&scene, Framing::Bust, 0.0, [96, 96]);
    let mut views = vec![view.clone()];
    view.lights.directional.to_light = Vec3::new(-0.8, 0.5, 0.3).normalize();
    views.push(view.clone());
    view.instances = vec![Mat4::from_rotation_y(0.6)];
    views.push(view.clone());
    views.push(views[0].clone());
    let renderer = hikage::Renderer::new(&gpu).expect("a renderer");
    let mut used = staged(renderer.upload(&scene));
    for (i, view) in views.iter().enumerate() {
        let again = renderer.shoot(&mut used, view).expect("a picture");
        let mut fresh = staged(renderer.upload(&scene));
        assert!(again == renderer.shoot(&mut fresh, view).expect("a picture"), "view {i} shows an older shadow");
    }
    let mut pose = hikage::motion::Pose::rest(&scene);
    pose.set_stance(&scene, hikage::motion::Stance::Bend);
    used.actors[0].pose = pose.clone();
    let bent = renderer.shoot(&mut used, &views[0]).expect("a picture");
    let mut fresh = staged(renderer.upload(&scene));
    fresh.actors[0].pose = pose.clone();
    assert!(bent == renderer.shoot(&mut fresh, &views[0]).expect("a picture"), "a pose shows an older shadow");
}

/// On the whole heroine: her chin shades her neck, and nothing gets lighter.
#[test]
fn the_chin_shades_the_neck() {
    let (gpu, mut heroine) = (gpu(), anime_heroine());
    // Where a terminator or the bangs' shadow is darker than shade, shade may be the lighter one.
    heroine.materials.iter_mut().for_each(|m| m.shade_ramp = None);
    heroine.bangs = None;
    let mut view = Shot::framed(&heroine, Framing::Portrait, 0.0, [256, 256]);
    view.lights.ambient = Ambient::uniform(LinearRgb::BLACK);
    view.lights.directional.to_light = Vec3::new(0.1, 0.8, 0.6).normalize();
    let with = render(&gpu, &heroine, &view);
    let channel = render(&gpu, &heroine, &Shot { channel: Channel::Look("self-shadow"), ..view.clone() });
    let without = render(&gpu, &Scene { self_shadow: None, ..heroine }, &view);
    let lighter = with.pixels.iter().zip(&without.pixels).filter(|(a, b)| a.saturating_sub(**b) > 2).count();
    let darker = with.pixels.iter().zip(&without.pixels).filter(|(a, b)| b.saturating_sub(**a) > 12).count();
    assert!(lighter == 0 && darker > 600, "{lighter} numbers lighter, {darker} darker");
    let lit = channel.pixels.chunks(4).filter(|p| p[0] > 200).count();
    assert!(lit > 2000, "{lit} pixels receive light");
}
