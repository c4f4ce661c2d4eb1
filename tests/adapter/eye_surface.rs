//! What shows on eyes behind a cornea: painted lights, the shade of lids, no step as view and light turn; and what is no eye.

use glam::{DVec2, Vec3};
use hikage::eye::EyeDimensions;
use hikage::material::{CatchLight, Eye, FacePaint, Material, Skin};
use hikage::scene::{Primitive, Scene};
use hikage::{Channel, Renderer};

use super::skin::{renderer, shoot};
use crate::eyeballs::{
    ball, colors, difference, eyeball, eyes, from_yaw, lids, linear, matt, open_ball, painted, rays, seen, shown,
    with_iris,
};
use crate::support::{Lent, Shoot, Shot, gpu, render, square, staged, texture, with_renderer};

/// The iris and a little of the white, mm to either side; the ball.
const IRIS: f32 = 7.0;
const ALL: f32 = 14.0;
const FRONT: [f32; 2] = [0.0; 2];

/// A painted light alone, on a black eye: by pixels, how much, and the place on the iris.
fn catch(gpu: &Lent, key_catch: CatchLight, shot: &Shot) -> Vec<(f32, DVec2)> {
    let eye = Eye { iris_color: [0.0; 3], key_catch, ..matt() };
    let mut of = eyeball(eye);
    of.materials[0].base = painted(0.0);
    let light = linear(&render(gpu, &of, shot));
    let places = linear(&render(gpu, &of, &shown(shot, "eye-place")));
    let lit = light.iter().zip(places).filter(|(l, _)| l.y > 0.01);
    lit.map(|(l, p)| {
        assert!(p.z < 0.5, "{l} beside the iris");
        (l.y, p.truncate().as_dvec2() * 2.0 - 1.0)
    })
    .collect()
}

fn middle(of: &[(f32, DVec2)]) -> DVec2 {
    of.iter().map(|(l, q)| *q * f64::from(*l)).sum::<DVec2>() / of.iter().map(|(l, _)| f64::from(*l)).sum::<f64>()
}

#[test]
fn painted_lights_keep_their_size_and_stay_on_the_iris() {
    let gpu = gpu();
    for key_catch in [Eye::portrait().key_catch, Eye::portrait().fill_catch] {
        let key_catch = CatchLight { strength: 0.8, ..key_catch };
        let areas: Vec<f32> = (-4..=4)
            .map(|i| {
                catch(&gpu, key_catch, &seen(128, IRIS, [10.0 * i as f32, 0.0], Vec3::Z)).iter().map(|(l, _)| l).sum()
            })
            .collect();
        let (least, most) = areas.iter().fold((f32::MAX, 0.0f32), |(a, b), x| (a.min(*x), b.max(*x)));
        println!("{areas:?}");
        assert!(least > 20.0 && most < 1.15 * least, "{areas:?}");
    }
}

#[test]
fn painted_lights_follow_the_light_as_far_as_they_are_told() {
    let gpu = gpu();
    let at = |follow: f32, degrees: f32| {
        let light = CatchLight { strength: 0.8, follow, ..CatchLight::default() };
        middle(&catch(&gpu, light, &seen(96, IRIS, FRONT, from_yaw(degrees))))
    };
    let still = [-40.0, 40.0].map(|degrees| at(0.0, degrees));
    assert!(still[0].distance(still[1]) < 0.01 && still[0].x < -0.2 && still[0].y > 0.2, "{still:?}");
    let moved = [-40.0, 0.0, 40.0].map(|degrees| at(1.0, degrees));
    println!("{moved:?}");
    // A mirrored light stands half way between the viewer and the light: 7.8 / 5.9 sin 20 degrees, seen through the cornea at less.
    assert!(moved[1].length() < 0.03 && (0.3..0.5).contains(&moved[2].x) && moved[2].y.abs() < 0.03, "{moved:?}");
    assert!((moved[0].x + moved[2].x).abs() < 0.03, "{moved:?}");
}

/// Between two edges, in radians over the ball.
const EDGES: [f32; 2] = [-0.28, 0.31];

fn with_lids(eye: Eye) -> Scene {
    let mut of = eyeball(eye);
    let shell = lids(|l, e| l.abs() < 0.9 && (EDGES[0]..EDGES[1]).contains(&e));
    of.materials.push(Material { base: painted(0.0), ..Material::default() });
    of.meshes[0].primitives.push(Primitive { material: 1, ..shell });
    of
}

