//! Natural light: environments, physical surfaces, lit hair.

use glam::Vec3;
use hikage::import::load_radiance;
use hikage::material::{Base, FibreModel, Hair, HairModel, Material, Shading, Standard, StrandDirection};
use hikage::scene::{Ambient, DirectionalLight, Environment, Lights, Post, Primitive, Radiance, Scene};
use hikage::{Background, Error, color::LinearRgb};

use crate::support::{Shot, gpu, pixel, render, scene, sphere, square, texture, two_tone, view, with_renderer};

/// A white surface of these numbers.
fn white(metallic: f32, roughness: f32) -> Material {
    Material {
        shading: Shading::Standard(Standard { metallic, roughness, ..Standard::default() }),
        ..Material::default()
    }
}

/// In the light of an environment alone.
fn in_light(mut shot: Shot, environment: Environment) -> Shot {
    shot.lights = Lights {
        directional: DirectionalLight { intensity: 0.0, ..DirectionalLight::default() },
        environment: Some(environment),
        ..Lights::default()
    };
    shot.background = Background::Transparent;
    shot
}

fn linear(code: u8) -> f32 {
    hikage::color::Srgb([code; 3]).to_linear().0[0]
}

/// A white furnace: whatever a surface is made of, as much light leaves it as arrives, to 1 %.
#[test]
fn white_surfaces_vanish_in_a_furnace() {
    let gpu = gpu();
    for metallic in [0.0, 1.0] {
        for roughness in [0.0, 0.3, 0.6, 1.0] {
            let shot = in_light(view(64, 3.0), Environment::uniform([0.5; 3]));
            let picture = render(&gpu, &scene(vec![(sphere(0.5, 64, 128), white(metallic, roughness))]), &shot);
            for (x, y) in [(32, 32), (28, 36), (40, 24), (22, 32)] {
                let [r, g, b, alpha] = pixel(&picture, x, y);
                assert_eq!(alpha, 255);
                for code in [r, g, b] {
                    let found = linear(code);
                    // A code of 8 bits is 0.9 % here.
                    assert!((found / 0.5 - 1.0).abs() < 0.015, "metal {metallic}, rough {roughness}: {found}");
                }
            }
        }
    }
}

/// Half of the surroundings white, half black.
fn half(of: impl Fn(u32, u32) -> bool) -> Environment {
    let texels = (0..64 * 128).map(|i| [f32::from(u8::from(of(i % 128, i / 128))) * 0.8; 3]).collect();
    Environment::new(Radiance::new(128, 64, texels).expect("radiance"))
}

/// A mirror shows what is on each side of it; a turn moves it to the character's left; a wall shows its mean.
#[test]
fn environments_stand_where_they_say() {
    let gpu = gpu();
    let at = |environment: Environment, material: Material, x: u32, y: u32| {
        let shot = in_light(view(64, 3.0), environment);
        linear(pixel(&render(&gpu, &scene(vec![(sphere(0.5, 64, 128), material)]), &shot), x, y)[1])
    };
    // The right half of the picture is +X: a mirror that is seen from +Z shows it on its right.
    let right = || half(|x, _| x >= 64);
    let mirror = || white(1.0, 0.0);
    assert!(at(right(), mirror(), 41, 32) > 0.7 && at(right(), mirror(), 22, 32) < 0.05);
    // The top is above.
    let above = || half(|_, y| y < 32);
    assert!(at(above(), mirror(), 32, 24) > 0.7 && at(above(), mirror(), 32, 41) < 0.05);
    // What is in front of the character comes to its left (+X) by a quarter turn.
    let front = || half(|x, _| !(32..96).contains(&x));
    let turned = || Environment { turn_rad: std::f32::consts::FRAC_PI_2, ..front() };
    assert!(at(turned(), mirror(), 43, 32) > 0.7 && at(turned(), mirror(), 20, 32) < 0.05);
    // Dull surfaces follow 1 + cos.
    let [left, middle, right_side] = [22, 32, 42].map(|x| at(right(), white(0.0, 1.0), x, 32));
    assert!((middle - 0.4).abs() < 0.02, "{middle}");
    assert!((left + right_side - 0.8).abs() < 0.02 && right_side - left > 0.15, "{left} {right_side}");
    // Toon surfaces take what comes from above and below.
    let shot = in_light(view(64, 3.0), half(|_, y| y < 32));
    let picture = render(&gpu, &scene(vec![(square([0.0; 2], 1.0, 0.0), two_tone())]), &shot);
    assert!(pixel(&picture, 32, 32)[0] > 40);
}

