//! What must hold for every picture, on the adapter.

use glam::{Mat4, Quat, Vec3};
use hikage::{
    Background, Channel, Output, Renderer, View,
    color::{LinearRgb, Srgb},
    material::{Alpha, AlphaMode, Base, Material, Outline, OutlineTint, OutlineWidth, Shading, Toon},
    motion::Pose,
    scene::{
        Ambient, Image, Influences, Lights, Mesh, MorphTarget, Node, PunctualLight, Scene, Skin, SpotCone, Transform,
    },
};

use crate::support::{cube, gpu, pixel, render, render_with, scene, sphere, square, texture, two_tone, view};

fn srgb(linear: [f32; 3]) -> [u8; 3] {
    LinearRgb(linear).to_srgb().0
}

fn close(found: &[u8], expected: &[u8], tolerance: u8, what: &str) {
    let off = found.iter().zip(expected).any(|(f, e)| f.abs_diff(*e) > tolerance);
    assert!(!off, "{what}: {found:?}, expected {expected:?} ± {tolerance}");
}

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
fn light_of_intensity_one_shows_lit_and_shade_colours_exactly() {
    let material = two_tone();
    let scene = scene(vec![(sphere(0.5, 64, 128), material)]);
    let image = render(&gpu(), &scene, &view(256, 4.0));
    close(&pixel(&image, 90, 90)[..3], &srgb([0.9, 0.3, 0.25]), 1, "lit");
    close(&pixel(&image, 188, 188)[..3], &srgb([0.3, 0.12, 0.4]), 1, "shade");
}