/// A row of the ball at an elevation, radians.
fn row(side: u32, elevation: f32) -> usize {
    (side as f32 * 0.5 * (1.0 - 12.0 * elevation.sin() / ALL)) as usize
}

#[test]
fn lids_shade_what_lies_under_them() {
    let gpu = gpu();
    let shot = shown(&seen(128, ALL, FRONT, Vec3::Z), "eye-lids");
    let open = |of: &Scene| linear(&render(&gpu, of, &shot));
    let bare = open(&eyeball(matt()));
    assert!(bare.iter().zip(rays(&shot)).all(|(c, ray)| c.y == 1.0 || !ray.is_on_ball()), "shade without lids");
    let found = open(&with_lids(Eye { lid_shadow: 0.4, lash_shadow: 0.25, ..matt() }));
    let at = |elevation: f32| found[row(128, elevation) * 128 + 64].y;
    let [upper, middle, lower] = [EDGES[1] - 0.06, 0.0, EDGES[0] + 0.06].map(at);
    println!("{upper} {middle} {lower}");
    // At its edge the upper lid leaves 0.6, lashes 0.75 of that; the lower one 0.8.
    assert!((0.4..0.55).contains(&upper) && middle > 0.9 && (0.75..0.9).contains(&lower), "{upper} {middle} {lower}");
    let column: Vec<f32> = (row(128, EDGES[1] - 0.05)..row(128, 0.0)).map(|y| found[y * 128 + 64].y).collect();
    assert!(column.windows(2).all(|w| w[0] <= w[1]), "{column:?}");
    // What the lids leave of the light is what the picture has.
    let [with, without] = [0.4, 0.0].map(|lid_shadow| {
        let of = with_lids(Eye { lid_shadow, lash_shadow: 0.0, ..matt() });
        linear(&render(&gpu, &of, &Shot { channel: Channel::Final, ..shot.clone() }))
    });
    let under = row(128, EDGES[1] - 0.06) * 128 + 64;
    assert!(with[under].y < 0.95 * without[under].y, "{} {}", with[under], without[under]);
}

#[test]
fn the_lower_lid_has_a_wet_line() {
    let gpu = gpu();
    let brighter = |wet_line_rad: f32| {
        let mut sum = vec![0.0; 128];
        // Half way between the view and a light far above, what is turned upwards mirrors.
        let shot = seen(128, ALL, FRONT, Vec3::new(0.0, 0.95, 0.3));
        let of = |wet_line_rad| with_lids(Eye { wet_line_rad, scatter: 0.0, ..Eye::default() });
        let [wet, dry] = [wet_line_rad, 0.0].map(|w| linear(&render(&gpu, &of(w), &shot)));
        wet.iter().zip(&dry).enumerate().for_each(|(i, (wet, dry))| sum[i / 128] += wet.y - dry.y);
        sum
    };
    let sums = brighter(0.12);
    let (lower, middle) = (row(128, EDGES[0] + 0.02), row(128, 0.0));
    println!("rows {middle} to {lower}: {:?}", &sums[middle..=lower + 2]);
    let near = row(128, EDGES[0] + 0.16);
    assert!(sums[near..].iter().sum::<f32>() > 2.0, "{sums:?}");
    assert!(sums[..near].iter().all(|s| s.abs() < 0.05), "{sums:?}");
}

/// Pictures of one eye, each a degree on from the last: how far each differs from the one before.
fn steps(renderer: &Renderer, of: &Scene, shots: impl Iterator<Item = Shot>) -> Vec<[f32; 2]> {
    let mut stage = staged(renderer.upload(of));
    let pictures: Vec<_> = shots.map(|shot| renderer.shoot(&mut stage, &shot).expect("a picture")).collect();
    pictures.windows(2).map(|pair| difference(&pair[0], &pair[1])).collect()
}

/// A degree of the view moves the iris by 0.2 mm, two thirds of a pixel, and its edge is sharp; a degree of the light moves what is
/// mirrored. What appears or goes at once would stand out from the steps beside it.
#[test]
fn nothing_jumps_as_view_and_light_turn() {
    let gpu = gpu();
    let of = with_iris(eyeball(Eye::portrait()), colors);
    let [view, lit] = with_renderer(&gpu, |renderer| {
        let views = (-60..=60).map(|yaw| seen(96, ALL, [yaw as f32, 5.0], Vec3::new(-0.4, 0.5, 0.8)));
        let lights = (-60..=60).map(|yaw| seen(96, ALL, [20.0, 5.0], from_yaw(yaw as f32) + Vec3::Y * 0.3));
        [steps(renderer, &of, views), steps(renderer, &of, lights)]
    });
    for (name, steps, bounds) in [("view", view, [3.0, 75.0, 0.35]), ("light", lit, [1.5, 20.0, 0.35])] {
        let most = |i: usize| steps.iter().map(|s| s[i]).fold(0.0f32, f32::max);
        let beside = steps.windows(3).map(|w| (w[1][0] - 0.5 * (w[0][0] + w[2][0])).abs()).fold(0.0f32, f32::max);
        let found = [most(0), most(1), beside];
        println!("{name}: {found:?}");
        assert!(found.iter().zip(bounds).all(|(found, bound)| *found < bound), "{name}: {found:?}");
    }
}

