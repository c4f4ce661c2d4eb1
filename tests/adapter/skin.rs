//! Light on skin: its energy, how far it spreads, what comes through, what channels show.

use std::f32::consts::PI;

use glam::Vec3;
use hikage::color::{LinearRgb, linear_from_srgb};
use hikage::material::{Base, CastShadow, Material, Skin, SkinDiffuse, SkinSpecular};
use hikage::picture::read_linear;
use hikage::scene::{Ambient, Camera, DirectionalLight, Environment, Lights, Primitive, Scene, SelfShadow};
use hikage::skin::{DiffusionProfile, Transmission};
use hikage::{Background, Channel, Error, Gpu, Output, Renderer, wgpu};

use crate::support::{Shoot, Shot, gpu, scene, sphere, square, staged, target};

const DIFFUSES: [SkinDiffuse; 6] = [
    SkinDiffuse::Lambert,
    SkinDiffuse::Wrapped,
    SkinDiffuse::PreIntegrated,
    SkinDiffuse::ScreenSpace,
    SkinDiffuse::ScreenSpaceDisc,
    SkinDiffuse::TextureSpace,
];
const SPECULARS: [SkinSpecular; 4] =
    [SkinSpecular::BlinnPhong, SkinSpecular::Kelemen, SkinSpecular::Ggx, SkinSpecular::DualGgx];

/// Skin that neither mirrors nor lets light through.
pub(super) fn matt(diffuse: SkinDiffuse) -> Skin {
    Skin { diffuse, taps: 40, specular_strength: 0.0, transmission: 0.0, ..Skin::default() }
}

pub(super) fn grey(d_mm: f32) -> DiffusionProfile {
    DiffusionProfile { scattering_distance_mm: [d_mm; 3], ..DiffusionProfile::default() }
}

/// White all over.
pub(super) fn white(skin: Skin) -> Material {
    colored(1.0, skin)
}

pub(super) fn colored(albedo: f32, skin: Skin) -> Material {
    Material {
        base: Base { color: [albedo, albedo, albedo, 1.0], texture: None },
        skin: Some(skin),
        ..Material::default()
    }
}

/// From an eye on the axis Z, with so many mm to a pixel where z = 0, in a light of strength 1.
pub(super) fn seen(size: [u32; 2], mm_per_px: f32, eye_z: f32, to_light: Vec3) -> Shot {
    let half_height = 0.0005 * mm_per_px * size[1] as f32;
    Shot {
        size,
        camera: Camera {
            eye: Vec3::Z * eye_z,
            target: Vec3::ZERO,
            fov_y_rad: 2.0 * (half_height / eye_z.abs()).atan(),
            near: 0.05,
            ..Camera::default()
        },
        lights: Lights {
            directional: DirectionalLight { to_light, ..DirectionalLight::default() },
            ambient: Ambient::uniform(LinearRgb::BLACK),
            ..Lights::default()
        },
        background: Background::Transparent,
        ..Shot::default()
    }
}

/// In the light of an environment alone.
fn furnace(mut shot: Shot) -> Shot {
    shot.lights.directional.intensity = 0.0;
    shot.lights.environment = Some(Environment::uniform([1.0; 3]));
    shot
}

/// Linear light of half floats, premultiplied.
pub(super) struct Picture {
    pub(super) width: usize,
    pub(super) texels: Vec<[f32; 4]>,
}

impl Picture {
    pub(super) fn at(&self, x: usize, y: usize) -> [f32; 4] {
        self.texels[y * self.width + x]
    }

    pub(super) fn middle(&self) -> [f32; 4] {
        self.at(self.width / 2, self.texels.len() / self.width / 2)
    }

    /// A row in the middle.
    pub(super) fn row(&self) -> &[[f32; 4]] {
        let row = self.texels.len() / self.width / 2 * self.width;
        &self.texels[row..row + self.width]
    }

    /// Texels that are covered whole.
    fn whole(&self) -> impl Iterator<Item = &[f32; 4]> {
        self.texels.iter().filter(|t| t[3] == 1.0)
    }
}

