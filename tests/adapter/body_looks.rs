//! Laws of the body looks, on pictures: what each does, where it ends, and that nothing changes without it.

use glam::Vec3;
use hikage::color::{LinearRgb, Srgb};
use hikage::material::{
    Alpha, AlphaMode, Base, Blink, CastShadow, Decal, Decals, DepthRim, Diamond, Dissolve, DitherFade, Emission, Fire,
    Fluff, Gem, Glow, InnerLines, Material, ShadeRamp, Shading, ShapedHighlight, Sparkle, Stocking, Toon,
};
use hikage::scene::{Ambient, Antialias, Bloom, Image, Post, PunctualLight, Scene, SelfShadow, ToneCurve};
use hikage::{Background, Channel, Output};

use crate::support::{Shot, gpu, pixel, render, render_with, scene, sphere, square, texture, two_tone, view};

fn ball(change: impl FnOnce(&mut Material)) -> Scene {
    let mut material = two_tone();
    change(&mut material);
    scene(vec![(sphere(0.5, 64, 128), material)])
}

/// A ball fills most of the picture.
fn ball_view(size: u32) -> Shot {
    let mut view = view(size, 10.0);
    view.camera.fov_y_rad = 2.0 * (0.06f32).atan();
    view
}

fn difference(a: &Image, b: &Image) -> usize {
    a.pixels
        .chunks(4)
        .zip(b.pixels.chunks(4))
        .filter(|(p, q)| p.iter().zip(*q).any(|(x, y)| x.abs_diff(*y) > 2))
        .count()
}

fn brightness(p: [u8; 4]) -> u32 {
    p[..3].iter().map(|c| u32::from(*c)).sum()
}

/// Every look changes the picture of a ball, and its channel shows something.
#[test]
fn every_look_shows() {
    let gpu = gpu();
    let view = ball_view(128);
    let plain = render(&gpu, &ball(|_| ()), &view);
    type Change = fn(&mut Material);
    let looks: [(Channel, Change); 8] = [
        (Channel::Look("highlight"), |m| m.shaped_highlight = Some(ShapedHighlight::default())),
        (Channel::Look("sparkle"), |m| m.sparkle = Some(Sparkle::default())),
        (Channel::Look("stone"), |m| m.gem = Some(Gem::ruby())),
        (Channel::Look("stone"), |m| m.diamond = Some(Diamond::default())),
        (Channel::Look("fluff"), |m| m.fluff = Some(Fluff { length_m: 0.05, ..Fluff::default() })),
        (Channel::Look("overlay"), |m| m.stocking = Some(Stocking::default())),
        (Channel::Look("dissolve"), |m| m.dissolve = Some(Dissolve { amount: 0.4, ..Dissolve::default() })),
        (Channel::Look("emission"), |m| m.emission = Emission { color: [0.0, 0.4, 0.1], ..Emission::default() }),
    ];
    for (channel, change) in looks {
        let scene = ball(change);
        let shown = render(&gpu, &scene, &view);
        let changed = difference(&plain, &shown);
        assert!(changed > 100, "{channel:?}: {changed} pixels change");
        let seen = render(&gpu, &scene, &Shot { channel, ..view.clone() });
        let bright = seen.pixels.chunks(4).filter(|p| p[..3].iter().any(|c| *c > 40)).count();
        assert!(bright > 60, "{channel:?} shows {bright} pixels");
    }
}

/// A highlight keeps its area while the light moves by thirty degrees, and stays in one piece where it is not split.
#[test]
fn a_shaped_highlight_keeps_its_area() {
    let gpu = gpu();
    let scene =
        ball(|m| m.shaped_highlight = Some(ShapedHighlight { in_shade: 1.0, strength: 1.0, ..Default::default() }));
    let areas: Vec<f64> = [-15.0f32, -7.5, 0.0, 7.5, 15.0]
        .iter()
        .map(|degrees| {
            let yaw = degrees.to_radians();
            let mut view = Shot { channel: Channel::Look("highlight"), ..ball_view(256) };
            view.lights.directional.to_light = Vec3::new(yaw.sin(), 0.2, yaw.cos()).normalize();
            let image = render(&gpu, &scene, &view);
            image.pixels.chunks(4).map(|p| f64::from(p[0]) / 255.0).sum()
        })
        .collect();
    let mean = areas.iter().sum::<f64>() / 5.0;
    assert!(mean > 300.0 && areas.iter().all(|a| (a / mean - 1.0).abs() < 0.1), "{areas:?}");
}

