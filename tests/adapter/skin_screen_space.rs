//! Light on skin that spreads over the picture: how far, and what keeps it from going on.

use glam::Vec3;
use hikage::material::{Material, Shading, Skin, SkinDiffuse};
use hikage::scene::{Primitive, Scene};
use hikage::skin::DiffusionProfile;

use super::skin::{card, colored, edge_response, grey, matt, renderer, seen, shoot, white};
use crate::support::{Shot, gpu, scene, square};

/// Those that spread the light of the picture.
const OVER_PICTURES: [SkinDiffuse; 2] = [SkinDiffuse::ScreenSpace, SkinDiffuse::ScreenSpaceDisc];

/// How far normals lean to make an exact edge of light: so little that both sides are seen alike.
const LEAN: f32 = 0.1;

/// A card from x to x, 40 mm high, on which light of [`leaning`] is 0 or 1.
fn lit(x: [f32; 2], z: f32, is_lit: bool) -> Primitive {
    let lean = if is_lit { LEAN } else { -LEAN };
    card(x, [-0.02, 0.02], z, Vec3::new(lean.sin(), 0.0, lean.cos()))
}

fn leaning(mut shot: Shot) -> Shot {
    let light = &mut shot.lights.directional;
    light.to_light = Vec3::new(LEAN.cos(), 0.0, LEAN.sin());
    light.intensity = 1.0 / (2.0 * LEAN).sin();
    shot
}

/// Half a plane in the dark, and half of it in light.
fn edge(skin: Skin) -> Scene {
    scene(vec![(lit([-0.03, 0.0], 0.0, false), white(skin)), (lit([0.0, 0.03], 0.0, true), white(skin))])
}

/// Where red that rises along a row passes a level, in texels.
fn passes(row: &[[f32; 4]], level: f32) -> f32 {
    let i = (1..row.len()).find(|i| row[*i][0] >= level).expect("it is passed");
    let (before, after) = (row[i - 1][0], row[i][0]);
    i as f32 - 1.0 + (level - before) / (after - before)
}

/// Nothing comes from what shines behind a border, and nothing is lost there.
#[test]
fn even_light_stays_even_when_it_spreads() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let shot = seen([128, 128], 0.2, 1.0, Vec3::Z);
    let at = |skin: Skin| {
        let wall = Material { shading: Shading::Unlit, ..Material::default() };
        let of = vec![(square([0.0; 2], 0.01, 0.0), colored(0.6, skin)), (square([0.0; 2], 0.05, -0.5), wall)];
        shoot(&renderer, &gpu, &scene(of), &shot)
    };
    for (taps, strength) in [(4, 0.0), (17, 1.0), (40, 1.0)] {
        let skin = |diffuse| Skin { taps, specular_strength: strength, ..matt(diffuse) };
        let lambert = at(skin(SkinDiffuse::Lambert));
        for diffuse in OVER_PICTURES {
            let spread = at(skin(diffuse));
            let off = |(a, b): (&[f32; 4], &[f32; 4])| (0..3).map(|c| (a[c] / b[c] - 1.0).abs()).fold(0.0, f32::max);
            let most = spread.texels.iter().zip(&lambert.texels).map(off).fold(0.0, f32::max);
            // Half floats keep 11 bits.
            assert!(most <= 1e-3, "{diffuse:?}, {taps} taps: {most}");
        }
        assert!(lambert.middle()[0] > 0.5 && lambert.at(0, 0)[0] == 1.0);
    }
}

/// To 0.04, by most taps. Along lines light comes from 80 places in cells, whose borders are exact and which have a few
/// hundredths each; by discs from 160, of which one alone is 0.006 of red, and several of blue, which goes less far than they lie.
#[test]
fn an_edge_of_light_is_that_of_the_profile() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let mut off = Vec::new();
    for diffuse in OVER_PICTURES {
        for (profile, up) in [(DiffusionProfile::default(), Vec3::Y), (grey(1.0), Vec3::Y), (grey(1.0), Vec3::X)] {
            let of = edge(Skin { profile, ..matt(diffuse) });
            let size = if up == Vec3::Y { [240, 16] } else { [16, 240] };
            let mut shot = leaning(seen(size, 0.05, 0.3, Vec3::Z));
            shot.camera.up = up;
            let picture = shoot(&renderer, &gpu, &of, &shot);
            let line: Vec<[f32; 4]> = match up {
                Vec3::Y => picture.row().to_vec(),
                _ => (0..240).rev().map(|i| picture.at(8, i)).collect(),
            };
            // The last place has no neighbour, of which it would have half.
            let off_in = |(i, found): (usize, &[f32; 4])| {
                let x = 0.05 * (i as f32 + 0.5 - 120.0);
                [0, 1, 2].map(|c| (found[c] - edge_response(&profile, x, c)).abs()).into_iter().fold(0.0, f32::max)
            };
            let most = line.iter().enumerate().skip(1).take(238).map(off_in).fold(0.0, f32::max);
            off.push((diffuse, profile.scattering_distance_mm, up, most));
        }
    }
    assert!(off.iter().all(|(.., most)| *most <= 0.04), "{off:#?}");
}