/// It fills what nobody stands before, with or without finishing, and nothing where there is none.
#[test]
fn environments_are_seen_behind_everything() {
    let gpu = gpu();
    let mut shot = in_light(view(64, 3.0), half(|x, _| x >= 64));
    shot.background = Background::Environment;
    let ball = || scene(vec![(sphere(0.2, 32, 64), white(0.0, 1.0))]);
    let plain = render(&gpu, &ball(), &shot);
    let mut finished = ball();
    finished.post = Some(Post::default());
    let finished = render(&gpu, &finished, &shot);
    for picture in [&plain, &finished] {
        assert_eq!(pixel(picture, 60, 32)[3], 255);
        assert!(linear(pixel(picture, 60, 32)[0]) > 0.75 && pixel(picture, 3, 32)[0] < 5);
    }
    shot.lights.environment = None;
    assert_eq!(pixel(&render(&gpu, &ball(), &shot), 60, 32), [0; 4]);
}

/// A stop doubles the light of the picture.
#[test]
fn exposure_doubles_light_by_the_stop() {
    let gpu = gpu();
    let at = |exposure_ev: f32| {
        let mut wall = scene(vec![(
            square([0.0; 2], 2.0, 0.0),
            Material {
                shading: Shading::Unlit,
                base: Base { color: [0.2, 0.2, 0.2, 1.0], texture: None },
                ..Material::default()
            },
        )]);
        wall.post = Some(Post { exposure_ev, ..Post::default() });
        linear(pixel(&render(&gpu, &wall, &view(32, 3.0)), 16, 16)[0])
    };
    assert!((at(0.0) - 0.2).abs() < 0.005 && (at(1.0) - 0.4).abs() < 0.005 && (at(-1.0) - 0.1).abs() < 0.005);
}

fn hair(of: Hair) -> Scene {
    scene(vec![(sphere(0.5, 64, 128), Material { hair: Some(of), ..two_tone() })])
}

/// At 0, without highlights, lit hair is the toon surface under it, to the byte; between both it is between.
#[test]
fn hair_goes_from_toon_to_lit() {
    let gpu = gpu();
    let mut shot = view(64, 3.0);
    shot.lights.ambient = Ambient::uniform(LinearRgb::splat(0.2));
    let toon = render(&gpu, &scene(vec![(sphere(0.5, 64, 128), two_tone())]), &shot);
    for model in [HairModel::Fibre, HairModel::KajiyaKay] {
        let at = |natural: f32| {
            render(&gpu, &hair(Hair { model, natural, highlight_color: [0.0; 3], ..Hair::default() }), &shot)
        };
        let [drawn, middle, lit] = [0.0, 0.5, 1.0].map(at);
        assert_eq!(drawn.pixels, toon.pixels, "{model:?}");
        assert_ne!(lit.pixels, toon.pixels, "{model:?}");
        for (x, y) in [(32, 32), (24, 24), (40, 40)] {
            let [a, b, c] = [&drawn, &middle, &lit].map(|p| linear(pixel(p, x, y)[1]));
            assert!((b - 0.5 * (a + c)).abs() < 0.01, "{model:?} {x} {y}: {a} {b} {c}");
        }
    }
}