/// The deeper a stone, the darker what shines through it: with twice the depth its colour is squared.
#[test]
fn stones_are_darker_with_depth() {
    let gpu = gpu();
    let view = ball_view(64);
    let shade = |color: [f32; 3]| {
        let gem = Gem { color, cloudiness: 0.0, polish: 0.0, ..Gem::amber() };
        brightness(pixel(&render(&gpu, &ball(|m| m.gem = Some(gem)), &view), 36, 38))
    };
    let thin = [0.7, 0.5, 0.4];
    let thick = thin.map(|c| c * c);
    assert!(shade(thin) > shade(thick) + 30, "{} and {}", shade(thin), shade(thick));
}

/// Sparks flash, but no more than one pixel in twenty changes when a ball turns by a degree; grains stay as far apart on the
/// picture when it comes nearer.
#[test]
fn sparks_do_not_flicker_and_keep_their_number() {
    let gpu = gpu();
    let scene = ball(|m| {
        m.base.color = [0.05, 0.05, 0.05, 1.0];
        m.sparkle = Some(Sparkle { spread: 0.8, ..Sparkle::default() });
    });
    let at = |degrees: f32, zoom: f32| {
        let mut view = Shot { channel: Channel::Look("sparkle"), ..ball_view(256) };
        view.camera.fov_y_rad /= zoom;
        view.lights.directional.to_light = Vec3::new(0.2, 0.3, 1.0).normalize();
        // The light turns with the viewer: only the surface's grains change their angle.
        let yaw = degrees.to_radians();
        let turn = glam::Quat::from_rotation_y(yaw);
        view.camera.eye = turn * view.camera.eye;
        view.lights.directional.to_light = turn * view.lights.directional.to_light;
        render(&gpu, &scene, &view)
    };
    // Grains move with the surface, so the light alone turns for the flicker.
    let lit_from = |degrees: f32| {
        let mut view = Shot { channel: Channel::Look("sparkle"), ..ball_view(256) };
        view.lights.directional.to_light =
            glam::Quat::from_rotation_y(degrees.to_radians()) * Vec3::new(0.2, 0.3, 1.0).normalize();
        render(&gpu, &scene, &view)
    };
    let (still, turned) = (lit_from(0.0), lit_from(1.0));
    let flicker = still.pixels.chunks(4).zip(turned.pixels.chunks(4)).filter(|(a, b)| a[0].abs_diff(b[0]) > 64).count()
        as f64
        / (256.0 * 256.0);
    assert!(flicker < 0.05, "{flicker} of the pixels flicker");
    let lit = |image: &Image| image.pixels.chunks(4).filter(|p| p[0] > 90).count() as f64;
    let (far, near) = (lit(&at(0.0, 1.0)), lit(&at(0.0, 2.5)));
    assert!(far > 100.0 && near > 0.2 * far && near < 5.0 * far, "{far} lit pixels, {near} from nearer");
}

/// Fire is the same after its period, another between, and gone where it is eroded; what it adds leaves the background.
#[test]
fn fire_loops_and_erodes() {
    let gpu = gpu();
    let burning = |fire: Fire| {
        let mut scene = scene(vec![(square([0.0, 0.0], 0.5, 0.0), Material::default())]);
        let heat = texture(&mut scene, 64, 64, |x, y| {
            let (u, v) = (x as f32 / 63.0 - 0.5, y as f32 / 63.0);
            let h = ((1.0 - (u / (0.1 + 0.3 * v)).powi(2)) * v.min(1.0 - v * 0.2) * 1.6).clamp(0.0, 1.0);
            [(h * 255.0) as u8; 4]
        });
        scene.materials[0] = Material {
            alpha: Alpha { mode: AlphaMode::Blend, ..Alpha::default() },
            fire: Some(Fire { heat: Some(heat), ..fire }),
            ..Material::default()
        };
        scene
    };
    let at = |scene: &Scene, time_s: f32| {
        render(&gpu, scene, &Shot { time_s, background: Background::Transparent, ..ball_view(96) })
    };
    let fire = burning(Fire::default());
    let (first, between, after) = (at(&fire, 0.5), at(&fire, 1.4), at(&fire, 2.5));
    assert_eq!(difference(&first, &after), 0, "it begins anew after two seconds");
    assert!(difference(&first, &between) > 200, "it moves");
    let cover = |image: &Image| image.pixels.chunks(4).filter(|p| p[3] > 20).count();
    let counts: Vec<usize> =
        [0.0, 0.2, 0.4, 0.7, 1.0].map(|erosion| cover(&at(&burning(Fire { erosion, ..Fire::default() }), 0.5))).into();
    assert!(counts.windows(2).all(|w| w[1] < w[0]) && counts[4] == 0, "{counts:?}");
}

