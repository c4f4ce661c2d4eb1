//! Blended surfaces that lie over themselves, as layers of hair do.

use std::path::PathBuf;

use glam::{Quat, Vec3};
use hikage::color::{LinearRgb, Srgb};
use hikage::material::{Alpha, AlphaMode, Blending, CastShadow, Material, Shading};
use hikage::scene::{Antialias, Framing, Image, Post, Primitive, Scene, SelfShadow, ToneCurve};
use hikage::{Actor, Background, Output, Renderer, Stage, View};

use crate::support::{Shoot, Shot, gpu, pixel, scene, square, staged, view, with_renderer};

const LAYERED: [Blending; 3] = [Blending::ThreePass, Blending::DoubleLayer, Blending::Weighted];

/// Squares over one another in one primitive: height above z = 0, colour with alpha.
fn stack(layers: &[(f32, [f32; 4])]) -> Primitive {
    let mut all = Primitive { uvs: vec![Vec::new()], ..Primitive::default() };
    for (z, color) in layers {
        let one = square([0.0, 0.0], 0.4, *z);
        let first = all.positions.len() as u32;
        all.indices.extend(one.indices.iter().map(|i| i + first));
        all.positions.extend(&one.positions);
        all.normals.extend(&one.normals);
        all.outline_normals.extend(&one.outline_normals);
        all.uvs[0].extend(&one.uvs[0]);
        all.colors.extend([*color; 4]);
    }
    all
}

fn reversed(mut of: Primitive) -> Primitive {
    let triangles: Vec<u32> = of.indices.chunks_exact(3).rev().flatten().copied().collect();
    of.indices = triangles;
    of
}

fn material(blending: Blending) -> Material {
    let alpha = Alpha { mode: AlphaMode::Blend, blending, ..Alpha::default() };
    Material { alpha, shading: Shading::Unlit, double_sided: true, ..Material::default() }
}

fn shoot(renderer: &Renderer, of: Primitive, with: Material, shot: &Shot) -> Image {
    let mut stage = staged(renderer.upload(&scene(vec![(of, with)])));
    renderer.shoot(&mut stage, shot).expect("a picture")
}

fn most_off_of(a: [u8; 4], b: [u8; 4]) -> u8 {
    a.iter().zip(b).map(|(a, b)| a.abs_diff(b)).max().unwrap_or(0)
}

fn most_off(a: &Image, b: &Image) -> u8 {
    a.pixels.iter().zip(&b.pixels).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}

#[test]
fn one_layer_and_layers_of_one_colour_are_what_sorting_makes_of_them() {
    let gpu = gpu();
    let color = |alpha: f32| [0.6, 0.3, 0.1, alpha];
    let one = [(0.0, color(0.5))];
    let several = [(-0.09, color(0.3)), (-0.03, color(0.8)), (0.03, color(0.5)), (0.09, color(0.2))];
    for samples in [1, 4] {
        let renderer = Renderer::with_output(&gpu, Output { samples, ..Output::default() }).expect("a renderer");
        for (layers, name) in [(&one[..], "one"), (&several[..], "several")] {
            let shot = view(64, 3.0);
            let sorted = shoot(&renderer, stack(layers), material(Blending::Sorted), &shot);
            assert!(pixel(&sorted, 32, 32) != [0x80, 0x80, 0x80, 255], "nothing is drawn");
            for blending in LAYERED {
                let found = shoot(&renderer, stack(layers), material(blending), &shot);
                let off = most_off(&sorted, &found);
                assert!(off <= 1, "{blending:?}, {samples} samples, {name}: {off}");
            }
            // Behind nothing, too.
            let shot = Shot { background: Background::Transparent, ..shot };
            let sorted = shoot(&renderer, stack(layers), material(Blending::Sorted), &shot);
            let found = shoot(&renderer, stack(layers), material(Blending::Weighted), &shot);
            assert!(most_off(&sorted, &found) <= 2, "{name}: {}", most_off(&sorted, &found));
        }
    }
}

