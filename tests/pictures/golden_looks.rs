//! Pictures of the body looks that were looked at: a row of each over light from the left to behind.

use glam::{Quat, Vec3};
use hikage::Background;
use hikage::color::{LinearRgb, Srgb};
use hikage::golden::{Goldens, Tolerance};
use hikage::material::{
    Alpha, AlphaMode, Base, Decal, Decals, DepthRim, Diamond, Dissolve, DitherFade, Emission, Fire, Fluff, Gem, Glow,
    InnerLines, Material, Outline, OutlineWidth, Shading, ShapedHighlight, Sparkle, Stocking, TextureRef, Toon,
};
use hikage::scene::{Ambient, Bloom, Image, Post, PunctualLight, Scene, ToneCurve};

use crate::support::{
    Lent, Shoot, Shot, cube, gpu, render, scene, sphere, square, staged, texture, two_tone, view, with_renderer,
};

/// Another driver may round edges and ramps differently, never more.
const TOLERANCE: Tolerance = Tolerance { channel: 6, outliers: 0.006, blob: 16, drift: 1.0 };

pub(crate) fn check(name: &str, rows: &[Image]) {
    let pixels = rows.iter().flat_map(|row| row.pixels.iter().copied()).collect();
    let picture = Image { height: rows.iter().map(|r| r.height).sum(), pixels, ..rows[0].clone() };
    let goldens =
        Goldens { bless_command: "cargo xtask goldens --bless {name}".to_owned(), ..Goldens::new("tests/golden") };
    if let Err(error) = goldens.check(name, &picture, &TOLERANCE) {
        panic!("{error}");
    }
}

pub(crate) fn beside(pictures: &[Image]) -> Image {
    let (width, height) = (pictures.iter().map(|p| p.width).sum(), pictures[0].height);
    let mut pixels = Vec::new();
    for y in 0..height as usize {
        for p in pictures {
            let row = p.width as usize * 4;
            pixels.extend_from_slice(&p.pixels[y * row..(y + 1) * row]);
        }
    }
    Image { width, height, pixels, ..pictures[0].clone() }
}

const PANEL: u32 = 128;

/// Pictures are drawn twice as fine and averaged, so that what one driver puts a pixel farther weighs less.
pub(crate) fn averaged(image: &Image) -> Image {
    let (width, height) = (image.width / 2, image.height / 2);
    let at = |x: u32, y: u32, c: usize| u32::from(image.pixels[(y * image.width + x) as usize * 4 + c]);
    let mean = |x: u32, y: u32, c: usize| {
        let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| at(2 * x + i, 2 * y + j, c));
        ((four.iter().sum::<u32>() + 2) / 4) as u8
    };
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels = texels.flat_map(|(x, y)| [0, 1, 2, 3].map(|c| mean(x, y, c))).collect();
    Image { width, height, pixels, ..image.clone() }
}

/// Shows something of one metre from the front.
pub(crate) fn panel_view() -> Shot {
    let mut view = view(2 * PANEL, 10.0);
    view.camera.fov_y_rad = 2.0 * 0.06f32.atan();
    view.lights.ambient = Ambient::uniform(LinearRgb::splat(0.12));
    view
}

/// A scene under light that comes round it; each picture by what `change` makes of its view.
fn sweep(gpu: &Lent, scene: &Scene, change: impl Fn(&mut Shot, usize)) -> Image {
    with_renderer(gpu, |renderer| {
        let mut uploaded = staged(renderer.upload(scene));
        let pictures: Vec<Image> = [-60.0f32, -20.0, 30.0, 75.0, 115.0]
            .into_iter()
            .enumerate()
            .map(|(i, degrees)| {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let mut view = panel_view();
                view.lights.directional.to_light = Vec3::new(sin, 0.45, cos).normalize();
                change(&mut view, i);
                averaged(&renderer.shoot(&mut uploaded, &view).expect("a picture"))
            })
            .collect();
        beside(&pictures)
    })
}

pub(crate) fn ball(material: Material) -> Scene {
    scene(vec![(sphere(0.5, 64, 128), material)])
}