/// Fluff reaches its length beyond the surface, within a pixel, and its edge is soft.
#[test]
fn fluff_reaches_its_length() {
    let gpu = gpu();
    let mut view = ball_view(256);
    view.background = Background::Color(Srgb([0; 3]));
    // 256 pixels are 1.2 m.
    let px_per_m = 256.0 / 1.2;
    let fluff = Fluff { length_m: 0.06, density: 200.0, gravity_m: 0.0, wind_m: 0.0, ..Fluff::default() };
    let bare = render(&gpu, &ball(|_| ()), &view);
    let soft = render(&gpu, &ball(|m| m.fluff = Some(fluff)), &view);
    let reach = |image: &Image, low: u32| {
        // Mean over rows near the middle, on the lit side: how far left something is seen.
        let rows = 108..148u32;
        let count = rows.len() as f32;
        rows.map(|y| (0..128).find(|x| brightness(pixel(image, *x, y)) > low).unwrap_or(128) as f32).sum::<f32>()
            / count
    };
    let grown = reach(&bare, 40) - reach(&soft, 40);
    let length = 0.06 * px_per_m;
    assert!(grown > length * 0.6 && grown < length + 1.0, "{grown} px, the strands are {length} px long");
    // From the first trace to full brightness takes several pixels: an aliased edge takes one.
    let softness = reach(&soft, 350) - reach(&soft, 40);
    assert!(softness > 2.0, "{softness}");
}

/// Received shadow has exactly the colour of a ramp's dark end.
#[test]
fn received_shadow_is_the_dark_end_of_the_ramp() {
    let gpu = gpu();
    let mut material = two_tone();
    material.shade_ramp =
        Some(ShadeRamp { shade_hue_rad: [0.3, -0.3], shade_saturation: [1.4, 1.2], ..Default::default() });
    material.cast_shadow = Some(CastShadow::default());
    // A plate before a wall, both towards the light; and the wall turned away from it.
    let light = Vec3::new(0.0, 0.5, 1.0).normalize();
    let wall = |normal: [f32; 3]| {
        let mut wall = square([0.0, 0.0], 0.6, -0.2);
        wall.normals = vec![normal; 4];
        let mut scene = scene(vec![(wall, material.clone()), (square([0.0, 0.25], 0.18, 0.1), material.clone())]);
        scene.self_shadow = Some(SelfShadow::default());
        scene
    };
    let mut view = ball_view(128);
    view.lights.directional.to_light = light;
    let shadowed = render(&gpu, &wall([0.0, 0.0, 1.0]), &view);
    let turned = render(&gpu, &wall([0.0, 0.0, -1.0]), &view);
    // Below the plate, where its shadow falls.
    let (x, y) = (64, 53 + 16);
    assert_eq!(pixel(&shadowed, x, y), pixel(&turned, x, y), "shadow and shade are one colour");
    assert!(
        brightness(pixel(&shadowed, 8 + 20, 110)) > brightness(pixel(&shadowed, x, y)),
        "the wall is lit elsewhere"
    );
}