pub(super) fn renderer(gpu: &Gpu) -> Renderer {
    let output = Output { format: wgpu::TextureFormat::Rgba16Float, ..Output::default() };
    Renderer::with_output(gpu, output).expect("a renderer")
}

pub(super) fn shoot(renderer: &Renderer, gpu: &Gpu, scene: &Scene, shot: &Shot) -> Picture {
    let mut stage = staged(renderer.upload(scene));
    shot.set(&mut stage);
    let texture = target(gpu, shot.size, wgpu::TextureFormat::Rgba16Float, 1);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    renderer.prepare(&mut encoder, &mut stage).expect("prepared");
    let into = texture.create_view(&wgpu::TextureViewDescriptor::default());
    renderer.draw(&mut encoder, &stage, &shot.view(), &into).expect("drawn");
    gpu.queue.submit([encoder.finish()]);
    Picture { width: shot.size[0] as usize, texels: read_linear(gpu, &texture).expect("texels") }
}

/// A channel: linear, from 8 bits.
fn shown(renderer: &Renderer, scene: &Scene, channel: Channel, shot: &Shot) -> Picture {
    let shot = Shot { channel, ..shot.clone() };
    let image = renderer.shoot(&mut staged(renderer.upload(scene)), &shot).expect("a channel");
    let texel = |p: &[u8]| [0, 1, 2, 3].map(|c| linear_from_srgb(f32::from(p[c]) / 255.0));
    Picture { width: shot.size[0] as usize, texels: image.pixels.chunks_exact(4).map(texel).collect() }
}

/// A rectangle in the plane z, metres, that is lit as if it faced another way.
pub(super) fn card(x: [f32; 2], y: [f32; 2], z: f32, normal: Vec3) -> Primitive {
    let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
    Primitive {
        positions: corners.map(|(i, j)| [x[i], y[j], z]).to_vec(),
        normals: vec![normal.to_array(); 4],
        outline_normals: vec![normal.to_array(); 4],
        uvs: vec![corners.map(|(i, j)| [i as f32, 1.0 - j as f32]).to_vec()],
        indices: vec![0, 1, 2, 0, 2, 3],
        ..Primitive::default()
    }
}

/// Light so far inside of an edge of light, by Burley's profile: the mean over rings that hold as much light each.
pub(super) fn edge_response(of: &DiffusionProfile, x_mm: f32, channel: usize) -> f32 {
    const RINGS: usize = 2000;
    let beyond = |i: usize| {
        let r = of.inverse_cdf((i as f32 + 0.5) / RINGS as f32, channel);
        (x_mm / r.max(1e-9)).clamp(-1.0, 1.0).acos() / PI
    };
    1.0 - (0..RINGS).map(beyond).sum::<f32>() / RINGS as f32
}

/// A box of 40 mm by 40 mm: vertices enough for a thickness that is known in its middle.
fn plate(thickness: f32) -> Primitive {
    const CELLS: u32 = 16;
    let half = Vec3::new(0.02, 0.02, 0.5 * thickness);
    let mut p = Primitive { uvs: vec![Vec::new()], ..Primitive::default() };
    for axis in 0..3 {
        for sign in [-1.0f32, 1.0] {
            let n = Vec3::AXES[axis] * sign;
            let (s, t) = (Vec3::AXES[(axis + 1) % 3] * sign, Vec3::AXES[(axis + 2) % 3]);
            let first = p.positions.len() as u32;
            for (j, i) in (0..=CELLS).flat_map(|j| (0..=CELLS).map(move |i| (j, i))) {
                let [u, v] = [i, j].map(|k| k as f32 / CELLS as f32);
                p.positions.push(((n + s * (2.0 * u - 1.0) + t * (2.0 * v - 1.0)) * half).to_array());
                p.normals.push(n.to_array());
                p.outline_normals.push(n.to_array());
                p.uvs[0].push([u, v]);
                if i < CELLS && j < CELLS {
                    let a = first + j * (CELLS + 1) + i;
                    p.indices.extend([a, a + 1, a + CELLS + 2, a, a + CELLS + 2, a + CELLS + 1]);
                }
            }
        }
    }
    p
}