fn metal() -> Material {
    Material {
        base: Base { color: [0.55, 0.32, 0.08, 1.0], texture: None },
        shading: Shading::Toon(Toon { shade_color: [0.2, 0.08, 0.05], toony: 0.8, ..Toon::default() }),
        ..Material::default()
    }
}

/// Round, moved and split, squashed, square, brushed, painted.
#[test]
fn shaped_highlights() {
    let gpu = gpu();
    let shape = ShapedHighlight { color: [1.0, 0.95, 0.8], strength: 0.7, ..ShapedHighlight::default() };
    let shapes = [
        shape,
        ShapedHighlight { split: [0.06, 0.05], square: 1.0, rotate_rad: 0.3, size_rad: 0.3, ..shape },
        ShapedHighlight { squash: 0.8, translate: [0.1, 0.15], rotate_rad: 0.6, ..shape },
        ShapedHighlight { anisotropy: 0.9, size_rad: 0.12, ..shape },
    ];
    let mut rows: Vec<Image> = shapes
        .into_iter()
        .map(|s| sweep(&gpu, &ball(Material { shaped_highlight: Some(s), ..metal() }), |_, _| ()))
        .collect();
    let mut painted = ball(metal());
    let star = texture(&mut painted, 64, 64, |x, y| {
        let (u, v) = ((x as f32 - 31.5).abs(), (y as f32 - 31.5).abs());
        [((60.0 - u * v).min((28.0 - u - v) * 8.0) * 6.0).clamp(0.0, 255.0) as u8; 4]
    });
    painted.materials[0].shaped_highlight = Some(ShapedHighlight { map: Some(star), ..shape });
    rows.push(sweep(&gpu, &painted, |_, _| ()));
    check("shaped-highlight", &rows);
}

/// Amber with inclusions, ruby, jade.
#[test]
fn gems() {
    let gpu = gpu();
    let rows: Vec<Image> = [Gem::amber(), Gem::ruby(), Gem::jade()]
        .into_iter()
        .enumerate()
        .map(|(i, gem)| {
            let mut stone = ball(Material::default());
            let bubbles = texture(&mut stone, 128, 64, |x, y| {
                let (u, v) = ((x % 32) as f32 - 16.0, (y % 32) as f32 - 16.0);
                let r = u.hypot(v);
                let ring = ((x / 32 + y / 32) % 3 == 0) && (4.0..6.0).contains(&r);
                if ring { [255, 240, 200, 220] } else { [60, 30, 10, 0] }
            });
            stone.materials[0].gem = Some(Gem { inclusions: (i == 0).then_some(bubbles), uv_per_m: 8.0, ..gem });
            sweep(&gpu, &stone, |_, _| ())
        })
        .collect();
    check("gems", &rows);
}

/// A cut stone of flat facets, and a smooth one, turned under one light.
#[test]
fn diamonds() {
    let gpu = gpu();
    let material = Material {
        // Two reflections: each more makes shards smaller, until drivers differ in which pixels they cover.
        diamond: Some(Diamond { bounces: 2, ..Diamond::default() }),
        ..Material::default()
    };
    let mut cut = cube(0.36);
    // A cube on its corner has facets towards the viewer.
    let turn = Quat::from_rotation_arc(Vec3::ONE.normalize(), Vec3::new(0.15, 0.25, 0.95).normalize());
    let turned = |v: &mut [f32; 3]| *v = (turn * Vec3::from_array(*v)).to_array();
    cut.positions.iter_mut().for_each(turned);
    cut.normals.iter_mut().for_each(turned);
    cut.outline_normals.iter_mut().for_each(turned);
    cut.tangents = cut
        .normals
        .iter()
        .map(|n| {
            let t = Vec3::from_array(*n).any_orthonormal_vector();
            [t.x, t.y, t.z, 1.0]
        })
        .collect();
    let scenes = [scene(vec![(cut, material.clone())]), ball(material)];
    let rows: Vec<Image> = scenes
        .iter()
        .map(|scene| {
            sweep(&gpu, scene, |view, i| {
                view.lights.directional.to_light = Vec3::new(-0.3, 0.6, 0.75).normalize();
                view.camera.eye = Quat::from_rotation_y(i as f32 * 0.05) * view.camera.eye;
            })
        })
        .collect();
    check("diamond", &rows);
}