/// A rim takes the colour of the side, the mask of its width, the light of lamps, and fades with distance.
#[test]
fn rims_have_sides_masks_lamps_and_an_end() {
    let gpu = gpu();
    let mut view = ball_view(256);
    view.lights.directional.to_light = Vec3::X;
    let rim = DepthRim { color: [1.0; 3], tint: 0.0, width_px: 16.0, ..DepthRim::default() };
    let rimmed = |rim: DepthRim| ball(move |m| m.depth_rim = Some(rim));
    let bare = render(&gpu, &ball(|_| ()), &view);
    let gained = |image: &Image, columns: std::ops::Range<u32>| -> u32 {
        columns.map(|x| brightness(pixel(image, x, 128)).saturating_sub(brightness(pixel(&bare, x, 128)))).sum()
    };
    let one = render(&gpu, &rimmed(rim), &view);
    assert!(gained(&one, 128..256) > 100 && gained(&one, 0..128) < 20, "only the lit side has one");
    let both = render(&gpu, &rimmed(DepthRim { shade_color: [0.0, 0.2, 0.8], ..rim }), &view);
    assert!(gained(&both, 0..128) > 100, "the shaded side has its own");
    let far = render(&gpu, &rimmed(DepthRim { fade_m: [4.0, 8.0], ..rim }), &view);
    assert!(gained(&far, 0..256) < 20, "ten metres away it has faded");
    // A lamp on the left draws a rim there.
    let mut lamp = view.clone();
    lamp.lights.punctual = vec![PunctualLight {
        position: Vec3::new(-3.0, 0.0, 0.5),
        color: LinearRgb::splat(1.0),
        intensity: 8.0,
        range: 0.0,
        spot: None,
    }];
    let dark = render(&gpu, &rimmed(DepthRim { punctual: 0.0, ..rim }), &lamp);
    let lit = render(&gpu, &rimmed(rim), &lamp);
    let left = |image: &Image| (0..128).map(|x| brightness(pixel(image, x, 128))).sum::<u32>();
    assert!(left(&lit) > left(&dark) + 60, "{} and {}", left(&lit), left(&dark));
    // A mask that is black above and white below.
    let mut masked = rimmed(rim);
    let mask = texture(&mut masked, 4, 16, |_, y| [if y < 8 { 0 } else { 255 }; 4]);
    masked.materials[0].depth_rim = Some(DepthRim { width_mask: Some(mask), light_side: [-1.5, -1.2], ..rim });
    let image = render(&gpu, &masked, &Shot { channel: Channel::Look("depth-rim"), ..view.clone() });
    let rows = |rows: std::ops::Range<u32>| {
        rows.map(|y| (0..256).filter(|x| pixel(&image, *x, y)[0] > 99).count()).sum::<usize>()
    };
    assert!(rows(40..110) == 0 && rows(150..220) > 60, "{} above, {} below", rows(40..110), rows(150..220));
}

/// Inner lines stand on borders of parts and folds, have their width, and leave shallow folds and the contour alone.
#[test]
fn inner_lines_are_drawn_where_surfaces_meet() {
    let gpu = gpu();
    let material = |lines: InnerLines| {
        let mut material = two_tone();
        material.inner_lines = Some(lines);
        material
    };
    let halves = |lines: InnerLines, right_normal: [f32; 3]| {
        let mut right = square([0.25, 0.0], 0.25, 0.0);
        right.normals = vec![right_normal; 4];
        scene(vec![(square([-0.25, 0.0], 0.25, 0.0), material(lines)), (right, material(lines))])
    };
    let view =
        Shot { channel: Channel::Look("inner-lines"), background: Background::Color(Srgb([0; 3])), ..ball_view(512) };
    let line = |scene: &Scene| {
        let image = render(&gpu, scene, &view);
        (0..512).map(|x| f32::from(pixel(&image, x, 256)[0]) / 255.0).map(hikage::color::linear_from_srgb).sum::<f32>()
    };
    let lines = InnerLines { width_px: 8.0, ..InnerLines::default() };
    let found = line(&halves(lines, [0.0, 0.0, 1.0]));
    // Half as high as the picture that widths are given for.
    assert!((found - 4.0).abs() <= 1.5, "{found} px, expected 4");
    let folds = InnerLines { between_parts: false, ..lines };
    assert_eq!(line(&halves(folds, [0.3, 0.0, 0.954])), 0.0, "a shallow fold has none");
    assert!((line(&halves(folds, [0.9, 0.0, 0.436])) - 4.0).abs() <= 1.5, "a sharp fold has one");
    // A line multiplies: in the dark it is dark.
    let mut dark = view.clone();
    dark.channel = Channel::Final;
    dark.lights.directional.intensity = 0.0;
    let image = render(&gpu, &halves(lines, [0.0, 0.0, 1.0]), &dark);
    assert!(image.pixels.chunks(4).all(|p| p[..3] == [0; 3]), "a line never glows");
}