/// As much light leaves white skin as arrives, whatever finds it: to 10 % and 5 %, as highlights have no second bounce and are of
/// an environment by the table of another lobe.
#[test]
fn white_skin_vanishes_in_a_furnace() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let shot = furnace(seen([48, 48], 0.5, 1.0, Vec3::Z));
    for (diffuse, specular) in DIFFUSES.into_iter().flat_map(|d| SPECULARS.map(|s| (d, s))) {
        for shape in [sphere(0.01, 32, 64), square([0.0; 2], 0.01, 0.0)] {
            let of = white(Skin { diffuse, specular, roughness: 0.4, ..Skin::default() });
            let picture = shoot(&renderer, &gpu, &scene(vec![(shape, of)]), &shot);
            assert!(picture.whole().count() > 1000);
            for found in picture.whole().flat_map(|t| &t[..3]) {
                assert!((0.9..1.05).contains(found), "{diffuse:?} {specular:?}: {found}");
            }
        }
    }
}

/// A sheet under a roof that is culled from above: by the formulas of the papers; the cosine-weighted share is known.
#[test]
fn light_from_all_around_is_less_where_something_hides_it() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let shot = furnace(seen([32, 32], 0.5, 1.0, Vec3::Z));
    let mut sheet = plate(0.0);
    // Its upper face alone.
    let face = 17 * 17;
    let first = sheet.positions.len() - face;
    sheet.positions.drain(..first);
    sheet.normals.drain(..first);
    sheet.outline_normals.drain(..first);
    sheet.uvs[0].drain(..first);
    sheet.indices.drain(..sheet.indices.len() / 6 * 5);
    sheet.indices.iter_mut().for_each(|i| *i -= first as u32);
    let under_roof = |albedo: f32, skin: Skin| {
        let roof = card([0.5, -0.5], [-0.5, 0.5], 0.05, Vec3::NEG_Z);
        scene(vec![(sheet.clone(), colored(albedo, skin)), (roof, Material::default())])
    };
    let open = shown(&renderer, &under_roof(0.6, Skin::default()), Channel::Look("skin-occlusion"), &shot).middle()[0];
    // 1 - (distance / reach)² of what lies in each direction is hidden: 1 - q + q ln q with q = (50 mm / 100 mm)².
    assert!((open - (0.25 - 0.25 * 0.25f32.ln())).abs() < 0.03, "{open}");
    let (a, b, c) = (2.0404 * 0.6 - 0.3324, -4.7951 * 0.6 + 0.6417, 2.7552 * 0.6 + 0.6903);
    let scattered = open.max(((open * a + b) * open + c) * open);
    let mirrored = (1.0 + open).powf((-16.0 * 0.45f32.powi(2) - 1.0).exp2()) - 1.0 + open;
    let ratio = |albedo: f32, skin: Skin| {
        let [all, part] = [0.0, 1.0].map(|occlusion| {
            shoot(&renderer, &gpu, &under_roof(albedo, Skin { occlusion, ..skin }), &shot).middle()[0]
        });
        part / all
    };
    for diffuse in DIFFUSES {
        let found = ratio(0.6, matt(diffuse));
        // The channel has 8 bits.
        assert!((found / scattered - 1.0).abs() < 0.01, "{diffuse:?}: {found}, expected {scattered}");
    }
    let found = ratio(0.0, Skin::default());
    assert!((found / mirrored - 1.0).abs() < 0.01, "{found}, expected {mirrored}");
    // What nothing hides is as it was.
    let ball = |occlusion: f32| {
        let of = scene(vec![(sphere(0.01, 32, 64), colored(0.6, Skin { occlusion, ..Skin::default() }))]);
        shoot(&renderer, &gpu, &of, &shot).texels
    };
    assert!(ball(0.0) == ball(1.0));
}

