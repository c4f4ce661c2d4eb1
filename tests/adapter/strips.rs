//! Strips of hair: their order, what is known along them, and that expressions move them.

use hikage::Channel;
use hikage::color::{LinearRgb, Srgb};
use hikage::hair::StripSort;
use hikage::material::{Alpha, AlphaMode, Material, Outline, OutlineWidth, Shading, Strips};
use hikage::scene::{Image, MorphTarget, Primitive, Scene};
use hikage::{Background, Renderer};

use crate::support::{Shoot, Shot, gpu, pixel, scene, sphere, staged, texture, view, with_renderer};

/// Cards in one primitive, each with rows of its own texture column: left edge, top, depth; 0.4 wide and 0.8 long.
fn cards(of: &[[f32; 3]]) -> Primitive {
    let mut all = Primitive { uvs: vec![Vec::new()], ..Primitive::default() };
    for (n, [left, top, z]) in of.iter().enumerate() {
        for row in 0..=8u32 {
            let t = row as f32 / 8.0;
            for side in [0.0, 1.0f32] {
                all.positions.push([left + 0.4 * side, top - 0.8 * t, *z]);
                all.normals.push([0.0, 0.0, 1.0]);
                all.outline_normals.push([0.0, 0.0, 1.0]);
                all.uvs[0].push([(n as f32 + 0.25 + 0.5 * side) / of.len() as f32, t]);
            }
            if row > 0 {
                let at = all.positions.len() as u32 - 4;
                all.indices.extend([at, at + 2, at + 1, at + 1, at + 2, at + 3]);
            }
        }
    }
    all
}

fn material(strips: Option<Strips>, mode: AlphaMode) -> Material {
    Material { alpha: Alpha { mode, ..Alpha::default() }, shading: Shading::Unlit, strips, ..Material::default() }
}

/// Cards, each of another colour, seen through by half.
fn colored(of: &[[f32; 3]], colors: &'static [[u8; 3]], strips: Option<Strips>) -> Scene {
    let mut scene = scene(vec![(cards(of), material(strips, AlphaMode::Blend))]);
    let count = colors.len() as u32;
    let map = texture(&mut scene, count * 8, 1, |x, _| {
        let [r, g, b] = colors[(x / 8) as usize];
        [r, g, b, 128]
    });
    scene.materials[0].base.texture = Some(map);
    scene
}

fn shoot(renderer: &Renderer, scene: &Scene, shot: &Shot) -> Image {
    renderer.shoot(&mut staged(renderer.upload(scene)), shot).expect("a picture")
}

fn dark() -> Shot {
    Shot { background: Background::Color(Srgb([0; 3])), ..view(96, 3.0) }
}

#[test]
fn strips_are_drawn_in_their_order() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        // The higher card stands first in the file, in front of nothing: both lie in one plane.
        let two = [[-0.2, 0.6, 0.0], [-0.2, 0.2, 0.0]];
        let at = |sort: Option<StripSort>| {
            let strips = sort.map(|sort| Strips { sort, ..Strips::default() });
            pixel(&shoot(renderer, &colored(&two, &[[255, 0, 0], [0, 255, 0]], strips), &dark()), 48, 48)
        };
        let above = |found: [u8; 4], upper: usize| found[upper] > 180 && found[1 - upper] < 150;
        assert!(above(at(None), 1), "the last one of the file is above: {:?}", at(None));
        assert!(above(at(Some(StripSort::None)), 1));
        assert!(above(at(Some(StripSort::Height)), 0), "the highest is above: {:?}", at(Some(StripSort::Height)));
        // Away from the middle, about the head that such a file has.
        let deep = [[-0.2, 0.4, 0.5], [-0.2, 0.4, 0.0], [-0.2, 0.4, -0.02]];
        let strips = |sort| Some(Strips { sort, ..Strips::default() });
        let colors: &[[u8; 3]] = &[[255, 0, 0], [0, 255, 0], [0, 0, 255]];
        let radial = pixel(&shoot(renderer, &colored(&deep, colors, strips(StripSort::Radial)), &dark()), 48, 40);
        assert!(radial[0] > 180, "the outermost is above: {radial:?}");
    });
}