#[test]
fn ambient_light_adds_its_share_of_the_lit_colour_and_equalizes() {
    let gpu = gpu();
    let at_top_and_bottom = |equalization: f32| {
        let toon = Toon { gi_equalization: equalization, ..Toon::default() };
        let base = Base { color: [0.5, 0.5, 0.5, 1.0], texture: None };
        let material = Material { base, shading: Shading::Toon(toon), ..Material::default() };
        let scene = scene(vec![(sphere(0.5, 64, 128), material)]);
        let mut view = view(256, 4.0);
        view.lights.directional.intensity = 0.0;
        view.lights.ambient = Ambient { sky: LinearRgb::splat(0.8), ground: LinearRgb::splat(0.2) };
        let image = render(&gpu, &scene, &view);
        [pixel(&image, 128, 50), pixel(&image, 128, 128), pixel(&image, 128, 205)].map(|p| p[0])
    };
    let even = at_top_and_bottom(1.0);
    close(&even, &srgb([0.25; 3]), 1, "equalized ambient light is the mean everywhere");
    let directed = at_top_and_bottom(0.0);
    assert!(directed[0] > directed[1] + 10 && directed[1] > directed[2] + 10, "sky above ground: {directed:?}");
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
    let mut renderer = hikage::Renderer::new(&gpu).expect("a renderer");
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
                    let mut uploaded = renderer.upload(&scene).expect("an upload");
                    let image = renderer.render(&mut uploaded, &view).expect("a picture");
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
    material.outline = Some(Outline { width, tint: Some(OutlineTint::default()), ..Outline::default() });
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

#[test]
fn transparent_pictures_have_straight_alpha() {
    let mut material = two_tone();
    material.base.color[3] = 0.5;
    material.alpha = Alpha { mode: AlphaMode::Blend, ..Alpha::default() };
    let scene = scene(vec![(square([0.0, 0.0], 0.4, 0.0), material)]);
    let mut view = view(64, 4.0);
    view.background = Background::Transparent;
    let image = render(&gpu(), &scene, &view);
    assert_eq!(pixel(&image, 1, 1), [0; 4], "nothing is there");
    let [r, g, b] = srgb([0.9, 0.3, 0.25]);
    close(&pixel(&image, 32, 32), &[r, g, b, 128], 2, "half of it is there");
}

#[test]
fn far_transparent_parts_show_through_near_ones_unless_depth_is_written() {
    let gpu = gpu();
    let glass = |color: [f32; 3], write_depth| Material {
        base: Base { color: [color[0], color[1], color[2], 0.5], texture: None },
        shading: Shading::Unlit,
        alpha: Alpha { mode: AlphaMode::Blend, write_depth, ..Alpha::default() },
        ..Material::default()
    };
    let mut view = view(64, 4.0);
    view.background = Background::Color(Srgb([0; 3]));
    // Near before far in the file: the order must come from the distance.
    let parts = |w| {
        vec![
            (square([0.0, 0.0], 0.3, 0.2), glass([1.0, 0.0, 0.0], w)),
            (square([0.0, 0.0], 0.3, -0.2), glass([0.0, 1.0, 0.0], w)),
        ]
    };
    let sorted = pixel(&render(&gpu, &scene(parts(false)), &view), 32, 32);
    close(&sorted[..3], &srgb([0.5, 0.25, 0.0]), 1, "red over green");
    // The queue offset is stronger than the distance.
    let mut forced = parts(false);
    forced[0].1.alpha.queue_offset = -1;
    let forced = pixel(&render(&gpu, &scene(forced), &view), 32, 32);
    close(&forced[..3], &srgb([0.25, 0.5, 0.0]), 1, "green over red by queue offset");
    // What writes depth comes first, whatever the distance, and hides the rest behind it.
    let mut writing = parts(false);
    writing[0].1.alpha.write_depth = true;
    let writing = pixel(&render(&gpu, &scene(writing), &view), 32, 32);
    close(&writing[..3], &srgb([0.5, 0.0, 0.0]), 1, "the writer hides what is behind");
}

#[test]
fn masked_alpha_cuts_at_its_cutoff() {
    let mut scene = scene(vec![(square([0.0, 0.0], 0.5, 0.0), two_tone())]);
    let holes = texture(&mut scene, 2, 1, |x, _| [255, 255, 255, if x == 0 { 100 } else { 160 }]);
    let material = &mut scene.materials[0];
    material.base.texture = Some(holes);
    material.alpha = Alpha { mode: AlphaMode::Mask, cutoff: 0.5, ..Alpha::default() };
    let image = render(&gpu(), &scene, &view(128, 4.0));
    assert_eq!(pixel(&image, 50, 64)[..3], [0x80; 3], "below the cutoff is open");
    close(&pixel(&image, 78, 64)[..3], &srgb([0.9, 0.3, 0.25]), 1, "above it is shut");
}

#[test]
fn double_sided_surfaces_face_the_viewer_on_both_sides() {
    let gpu = gpu();
    let mut material = two_tone();
    let mut view = view(64, 4.0);
    view.camera.eye = Vec3::Z * -4.0;
    view.lights.directional.to_light = Vec3::NEG_Z;
    let behind = |material: Material| {
        let image = render(&gpu, &scene(vec![(square([0.0, 0.0], 0.4, 0.0), material)]), &view);
        pixel(&image, 32, 32)
    };
    assert_eq!(behind(material.clone())[..3], [0x80; 3], "a single side is culled from behind");
    material.double_sided = true;
    close(&behind(material)[..3], &srgb([0.9, 0.3, 0.25]), 1, "two sides are lit from behind");
}

#[test]
fn a_mirrored_node_keeps_its_outside_outside() {
    let gpu = gpu();
    let mut mirrored = scene(vec![(sphere(0.5, 32, 64), two_tone())]);
    let plain = render(&gpu, &mirrored, &view(128, 4.0));
    mirrored.nodes[0].transform.scale = Vec3::new(-1.0, 1.0, 1.0);
    let image = render(&gpu, &mirrored, &view(128, 4.0));
    let off = plain.pixels.iter().zip(&image.pixels).filter(|(a, b)| a.abs_diff(**b) > 8).count();
    // The sphere is its own mirror image; only its tessellation differs.
    assert!(off < 200, "{off} channels differ");
}

#[test]
fn one_direction_of_light_by_lamp_or_sun_is_the_same() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.5, 64, 128), two_tone())]);
    let mut sun = view(128, 4.0);
    let mut lamp = sun.clone();
    sun.lights.directional.to_light = Vec3::Z;
    lamp.lights = Lights { ambient: sun.lights.ambient, ..Lights::default() };
    lamp.lights.directional.intensity = 0.0;
    lamp.lights.punctual.push(PunctualLight {
        position: Vec3::Z * 200.0,
        color: LinearRgb::WHITE,
        intensity: 200.0 * 200.0,
        range: 0.0,
        spot: Some(SpotCone { direction: Vec3::NEG_Z, inner_rad: 0.2, outer_rad: 0.3 }),
    });
    let (a, b) = (render(&gpu, &scene, &sun), render(&gpu, &scene, &lamp));
    let off = a.pixels.iter().zip(&b.pixels).filter(|(a, b)| a.abs_diff(**b) > 8).count();
    assert!(off < 300, "{off} channels differ");
    // Outside of its cone the lamp does nothing.
    lamp.lights.punctual[0].spot = Some(SpotCone { direction: Vec3::X, inner_rad: 0.2, outer_rad: 0.3 });
    assert_eq!(pixel(&render(&gpu, &scene, &lamp), 64, 64)[..3], [0; 3]);
}