#[test]
fn eyes_are_finite_and_the_same_each_time() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    for pupil_mm in [0.2, 10.0] {
        let of = with_iris(eyeball(Eye { pupil_mm, veins: 1.0, ..Eye::portrait() }), colors);
        for yaw in [0.0, 85.0, 90.0, 95.0, 180.0] {
            for to_light in [Vec3::Z, Vec3::NEG_Z, Vec3::new(1.0, 0.2, 0.0)] {
                let shot = seen(64, ALL, [yaw, 0.0], to_light);
                let draw = || shoot(&renderer, &gpu, &of, &shot).texels;
                let (first, again) = (draw(), draw());
                assert!(first.iter().filter(|t| t[3] == 1.0).count() > 1500);
                // Mirrored light of the sharp cornea is strong and a number.
                assert!(first.iter().flatten().all(|x| (0.0..6e4).contains(x)), "from {yaw}, lit from {to_light}");
                let bits = |of: &[[f32; 4]]| of.as_flattened().iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                assert!(bits(&first) == bits(&again), "from {yaw}, lit from {to_light}");
            }
        }
    }
}

/// A ball whose picture runs round its axis, as maps of the earth do.
fn wrapped() -> Scene {
    let mut part = open_ball();
    for (uv, [x, y, z]) in part.uvs[0].iter_mut().zip(&part.positions) {
        *uv = [y.atan2(*x) / std::f32::consts::TAU + 0.5, x.hypot(*y).atan2(*z) / std::f32::consts::PI];
    }
    let mut of = eyes(vec![part], matt());
    of.materials[0].base.texture = Some(texture(&mut of, 8, 8, |x, y| [x as u8, y as u8, 0, 255]));
    of
}

fn row_of(count: usize) -> Scene {
    let part = |i: usize| {
        let mut part = open_ball();
        part.positions.iter_mut().for_each(|p| p[0] += 0.04 * i as f32);
        part
    };
    eyes((0..count).map(part).collect(), matt())
}

#[test]
fn what_is_no_eye_is_refused_by_name() {
    let gpu = gpu();
    let human = EyeDimensions::default();
    let measured = |dimensions| eyes(vec![open_ball()], Eye { dimensions, ..matt() });
    let beside = |more: fn(&mut Material)| {
        let mut of = eyes(vec![open_ball()], matt());
        more(&mut of.materials[0]);
        texture(&mut of, 1, 1, |_, _| [255; 4]);
        of
    };
    let flat = square([0.0; 2], 0.01, 0.0);
    with_renderer(&gpu, |renderer| {
        renderer.upload(&row_of(4)).expect("as many as there may be");
        for (of, words) in [
            (measured(EyeDimensions { limbus_radius_mm: 8.0, ..human }), ["eye.dimensions", "cornea_radius_mm, 7.8"]),
            (measured(EyeDimensions { cornea_radius_mm: 13.0, ..human }), ["eye.dimensions", "eyeball_radius_mm, 12"]),
            (measured(EyeDimensions { ior: 0.9, ..human }), ["eye.dimensions.ior", "1..3"]),
            (eyes(vec![ball()], matt()), ["eye", "without a front"]),
            (eyes(vec![flat], matt()), ["eye", "is flat"]),
            (row_of(5), ["eye", "5 eyes; there may be 4"]),
            (wrapped(), ["eye.iris_map", "does not lie evenly"]),
            (beside(|m| m.skin = Some(Skin::default())), ["skin", "material of their own"]),
            (beside(|m| m.face_paint = Some(FacePaint::default())), ["face_paint", "material of their own"]),
        ] {
            let message = renderer.upload(&of).expect_err(words[1]).to_string();
            println!("{message}");
            assert!(message.contains("\"Eyes\"") && !message.contains('\n'), "{message}");
            assert!(words.iter().all(|word| message.contains(word)), "{message}");
        }
    });
}