#[test]
fn channels_show_what_is_known_along_strips() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let strips = Strips { occlusion: [0.5, 1.0, 2.0], grayness: 0.25, ..Strips::default() };
        let two = [[-0.5, 0.4, 0.0], [0.1, 0.1, 0.0]];
        let scene = scene(vec![(cards(&two), material(Some(strips), AlphaMode::Opaque))]);
        let mut stage = staged(renderer.upload(&scene));
        let mut channel =
            |name| renderer.shoot(&mut stage, &Shot { channel: Channel::Look(name), ..dark() }).expect("a channel");
        let (colors, order) = (channel("strips"), channel("strip-order"));
        let (occlusion, grayness) = (channel("strip-occlusion"), channel("strip-grayness"));
        // Pixels of the first card from its top to its bottom, and one of the second.
        let (left, right) = (30, 66);
        let lit: Vec<u32> = (0..96).filter(|y| pixel(&colors, left, *y)[..3] != [0; 3]).collect();
        let (top, bottom) = (lit[0], lit[lit.len() - 1]);
        let linear = |c: u8| hikage::color::linear_from_srgb(f32::from(c) / 255.0);
        for y in top + 1..bottom {
            let t = (y as f32 + 0.5 - top as f32) / (bottom + 1 - top) as f32;
            let found = pixel(&occlusion, left, y).map(linear);
            for (found, k) in found.iter().zip(strips.occlusion) {
                let expected = (-k * (1.0 - t)).exp();
                assert!((found - expected).abs() < 0.03, "row {y}, k {k}: {found}, expected {expected}");
            }
            assert!((linear(pixel(&grayness, left, y)[0]) - 0.25).abs() < 0.01);
            assert_eq!(pixel(&colors, left, y), pixel(&colors, left, top + 1), "one strip, one colour");
        }
        assert_ne!(pixel(&colors, left, 48), pixel(&colors, right, 48));
        assert_eq!((pixel(&order, right, 48)[0], pixel(&order, left, 48)[0]), (0, 255), "the lower one first");
        // Without strips there is nothing to show.
        let mut bare = scene.clone();
        bare.materials[0] = Material::default();
        let nothing = shoot(renderer, &bare, &Shot { channel: Channel::Look("strips"), ..dark() });
        assert!(nothing.pixels.chunks(4).all(|p| p[..3] == [0; 3]));
        // Numbers may change on an actor.
        let mut stage = staged(renderer.upload(&scene));
        let mut other = scene.materials[0].clone();
        other.strips = Some(Strips { grayness: 0.75, ..strips });
        stage.actors[0].materials.insert(0, other.clone());
        let shot = Shot { channel: Channel::Look("strip-grayness"), ..dark() };
        let found = renderer.shoot(&mut stage, &shot).expect("a channel");
        assert!((linear(pixel(&found, left, 48)[0]) - 0.75).abs() < 0.01);
        other.strips = Some(Strips { sort: StripSort::None, ..strips });
        stage.actors[0].materials.insert(0, other);
        let error = renderer.shoot(&mut stage, &shot).expect_err("another order").to_string();
        assert!(error.contains("draw order"), "{error}");
    });
}