#[test]
fn many_lights_still_cut_one_band() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.5, 96, 192), two_tone())]);
    let mut view = view(256, 4.0);
    for x in [-2.0, 2.0] {
        view.lights.punctual.push(PunctualLight {
            position: Vec3::new(x, 1.0, 3.0),
            color: LinearRgb::WHITE,
            intensity: 3.0,
            range: 0.0,
            spot: None,
        });
    }
    let image = render(&gpu, &scene, &view);
    // Along the middle column the picture goes from light to shade once.
    let reds: Vec<u8> = (40..216).map(|y| pixel(&image, 128, y)[0]).collect();
    let lit = reds[20];
    let turns = reds.windows(2).filter(|w| (w[0] > lit / 2 + 20) != (w[1] > lit / 2 + 20)).count();
    assert!(turns <= 1, "{turns} edges of shade in one column");
}

/// A bar of two segments along +Y with as many influences a vertex as asked for.
fn skinned_bar(per_vertex: usize) -> Scene {
    let mut bar = cube(0.2);
    let count = bar.positions.len();
    bar.influences =
        Influences { per_vertex, joints: vec![0; count * per_vertex], weights: vec![0.0; count * per_vertex] };
    for (v, position) in bar.positions.iter().enumerate() {
        let joint = u16::from(position[1] > 0.0);
        // Split evenly over all slots: the sum must still be whole.
        for slot in 0..per_vertex {
            bar.influences.joints[v * per_vertex + slot] = joint;
            bar.influences.weights[v * per_vertex + slot] = 1.0 / per_vertex as f32;
        }
    }
    let mut scene = scene(vec![(bar, two_tone())]);
    scene.nodes[0].skin = Some(0);
    scene.nodes.push(Node::default());
    scene.nodes.push(Node { parent: Some(1), ..Node::default() });
    scene.skins.push(Skin { joints: vec![1, 2], joint_from_mesh: vec![Mat4::IDENTITY; 2], ..Skin::default() });
    scene
}

#[test]
fn joints_move_what_they_hold_with_any_number_of_influences() {
    let gpu = gpu();
    for per_vertex in [4, 8] {
        let scene = skinned_bar(per_vertex);
        let mut renderer = Renderer::new(&gpu).expect("a renderer");
        let mut uploaded = renderer.upload(&scene).expect("an upload");
        let view = view(128, 4.0);
        let rest = renderer.render(&mut uploaded, &view).expect("a picture");
        assert_eq!(pixel(&rest, 64, 30)[..3], [0x80; 3], "nothing above the cube at rest");
        let mut pose = Pose::rest(&scene);
        pose.locals[2].translation.y = 0.3;
        uploaded.set_pose(&gpu, &scene, &pose);
        let raised = renderer.render(&mut uploaded, &view).expect("a picture");
        assert_ne!(pixel(&raised, 64, 30)[..3], [0x80; 3], "the upper half is raised, {per_vertex} influences");
        assert_ne!(pixel(&raised, 64, 78)[..3], [0x80; 3], "the lower half stays, {per_vertex} influences");
    }
}