#[test]
fn black_skin_only_mirrors() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let mut shot = seen([32, 32], 0.75, 1.0, Vec3::new(0.6, 0.2, 0.8).normalize());
    shot.lights.environment = Some(Environment::uniform([0.5; 3]));
    for (diffuse, specular) in DIFFUSES.into_iter().flat_map(|d| SPECULARS.map(|s| (d, s))) {
        let ball = |specular_strength: f32| {
            let skin = Skin { diffuse, specular, specular_strength, ..Skin::default() };
            scene(vec![(sphere(0.01, 32, 64), colored(0.0, skin))])
        };
        let nothing = shoot(&renderer, &gpu, &ball(0.0), &shot);
        assert!(nothing.texels.iter().all(|t| t[..3] == [0.0; 3]), "{diffuse:?}");
        let [all, alone] =
            [Channel::Final, Channel::Look("skin-specular")].map(|c| shown(&renderer, &ball(1.0), c, &shot));
        for (all, alone) in all.texels.iter().zip(&alone.texels).filter(|(t, _)| t[3] == 1.0) {
            // A code of 8 bits is 4 % where it is as dark as here.
            assert!(all[0] > 0.0 && (all[0] / alone[0] - 1.0).abs() < 0.04, "{specular:?}: {all:?} {alone:?}");
        }
    }
}

/// Light on a cylinder of this curvature, whose ring spreads it by the profile's line spread (Penner 2011).
fn penner(of: &DiffusionProfile, n_dot_l: f32, curvature: f32) -> [f32; 3] {
    const STEPS: usize = 2000;
    let theta = n_dot_l.clamp(-1.0, 1.0).acos();
    let (mut sum, mut weights) = ([0.0; 3], [0.0; 3]);
    for i in 0..STEPS {
        // Finer where the line spread is steep.
        let t = (i as f32 + 0.5) / STEPS as f32;
        let x = PI * t * t;
        let spread = of.line_spread(2.0 / curvature * (0.5 * x).sin());
        for c in 0..3 {
            sum[c] += spread[c] * t * ((theta + x).cos().max(0.0) + (theta - x).cos().max(0.0)) * 0.5;
            weights[c] += spread[c] * t;
        }
    }
    [0, 1, 2].map(|c| sum[c] / weights[c])
}

/// Lit from the side, N.L grows evenly along a row.
#[test]
fn round_skin_has_the_light_of_its_curvature() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let profile = DiffusionProfile::default();
    for radius_mm in [10.0f32, 25.0] {
        let mm_per_px = radius_mm / 112.0;
        let shot = seen([240, 8], mm_per_px, 3.0, Vec3::X);
        let ball = |diffuse| scene(vec![(sphere(radius_mm * 1e-3, 64, 128), white(matt(diffuse)))]);
        let picture = shoot(&renderer, &gpu, &ball(SkinDiffuse::PreIntegrated), &shot);
        let lambert = shoot(&renderer, &gpu, &ball(SkinDiffuse::Lambert), &shot);
        let whole = |p: &Picture| -> Vec<(usize, [f32; 4])> {
            p.row().iter().copied().enumerate().filter(|(_, t)| t[3] == 1.0).collect()
        };
        let row = whole(&picture);
        let mut most = 0.0f32;
        for (i, found) in row.iter().step_by(7) {
            let n_dot_l = (*i as f32 + 0.5 - 120.0) / 112.0;
            let expected = penner(&profile, n_dot_l, 1.0 / radius_mm);
            for c in 0..3 {
                most = most.max((found[c] - expected[c]).abs());
            }
        }
        assert!(most <= 5e-3, "{radius_mm} mm: {most} off the integral");
        for pair in row.windows(2) {
            let [(_, a), (_, b)] = pair else { continue };
            // Half floats keep 11 bits.
            assert!((0..3).all(|c| b[c] >= a[c] * (1.0 - 1e-3)), "{radius_mm} mm: {a:?}, then {b:?}");
        }
        for (_, t) in row.iter().filter(|(i, _)| *i < 120) {
            assert!(t[0] >= t[1] && t[1] >= t[2], "{radius_mm} mm: {t:?}");
        }
        let mean = |of: &[(usize, [f32; 4])], c: usize| of.iter().map(|(_, t)| t[c]).sum::<f32>() / of.len() as f32;
        let flat = mean(&whole(&lambert), 0);
        let off = [0, 1, 2].map(|c| mean(&row, c) / flat - 1.0);
        assert!(off.iter().all(|off| off.abs() <= 0.02), "{radius_mm} mm: {off:?} more than Lambert's");
    }
}