/// A strand of a layer is what the model says, summed without a table: for lights from all round.
#[test]
fn the_table_of_fibres_is_the_model() {
    let gpu = gpu();
    let fibre = FibreModel {
        scatter: 0.0,
        packing: 0.0,
        density: 0.0,
        tilt_rad: 0.0,
        longitudinal: 0.6,
        ..Hair::blond().fibre
    };
    // Of a wall whose strands hang down.
    let wall = scene(vec![(
        square([0.0; 2], 2.0, 0.0),
        Material { hair: Some(Hair { fibre, ..Hair::default() }), double_sided: true, ..two_tone() },
    )]);
    let absorption = fibre.absorption();
    for (azimuth, height) in [(0.0f32, 0.0f32), (40.0, 10.0), (100.0, -15.0), (150.0, 5.0), (175.0, 20.0)] {
        let (azimuth, height) = (azimuth.to_radians(), height.to_radians());
        let to_light = Vec3::new(azimuth.sin() * height.cos(), height.sin(), azimuth.cos() * height.cos());
        let mut shot = view(32, 3.0);
        shot.lights.directional = DirectionalLight { to_light, intensity: 0.5, ..DirectionalLight::default() };
        let found = pixel(&render(&gpu, &wall, &shot), 16, 16);
        let expected = model(&fibre, absorption, height, azimuth).map(|s| s * std::f64::consts::PI * 0.5);
        for (found, expected) in found.into_iter().zip(expected) {
            let code = f64::from(LinearRgb::splat(expected as f32).to_srgb().0[0]);
            assert!(
                (f64::from(found) - code).abs() <= 2.0 + code * 0.01,
                "{azimuth} {height}: {found}, expected {code}"
            );
        }
    }
}

/// The far field of a fibre that is seen square to it, in 64 bits.
fn model(of: &FibreModel, absorption: [f32; 3], theta_i: f32, phi: f32) -> [f64; 3] {
    let b = f64::from(of.longitudinal);
    let v = (0.726 * b + 0.812 * b * b + 3.7 * b.powi(20)).powi(2);
    let n = f64::from(of.azimuthal);
    let s = (std::f64::consts::PI / 8.0).sqrt() * (0.265 * n + 1.194 * n * n + 5.372 * n.powi(22));
    let (sin_i, cos_i) = f64::from(theta_i).sin_cos();
    let i0 = |x: f64| {
        (1..60)
            .fold((1.0, 1.0), |(sum, term): (f64, f64), k| {
                let term = term * (x / 2.0).powi(2) / f64::from(k * k);
                (sum + term, term)
            })
            .0
    };
    // Seen square to it: sin of the view is 0.
    let longitudinal = |v: f64| (-(sin_i * 0.0)).exp() * i0(cos_i / v) / (v * ((1.0 / v).exp() - (-1.0 / v).exp()));
    let along = [longitudinal(v), longitudinal(0.25 * v), longitudinal(4.0 * v), longitudinal(4.0 * v)];
    let eta = f64::from(of.ior);
    let tau = std::f64::consts::TAU;
    let logistic = |x: f64| {
        let x = (x - tau * (x / tau).round()).abs();
        let e = (-x / s).exp();
        e / (s * (1.0 + e).powi(2)) / (std::f64::consts::PI / (2.0 * s)).tanh()
    };
    let mut sums = [0.0; 3];
    const NODES: usize = 20_000;
    for i in 0..NODES {
        let g = ((i as f64 + 0.5) / NODES as f64 - 0.5) * std::f64::consts::PI;
        let (gi, gt) = (g, (g.sin() / eta).asin());
        let c = g.cos();
        let t = (1.0 - (1.0 - c * c) / (eta * eta)).sqrt();
        let f = 0.5 * (((eta * c - t) / (eta * c + t)).powi(2) + ((c - eta * t) / (c + eta * t)).powi(2));
        let weight = g.cos() * 0.5 * std::f64::consts::PI / NODES as f64;
        let about =
            [0.0, 1.0, 2.0].map(|p| logistic(f64::from(phi) - (2.0 * p * gt - 2.0 * gi + p * std::f64::consts::PI)));
        for (sum, sigma) in sums.iter_mut().zip(absorption) {
            let pass = (-f64::from(sigma) * 2.0 * gt.cos()).exp();
            let tt = (1.0 - f).powi(2) * pass;
            let (trt, rest) = (tt * pass * f, tt * pass * f * pass * f / (1.0 - pass * f));
            *sum += weight
                * (f * along[0] * about[0]
                    + tt * along[1] * about[1]
                    + trt * along[2] * about[2]
                    + rest * along[3] / tau);
        }
    }
    sums
}