/// Many layers of hair colours.
fn hair() -> Vec<(f32, [f32; 4])> {
    let noise = |i: u32, k: u32| (i * 7 + k * 13) % 11;
    (0..12u32)
        .map(|i| {
            let shade = 0.5 + noise(i, 1) as f32 / 11.0;
            let alpha = 0.3 + 0.5 * noise(i, 2) as f32 / 11.0;
            ((i as f32 - 5.5) * 0.02, [0.35 * shade, 0.22 * shade, 0.12 * shade, alpha])
        })
        .collect()
}

#[test]
fn no_order_of_triangles_shows_in_weighted_layers() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let shot = view(64, 3.0);
        let shoot = |of, blending| shoot(renderer, of, material(blending), &shot);
        let [there, back] = [stack(&hair()), reversed(stack(&hair()))].map(|of| shoot(of, Blending::Weighted));
        // Sums of halves are rounded in the order in which they are added.
        let off = most_off(&there, &back);
        // From below upwards is far before near here.
        let sorted = shoot(stack(&hair()), Blending::Sorted);
        let wrong = shoot(reversed(stack(&hair())), Blending::Sorted);
        println!(
            "weighted there and back: {off}/255; against far before near: {}/255, near before far: {}/255",
            most_off(&there, &sorted),
            most_off(&wrong, &sorted)
        );
        assert!(off <= 1, "{off}");
        assert!(most_off(&there, &sorted) < most_off(&wrong, &sorted), "no better than the wrong order");
    });
}

#[test]
fn the_opaque_part_is_the_same_in_any_order() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let shot = view(64, 3.0);
        // What lies below the opaque layers is hidden by them.
        let layers = [
            (0.1, [0.9, 0.1, 0.1, 1.0]),
            (-0.1, [0.1, 0.9, 0.1, 0.5]),
            (0.0, [0.1, 0.1, 0.9, 0.95]),
            (-0.2, [0.9, 0.9, 0.1, 1.0]),
        ];
        for blending in LAYERED {
            let all: Vec<Image> = [[0, 1, 2, 3], [3, 2, 1, 0], [1, 3, 0, 2]]
                .map(|order| shoot(renderer, stack(&order.map(|i| layers[i])), material(blending), &shot))
                .into();
            assert!(all.iter().all(|image| image.pixels == all[0].pixels), "{blending:?}");
            let found = pixel(&all[0], 32, 32);
            assert!(
                most_off_of(found, [243, 89, 89, 255]) <= 1,
                "{blending:?}: the uppermost is opaque, not {found:?}"
            );
            // Without that pass, the order shows or colours mix.
            let mut bare = material(blending);
            bare.alpha.opaque_pass = false;
            let bare = shoot(renderer, stack(&layers), bare, &shot);
            assert!(most_off_of(pixel(&bare, 32, 32), [243, 89, 89, 255]) > 4, "{blending:?}");
        }
    });
}

#[test]
fn back_faces_lie_below_front_faces() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let shot = Shot { background: Background::Color(Srgb([0; 3])), ..view(64, 3.0) };
        // The front face comes first in the file, the back face lies below it.
        let mut both = stack(&[(0.1, [1.0, 0.0, 0.0, 0.5]), (-0.1, [0.0, 1.0, 0.0, 0.5])]);
        both.indices[6..].chunks_exact_mut(3).for_each(|t| t.swap(1, 2));
        let at = |with: Material| pixel(&shoot(renderer, both.clone(), with, &shot), 32, 32);
        let near = |found: [u8; 4], expected: [f32; 3]| {
            found[..3].iter().zip(LinearRgb(expected).to_srgb().0).all(|(a, b)| a.abs_diff(b) <= 2)
        };
        assert!(near(at(material(Blending::ThreePass)), [0.5, 0.25, 0.0]), "{:?}", at(material(Blending::ThreePass)));
        assert!(near(at(material(Blending::DoubleLayer)), [0.25, 0.5, 0.0]), "as the file has them");
        // Both sides are drawn whether or not the material has two.
        let single = Material { double_sided: false, ..material(Blending::ThreePass) };
        assert!(near(at(single), [0.5, 0.25, 0.0]));
        // Front faces that write depth hide what comes after them.
        let fronts = stack(&[(0.1, [1.0, 0.0, 0.0, 0.5]), (-0.1, [0.0, 1.0, 0.0, 0.5])]);
        let mut writing = material(Blending::ThreePass);
        writing.alpha.front_writes_depth = true;
        let found = pixel(&shoot(renderer, fronts, writing, &shot), 32, 32);
        assert!(near(found, [0.5, 0.0, 0.0]), "{found:?}");
    });
}