#[test]
fn flat_skin_is_lit_as_any_surface() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    for angle in [0.0f32, 0.4, 0.9, 1.3] {
        let shot = seen([16, 16], 0.5, 1.0, Vec3::new(angle.sin(), 0.0, angle.cos()));
        let at = |diffuse| {
            shoot(&renderer, &gpu, &scene(vec![(square([0.0; 2], 0.02, 0.0), white(matt(diffuse)))]), &shot).middle()
        };
        let (found, lambert) = (at(SkinDiffuse::PreIntegrated), at(SkinDiffuse::Lambert));
        for c in 0..3 {
            // Half floats keep 11 bits.
            assert!(
                (lambert[c] - angle.cos()).abs() < 1e-3 && (found[c] / lambert[c] - 1.0).abs() <= 1e-3,
                "{angle}: {found:?} {lambert:?}"
            );
        }
    }
}

/// Of a plate that is lit from behind: by its own thickness or by the shadow map.
#[test]
fn light_comes_through_a_plate() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let shot = seen([16, 16], 0.5, 1.0, Vec3::NEG_Z);
    let through = |thickness_mm: f32, transmission: Transmission, transmission_of_volume: bool, share: f32| {
        let profile = DiffusionProfile { transmission, ..DiffusionProfile::default() };
        let skin = Skin { profile, transmission: share, transmission_of_volume, ..matt(SkinDiffuse::PreIntegrated) };
        let mut of = white(skin);
        let is_thick = transmission == Transmission::Thick;
        of.cast_shadow = is_thick.then(CastShadow::default);
        let mut of = scene(vec![(plate(thickness_mm * 1e-3), of)]);
        of.self_shadow = is_thick.then(|| SelfShadow { side: 4096, ..SelfShadow::default() });
        shoot(&renderer, &gpu, &of, &shot).middle()
    };
    let profile = DiffusionProfile::default();
    for transmission in [Transmission::Thin, Transmission::Thick] {
        for thickness in [0.2f32, 1.0, 3.0] {
            let [found, of_volume, dark] = [(false, 1.0), (true, 1.0), (false, 0.0)]
                .map(|(volume, share)| through(thickness, transmission, volume, share));
            let expected = [profile.transmittance(thickness), profile.transmittance_of_volume(thickness)];
            for c in 0..3 {
                assert!(
                    (found[c] / expected[0][c] - 1.0).abs() <= 0.1,
                    "{transmission:?} {thickness} mm: {found:?}, expected {expected:?}"
                );
                assert!(
                    (of_volume[c] / expected[1][c] - 1.0).abs() <= 0.1,
                    "{transmission:?} {thickness} mm: {of_volume:?}, expected {expected:?}"
                );
                assert!(of_volume[c] > found[c] && dark[c] == 0.0, "{transmission:?} {thickness} mm: {dark:?}");
            }
            assert!(found[0] > found[1] && found[1] > found[2], "{found:?}");
        }
        // The thinner, the more: all of it comes through nothing.
        assert!(through(0.2, transmission, false, 1.0)[0] > 0.85);
    }
}