#[test]
fn morph_targets_move_only_their_vertices() {
    let gpu = gpu();
    let mut bar = cube(0.2);
    let top: Vec<u32> = (0..bar.positions.len() as u32).filter(|&v| bar.positions[v as usize][1] > 0.0).collect();
    let count = top.len();
    bar.morphs = vec![
        MorphTarget::default(),
        MorphTarget { vertices: top, positions: vec![[0.0, 0.3, 0.0]; count], normals: vec![[0.0; 3]; count] },
    ];
    let mut scene = scene(vec![(bar, two_tone())]);
    scene.meshes[0] = Mesh { morph_names: vec!["nothing".into(), "up".into()], ..scene.meshes[0].clone() };
    scene.nodes[0].morph_weights = vec![0.0, 0.0];
    let mut renderer = Renderer::new(&gpu).expect("a renderer");
    let mut uploaded = renderer.upload(&scene).expect("an upload");
    let view = view(128, 4.0);
    let heights: Vec<u32> = [0.0, 0.5, 1.0]
        .into_iter()
        .map(|weight| {
            let mut pose = Pose::rest(&scene);
            pose.morph_weights[0][1] = weight;
            uploaded.set_pose(&gpu, &scene, &pose);
            let image = renderer.render(&mut uploaded, &view).expect("a picture");
            (0..128).filter(|&y| pixel(&image, 64, y)[..3] != [0x80; 3]).count() as u32
        })
        .collect();
    assert!(heights[1] > heights[0] + 8 && heights[2] > heights[1] + 8, "growing with the weight: {heights:?}");
}

#[test]
fn an_instance_moves_like_the_camera_moves_back() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.4, 48, 96), two_tone())]);
    let here = render(&gpu, &scene, &view(128, 4.0));
    let offset = Vec3::new(3.0, -2.0, 5.0);
    let mut moved = view(128, 4.0);
    moved.camera.eye += offset;
    moved.camera.target += offset;
    moved.instances = vec![Mat4::from_translation(offset)];
    let there = render(&gpu, &scene, &moved);
    let off = here.pixels.iter().zip(&there.pixels).filter(|(a, b)| a.abs_diff(**b) > 2).count();
    assert!(off < 40, "{off} channels differ");
    // Two instances are two characters.
    moved.instances.push(Mat4::from_translation(offset + Vec3::X * 0.5));
    assert_ne!(render(&gpu, &scene, &moved).pixels, there.pixels);
}

#[test]
fn a_turned_character_is_sorted_as_it_stands() {
    let glass = |color: [f32; 3]| Material {
        base: Base { color: [color[0], color[1], color[2], 0.5], texture: None },
        shading: Shading::Unlit,
        alpha: Alpha { mode: AlphaMode::Blend, ..Alpha::default() },
        double_sided: true,
        ..Material::default()
    };
    let scene = scene(vec![
        (square([0.0, 0.0], 0.3, 0.2), glass([1.0, 0.0, 0.0])),
        (square([0.0, 0.0], 0.3, -0.2), glass([0.0, 1.0, 0.0])),
    ]);
    let mut view = view(64, 4.0);
    view.background = Background::Color(Srgb([0; 3]));
    view.instances = vec![Mat4::from_rotation_y(std::f32::consts::PI)];
    let turned = pixel(&render(&gpu(), &scene, &view), 32, 32);
    close(&turned[..3], &srgb([0.25, 0.5, 0.0]), 1, "green, now near, over red");
}

#[test]
fn parts_are_numbered_in_the_order_of_nodes() {
    let gpu = gpu();
    let glass = Material { alpha: Alpha { mode: AlphaMode::Blend, ..Alpha::default() }, ..two_tone() };
    let scene = scene(vec![(square([-0.3, 0.0], 0.2, 0.0), glass), (square([0.3, 0.0], 0.2, 0.0), two_tone())]);
    let mut ids = view(128, 4.0);
    ids.channel = Channel::PartId;
    let image = render(&gpu, &scene, &ids);
    assert_eq!(pixel(&image, 40, 64), [1, 0, 0, 255], "the first part, although it is drawn last");
    assert_eq!(pixel(&image, 90, 64), [2, 0, 0, 255]);
    assert_eq!(pixel(&image, 2, 2), [0, 0, 0, 255]);
    let mut renderer = Renderer::new(&gpu).expect("a renderer");
    let uploaded = renderer.upload(&scene).expect("an upload");
    assert_eq!((uploaded.part_material(0), uploaded.part_material(1)), (Some(0), Some(1)));
}

