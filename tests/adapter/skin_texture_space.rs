//! Light that scatters in skin over its texture coordinates.

use std::f32::consts::PI;

use glam::Vec3;
use hikage::material::{Material, Skin, SkinDiffuse};
use hikage::picture::read_linear;
use hikage::scene::{Primitive, Scene};
use hikage::skin::DiffusionProfile;
use hikage::{Error, Output, Renderer, wgpu};

use super::skin;
use crate::support::{Shot, gpu, scene, sphere, square, staged, target};

const SIDE: usize = 128;
const MM_PER_PX: f32 = 0.2;

/// White skin that neither mirrors nor lets light through.
fn white(diffuse: SkinDiffuse) -> Material {
    let skin = Skin { diffuse, taps: 40, specular_strength: 0.0, transmission: 0.0, ..Skin::default() };
    Material { skin: Some(skin), ..Material::default() }
}

fn over_uv() -> Material {
    white(SkinDiffuse::TextureSpace)
}

/// The origin as an eye on the axis Z sees it.
fn seen(eye_z: f32, to_light: Vec3) -> Shot {
    skin::seen([SIDE as u32; 2], MM_PER_PX, eye_z, to_light)
}

/// Linear light, row by row.
fn shoot(scene: &Scene, shot: &Shot) -> Vec<[f32; 4]> {
    let gpu = gpu();
    let format = wgpu::TextureFormat::Rgba16Float;
    let renderer = Renderer::with_output(&gpu, Output { format, ..Output::default() }).expect("a renderer");
    let mut stage = staged(renderer.upload(scene));
    shot.set(&mut stage);
    let texture = target(&gpu, shot.size, format, 1);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    renderer.prepare(&mut encoder, &mut stage).expect("prepared");
    let into = texture.create_view(&wgpu::TextureViewDescriptor::default());
    renderer.draw(&mut encoder, &stage, &shot.view(), &into).expect("drawn");
    gpu.queue.submit([encoder.finish()]);
    read_linear(&gpu, &texture).expect("texels")
}

fn row(of: &[[f32; 4]]) -> &[[f32; 4]] {
    &of[SIDE / 2 * SIDE..(SIDE / 2 + 1) * SIDE]
}

/// Cards in the plane z = 0, 40 mm high: from x to x, metres, from u to u, and whether light falls on them.
fn cards(of: &[([f32; 2], [f32; 2], bool)]) -> Primitive {
    let mut all = Primitive { uvs: vec![Vec::new()], ..Primitive::default() };
    for ([left, right], [u_left, u_right], is_lit) in of {
        let first = all.positions.len() as u32;
        let lean = if *is_lit { LEAN } else { -LEAN };
        let normal = [lean.sin(), 0.0, lean.cos()];
        all.positions.extend([[*left, -0.02, 0.0], [*right, -0.02, 0.0], [*right, 0.02, 0.0], [*left, 0.02, 0.0]]);
        all.normals.extend([normal; 4]);
        all.outline_normals.extend([normal; 4]);
        all.uvs[0].extend([[*u_left, 1.0], [*u_right, 1.0], [*u_right, 0.0], [*u_left, 0.0]]);
        all.indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
    }
    all
}

/// How far normals lean to make an exact edge of light.
const LEAN: f32 = 0.1;

/// Light that is 1 where it falls on [`cards`].
fn leaning() -> Shot {
    let mut shot = seen(1.0, Vec3::new(LEAN.cos(), 0.0, LEAN.sin()));
    shot.lights.directional.intensity = 1.0 / (2.0 * LEAN).sin();
    shot
}

#[test]
fn even_light_stays_even() {
    let shot = seen(1.0, Vec3::Z);
    let [spread, lambert] = [SkinDiffuse::TextureSpace, SkinDiffuse::Lambert]
        .map(|of| shoot(&scene(vec![(square([0.0; 2], 0.01, 0.0), white(of))]), &shot));
    let whole = spread.iter().zip(&lambert).filter(|(_, b)| b[3] == 1.0);
    assert!(whole.clone().count() > 9000);
    for (a, b) in whole {
        assert!((0..3).all(|c| (a[c] / b[c] - 1.0).abs() <= 1e-3), "{a:?} {b:?}");
    }
}

/// Light so far inside of an edge of light, by Burley's profile: the mean over rings that hold as much light each.
fn edge_response(x_mm: f32, channel: usize) -> f32 {
    const RINGS: usize = 2000;
    let of = DiffusionProfile::default();
    let beyond = |i: usize| {
        let r = of.inverse_cdf((i as f32 + 0.5) / RINGS as f32, channel);
        (x_mm / r.max(1e-9)).clamp(-1.0, 1.0).acos() / PI
    };
    1.0 - (0..RINGS).map(beyond).sum::<f32>() / RINGS as f32
}