#[test]
fn channels_show_skin_and_nothing_else() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let found_at = |name: &'static str, mut left: Primitive, diffuse: SkinDiffuse| {
        let skin = Skin { diffuse, ..Skin::default() };
        left.positions.iter_mut().for_each(|p| p[0] -= 0.005);
        let beside = (square([0.008, 0.0], 0.002, 0.0), Material::default());
        let shot = seen([64, 32], 0.5, 1.0, Vec3::new(0.6, 0.0, 0.8));
        let picture = shown(&renderer, &scene(vec![(left, colored(0.6, skin)), beside]), Channel::Look(name), &shot);
        for (x, y) in [(48, 16), (62, 2)] {
            assert_eq!(picture.at(x, y)[..3], [0.0; 3], "{name} beside skin");
        }
        picture.at(22, 16)
    };
    let ball = || sphere(0.01, 64, 128);
    for diffuse in [SkinDiffuse::PreIntegrated, SkinDiffuse::ScreenSpace, SkinDiffuse::ScreenSpaceDisc] {
        for name in [
            "skin-irradiance",
            "skin-scattered",
            "skin-specular",
            "skin-thickness",
            "skin-occlusion",
            "skin-curvature",
            "skin-profile",
        ] {
            let found = found_at(name, ball(), diffuse);
            assert!(found[..3].iter().any(|c| *c > 0.01), "{name}: {found:?}");
        }
    }
    let curvature = |of: Primitive| found_at("skin-curvature", of, SkinDiffuse::PreIntegrated);
    // White is 0.5/mm. The mesh and a code of 8 bits are within 2 %.
    let bulge = curvature(ball());
    assert!(bulge[..3].iter().all(|c| (c / 0.2 - 1.0).abs() < 0.02), "{bulge:?}");
    let mut hollow = ball();
    hollow.indices.chunks_exact_mut(3).for_each(|t| t.swap(1, 2));
    hollow.normals.iter_mut().for_each(|n| *n = n.map(|c| -c));
    let hollow = curvature(hollow);
    assert!(hollow[..2] == [0.0; 2] && (hollow[2] / 0.2 - 1.0).abs() < 0.02, "{hollow:?}");
    // White is 10 mm. Narrow, as it stands beside others.
    let mut slab = plate(0.003);
    slab.positions.iter_mut().for_each(|p| p[0] *= 0.4);
    let thickness = found_at("skin-thickness", slab, SkinDiffuse::PreIntegrated);
    assert!(thickness[..3].iter().all(|c| (c / 0.3 - 1.0).abs() < 0.02), "{thickness:?}");
}

#[test]
fn bad_numbers_of_skin_are_refused_by_name() {
    let gpu = gpu();
    let renderer = renderer(&gpu);
    let fault = |skin: Skin| match renderer.upload(&scene(vec![(sphere(0.01, 8, 16), white(skin))])) {
        Err(Error::Argument { what, message }) => format!("{what}: {message}"),
        Ok(_) => panic!("it is taken: {skin:?}"),
        Err(other) => panic!("{other}"),
    };
    for bad in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        let mut profile = DiffusionProfile::default();
        profile.scattering_distance_mm[1] = bad;
        let found = fault(Skin { profile, ..Skin::default() });
        assert!(found.contains("skin.profile.scattering_distance_mm"), "{found}");
    }
    for (name, skin) in [
        ("skin.taps", Skin { taps: 0, ..Skin::default() }),
        ("skin.taps", Skin { taps: 41, ..Skin::default() }),
        ("skin.roughness", Skin { roughness: 0.0, ..Skin::default() }),
        ("skin.roughness", Skin { roughness: f32::NAN, ..Skin::default() }),
        ("skin.natural", Skin { natural: 1.5, ..Skin::default() }),
        ("skin.occlusion", Skin { occlusion: 1.1, ..Skin::default() }),
        ("skin.transmission", Skin { transmission: -0.1, ..Skin::default() }),
        ("skin.lobes", Skin { lobes: [0.75, 0.0], ..Skin::default() }),
    ] {
        let found = fault(skin);
        assert!(found.contains(name), "{found}");
    }
}

#[test]
fn each_picture_of_skin_has_the_same_bits() {
    let gpu = gpu();
    let ball = scene(vec![(
        sphere(0.01, 32, 64),
        colored(0.6, Skin { diffuse: SkinDiffuse::ScreenSpace, ..Skin::default() }),
    )]);
    let shot = seen([64, 64], 0.4, 1.0, Vec3::new(1.0, 0.3, 0.2).normalize());
    let bits = |renderer: &Renderer| -> Vec<u32> {
        shoot(renderer, &gpu, &ball, &shot).texels.as_flattened().iter().map(|x| x.to_bits()).collect()
    };
    let one = renderer(&gpu);
    let first = bits(&one);
    assert!(first.iter().any(|b| *b != 0));
    assert!(first == bits(&one) && first == bits(&renderer(&gpu)));
}