/// An eye under hair whose middle is farther away: large parts have no one distance.
#[test]
fn layers_lie_over_what_is_sorted_unless_their_queue_says_otherwise() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let shot = Shot { background: Background::Color(Srgb([0; 3])), ..view(64, 3.0) };
        for blending in [Blending::ThreePass, Blending::DoubleLayer] {
            let at = |queue_offset: i32| {
                let eye = stack(&[(0.0, [0.0, 1.0, 0.0, 0.5])]);
                // A strand before the eye, and many behind it.
                let strands = stack(&[(0.05, [1.0, 0.0, 0.0, 0.5]), (-0.9, [1.0, 0.0, 0.0, 0.0])]);
                let mut hair = material(blending);
                hair.alpha.queue_offset = queue_offset;
                let of = scene(vec![(strands, hair), (eye, material(Blending::Sorted))]);
                pixel(&renderer.shoot(&mut staged(renderer.upload(&of)), &shot).expect("a picture"), 32, 32)
            };
            assert!(at(0)[0] > at(0)[1], "{blending:?}: the strand is above: {:?}", at(0));
            assert!(at(-1)[0] < at(-1)[1], "{blending:?}: the eye is above: {:?}", at(-1));
        }
    });
}

#[test]
fn what_is_hardly_there_is_left_out() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let shot = view(64, 3.0);
        for blending in LAYERED {
            for (least_alpha, is_there) in [(0.0, true), (0.1, false)] {
                let mut with = material(blending);
                with.alpha.least_alpha = least_alpha;
                let image = shoot(renderer, stack(&[(0.0, [1.0, 0.0, 0.0, 0.08])]), with, &shot);
                assert_eq!(pixel(&image, 32, 32)[..3] != [0x80; 3], is_there, "{blending:?} at {least_alpha}");
            }
        }
    });
}

/// A card over a floor, both of one character.
fn card_and_floor(blending: Blending) -> Scene {
    let floor =
        Material { cast_shadow: Some(CastShadow { casts: false, ..CastShadow::default() }), ..Material::default() };
    let casts = Some(CastShadow::default());
    let card = Material { cast_shadow: casts, ..material(blending) };
    let mut scene = scene(vec![(square([0.0, 0.0], 0.8, 0.0), floor), (square([0.0, 0.0], 0.15, 0.4), card)]);
    scene.self_shadow = Some(SelfShadow::default());
    scene
}

#[test]
fn the_opaque_part_casts() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let shade = |blending: Blending, opaque_pass: bool| {
            let mut scene = card_and_floor(blending);
            scene.materials[1].alpha.opaque_pass = opaque_pass;
            let mut shot = view(96, 4.0);
            shot.lights.directional.to_light = Vec3::new(0.6, 0.0, 0.8);
            let image = renderer.shoot(&mut staged(renderer.upload(&scene)), &shot).expect("a picture");
            // Where the card's shadow falls: 0.3 m to the left of it.
            pixel(&image, 34, 48)[0]
        };
        let lit = shade(Blending::Sorted, true);
        for blending in LAYERED {
            let dark = shade(blending, true);
            assert!(dark + 30 < lit, "{blending:?}: {dark} and {lit}");
            assert_eq!(shade(blending, false), lit, "{blending:?} without an opaque part");
        }
    });
}