/// Post keeps transparent backgrounds and their colours, changes nothing by itself, and lets only what glows spread.
#[test]
fn post_spreads_what_glows_and_keeps_backgrounds() {
    let gpu = gpu();
    let with = |post: Option<Post>, glow: Option<Glow>| {
        let mut scene = ball(|m| {
            m.emission = Emission { color: [0.2, 1.5, 0.4], ..Emission::default() };
            m.glow = glow;
        });
        scene.post = post;
        scene
    };
    let bloom = Post { bloom: Some(Bloom::default()), ..Post::default() };
    let mut view = ball_view(128);
    for background in [Background::Transparent, Background::Color(Srgb([0xdf, 0xe7, 0xee]))] {
        view.background = background;
        let plain = render(&gpu, &with(None, None), &view);
        for tone in [ToneCurve::None, ToneCurve::Filmic, ToneCurve::Neutral] {
            let post = render(&gpu, &with(Some(Post { tone, ..Post::default() }), None), &view);
            assert_eq!(pixel(&post, 2, 2), pixel(&plain, 2, 2), "{tone:?} keeps {background:?}");
        }
        // Half floats round, and edges are mixed before they are cut at white.
        let same = render(&gpu, &with(Some(Post::default()), None), &view);
        assert!(difference(&plain, &same) < 700, "{} pixels change", difference(&plain, &same));
        let silent = render(&gpu, &with(Some(bloom), None), &view);
        assert_eq!(silent.pixels, same.pixels, "without a glow nothing spreads");
        let spread = render(&gpu, &with(Some(bloom), Some(Glow::default())), &view);
        assert!(brightness(pixel(&spread, 9, 64)) != brightness(pixel(&same, 9, 64)), "light spreads beside the ball");
        assert_eq!(pixel(&spread, 0, 0)[3], pixel(&plain, 0, 0)[3], "far away the background is as it was");
    }
}

/// Light that blooms is hidden by what stands before it, and fades with what shines.
#[test]
fn glow_is_hidden_and_fades() {
    let gpu = gpu();
    let view = ball_view(128);
    let with = |wall_z: f32, glow: bool, opacity: f32| {
        let lamp = Material {
            emission: Emission { color: [1.5; 3], ..Emission::default() },
            glow: glow.then(Glow::default),
            dither_fade: Some(DitherFade { opacity, ..DitherFade::default() }),
            ..two_tone()
        };
        let mut scene =
            scene(vec![(square([0.0, 0.0], 0.2, 0.0), lamp), (square([0.0, 0.0], 0.3, wall_z), two_tone())]);
        scene.post = Some(Post { bloom: Some(Bloom::default()), ..Post::default() });
        render(&gpu, &scene, &view)
    };
    let change = |wall_z, opacity| difference(&with(wall_z, true, opacity), &with(wall_z, false, opacity));
    assert_eq!(change(0.1, 1.0), 0, "behind a wall nothing of it is seen");
    assert!(change(-0.1, 1.0) > 500, "before the wall it spreads");
    assert_eq!(change(-0.1, 0.0), 0, "what has faded does not shine");
}

/// With one sample a pixel, post smooths the edge of a ball.
#[test]
fn post_smooths_edges_of_one_sample() {
    let gpu = gpu();
    let mut view = ball_view(128);
    view.background = Background::Color(Srgb([0; 3]));
    let edge_values = |antialias| {
        let mut scene = ball(|m| m.shading = Shading::Unlit);
        scene.post = Some(Post { antialias, ..Post::default() });
        let image = render_with(&gpu, &scene, &view, Output { samples: 1, ..Output::default() });
        image.pixels.chunks(4).filter(|p| p[0] > 20 && p[0] < 225).count()
    };
    assert_eq!(edge_values(Antialias::None), 0, "one sample has hard edges");
    assert!(edge_values(Antialias::Fxaa) > 150, "{} pixels lie between", edge_values(Antialias::Fxaa));
}