/// The same comb by a flow map as by the texture's own axes.
#[test]
fn a_flow_map_combs_hair() {
    let gpu = gpu();
    let with_map = |flow: Option<[u8; 4]>, direction: StrandDirection| {
        let mut combed = scene(vec![(sphere(0.5, 64, 128), two_tone())]);
        let flow_map = flow.map(|texel| texture(&mut combed, 4, 4, |_, _| texel));
        combed.materials[0].hair = Some(Hair { flow_map, direction, ..Hair::default() });
        render(&gpu, &combed, &view(64, 3.0))
    };
    let near = |a: &hikage::scene::Image, b: &hikage::scene::Image| {
        let off = a.pixels.iter().zip(&b.pixels).filter(|(a, b)| a.abs_diff(**b) > 3).count();
        assert!(off * 200 < a.pixels.len(), "{off} bytes differ");
    };
    // Up in the texture is against v.
    near(&with_map(Some([128, 0, 255, 255]), StrandDirection::Auto), &with_map(None, StrandDirection::UvV));
    near(&with_map(Some([255, 128, 255, 255]), StrandDirection::Auto), &with_map(None, StrandDirection::UvU));
}

#[test]
fn absurd_hair_and_strands_that_cannot_be_found_are_refused_by_name() {
    let gpu = gpu();
    let fault = |scene: Scene| {
        with_renderer(&gpu, |renderer| match renderer.upload(&scene) {
            Err(Error::Argument { what, message }) => format!("{what}: {message}"),
            Ok(_) => panic!("it is taken"),
            Err(other) => panic!("{other}"),
        })
    };
    let absurd = |fibre: FibreModel| hair(Hair { fibre, ..Hair::default() });
    assert!(fault(absurd(FibreModel { eumelanin: -1.0, ..FibreModel::default() })).contains("hair.fibre.eumelanin"));
    assert!(
        fault(absurd(FibreModel { longitudinal: 0.0, ..FibreModel::default() })).contains("hair.fibre.longitudinal")
    );
    assert!(fault(absurd(FibreModel { ior: f32::NAN, ..FibreModel::default() })).contains("hair.fibre.ior"));
    let by_shape = Hair { direction: StrandDirection::Mesh, ..Hair::default() };
    let mut combed = hair(Hair::default());
    let normals = texture(&mut combed, 4, 4, |_, _| [128, 128, 255, 255]);
    combed.materials[0].hair = Some(Hair { flow_map: Some(normals), ..Hair::default() });
    let message = fault(combed);
    assert!(message.contains("hair.flow_map") && message.contains("normal map"), "{message}");
    // A closed ball has neither root nor tip.
    let corners = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z].map(|c| c.to_array());
    let octahedron = Primitive {
        positions: corners.to_vec(),
        normals: corners.to_vec(),
        outline_normals: corners.to_vec(),
        indices: vec![0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2, 1, 0, 5, 3, 1, 5, 4, 3, 5, 0, 4, 5],
        ..Primitive::default()
    };
    let message = fault(scene(vec![(octahedron, Material { hair: Some(by_shape), ..two_tone() })]));
    assert!(message.contains("hair.direction") && message.contains("uv-v"), "{message}");
}

#[test]
fn pictures_of_radiance_that_are_none_are_refused() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let fault = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        std::fs::write(&path, bytes).expect("writes");
        load_radiance(&path).err().map(|e| e.to_string()).unwrap_or_else(|| panic!("{name} is read"))
    };
    let header = |width: u32, height: u32| {
        format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes()
    };
    assert!(fault("none.hdr", b"PNG and so on").contains("Radiance file"));
    assert!(fault("empty.hdr", b"").contains("Radiance file"));
    let cut = fault("cut.hdr", &[header(64, 32), vec![128; 100]].concat());
    assert!(cut.contains("cut.hdr") && cut.contains("cut off"), "{cut}");
    assert!(fault("huge.hdr", &header(60_000, 30_000)).contains("over the limit"));
    assert!(fault("square.hdr", &header(64, 64)).contains("twice as wide"));
    assert!(fault("flat.hdr", &header(0, 0)).contains("flat.hdr"));
    // One that is whole: flat texels of 1, which RGBE writes as 128 and an exponent of 129.
    let path = folder.join("whole.hdr");
    let texels = [128u8, 128, 128, 129].repeat(4 * 2);
    std::fs::write(&path, [header(4, 2), texels].concat()).expect("writes");
    let whole = load_radiance(&path).expect("a picture");
    assert_eq!(whole.size(), [4, 2]);
    assert!(whole.texels().iter().flatten().all(|x| (x - 1.0).abs() < 0.02), "{:?}", whole.texels());
}