#[test]
fn several_actors_and_finished_pictures_show_the_same_layers() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        for blending in LAYERED {
            let shot = Shot { size: [128, 64], ..view(64, 4.0) };
            let character = renderer.upload(&scene(vec![(stack(&hair()), material(blending))])).expect("an upload");
            let at = |places: &[f32]| {
                let mut stage = Stage::of(places.iter().map(|x| Actor::new(&character).at([*x, 0.0, 0.0], 0.0)));
                stage.lights = shot.lights.clone();
                stage
            };
            let alone = [-0.6, 0.6].map(|x| renderer.render(&mut at(&[x]), &shot.view()).expect("a picture"));
            let mut both = at(&[-0.6, 0.6]);
            let together = renderer.render(&mut both, &shot.view()).expect("a picture");
            let half = |image: &Image, right: bool| {
                let rows = image.pixels.chunks_exact(128 * 4);
                rows.flat_map(|row| row[if right { 256..512 } else { 0..256 }].to_vec()).collect::<Vec<u8>>()
            };
            for right in [false, true] {
                let (a, b) = (half(&alone[usize::from(right)], right), half(&together, right));
                let off = a.iter().zip(&b).map(|(a, b)| a.abs_diff(*b)).max();
                assert!(off <= Some(1), "{blending:?}: {off:?}");
            }
            both.post = Some(Post { bloom: None, exposure_ev: 0.0, tone: ToneCurve::None, antialias: Antialias::None });
            let finished = renderer.render(&mut both, &shot.view()).expect("a picture");
            assert!(most_off(&together, &finished) <= 2, "{blending:?}: {}", most_off(&together, &finished));
            // Its own layers are not before an actor's eyes where its file says nothing of heads; the other's are whole.
            let first = View { first_person: Some(0), ..shot.view() };
            assert!(renderer.render(&mut both, &first).is_ok());
        }
        // The nearer one's layers count for more.
        let of = |color: [f32; 4]| scene(vec![(stack(&[(0.0, color)]), material(Blending::Weighted))]);
        let [red, green] =
            [[1.0, 0.0, 0.0, 0.6], [0.0, 1.0, 0.0, 0.6]].map(|c| renderer.upload(&of(c)).expect("an upload"));
        let mut stage =
            Stage::of([Actor::new(&green).at([0.0, 0.0, -1.0], 0.0), Actor::new(&red).at([0.0, 0.0, 1.0], 0.0)]);
        let shot = Shot { background: Background::Color(Srgb([0; 3])), ..view(64, 3.0) };
        let [r, g, ..] = pixel(&renderer.render(&mut stage, &shot.view()).expect("a picture"), 32, 32);
        assert!(r > 220 && g < 40, "{r} {g}");
    });
}

#[test]
fn numbers_of_layers_may_change_and_their_passes_may_not() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let with = material(Blending::ThreePass);
        let mut stage = staged(renderer.upload(&scene(vec![(stack(&hair()), with.clone())])));
        let shot = view(64, 3.0);
        let before = renderer.shoot(&mut stage, &shot).expect("a picture");
        let mut other = with.clone();
        other.alpha.opaque_cutoff = 0.5;
        stage.actors[0].materials.insert(0, other);
        let after = renderer.shoot(&mut stage, &shot).expect("a picture");
        assert!(most_off(&before, &after) > 4);
        let mut other = with.clone();
        other.alpha.blending = Blending::Weighted;
        stage.actors[0].materials.insert(0, other);
        let error = renderer.shoot(&mut stage, &shot).expect_err("another mode").to_string();
        assert!(error.contains("alpha mode, draw order"), "{error}");
        let mut wrong = with;
        wrong.alpha.opaque_cutoff = f32::NAN;
        let error = renderer.upload(&scene(vec![(stack(&hair()), wrong)])).expect_err("no number").to_string();
        assert!(error.contains("opaque_cutoff"), "{error}");
    });
}