/// Fire over a period, orange and blue, over a dark and a light background; one that nobody drew a shape for.
#[test]
fn fires() {
    let gpu = gpu();
    let rows: Vec<Image> =
        [(Fire::default(), [0x28; 3], true), (Fire::blue(), [0xd0; 3], true), (Fire::default(), [0x28; 3], false)]
            .into_iter()
            .map(|(fire, background, is_drawn)| {
                let mut flame = scene(vec![(square([0.0, 0.0], 0.5, 0.0), Material::default())]);
                let heat = texture(&mut flame, 64, 64, |x, y| {
                    let (u, v) = ((x as f32 / 63.0 - 0.5).abs(), y as f32 / 63.0);
                    let half = 0.36 * v.powf(0.8) * (1.0 - v.powi(6));
                    [(((half - u) / 0.3).clamp(0.0, 1.0) * 255.0) as u8; 4]
                });
                flame.materials[0] = Material {
                    alpha: Alpha { mode: AlphaMode::Blend, ..Alpha::default() },
                    fire: Some(Fire { heat: is_drawn.then_some(heat), ..fire }),
                    ..Material::default()
                };
                sweep(&gpu, &flame, |view, i| {
                    view.time_s = i as f32 * 0.4;
                    view.background = Background::Color(Srgb(background));
                })
            })
            .collect();
    check("fire", &rows);
}

/// A ball of fluff, near and far.
#[test]
fn fluff() {
    let gpu = gpu();
    let fluff = Fluff { length_m: 0.09, density: 48.0, gravity_m: 0.03, ..Fluff::default() };
    let material = Material {
        base: Base { color: [0.95, 0.85, 0.8, 1.0], texture: None },
        shading: Shading::Toon(Toon { shade_color: [0.62, 0.5, 0.66], toony: 0.9, ..Toon::default() }),
        fluff: Some(fluff),
        ..Material::default()
    };
    let rows = [1.15f32, 4.0].map(|zoom| sweep(&gpu, &ball(material.clone()), |view, _| view.camera.fov_y_rad *= zoom));
    check("fluff", &rows);
}

/// Sparks on a dark ball.
#[test]
fn sparkles() {
    let gpu = gpu();
    let material = Material {
        base: Base { color: [0.1, 0.05, 0.2, 1.0], texture: None },
        shading: Shading::Toon(Toon { shade_color: [0.04, 0.02, 0.1], ..Toon::default() }),
        sparkle: Some(Sparkle { color: [1.0, 0.9, 1.0], ..Sparkle::default() }),
        ..Material::default()
    };
    check("sparkle", &[sweep(&gpu, &ball(material), |_, _| ())]);
}

/// Rims of two colours, with a lamp on the left in the second row.
#[test]
fn rims_by_depth() {
    let gpu = gpu();
    let rim = DepthRim { width_px: 40.0, threshold_m: 0.25, shade_color: [0.1, 0.2, 0.6], ..DepthRim::default() };
    let scene = ball(Material { depth_rim: Some(rim), ..two_tone() });
    let plain = sweep(&gpu, &scene, |_, _| ());
    let lamp = sweep(&gpu, &scene, |view, _| {
        view.lights.punctual = vec![PunctualLight {
            position: Vec3::new(-1.5, -1.0, 0.5),
            color: LinearRgb([1.0, 0.7, 0.2]),
            intensity: 0.8,
            range: 0.0,
            spot: None,
        }];
    });
    check("depth-rim-details", &[plain, lamp]);
}