#[test]
fn depth_and_normal_channels_show_the_surface() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.5, 64, 128), two_tone())]);
    let mut channel = view(128, 4.0);
    channel.channel = Channel::Normal;
    let normal = render(&gpu, &scene, &channel);
    close(&pixel(&normal, 64, 64)[..3], &[128, 128, 255], 3, "the middle faces the camera");
    channel.channel = Channel::Depth;
    let depth = render(&gpu, &scene, &channel);
    assert!(pixel(&depth, 64, 64)[0] > pixel(&depth, 40, 64)[0], "the middle is nearest");
    assert_eq!(pixel(&depth, 1, 1), [0; 4]);
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let gpu = gpu();
    let mut material = two_tone();
    material.rim.color = [0.6, 0.7, 0.8];
    let width = OutlineWidth::World { metres: 0.01 };
    material.outline = Some(Outline { width, ..Outline::default() });
    let scene = scene(vec![(sphere(0.5, 64, 128), material)]);
    let first = render(&gpu, &scene, &view(256, 4.0));
    for run in 0..10 {
        assert!(render(&gpu, &scene, &view(256, 4.0)) == first, "run {run} differs");
    }
}

#[test]
fn targets_that_do_not_encode_show_the_same_colours() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.5, 64, 128), two_tone())]);
    let plain = Output { format: wgpu::TextureFormat::Rgba8Unorm, samples: 1 };
    let encoded = Output { format: wgpu::TextureFormat::Rgba8UnormSrgb, samples: 1 };
    let a = render_with(&gpu, &scene, &view(128, 4.0), plain);
    let b = render_with(&gpu, &scene, &view(128, 4.0), encoded);
    let worst = a.pixels.iter().zip(&b.pixels).map(|(a, b)| a.abs_diff(*b)).max();
    assert!(worst <= Some(1), "{worst:?}");
}

#[test]
fn views_without_sense_are_refused_with_their_reason() {
    let gpu = gpu();
    let scene = scene(vec![(sphere(0.5, 8, 16), two_tone())]);
    let mut renderer = Renderer::new(&gpu).expect("a renderer");
    let mut uploaded = renderer.upload(&scene).expect("an upload");
    let mut refuse = |change: fn(&mut View), word: &str| {
        let mut view = view(64, 4.0);
        change(&mut view);
        let error = renderer.render(&mut uploaded, &view).expect_err(word).to_string();
        assert!(error.contains(word), "{error}");
    };
    refuse(|v| v.size = [0, 10], "size");
    refuse(|v| v.size = [10, 100_000], "size");
    refuse(|v| v.camera.fov_y_rad = 0.0, "field of view");
    refuse(|v| v.camera.near = f32::NAN, "near");
    refuse(|v| v.camera.target = v.camera.eye, "camera");
    refuse(|v| v.camera.up = Vec3::Z, "camera");
    refuse(|v| v.instances.clear(), "instances");
    let wrong = Output { samples: 3, ..Output::default() };
    assert!(Renderer::with_output(&gpu, wrong).is_err());
}

#[test]
fn an_empty_scene_is_its_background() {
    let image = render(&gpu(), &Scene::default(), &view(16, 4.0));
    assert!(image.pixels.chunks_exact(4).all(|p| p == [0x80, 0x80, 0x80, 255]));
}

#[test]
fn node_transforms_chain() {
    let mut tree = scene(vec![(sphere(0.1, 16, 32), two_tone())]);
    let moved = |x| Transform { translation: Vec3::X * x, ..Transform::default() };
    let sphere_node = tree.nodes.remove(0);
    tree.nodes = vec![
        Node { transform: moved(0.1), ..Node::default() },
        Node { parent: Some(0), transform: moved(0.2), ..Node::default() },
        Node { parent: Some(1), transform: moved(0.1), ..sphere_node },
    ];
    let image = render(&gpu(), &tree, &view(128, 4.0));
    let lit: Vec<u32> = (0..128).filter(|&x| pixel(&image, x, 64)[..3] != [0x80; 3]).collect();
    let middle = (lit[0] + lit[lit.len() - 1]) as f32 / 2.0;
    let expected = 63.5 + 0.4 * 64.0 / (4.0 * 10f32.to_radians().tan());
    assert!((middle - expected).abs() < 1.0, "{middle}, expected {expected}");
}