/// Hair with a head under it, from the folder of real models.
fn real(name: &str, blending: Blending) -> Option<Scene> {
    let default = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/real");
    let path = std::env::var_os("HIKAGE_REAL").map_or(default, PathBuf::from).join("models").join(name);
    if !path.is_file() {
        eprintln!("NOT TESTED: no {}; set HIKAGE_REAL to the folder above", path.display());
        return None;
    }
    let mut scene = hikage::import::load(&path).expect("loads");
    for material in &mut scene.materials {
        material.alpha.blending = blending;
        material.shading = Shading::Unlit;
    }
    Some(scene)
}

/// The triangles of its hair far before near, as seen from there.
fn sorted_from(scene: &mut Scene, eye: Vec3) {
    for p in scene.meshes.iter_mut().flat_map(|m| &mut m.primitives) {
        let middle = |t: &[u32]| t.iter().map(|i| Vec3::from(p.positions[*i as usize])).sum::<Vec3>() / 3.0;
        let mut triangles: Vec<&[u32]> = p.indices.chunks_exact(3).collect();
        triangles.sort_by(|a, b| middle(b).distance_squared(eye).total_cmp(&middle(a).distance_squared(eye)));
        p.indices = triangles.concat();
    }
}

/// How much more a pixel changes from degree to degree than it would with all triangles in their order, as the camera goes round.
/// What is opaque goes by depth in the reference, too, for triangles that cross have no order; the rest by its triangles.
#[test]
fn layers_of_hair_do_not_pop_as_the_camera_goes_round() {
    const STEPS: usize = 40;
    let gpu = gpu();
    for name in ["hair_mh_short01.glb", "hair_elv_adrienne.glb", "hair_mh_braid01.glb"] {
        let Some(sorted) = real(name, Blending::DoubleLayer) else { return };
        let at = |i: usize| {
            let mut shot = Shot::framed(&sorted, Framing::Full, 0.0, [96, 96]);
            let turn = Quat::from_rotation_y((i as f32 - 20.0).to_radians());
            shot.camera.eye = shot.camera.target + turn * (shot.camera.eye - shot.camera.target);
            shot.background = Background::Color(Srgb([0x80; 3]));
            shot
        };
        let steps = |a: &Image, b: &Image| -> Vec<i32> {
            a.pixels.iter().zip(&b.pixels).map(|(a, b)| i32::from(a.abs_diff(*b))).collect()
        };
        with_renderer(&gpu, |renderer| {
            let of_reference = |i: usize| {
                let mut scene = sorted.clone();
                sorted_from(&mut scene, at(i).camera.eye);
                renderer.shoot(&mut staged(renderer.upload(&scene)), &at(i)).expect("a picture")
            };
            let reference: Vec<Image> = (0..STEPS).map(of_reference).collect();
            let mut found = Vec::new();
            for blending in [Blending::Sorted, Blending::ThreePass, Blending::DoubleLayer, Blending::Weighted] {
                let mut stage = staged(renderer.upload(&real(name, blending).expect("a model")));
                let images: Vec<Image> =
                    (0..STEPS).map(|i| renderer.shoot(&mut stage, &at(i)).expect("a picture")).collect();
                let errors = images.iter().zip(&reference).map(|(a, b)| steps(a, b));
                let error = errors.map(|e| e.iter().sum::<i32>() as f32 / e.len() as f32 / 255.0).sum::<f32>();
                let more = images.windows(2).zip(reference.windows(2)).flat_map(|(own, reference)| {
                    let (own, of_reference) = (steps(&own[0], &own[1]), steps(&reference[0], &reference[1]));
                    own.into_iter().zip(of_reference).map(|(a, b)| a - b).collect::<Vec<_>>()
                });
                let more: Vec<i32> = more.collect();
                let worst = more.iter().max().copied().unwrap_or(0) as f32 / 255.0;
                found.push((error / STEPS as f32, more.iter().filter(|m| **m > 25).count()));
                let (error, pops) = found[found.len() - 1];
                println!("{name}, {blending:?}: error {error:.4}, {pops} steps of more than 0.1, largest {worst:.3}");
            }
            for (error, pops) in &found[1..] {
                assert!(*pops == 0 && *error < found[0].0, "{name}: {found:?}");
            }
        });
    }
}
