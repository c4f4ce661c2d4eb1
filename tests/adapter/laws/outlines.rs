//! Outlines: their width, where they are, their light.

use glam::Quat;
use hikage::Background;
use hikage::color::Srgb;
use hikage::material::{Base, Material, Outline, OutlineTint, OutlineWidth, Shading, Toon};
use hikage::scene::Image;

use crate::support::{Shoot, cube, gpu, pixel, render, scene, sphere, staged, texture, two_tone, view};

/// Without a hue of its own, so that a green line is what is green.
fn grey() -> Material {
    let toon = Toon { shade_color: [0.2; 3], ..Toon::default() };
    Material {
        base: Base { color: [0.5, 0.5, 0.5, 1.0], texture: None },
        shading: Shading::Toon(toon),
        ..Material::default()
    }
}

#[test]
fn outlines_on_screen_keep_their_width_at_any_distance_field_of_view_and_aspect() {
    let gpu = gpu();
    for (distance, fov, size, radius) in [
        (0.5, 40.0f32, [256, 256], 0.1),
        (3.0, 15.0, [256, 256], 0.3),
        (20.0, 15.0, [384, 256], 2.0),
        (2.0, 90.0, [200, 320], 0.8),
        (5.0, 30.0, [512, 256], 0.7),
    ] {
        let mut material = grey();
        let width = OutlineWidth::Screen { height_ratio: 6.0 / size[1] as f32 };
        material.outline = Some(Outline { width, color: [0.0, 1.0, 0.0], lighting_mix: 0.0, ..Outline::default() });
        let scene = scene(vec![(sphere(radius, 128, 256), material)]);
        let mut view = view(256, distance);
        view.size = size;
        view.camera.fov_y_rad = fov.to_radians();
        view.camera.near = 0.01;
        let image = render(&gpu, &scene, &view);
        for (name, line) in [
            ("row", (0..size[0]).map(|x| pixel(&image, x, size[1] / 2)).collect::<Vec<_>>()),
            ("column", (0..size[1]).map(|y| pixel(&image, size[0] / 2, y)).collect()),
        ] {
            let half = line.len() / 2;
            // Coverage of the line in one half, summed: green over black or grey.
            let width: f32 = line[..half]
                .iter()
                .map(|p| {
                    let [_, g, b, _] = p.map(|c| Srgb([c; 3]).to_linear().0[0]);
                    (g - b).clamp(0.0, 1.0)
                })
                .sum();
            assert!((width - 6.0).abs() < 0.7, "{name} at {distance} m, {fov}°, {size:?}: {width} px, expected 6");
        }
    }
}

/// Width of the green line in the left and the upper half of a picture, pixels.
fn line_widths(image: &Image) -> [f32; 2] {
    let (w, h) = (image.width, image.height);
    let sum = |line: &mut dyn Iterator<Item = [u8; 4]>| {
        line.map(|p| {
            let [_, g, b, _] = p.map(|c| Srgb([c; 3]).to_linear().0[0]);
            (g - b).clamp(0.0, 1.0)
        })
        .sum()
    };
    [sum(&mut (0..w / 2).map(|x| pixel(image, x, h / 2))), sum(&mut (0..h / 2).map(|y| pixel(image, w / 2, y)))]
}

/// Lines in both units keep their widths over distances, fields of view and aspects: a ball whose hull is a ball again.
#[test]
fn lines_keep_their_widths_over_the_whole_range() {
    let gpu = gpu();
    let renderer = hikage::Renderer::new(&gpu).expect("a renderer");
    for fov in [15f32, 45.0, 90.0] {
        for distance in [0.5f32, 3.0, 20.0] {
            for size in [[256, 256], [160, 320], [384, 192]] {
                let half = (fov.to_radians() * 0.5).tan();
                let least = size[0].min(size[1]) as f32 / size[1] as f32;
                // The ball spans half of the shorter side.
                let radius = distance * (half * least * 0.5).atan().sin();
                let to_px = |radius: f32| {
                    let angle = (radius / distance).asin();
                    angle.tan() / half * size[1] as f32 * 0.5
                };
                let metres = radius * 0.06;
                let wide = to_px(radius + metres) - to_px(radius);
                let px = 5.0;
                for (width, expected) in [
                    (OutlineWidth::World { metres }, wide),
                    (OutlineWidth::Screen { height_ratio: px / size[1] as f32 }, px),
                ] {
                    let mut material = grey();
                    material.outline =
                        Some(Outline { width, color: [0.0, 1.0, 0.0], lighting_mix: 0.0, ..Outline::default() });
                    let scene = scene(vec![(sphere(radius, 96, 192), material)]);
                    let mut view = view(256, distance);
                    view.size = size;
                    view.camera.fov_y_rad = fov.to_radians();
                    view.camera.near = 0.01;
                    let mut uploaded = staged(renderer.upload(&scene));
                    let image = renderer.shoot(&mut uploaded, &view).expect("a picture");
                    for found in line_widths(&image) {
                        let what = format!("{width:?} at {distance} m, {fov}°, {size:?}");
                        assert!((found - expected).abs() <= 0.5, "{what}: {found} px, expected {expected}");
                    }
                }
            }
        }
    }
}

