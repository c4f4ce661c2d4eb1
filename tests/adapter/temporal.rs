//! Edges that are smoothed over several pictures: means of stills, noise of hashed alpha, and windows.

use glam::Vec3;
use hikage::color::{linear_from_srgb, srgb_from_linear};
use hikage::material::{Alpha, AlphaMode, Base, Material, Outline, OutlineWidth, Shading};
use hikage::scene::{Antialias, Image, Post, Scene, ToneCurve};
use hikage::{Actor, Background, Channel, Gpu, Grid, Ground, Output, Renderer, Stage, View};

use crate::support::{cube, gpu, scene, sphere, square, texture, two_tone, view};

/// Samples along a pixel of the reference.
const FINE: u32 = 8;

/// Premultiplied linear light.
pub(crate) type Light = [f32; 4];

pub(crate) fn light_of(p: &[u8]) -> Light {
    let alpha = f32::from(p[3]) / 255.0;
    let [r, g, b] = [0, 1, 2].map(|i| linear_from_srgb(f32::from(p[i]) / 255.0) * alpha);
    [r, g, b, alpha]
}

/// A picture as large as `size`, of one that is drawn larger: the mean of each block in linear light, and the greatest
/// difference within it.
pub(crate) fn boxed(fine: &Image, size: [u32; 2]) -> Vec<(Light, f32)> {
    let by = fine.width / size[0];
    let block = |x: u32, y: u32| {
        let (mut sum, mut low, mut high) = ([0.0; 4], [f32::MAX; 4], [f32::MIN; 4]);
        for (dx, dy) in (0..by).flat_map(|dy| (0..by).map(move |dx| (dx, dy))) {
            let at = (((y * by + dy) * fine.width + x * by + dx) * 4) as usize;
            let light = light_of(&fine.pixels[at..at + 4]);
            for i in 0..4 {
                sum[i] += light[i] / (by * by) as f32;
                (low[i], high[i]) = (low[i].min(light[i]), high[i].max(light[i]));
            }
        }
        (sum, (0..4).map(|i| high[i] - low[i]).fold(0.0, f32::max))
    };
    (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| block(x, y))).collect()
}

/// How far a picture is from the mean of a larger one.
#[derive(Debug)]
pub(crate) struct Off {
    /// Mean over all pixels and channels, encoded as the picture is, 0..1.
    pub mean: f32,
    /// Mean of squares over pixels in which something differs, linear light.
    pub edges: f32,
    pub edge_count: usize,
}

fn off(found: &Image, expected: &[(Light, f32)]) -> Off {
    let found: Vec<Light> = found.pixels.chunks_exact(4).map(light_of).collect();
    off_lights(&found, expected)
}

pub(crate) fn off_lights(found: &[Light], expected: &[(Light, f32)]) -> Off {
    let (mut mean, mut edges, mut edge_count) = (0.0, 0.0, 0);
    for (found, (light, spread)) in found.iter().zip(expected) {
        let code = |l: &Light| [srgb_from_linear(l[0]), srgb_from_linear(l[1]), srgb_from_linear(l[2]), l[3]];
        mean += code(found).iter().zip(code(light)).map(|(a, b)| (a - b).abs()).sum::<f32>() / 4.0;
        if *spread > 0.05 {
            edges += found.iter().zip(light).map(|(a, b)| (a - b).powi(2)).sum::<f32>() / 4.0;
            edge_count += 1;
        }
    }
    Off { mean: mean / expected.len() as f32, edges: edges / edge_count.max(1) as f32, edge_count }
}