/// What the left border of a picture shows has no part in the right one, nor the upper in the lower.
#[test]
fn borders_of_a_picture_have_their_own_light() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let mut shot = leaning(seen([64, 64], 0.5, 0.3, Vec3::Z));
    for (diffuse, up) in OVER_PICTURES.into_iter().flat_map(|d| [(d, Vec3::Y), (d, Vec3::X)]) {
        shot.camera.up = up;
        let picture = shoot(&renderer, &gpu, &edge(matt(diffuse)), &shot);
        let ends: [f32; 4] = match up {
            Vec3::Y => [0, 1, 62, 63].map(|i| picture.at(i, 32)[0]),
            _ => [63, 62, 1, 0].map(|i| picture.at(32, i)[0]),
        };
        // 15 mm from the edge of light 1 in 1000 of red is left.
        let off = ends.iter().zip([0.0, 0.0, 1.0, 1.0]).map(|(a, b): (_, f32)| (a - b).abs());
        assert!(off.fold(0.0, f32::max) < 0.01, "{diffuse:?}, {up}: {ends:?}");
    }
}

/// Whether the camera comes nearer or zooms, to 5 %: light that has crossed the edge; and of discs, whose light has no cells that
/// move the places of two levels, also how far it is from a tenth to nine tenths.
#[test]
fn light_spreads_as_far_from_any_distance() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let spread = |diffuse, d_mm: f32, columns: u32, mm_per_px: f32, distance: f32| {
        let of = edge(Skin { profile: grey(d_mm), ..matt(diffuse) });
        let picture = shoot(&renderer, &gpu, &of, &leaning(seen([columns, 16], mm_per_px, distance, Vec3::Z)));
        let crossed = |(i, found): (usize, &[f32; 4])| (found[0] - f32::from(u8::from(i >= picture.width / 2))).abs();
        let crossed = picture.row().iter().enumerate().map(crossed).sum::<f32>();
        [crossed, passes(picture.row(), 0.9) - passes(picture.row(), 0.1)].map(|px| px * mm_per_px)
    };
    const DISTANCES: [f32; 5] = [0.3, 0.55, 1.0, 1.7, 3.0];
    for diffuse in OVER_PICTURES {
        let zoomed = DISTANCES.map(|distance| spread(diffuse, 0.757, 240, 0.05, distance));
        // By one lens.
        let walked =
            DISTANCES.map(|distance| spread(diffuse, 3.0, (288.0 / distance) as u32, distance / 6.0, distance));
        for all in [zoomed, walked] {
            let measures = if diffuse == SkinDiffuse::ScreenSpaceDisc { 2 } else { 1 };
            for i in 0..measures {
                assert!(all.iter().all(|one| (one[i] / all[0][i] - 1.0).abs() <= 0.05), "{diffuse:?}, {i}: {all:?} mm");
            }
        }
    }
}

/// Not across a gap of 10 cm, whichever side is lit, and not between two profiles beyond the pixel of their border.
#[test]
fn light_spreads_to_nothing_else() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let shot = leaning(seen([128, 32], 0.1, 1.0, Vec3::Z));
    // Border in the middle of pixel 64, so that what is left of it is whole.
    let border = 0.05e-3;
    let pairs = OVER_PICTURES.into_iter().flat_map(|diffuse| {
        let skin = matt(diffuse);
        let other = Skin { profile: grey(0.5), ..skin };
        [
            ("gap, front dark", skin, skin, -0.1, false),
            ("gap, front lit", skin, skin, -0.1, true),
            ("other profile", skin, other, 0.0, false),
            ("other profile", skin, other, 0.0, true),
        ]
    });
    let mut bled = Vec::new();
    for (what, left, right, z, is_left_lit) in pairs {
        let from = if z < 0.0 { -0.03 } else { border };
        let two = scene(vec![
            (lit([-0.03, border], 0.0, is_left_lit), white(left)),
            (lit([from, 0.03], z, !is_left_lit), white(right)),
        ]);
        let picture = shoot(&renderer, &gpu, &two, &shot);
        // 64 is of both; of two profiles the pixel beside as well.
        let last = if z < 0.0 { 64 } else { 63 };
        for (y, x) in (0..32).flat_map(|y| (0..last).chain(65..127).map(move |x| (y, x))) {
            let expected = f32::from(u8::from((x < 64) == is_left_lit));
            let found = picture.at(x, y);
            if found[..3].iter().any(|c| (c - expected).abs() >= 0.01) {
                bled.push((what, left.diffuse, x, y, found));
            }
        }
    }
    assert!(bled.is_empty(), "{} texels: {:?}", bled.len(), bled.iter().step_by(16).collect::<Vec<_>>());
}