#[test]
fn outlines_in_the_world_have_their_width_in_metres() {
    let gpu = gpu();
    let mut material = grey();
    let width = OutlineWidth::World { metres: 0.05 };
    material.outline = Some(Outline { width, color: [0.0, 1.0, 0.0], lighting_mix: 0.0, ..Outline::default() });
    let scene = scene(vec![(sphere(0.5, 128, 256), material)]);
    let view = view(512, 40.0);
    let pixels_per_metre = 256.0 / ((view.camera.fov_y_rad * 0.5).tan() * 40.0);
    let image = render(&gpu, &scene, &view);
    let green = (0..256)
        .map(|x| {
            let [_, g, b, _] = pixel(&image, x, 256).map(|c| Srgb([c; 3]).to_linear().0[0]);
            (g - b).clamp(0.0, 1.0)
        })
        .sum::<f32>();
    let expected = 0.05 * pixels_per_metre;
    assert!((green - expected).abs() < 0.3, "{green} px, expected {expected}");
}

#[test]
fn uv_animation_moves_the_mask_of_the_outline() {
    let gpu = gpu();
    let mut scene = scene(vec![(sphere(0.5, 64, 128), grey())]);
    let upper_half = texture(&mut scene, 64, 64, |_, y| [0, if y < 32 { 255 } else { 0 }, 0, 255]);
    let width = OutlineWidth::World { metres: 0.06 };
    let outline = Outline {
        width,
        color: [0.0, 1.0, 0.0],
        lighting_mix: 0.0,
        width_mask: Some(upper_half),
        ..Outline::default()
    };
    scene.materials[0].outline = Some(outline);
    scene.materials[0].uv_animation.scroll_v_per_s = 0.5;
    let mut view = view(128, 4.0);
    let mut green_at = |time_s: f32| {
        view.time_s = time_s;
        let image = render(&gpu, &scene, &view);
        let green = |y: u32| (0..128).any(|x| pixel(&image, x, y)[1] > 200 && pixel(&image, x, y)[0] < 60);
        (green(40), green(88))
    };
    assert_eq!(green_at(0.0), (true, false), "the upper half has a line");
    assert_eq!(green_at(1.0), (false, true), "half a texture later the lower half has it");
}

#[test]
fn hard_edges_do_not_split_the_outline() {
    let mut material = two_tone();
    let width = OutlineWidth::World { metres: 0.06 };
    material.outline = Some(Outline { width, color: [0.0, 1.0, 0.0], lighting_mix: 0.0, ..Outline::default() });
    let mut scene = scene(vec![(cube(0.35), material)]);
    scene.nodes[0].transform.rotation = Quat::from_rotation_y(0.6) * Quat::from_rotation_x(0.5);
    let image = render(&gpu(), &scene, &view(256, 5.0));
    // From the background inwards every row and column meets the line first.
    for i in 0..256 {
        for (line, what) in [
            ((0..256).map(|k| pixel(&image, k, i)).collect::<Vec<_>>(), "row"),
            ((0..256).map(|k| pixel(&image, i, k)).collect(), "column"),
        ] {
            let inside = |p: &[u8; 4]| p[0].abs_diff(0x80) > 40 || p[1].abs_diff(0x80) > 40;
            let Some(first) = line.iter().find(|p| inside(p)) else { continue };
            assert!(first[1] > first[0] && first[1] > first[2], "{what} {i} meets {first:?} before the outline");
        }
    }
}