/// A turned cube with lines round it, a ball, and a card with holes.
pub(crate) fn still_life(outline: Option<OutlineWidth>) -> Scene {
    let lined = |m: Material| Material { outline: outline.map(|width| Outline { width, ..Outline::default() }), ..m };
    let mut ball = sphere(0.28, 24, 48);
    ball.positions.iter_mut().for_each(|p| *p = [p[0] + 0.35, p[1] - 0.2, p[2] + 0.1]);
    let mut turned = cube(0.22);
    let turn = glam::Quat::from_euler(glam::EulerRot::XYZ, 0.5, 0.6, 0.2);
    for (p, n) in turned.positions.iter_mut().zip(&mut turned.normals) {
        *p = (turn * Vec3::from(*p) + Vec3::new(-0.35, 0.25, 0.0)).to_array();
        *n = (turn * Vec3::from(*n)).to_array();
    }
    turned.outline_normals.iter_mut().for_each(|n| *n = (turn * Vec3::from(*n)).to_array());
    let mut made = scene(vec![
        (turned, lined(two_tone())),
        (ball, lined(two_tone())),
        (square([-0.3, -0.35], 0.25, 0.2), Material::default()),
    ]);
    let holes = texture(&mut made, 64, 64, |x, y| {
        let away = ((x as f32 - 31.5).powi(2) + (y as f32 - 31.5).powi(2)).sqrt();
        [90, 200, 160, (127.0 + (away * 0.45).cos() * 127.0) as u8]
    });
    made.materials[2] = Material {
        shading: Shading::Unlit,
        base: Base { texture: Some(holes), ..Base::default() },
        alpha: Alpha { mode: AlphaMode::Mask, ..Alpha::default() },
        double_sided: true,
        ..Material::default()
    };
    made
}

pub(crate) fn output(samples: u32) -> Output {
    Output { samples, ..Output::default() }
}

pub(crate) fn staged(renderer: &Renderer, scene: &Scene) -> Stage {
    let mut stage = Stage::of([Actor::new(&renderer.upload(scene).expect("an upload"))]);
    stage.lights = view(1, 1.0).lights;
    stage
}

/// What a view would be with as many samples a pixel as there are.
pub(crate) fn reference(gpu: &Gpu, scene: &Scene, set: impl Fn(&mut Stage), view: &View) -> Vec<(Light, f32)> {
    let renderer = Renderer::with_output(gpu, output(1)).expect("a renderer");
    let mut stage = staged(&renderer, scene);
    set(&mut stage);
    stage.post = stage.post.map(|post| Post { antialias: Antialias::None, ..post });
    let fine = View { size: view.size.map(|s| s * FINE), ..view.clone() };
    boxed(&renderer.render(&mut stage, &fine).expect("a picture"), view.size)
}

/// The mean of 64 pictures is what a picture with 64 samples a pixel would be: edges, cuts, lines of a width in pixels, ground,
/// transparent background, tone curve.
#[test]
fn the_mean_of_many_pictures_is_one_with_many_samples() {
    let gpu = gpu();
    let shot = view(96, 4.0).view();
    let scene = still_life(Some(OutlineWidth::Screen { height_ratio: 0.01 }));
    let clear = View { background: Background::Transparent, ..shot.clone() };
    let ground = Ground { grid: Some(Grid::default()), middle: Vec3::Y * -0.6, radius_m: 3.0, ..Ground::default() };
    let toned = Post { tone: ToneCurve::Filmic, ..Post::default() };
    let cases = [
        ("colour", &shot, None, None),
        ("clear", &clear, None, None),
        ("ground", &shot, Some(ground), None),
        ("post", &clear, None, Some(toned)),
    ];
    for (name, view, ground, post) in cases {
        let set = |stage: &mut Stage| (stage.ground, stage.post) = (ground.clone(), post);
        let expected = reference(&gpu, &scene, set, view);
        for samples in [1, 4] {
            let renderer = Renderer::with_output(&gpu, output(samples)).expect("a renderer");
            let mut stage = staged(&renderer, &scene);
            set(&mut stage);
            let once = off(&renderer.render(&mut stage, view).expect("a picture"), &expected);
            let found = off(&renderer.render_accumulated(&mut stage, view, 64).expect("a mean"), &expected);
            println!("{name}, {samples} samples: {once:?} -> {found:?}");
            assert!(found.edge_count > 200, "{name}: {found:?}");
            assert!(found.mean <= 1.0 / 255.0 && found.edges < 0.01, "{name}, {samples} samples: {found:?}");
            assert!(found.edges < once.edges, "{name}, {samples} samples: {found:?} is no better than {once:?}");
        }
    }
}