/// Lines between parts and along folds.
#[test]
fn inner_lines() {
    let gpu = gpu();
    let lined = |color: [f32; 4]| Material {
        base: Base { color, texture: None },
        inner_lines: Some(InnerLines { width_px: 16.0, step_m: 0.1, ..InnerLines::default() }),
        ..two_tone()
    };
    let mut block = cube(0.28);
    let turn = Quat::from_rotation_y(0.6) * Quat::from_rotation_x(0.5);
    let turned = |v: &mut [f32; 3]| *v = (turn * Vec3::from_array(*v)).to_array();
    block.positions.iter_mut().for_each(turned);
    block.normals.iter_mut().for_each(turned);
    let mut head = sphere(0.24, 48, 96);
    head.positions.iter_mut().for_each(|p| p[1] += 0.34);
    let scene = scene(vec![(block, lined([0.4, 0.6, 0.9, 1.0])), (head, lined([0.9, 0.8, 0.5, 1.0]))]);
    check("inner-lines", &[sweep(&gpu, &scene, |_, _| ())]);
}

/// What vanishes: burnt from whole to nothing, faded the same way.
#[test]
fn vanishing() {
    let gpu = gpu();
    let burnt = beside(&[0.0f32, 0.25, 0.5, 0.75, 0.95].map(|amount| {
        let dissolve = Some(Dissolve { amount, cell_m: 0.2, ..Dissolve::default() });
        let outline = Some(Outline { width: OutlineWidth::World { metres: 0.015 }, ..Outline::default() });
        averaged(&render(&gpu, &ball(Material { dissolve, outline, ..two_tone() }), &panel_view()))
    }));
    let faded = beside(&[1.0f32, 0.8, 0.5, 0.3, 0.1].map(|opacity| {
        let dither_fade = Some(DitherFade { opacity, ..DitherFade::default() });
        averaged(&render(&gpu, &ball(Material { dither_fade, ..two_tone() }), &panel_view()))
    }));
    check("vanishing", &[burnt, faded]);
}

/// Stockings of three strengths and a decal in the light and in shade.
#[test]
fn overlays() {
    let gpu = gpu();
    let skin = Material {
        base: Base { color: [0.95, 0.72, 0.62, 1.0], texture: None },
        shading: Shading::Toon(Toon { shade_color: [0.72, 0.4, 0.38], ..Toon::default() }),
        ..Material::default()
    };
    let mut rows: Vec<Image> = [0.25f32, 0.7]
        .into_iter()
        .map(|cover| {
            let stocking = Some(Stocking { cover, ..Stocking::default() });
            sweep(&gpu, &ball(Material { stocking, ..skin.clone() }), |_, _| ())
        })
        .collect();
    let mut marked = ball(skin);
    let map: TextureRef = texture(&mut marked, 64, 64, |x, y| {
        let (u, v) = (x as f32 / 31.5 - 1.0, y as f32 / 31.5 - 1.0);
        let inside = (u * u + v * v - 0.45).powi(3) + u * u * v.powi(3) < 0.0;
        [220, 30, 70, if inside { 255 } else { 0 }]
    });
    let placed = vec![
        Decal { middle: [0.5, 0.5], size: [0.12, 0.24], ..Decal::default() },
        Decal { middle: [0.6, 0.36], size: [0.08, 0.16], rotation_rad: 0.6, multiplies: true, ..Decal::default() },
    ];
    marked.materials[0].decals = Some(Decals { map: Some(map), placed });
    rows.push(sweep(&gpu, &marked, |_, _| ()));
    check("overlays", &rows);
}

/// Light beyond white under each tone curve; bloom of what glows; the same over nothing.
#[test]
fn post() {
    let gpu = gpu();
    let rows: Vec<Image> = [ToneCurve::None, ToneCurve::Filmic, ToneCurve::Neutral]
        .into_iter()
        .map(|tone| {
            let material = Material {
                emission: Emission { color: [0.9, 0.35, 0.05], ..Emission::default() },
                glow: Some(Glow::default()),
                ..two_tone()
            };
            let mut scene = ball(material);
            scene.post = Some(Post { bloom: Some(Bloom::default()), tone, ..Post::default() });
            sweep(&gpu, &scene, |view, i| {
                view.camera.fov_y_rad *= 1.5;
                view.lights.directional.intensity = 1.0 + i as f32 * 0.5;
                view.background = match i % 2 {
                    0 => Background::Color(Srgb([0x20, 0x24, 0x30])),
                    _ => Background::Transparent,
                };
            })
        })
        .collect();
    check("post", &rows);
}