/// Pixels of a green line in the left half of the middle row.
fn green_width(image: &hikage::scene::Image) -> f32 {
    let share = |p: [u8; 4]| {
        let [_, g, b, _] = p.map(|c| Srgb([c; 3]).to_linear().0[0]);
        (g - b).clamp(0.0, 1.0)
    };
    (0..image.width / 2).map(|x| share(pixel(image, x, image.height / 2))).sum()
}

/// Between its bounds a line in the world thins with distance; beyond them it has their width, at any field of view.
#[test]
fn a_line_in_the_world_keeps_to_its_bounds() {
    let gpu = gpu();
    let bounds = [2.0, 12.0];
    let width = OutlineWidth::World { metres: 0.02 };
    let mut material = grey();
    let line = Outline { width, color: [0.0, 1.0, 0.0], lighting_mix: 0.0, ..Outline::default() };
    material.outline = Some(Outline { clamp_px: Some(bounds), ..line });
    let scene = scene(vec![(sphere(0.5, 128, 256), material)]);
    for (distance, fov) in [(1.2f32, 60.0f32), (4.0, 30.0), (8.0, 30.0), (20.0, 15.0), (20.0, 60.0)] {
        let mut view = view(512, distance);
        view.camera.fov_y_rad = fov.to_radians();
        let found = green_width(&render(&gpu, &scene, &view));
        // Along the view, as the hull of a sphere is seen.
        let px_per_m = 256.0 / ((fov.to_radians() * 0.5).tan() * distance);
        let expected = (0.02 * px_per_m).clamp(bounds[0] * 0.5, bounds[1] * 0.5);
        let tolerance = 0.5 + 0.3 * f32::from(u8::from(distance < 2.0)) * expected;
        assert!((found - expected).abs() < tolerance, "{found} px at {distance} m, {fov} degrees; expected {expected}");
    }
}

/// A line thinner than a pixel is as faint as it is thin, and whole: no row is without it.
#[test]
fn a_thin_line_is_faint_and_whole() {
    let gpu = gpu();
    for px in [0.3f32, 0.8] {
        let mut material = grey();
        let width = OutlineWidth::Screen { height_ratio: px / 256.0 };
        material.outline = Some(Outline { width, color: [0.0, 1.0, 0.0], lighting_mix: 0.0, ..Outline::default() });
        let image = render(&gpu, &scene(vec![(sphere(0.5, 128, 256), material)]), &view(256, 4.0));
        let widths: Vec<f32> = (112..144)
            .map(|y| {
                let share = |x: u32| {
                    let [_, g, b, _] = pixel(&image, x, y).map(|c| Srgb([c; 3]).to_linear().0[0]);
                    (g - b).clamp(0.0, 1.0)
                };
                (0..128).map(share).sum()
            })
            .collect();
        let mean = widths.iter().sum::<f32>() / widths.len() as f32;
        assert!((mean - px).abs() < 0.15, "{mean} px, expected {px}");
        assert!(widths.iter().all(|w| *w > px * 0.5), "{widths:?}: the line is torn");
    }
}

/// In the colour of its surface a line grows no wider than a pen's, however near it is.
#[test]
fn a_tinted_line_is_a_pen_s_at_most() {
    let gpu = gpu();
    let mut material = grey();
    let width = OutlineWidth::World { metres: 0.05 };
    let tint = OutlineTint { factor: [0.0, 10.0, 0.0], ..OutlineTint::default() };
    material.outline = Some(Outline { width, tint: Some(tint), ..Outline::default() });
    let found = green_width(&render(&gpu, &scene(vec![(sphere(0.5, 128, 256), material)]), &view(1024, 4.0)));
    assert!((found - 4.0).abs() < 1.2, "{found} px");
}

/// A line takes its width from the red of the vertex colours where it is told to.
#[test]
fn vertex_colours_give_a_line_its_width() {
    let gpu = gpu();
    let width = OutlineWidth::Screen { height_ratio: 12.0 / 256.0 };
    let mut material = grey();
    material.outline =
        Some(Outline { width, color: [0.0, 1.0, 0.0], lighting_mix: 0.0, vertex_width: true, ..Outline::default() });
    let mut ball = sphere(0.5, 64, 128);
    ball.colors = vec![[0.5, 1.0, 1.0, 1.0]; ball.positions.len()];
    let found = green_width(&render(&gpu, &scene(vec![(ball, material)]), &view(256, 4.0)));
    assert!((found - 6.0).abs() < 0.7, "{found} px");
}