/// One picture is the same as ever, and so is a view without jitter; jitter moves all that is drawn by as much.
#[test]
fn jitter_moves_the_picture_and_nothing_else() {
    let gpu = gpu();
    let mut scene = still_life(None);
    // A cut is a ramp by what a pixel's neighbour in its group of four holds, and that is another one then.
    scene.materials[2].alpha.mode = AlphaMode::Opaque;
    let view = view(96, 4.0).view();
    for samples in [1, 4] {
        let renderer = Renderer::with_output(&gpu, output(samples)).expect("a renderer");
        let mut stage = staged(&renderer, &scene);
        let plain = renderer.render(&mut stage, &view).expect("a picture");
        let one = renderer.render_accumulated(&mut stage, &view, 1).expect("a mean");
        assert!(one.pixels == plain.pixels, "a mean of one picture is that picture");
        let moved = View { jitter_px: [1.0, -1.0], ..view.clone() };
        let moved = renderer.render(&mut stage, &moved).expect("a picture");
        let at = |image: &Image, x: u32, y: u32| {
            let at = ((y * 96 + x) * 4) as usize;
            image.pixels[at..at + 4].to_vec()
        };
        let inner = || (1..95).flat_map(|y| (1..95).map(move |x| (x, y)));
        let others = inner()
            .filter(|&(x, y)| at(&moved, x + 1, y - 1).iter().zip(at(&plain, x, y)).any(|(a, b)| a.abs_diff(b) > 2));
        // Rounding puts a few points on the other side of an edge.
        let others = others.count();
        assert!(others <= 8, "{samples} samples: {others} pixels are others");
    }
}

/// What cannot be averaged is refused with the reason.
#[test]
fn what_has_no_mean_is_refused() {
    let gpu = gpu();
    let renderer = Renderer::with_output(&gpu, output(1)).expect("a renderer");
    let mut stage = staged(&renderer, &still_life(None));
    let view = view(16, 4.0).view();
    let wild = View { jitter_px: [0.0, f32::NAN], ..view.clone() };
    let part_ids = View { channel: Channel::PartId, ..view.clone() };
    for (frames, view, words) in [
        (0, &view, "is 0; expected 1 to 4096"),
        (5000, &view, "is 5000"),
        (4, &part_ids, "part-id"),
        (4, &wild, "jitter"),
    ] {
        let error = renderer.render_accumulated(&mut stage, view, frames).expect_err(words).to_string();
        assert!(error.contains(words), "{error}");
    }
}

/// A card with a constant alpha that fills the picture, and one behind it.
pub(crate) fn veils(count: usize, alpha: f32, mode: AlphaMode) -> Scene {
    let veil = |i: usize| {
        let material = Material {
            shading: Shading::Unlit,
            base: Base { color: [1.0, 1.0, 1.0, alpha], texture: None },
            alpha: Alpha { mode, hashed: true, ..Alpha::default() },
            ..Material::default()
        };
        (square([0.0, 0.0], 1.2, -0.3 * i as f32), material)
    };
    scene((0..count).map(veil).collect())
}

/// Mean and spread of the alpha of a picture.
fn alpha_of(image: &Image) -> (f32, f32) {
    let alphas = || image.pixels.chunks_exact(4).map(|p| f32::from(p[3]) / 255.0);
    let count = alphas().count() as f32;
    let mean = alphas().sum::<f32>() / count;
    (mean, (alphas().map(|a| (a - mean).powi(2)).sum::<f32>() / count).sqrt())
}