#[test]
fn colours_of_a_file_are_kept_and_colour_nothing() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let plain = scene(vec![(cards(&[[-0.2, 0.4, 0.0]]), material(None, AlphaMode::Opaque))]);
        let mut own = plain.clone();
        own.meshes[0].primitives[0].colors = vec![[0.2, 0.4, 0.6, 0.8]; 18];
        assert_ne!(shoot(renderer, &plain, &dark()).pixels, shoot(renderer, &own, &dark()).pixels, "they colour it");
        own.materials[0].strips = Some(Strips::default());
        assert_eq!(shoot(renderer, &plain, &dark()).pixels, shoot(renderer, &own, &dark()).pixels);
        let shown = |name| pixel(&shoot(renderer, &own, &Shot { channel: Channel::Look(name), ..dark() }), 48, 48);
        let srgb = |c: [f32; 3]| LinearRgb(c).to_srgb().0;
        let near = |a: [u8; 4], b: [u8; 3]| a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 1);
        assert!(near(shown("strip-occlusion"), srgb([0.2, 0.4, 0.6])), "{:?}", shown("strip-occlusion"));
        assert!(near(shown("strip-grayness"), srgb([0.8; 3])), "{:?}", shown("strip-grayness"));
        assert_ne!(shown("strips")[..3], [0; 3]);
        // Neither does what is known along a strip, in any pass: cut, blended, in lines.
        for mode in [AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend] {
            let line =
                Outline { width: OutlineWidth::World { metres: 0.02 }, vertex_width: true, ..Outline::default() };
            let mut bare = plain.clone();
            bare.materials[0] = Material { outline: Some(line), ..material(None, mode) };
            let mut with = bare.clone();
            with.materials[0].strips = Some(Strips { sort: StripSort::None, ..Strips::default() });
            assert_eq!(shoot(renderer, &bare, &dark()).pixels, shoot(renderer, &with, &dark()).pixels, "{mode:?}");
        }
        // Parts keep their numbers.
        let mut several = scene(vec![
            (sphere(0.1, 8, 8), Material::default()),
            (cards(&[[-0.5, 0.4, 0.0], [0.1, 0.4, 0.0]]), material(Some(Strips::default()), AlphaMode::Opaque)),
        ]);
        let ids = |scene: &Scene| shoot(renderer, scene, &Shot { channel: Channel::PartId, ..dark() }).pixels;
        let with = ids(&several);
        several.materials[1].strips = None;
        assert_eq!(with, ids(&several));
    });
}

#[test]
fn expressions_move_strips() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let two = [[-0.2, 0.6, 0.0], [-0.2, 0.2, 0.0]];
        let mut scene = colored(&two, &[[255, 0, 0], [0, 255, 0]], Some(Strips::default()));
        // The second one's vertices move to the right.
        let morph = MorphTarget {
            vertices: (18..36).collect(),
            positions: vec![[0.5, 0.0, 0.0]; 18],
            normals: vec![[0.0; 3]; 18],
        };
        scene.meshes[0].primitives[0].morphs = vec![morph];
        scene.meshes[0].morph_names = vec!["aside".to_owned()];
        let picture = |weight: f32| {
            let mut stage = staged(renderer.upload(&scene));
            stage.actors[0].pose.morph_weights[0] = vec![weight];
            renderer.shoot(&mut stage, &dark()).expect("a picture")
        };
        let (rest, moved) = (picture(0.0), picture(1.0));
        let is = |p: [u8; 4], red: bool, green: bool| (p[0] > 100, p[1] > 100) == (red, green);
        let both = |x, y| [pixel(&rest, x, y), pixel(&moved, x, y)];
        let [at_rest, when_moved] = both(48, 74);
        assert!(is(at_rest, false, true) && is(when_moved, false, false), "it has left: {at_rest:?} {when_moved:?}");
        let [at_rest, when_moved] = both(85, 60);
        assert!(is(at_rest, false, false) && is(when_moved, false, true), "it is there: {at_rest:?} {when_moved:?}");
        assert!(is(pixel(&moved, 48, 40), true, false), "the other one stays");
    });
}

#[test]
fn what_has_no_strips_is_drawn_as_it_is() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        // A closed ball: its seam has the same places on both sides.
        let mut ball = sphere(0.4, 12, 24);
        for ring in 0..=12usize {
            ball.positions[ring * 25 + 24] = ball.positions[ring * 25];
            if ring == 0 || ring == 12 {
                (0..25).for_each(|s| ball.positions[ring * 25 + s] = [0.0, if ring == 0 { 0.4 } else { -0.4 }, 0.0]);
            }
        }
        let with = |strips| scene(vec![(ball.clone(), material(strips, AlphaMode::Opaque))]);
        let [bare, asked] = [None, Some(Strips::default())].map(|s| shoot(renderer, &with(s), &dark()));
        assert_eq!(bare.pixels, asked.pixels);
        let shot = Shot { channel: Channel::Look("strip-occlusion"), ..dark() };
        assert_eq!(pixel(&shoot(renderer, &with(Some(Strips::default())), &shot), 48, 48), [255; 4], "no occlusion");
        // Numbers out of their ranges.
        let wrong = Strips { occlusion: [1.0, -1.0, 2.0], ..Strips::default() };
        let error = renderer.upload(&with(Some(wrong))).expect_err("a negative strength").to_string();
        assert!(error.contains("strips.occlusion") && error.contains("-1"), "{error}");
    });
}