/// Pushed away from the viewer, the line round a part that lies on another is hidden by it; the line round both stays.
#[test]
fn a_pushed_line_is_hidden_inside_of_the_shape() {
    let gpu = gpu();
    let lined = |push_m| {
        let mut material = grey();
        let width = OutlineWidth::World { metres: 0.02 };
        material.outline =
            Some(Outline { width, color: [0.0, 1.0, 0.0], lighting_mix: 0.0, push_m, ..Outline::default() });
        let mut part = sphere(0.12, 32, 64);
        part.positions.iter_mut().for_each(|p| p[2] = p[2] * 0.2 + 0.53);
        render(&gpu, &scene(vec![(sphere(0.5, 64, 128), material.clone()), (part, material)]), &view(256, 4.0))
    };
    let green = |image: &hikage::scene::Image, inside: bool| {
        let is_green = |p: [u8; 4]| p[1] > p[0].saturating_add(60);
        let at = |x: u32, y: u32| (x.abs_diff(128).pow(2) + y.abs_diff(128).pow(2) < 60 * 60) == inside;
        (0..256u32 * 256)
            .map(|i| (i % 256, i / 256))
            .filter(|(x, y)| at(*x, *y) && is_green(pixel(image, *x, *y)))
            .count()
    };
    let (plain, pushed) = (lined(0.0), lined(0.1));
    assert!(
        green(&plain, true) > 50 && green(&pushed, true) == 0,
        "{} and {}",
        green(&plain, true),
        green(&pushed, true)
    );
    assert!(green(&pushed, false) * 10 > green(&plain, false) * 9, "the line round the shape is gone");
}

/// A line in the colour of its surface is darker than that, dims with the light and never outshines it.
#[test]
fn a_tinted_line_dims_with_the_light() {
    let gpu = gpu();
    let mut material = two_tone();
    let width = OutlineWidth::World { metres: 0.1 };
    let line = Outline { width, clamp_px: Some([0.0, 1000.0]), ..Outline::default() };
    material.outline = Some(Outline { tint: Some(OutlineTint::default()), ..line });
    let scene = scene(vec![(sphere(0.4, 32, 64), material)]);
    let line = |intensity: f32| {
        let mut view = view(128, 5.0);
        view.lights.directional.intensity = intensity;
        view.background = Background::Color(Srgb([0; 3]));
        let image = render(&gpu, &scene, &view);
        // Just inside of the hull.
        let first = (0..64).find(|x| pixel(&image, *x, 64)[..3] != [0; 3]);
        first.map(|x| Srgb(pixel(&image, x + 2, 64)[..3].try_into().expect("three")).to_linear().0)
    };
    let [full, half, bright] = [1.0, 0.5, 30.0].map(|i| line(i).expect("a line"));
    assert_eq!(line(0.0), None, "no light, no line");
    let shade = [0.3, 0.12, 0.4];
    assert!(full.iter().zip(shade).all(|(l, s)| *l < s * 0.7), "{full:?} round {shade:?}");
    assert!(half.iter().zip(full).all(|(h, f)| (h - f * 0.5).abs() < 0.01), "{half:?} of {full:?}");
    assert!(bright.iter().zip(full).all(|(b, f)| (b - f).abs() < 0.01), "{bright:?} of {full:?}");
}

#[test]
fn an_outline_never_shines_in_the_dark() {
    let mut material = two_tone();
    let width = OutlineWidth::World { metres: 0.05 };
    material.outline = Some(Outline { width, color: [1.0; 3], lighting_mix: 1.0, ..Outline::default() });
    let scene = scene(vec![(sphere(0.5, 32, 64), material)]);
    let mut view = view(128, 5.0);
    view.lights.directional.intensity = 0.0;
    view.background = Background::Color(Srgb([0; 3]));
    let image = render(&gpu(), &scene, &view);
    assert!(image.pixels.chunks_exact(4).all(|p| p[..3] == [0; 3]), "no light, no picture");
}