/// As much is left of what noise cuts as alpha says: in one picture over its area, in many in each pixel.
#[test]
fn hashed_alpha_covers_as_much_as_alpha_says() {
    let gpu = gpu();
    let view = View { background: Background::Transparent, ..view(96, 4.0).view() };
    for samples in [1, 4] {
        let renderer = Renderer::with_output(&gpu, output(samples)).expect("a renderer");
        for (mode, alpha) in
            (1..=9).map(|i| (if i % 2 == 0 { AlphaMode::Mask } else { AlphaMode::Blend }, i as f32 * 0.1))
        {
            let mut stage = staged(&renderer, &veils(1, alpha, mode));
            let (one, grain) = alpha_of(&renderer.render(&mut stage, &view).expect("a picture"));
            let (many, spread) = alpha_of(&renderer.render_accumulated(&mut stage, &view, 64).expect("a mean"));
            println!("{samples} samples, {mode:?} {alpha}: {one} +- {grain} -> {many} +- {spread}");
            assert!((one - alpha).abs() < 0.03, "{mode:?} {alpha}: {one}");
            assert!((many - alpha).abs() < 0.02 && spread < 0.05, "{mode:?} {alpha}: {many} +- {spread}");
            assert!(samples == 4 || grain > 0.2, "{mode:?} {alpha}: one picture has no grain");
            // Whatever is behind shows through by as much.
            let mut stage = staged(&renderer, &veils(2, alpha, mode));
            let (many, _) = alpha_of(&renderer.render_accumulated(&mut stage, &view, 64).expect("a mean"));
            let expected = 1.0 - (1.0 - alpha).powi(2);
            assert!((many - expected).abs() < 0.03, "two of {alpha}: {many}; expected {expected}");
        }
        for (alpha, left) in [(0.0, 0.0), (1.0, 1.0)] {
            let mut stage = staged(&renderer, &veils(1, alpha, AlphaMode::Blend));
            let found = alpha_of(&renderer.render_accumulated(&mut stage, &view, 8).expect("a mean"));
            assert_eq!(found, (left, 0.0), "alpha {alpha}");
        }
    }
}

/// Noise lies on the surface: while a camera moves by a tenth of a pixel or nearer by half a thousandth, fewer than 8 in 100 of
/// its pixels become others (found: 6), and it goes with the surface. Noise that is another one in each picture would change
/// half of them.
#[test]
fn hashed_alpha_does_not_crawl() {
    let gpu = gpu();
    let renderer = Renderer::with_output(&gpu, output(1)).expect("a renderer");
    let mut stage = staged(&renderer, &veils(1, 0.5, AlphaMode::Blend));
    let still = View { background: Background::Transparent, ..view(96, 4.0).view() };
    let px_m = 2.0 * 4.0 * (10f32.to_radians()).tan() / 96.0;
    let mut drawn = |view: &View| renderer.render(&mut stage, view).expect("a picture");
    let others = |a: &Image, b: &Image, shift: u32| {
        let alpha = |image: &Image, x: u32, y: u32| image.pixels[((y * 96 + x) * 4 + 3) as usize];
        let inner = || (2..94).flat_map(|y| (2..90).map(move |x| (x, y)));
        inner().filter(|&(x, y)| alpha(a, x + shift, y) != alpha(b, x, y)).count() as f32 / inner().count() as f32
    };
    let moved = |right_px: f32, nearer: f32| {
        let mut view = still.clone();
        let by = Vec3::X * right_px * px_m - Vec3::Z * nearer;
        (view.camera.eye, view.camera.target) = (view.camera.eye + by, view.camera.target + by);
        view
    };
    let first = drawn(&still);
    let sideways: Vec<f32> = (1..=10)
        .map(|i| (drawn(&moved(i as f32 * 0.1 - 0.1, 0.0)), drawn(&moved(i as f32 * 0.1, 0.0))))
        .map(|(a, b)| others(&a, &b, 0))
        .collect();
    let nearer: Vec<f32> = (0..10)
        .map(|i| others(&drawn(&moved(0.0, i as f32 * 0.002)), &drawn(&moved(0.0, (i + 1) as f32 * 0.002)), 0))
        .collect();
    let whole = others(&first, &drawn(&moved(3.0, 0.0)), 3);
    println!("sideways {sideways:?}, nearer {nearer:?}, three pixels {whole}");
    assert!(sideways.iter().all(|share| *share < 0.08), "{sideways:?}");
    assert!(nearer.iter().all(|share| *share < 0.08), "{nearer:?}");
    assert!(whole < 0.1, "the grain has not moved with the surface: {whole}");
    let next = drawn(&View { frame: 1, ..still.clone() });
    assert!(others(&first, &next, 0) > 0.3, "the next of many pictures has the same noise");
}