/// Dissolve takes the surface away from whole to nothing, and so does fading; both leave what is left in place.
#[test]
fn surfaces_vanish() {
    let gpu = gpu();
    let view = Shot { background: Background::Transparent, ..ball_view(128) };
    let left = |change: &dyn Fn(&mut Material)| {
        let image = render(&gpu, &ball(change), &view);
        image.pixels.chunks(4).filter(|p| p[3] > 0).count()
    };
    let whole = left(&|_| ());
    let dissolved: Vec<usize> = [0.0, 0.3, 0.6, 1.0]
        .map(|amount| left(&move |m| m.dissolve = Some(Dissolve { amount, ..Dissolve::default() })))
        .into();
    assert!(dissolved[0] == whole && dissolved[3] == 0, "{dissolved:?} of {whole}");
    assert!(dissolved.windows(2).all(|w| w[1] < w[0]), "{dissolved:?}");
    for samples in [1, 4] {
        let faded = |opacity: f32| {
            let scene = ball(move |m| m.dither_fade = Some(DitherFade { opacity, ..DitherFade::default() }));
            render_with(&gpu, &scene, &view, Output { samples, ..Output::default() })
        };
        let sum = |image: &Image| image.pixels.chunks(4).map(|p| f64::from(p[3]) / 255.0).sum::<f64>();
        let whole = sum(&render_with(&gpu, &ball(|_| ()), &view, Output { samples, ..Output::default() }));
        for opacity in [1.0f32, 0.75, 0.3, 0.0] {
            let share = sum(&faded(opacity)) / whole;
            assert!((share - f64::from(opacity)).abs() < 0.01, "{share} is left of {opacity} with {samples} samples");
        }
        if samples == 4 {
            let half = faded(0.5);
            let middle = (56..72).flat_map(|y| (56..72).map(move |x| (y * 128 + x) * 4 + 3));
            assert!(middle.clone().all(|i| (60..200).contains(&half.pixels[i])), "half of it is left in every pixel");
        }
    }
    let near = left(&|m| m.dither_fade = Some(DitherFade { near_m: [20.0, 30.0], ..DitherFade::default() }));
    assert_eq!(near, 0, "nearer than twenty metres it is gone");
}

/// A decal lies where it is placed, as large as it is, turned clockwise, and takes shade as paint does.
#[test]
fn decals_lie_where_they_are_placed() {
    let gpu = gpu();
    let mut scene = scene(vec![(square([0.0, 0.0], 0.5, 0.0), two_tone())]);
    // Left half green, right half transparent.
    let map = texture(&mut scene, 8, 8, |x, _| if x < 4 { [0, 255, 0, 255] } else { [0, 255, 0, 0] });
    let decal = Decal { middle: [0.25, 0.75], size: [0.4, 0.2], ..Decal::default() };
    let with = |scene: &Scene, decal: Decal| {
        let mut scene = scene.clone();
        scene.materials[0].decals = Some(Decals { map: Some(map), placed: vec![decal] });
        let mut view = view(200, 10.0);
        view.camera.fov_y_rad = 2.0 * 0.05f32.atan();
        view.lights.directional.to_light = Vec3::Z;
        view.lights.ambient = Ambient::uniform(LinearRgb::BLACK);
        render(&gpu, &scene, &view)
    };
    let green = |image: &Image, u: f32, v: f32| {
        let p = pixel(image, (u * 200.0) as u32, (v * 200.0) as u32);
        p[1] > 200 && p[0] < 60
    };
    let image = with(&scene, decal);
    assert!(green(&image, 0.12, 0.75) && !green(&image, 0.35, 0.75), "its left half is seen");
    assert!(!green(&image, 0.03, 0.75) && !green(&image, 0.12, 0.88), "it ends where it should");
    let turned = with(&scene, Decal { rotation_rad: std::f32::consts::FRAC_PI_2, ..decal });
    assert!(green(&turned, 0.25, 0.6) && !green(&turned, 0.25, 0.9), "a quarter clockwise, its left points up");
}

/// Emission blinks by time alone and a texture of it scrolls.
#[test]
fn emission_blinks_and_scrolls() {
    let gpu = gpu();
    let mut scene = scene(vec![(square([0.0, 0.0], 0.5, 0.0), Material::default())]);
    let stripes = texture(&mut scene, 8, 1, |x, _| [if x < 4 { 255 } else { 0 }; 4]);
    scene.materials[0] = Material {
        base: Base { color: [0.0, 0.0, 0.0, 1.0], texture: None },
        shading: Shading::Toon(Toon { shade_color: [0.0; 3], ..Toon::default() }),
        emission: Emission {
            color: [1.0; 3],
            texture: Some(stripes),
            scroll_per_s: [0.25, 0.0],
            blink: Some(Blink { period_s: 2.0, low: 0.0, sharpness: 0.0 }),
        },
        ..Material::default()
    };
    let at = |time_s: f32| pixel(&render(&gpu, &scene, &Shot { time_s, ..ball_view(64) }), 20, 32)[0];
    assert!(at(0.0) > 200 && at(1.0) < 5, "{} and {}", at(0.0), at(1.0));
    // After two seconds the stripes have moved by half: dark where it was bright, at the peak of the blink.
    assert!(at(2.0) < 5 && at(4.0) > 200, "{} and {}", at(2.0), at(4.0));
}