/// The most, and the root of the mean square.
fn off_the_edge(of: &[[f32; 4]]) -> [f32; 2] {
    let (mut most, mut squares) = (0.0f32, 0.0f32);
    for (i, found) in row(of).iter().enumerate() {
        let x_mm = (i as f32 + 0.5 - SIDE as f32 * 0.5) * MM_PER_PX;
        // A pixel is the mean over its width.
        let expected = |c: usize| {
            let places = (0..4).map(|k| x_mm + (f32::from(k as u8) - 1.5) * 0.25 * MM_PER_PX);
            places.map(|x| edge_response(x, c)).sum::<f32>() / 4.0
        };
        for off in [0, 1, 2].map(|c| found[c] - expected(c)) {
            most = most.max(off.abs());
            squares += off * off;
        }
    }
    [most, (squares / (3 * SIDE) as f32).sqrt()]
}

/// On one chart; and across a seam of two that lie apart in the texture, one of them turned over and twice as large.
#[test]
fn edges_of_light_spread_as_burley_says() {
    let whole = [([-0.03, 0.0], [0.0, 0.5], false), ([0.0, 0.03], [0.5, 1.0], true)];
    let cut = [([-0.03, 0.0], [0.3, 0.0], false), ([0.0, 0.03], [0.4, 1.0], true)];
    for of in [whole, cut] {
        let [most, mean] = off_the_edge(&shoot(&scene(vec![(cards(&of), over_uv())]), &leaning()));
        println!("off Burley's edge: {most} at most, {mean} in the mean");
        // 160 places about a point are as even as this.
        assert!(most < 0.035 && mean < 0.008, "{of:?}: {most} {mean}");
    }
}

#[test]
fn charts_that_touch_in_the_texture_alone_keep_their_light() {
    let apart = [([-0.0125, -0.0105], [0.0, 0.5], true), ([0.0105, 0.0125], [0.5, 1.0], false)];
    let picture = shoot(&scene(vec![(cards(&apart), over_uv())]), &leaning());
    let x_mm = |i: usize| (i as f32 + 0.5 - SIDE as f32 * 0.5) * MM_PER_PX;
    for (i, found) in row(&picture).iter().enumerate().filter(|(_, t)| t[3] == 1.0) {
        // Nearer than three texels both are read together.
        let is_inside = x_mm(i).abs() > 10.7 && x_mm(i).abs() < 12.3;
        let expected = f32::from(u8::from(x_mm(i) < 0.0));
        assert!(!is_inside || (0..3).all(|c| (found[c] - expected).abs() < 2e-3), "{i}: {found:?}");
    }
}

/// The edge of light along the seam of a sphere, and across it.
#[test]
fn seams_of_a_sphere_do_not_show() {
    let ball = scene(vec![(sphere(0.01, 64, 128), over_uv())]);
    // The seam is behind it.
    for to_light in [Vec3::X, Vec3::new(1.0, 0.0, -1.0).normalize()] {
        let picture = shoot(&ball, &seen(-1.0, to_light));
        let row = row(&picture);
        let middle = SIDE / 2;
        let step = |i: usize| (0..3).map(|c| (row[i + 1][c] - row[i][c]).abs()).fold(0.0, f32::max);
        let across = (middle - 3..middle + 2).map(step).fold(0.0, f32::max);
        let elsewhere = (middle - 30..middle - 4).chain(middle + 3..middle + 30).map(step).fold(0.0, f32::max);
        println!("{to_light}: {across} across the seam, {elsewhere} elsewhere");
        assert!(across <= 2.0 * elsewhere, "{to_light}: {across} {elsewhere}");
    }
}

/// Seventeen materials have no layers: they are lit as Lambert says.
#[test]
fn what_has_no_layer_is_lit_without_scattering() {
    let shot = seen(1.0, Vec3::new(0.6, 0.0, 0.8));
    let many = |of: SkinDiffuse| {
        let ball = || (sphere(0.005, 16, 32), white(of));
        shoot(&scene((0..17).map(|_| ball()).collect()), &shot)
    };
    assert_eq!(many(SkinDiffuse::TextureSpace), many(SkinDiffuse::Lambert));
}

#[test]
fn parts_without_texture_coordinates_are_refused() {
    let gpu = gpu();
    let renderer = Renderer::new(&gpu).expect("a renderer");
    for uvs in [vec![], vec![vec![[0.0; 2]; 4]]] {
        let part = Primitive { uvs, ..square([0.0; 2], 0.01, 0.0) };
        let material = Material { name: "cheek".to_owned(), ..over_uv() };
        let error = renderer.upload(&scene(vec![(part, material)])).expect_err("it has no place for its light");
        let Error::Argument { what, message } = error else { panic!("{error}") };
        assert_eq!(what, "material 0 \"cheek\", skin.diffuse");
        assert!(message.contains("no texture coordinates") && message.contains("pre-integrated"), "{message}");
    }
}
