//! Pictures that were looked at: every parameter of a material, on rows of spheres, under one light.

use glam::{Quat, Vec3};
use hikage::{
    Background,
    color::{LinearRgb, Srgb},
    golden::{Goldens, Tolerance},
    material::{
        Alpha, AlphaMode, Base, Emission, FurDetail, LightResponse, Matcap, Material, NormalMap, Outline, OutlineTint,
        OutlineWidth, PartColors, RampMaps, Rim, ShadeRamp, Shading, TextureRef, TintSource, Toon, UvAnimation,
        UvTransform,
    },
    scene::{Ambient, Image, PunctualLight, Sampler, Scene, SpotCone, Wrap},
};

use crate::support::{Shot, cube, gpu, render, scene, sphere, square, texture, two_tone, view};

/// Another driver may round edges and ramps differently, never more.
const TOLERANCE: Tolerance = Tolerance { channel: 6, outliers: 0.004, blob: 12, drift: 1.0 };

fn check(name: &str, scene: &Scene, view: &Shot) {
    check_picture(name, &render(&gpu(), scene, view));
}

fn check_picture(name: &str, picture: &Image) {
    let goldens =
        Goldens { bless_command: "cargo xtask goldens --bless {name}".to_owned(), ..Goldens::new("tests/golden") };
    if let Err(error) = goldens.check(name, picture, &TOLERANCE) {
        panic!("{error}");
    }
}

/// Spheres in a row, one for each material.
fn row(materials: Vec<Material>) -> Scene {
    let count = materials.len();
    let parts = materials.into_iter().enumerate().map(|(i, material)| {
        let mut ball = sphere(0.45, 48, 96);
        let x = i as f32 - (count as f32 - 1.0) * 0.5;
        ball.positions.iter_mut().for_each(|p| p[0] += x);
        (ball, material)
    });
    scene(parts.collect())
}

/// A view that shows `count` spheres of [`row`].
fn row_view(count: u32) -> Shot {
    let mut view = view(128, 4.0);
    view.size = [128 * count, 128];
    // One sphere and its margin are one unit high.
    view.camera.eye = Vec3::Z * (0.5 / 2f32.to_radians().tan());
    view.camera.fov_y_rad = 4f32.to_radians();
    view.lights.ambient = Ambient::uniform(LinearRgb::splat(0.08));
    view
}

fn toon(change: impl FnOnce(&mut Toon)) -> Material {
    let mut toon = Toon { shade_color: [0.3, 0.12, 0.4], ..Toon::default() };
    change(&mut toon);
    Material { shading: Shading::Toon(toon), ..two_tone() }
}

/// A picture with a clear top left: quarters of four colours on a grid.
fn quarters(x: u32, y: u32) -> [u8; 4] {
    let grid = if x.is_multiple_of(8) || y.is_multiple_of(8) {
        60
    } else {
        0
    };
    let [r, g, b] = match (x < 32, y < 32) {
        (true, true) => [250, 120, 110],
        (false, true) => [240, 220, 90],
        (true, false) => [90, 190, 120],
        (false, false) => [90, 130, 240],
    };
    [r - grid, g - grid, b - grid, 255]
}

/// Panels of a scene under level light that turns from the front to behind, for warm, white and cool light below each other.
fn check_sweep(name: &str, scene: &Scene, view: &Shot, coolness: &[f32]) {
    let gpu = gpu();
    let mut rows = Vec::new();
    for coolness in coolness {
        let mut row: Option<Image> = None;
        for degrees in [-60.0f32, -20.0, 30.0, 75.0, 115.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let mut view = view.clone();
            view.lights.directional.to_light = Vec3::new(sin, 0.35, cos).normalize();
            view.lights.coolness = Some(*coolness);
            let panel = render(&gpu, scene, &view);
            row = Some(match row {
                None => panel,
                Some(row) => beside(&row, &panel),
            });
        }
        rows.extend(row);
    }
    let pixels = rows.iter().flat_map(|row| row.pixels.iter().copied()).collect();
    let picture = Image { height: rows.iter().map(|r| r.height).sum(), pixels, ..rows[0].clone() };
    check_picture(name, &picture);
}

fn beside(left: &Image, right: &Image) -> Image {
    let rows = |image: &Image| image.width as usize * 4;
    let pixels =
        left.pixels.chunks(rows(left)).zip(right.pixels.chunks(rows(right))).flat_map(|(a, b)| [a, b].concat());
    Image { width: left.width + right.width, pixels: pixels.collect(), ..left.clone() }
}

/// Warm and cool: hue and saturation of shade without a picture, over a terminator of its own.
#[test]
fn bands_of_shade_in_warm_and_cool_light() {
    let ramp = ShadeRamp { shade_hue_rad: [0.5, -0.6], shade_saturation: [1.3, 1.1], ..ShadeRamp::default() };
    let material = Material { shade_ramp: Some(ramp), ..toon(|_| ()) };
    check_sweep("shade-bands", &row(vec![material]), &row_view(1), &[0.0, 1.0]);
}

/// Ramps in pictures, with another row for a part that a map tells apart.
#[test]
fn ramps_by_part_in_warm_and_cool_light() {
    let mut scene = row(vec![toon(|_| ())]);
    let painted = |rows: [[[u8; 3]; 2]; 2]| {
        move |x: u32, y: u32| {
            let [shade, terminator] = rows[usize::from(y >= 4)];
            let color = match x {
                0..26 => shade,
                26..33 => terminator,
                _ => [255; 3],
            };
            [color[0], color[1], color[2], 255]
        }
    };
    let clamped = Sampler { wrap_u: Wrap::Clamp, wrap_v: Wrap::Clamp, ..Sampler::default() };
    let warm = texture(&mut scene, 64, 8, painted([[[200, 110, 80], [255, 120, 40]], [[60, 120, 90], [190, 220, 90]]]));
    let cool =
        texture(&mut scene, 64, 8, painted([[[110, 90, 200], [220, 110, 190]], [[40, 90, 140], [90, 200, 220]]]));
    for ramp in [warm, cool] {
        scene.textures[ramp.texture].sampler = clamped;
    }
    // Checks of the sphere, each an eighth of the way round.
    let part_ids = texture(&mut scene, 64, 32, |x, y| [u8::from((x / 8 + y / 8) % 2 == 1) * 2, 0, 0, 255]);
    let maps = RampMaps { warm, cool, rows: 2, row: 0, part_ids: Some(part_ids), part_rows: [0, 1, 0, 0, 0, 0, 0, 0] };
    scene.materials[0].base.color = [0.9, 0.85, 0.8, 1.0];
    scene.materials[0].shade_ramp = Some(ShadeRamp { maps: Some(maps), ..ShadeRamp::default() });
    check_sweep("shade-ramps", &scene, &row_view(1), &[0.0, 0.5, 1.0]);
}

/// Painted fur: few strokes in the light, all of them at the terminator, half of them in shade, and a border of light in the
/// shape of the strands.
#[test]
fn fur_with_strands_at_the_terminator() {
    let mut scene = row(vec![toon(|t| t.toony = 0.95)]);
    let strand = |x: u32, y: u32| {
        let shift = (y / 16 % 2) * 4;
        let (u, v) = (((x + shift) % 8) as f32 / 8.0 - 0.5, (y % 16) as f32 / 16.0);
        (u, v, u.abs() * 2.0 < 1.0 - v)
    };
    let color = texture(&mut scene, 128, 64, |x, y| match strand(x, y) {
        (_, v, true) => [(255.0 - 60.0 * v) as u8, (238.0 - 70.0 * v) as u8, (225.0 - 60.0 * v) as u8, 255],
        _ => [150, 110, 130, 255],
    });
    let normals = texture(&mut scene, 128, 64, |x, y| {
        let (u, _, inside) = strand(x, y);
        let n = Vec3::new(if inside { u * 1.6 } else { 0.0 }, if inside { 0.35 } else { -0.5 }, 1.0).normalize();
        [(n.x * 127.0 + 128.0) as u8, (n.y * 127.0 + 128.0) as u8, (n.z * 127.0 + 128.0) as u8, 255]
    });
    scene.materials[0].base = Base { color: [1.0; 4], texture: Some(color) };
    if let Shading::Toon(toon) = &mut scene.materials[0].shading {
        toon.shade_texture = Some(color);
        toon.shade_color = [0.62, 0.5, 0.7];
    }
    scene.materials[0].fur_detail = Some(FurDetail { detail_normal: normals, ..FurDetail::default() });
    check_sweep("fur-detail", &scene, &row_view(1), &[0.5]);
}

/// Bounds of the light: in the dark, in twice the light, in green light that counts and that does not.
#[test]
fn light_between_bounds() {
    let mut materials = vec![toon(|_| ()); 4];
    let response = |min, max, monochrome| Some(LightResponse { min, max, monochrome });
    materials[1].light_response = response(0.4, 0.8, 0.0);
    materials[2].light_response = response(0.0, 0.8, 1.0);
    materials[3].light_response = response(0.0, 10.0, 1.0);
    let (scene, mut view) = (row(materials), row_view(4));
    view.lights.directional.color = LinearRgb([0.5, 1.6, 0.5]);
    check("light-response", &scene, &view);
}

#[test]
fn toony_from_soft_to_hard() {
    let materials = [0.0, 0.5, 0.9, 1.0].map(|toony| toon(|t| t.toony = toony)).to_vec();
    check("toony", &row(materials), &row_view(4));
}

#[test]
fn shading_shift_by_number_and_by_texture() {
    let mut scene = row(vec![toon(|t| t.shift = -0.5), toon(|_| ()), toon(|t| t.shift = 0.5), toon(|_| ())]);
    let stripes = texture(&mut scene, 64, 64, |x, _| [if x % 8 < 4 { 255 } else { 0 }, 0, 0, 255]);
    let Shading::Toon(toon) = &mut scene.materials[3].shading else { unreachable!() };
    (toon.shift_texture, toon.shift_texture_scale) = (Some(stripes), -0.5);
    check("shift", &scene, &row_view(4));
}

#[test]
fn base_and_shade_textures() {
    let mut scene = row(vec![toon(|t| t.shade_color = [0.5, 0.4, 0.6]); 4]);
    let picture = texture(&mut scene, 64, 64, quarters);
    let other = texture(&mut scene, 64, 64, |x, y| {
        if (x / 8 + y / 8) % 2 == 0 {
            [90; 4]
        } else {
            [200, 200, 255, 255]
        }
    });
    let turned = UvTransform { offset: [0.1, 0.2], rotation_rad: 0.6, scale: [2.0, 2.0] };
    for (i, material) in scene.materials.iter_mut().enumerate() {
        material.base.color = [1.0; 4];
        material.base.texture =
            Some(TextureRef { transform: if i == 3 { turned } else { UvTransform::default() }, ..picture });
        let Shading::Toon(toon) = &mut material.shading else { unreachable!() };
        toon.shade_texture = [None, Some(picture), Some(other), Some(other)][i];
    }
    check("textures", &scene, &row_view(4));
}

#[test]
fn ambient_light_even_and_directed() {
    let materials = [0.0, 0.5, 1.0].map(|gi| toon(|t| t.gi_equalization = gi)).to_vec();
    let mut view = row_view(3);
    view.lights.ambient = Ambient { sky: LinearRgb([0.35, 0.45, 0.7]), ground: LinearRgb([0.2, 0.1, 0.02]) };
    check("ambient", &row(materials), &view);
}

#[test]
fn rim_with_power_lift_mask_and_mix() {
    let rim = |rim: Rim| Material { rim: Rim { color: [0.7, 0.85, 1.0], ..rim }, ..two_tone() };
    let mut scene = row(vec![
        rim(Rim { fresnel_power: 2.0, ..Rim::default() }),
        rim(Rim { lift: 0.2, fresnel_power: 8.0, ..Rim::default() }),
        rim(Rim { lighting_mix: 0.0, ..Rim::default() }),
        rim(Rim { fresnel_power: 2.0, ..Rim::default() }),
    ]);
    scene.materials[3].rim.mask = Some(texture(&mut scene, 64, 64, |x, y| {
        if (x / 4 + y / 4) % 2 == 0 {
            [255; 4]
        } else {
            [0, 0, 0, 255]
        }
    }));
    let mut view = row_view(4);
    view.lights.directional.color = LinearRgb([1.0, 0.8, 0.5]);
    check("rim", &scene, &view);
}

#[test]
fn matcap_with_its_top_at_the_top() {
    let mut scene = row(vec![two_tone(); 3]);
    let picture = texture(&mut scene, 64, 64, |x, y| {
        let (dx, dy) = (x as f32 - 22.0, y as f32 - 16.0);
        let spot = (255.0 * (1.0 - (dx * dx + dy * dy).sqrt() / 14.0)).clamp(0.0, 255.0) as u8;
        let floor = if y > 52 { 90 } else { 0 };
        [spot.max(floor / 3), spot.max(floor / 2), spot.max(floor), 255]
    });
    for (material, color) in scene.materials.iter_mut().zip([[1.0; 3], [1.0, 0.5, 0.2], [0.0; 3]]) {
        material.matcap = Some(Matcap { texture: picture, color });
    }
    check("matcap", &scene, &row_view(3));
}

#[test]
fn normal_map_bumps_outwards() {
    let mut scene = row(vec![two_tone(); 3]);
    // A round bump in every cell: its left slope faces left, its upper slope faces up (green is up).
    let bumps = texture(&mut scene, 128, 128, |x, y| {
        let (dx, dy) = ((x % 32) as f32 - 15.5, (y % 32) as f32 - 15.5);
        let radius = (dx * dx + dy * dy).sqrt();
        let slope = if radius > 2.0 && radius < 12.0 {
            0.7 / radius
        } else {
            0.0
        };
        let (nx, ny) = (dx * slope, -dy * slope);
        let nz = (1.0 - nx * nx - ny * ny).sqrt();
        let [r, g, b] = [nx, ny, nz].map(|n| (n * 127.5 + 127.5).round() as u8);
        [r, g, b, 255]
    });
    for (material, scale) in scene.materials.iter_mut().zip([0.3, 1.0, -1.0]) {
        material.normal_map = Some(NormalMap { texture: bumps, scale });
    }
    check("normal-map", &scene, &row_view(3));
}

#[test]
fn emission_adds_light_of_its_own() {
    let mut scene = row(vec![two_tone(); 3]);
    let picture = texture(&mut scene, 64, 64, |x, y| {
        if (x / 8 + y / 8) % 2 == 0 {
            [255; 4]
        } else {
            [0, 0, 0, 255]
        }
    });
    scene.materials[0].emission = Emission { color: [0.0, 0.3, 0.1], ..Emission::default() };
    scene.materials[1].emission = Emission { color: [0.1, 0.9, 0.9], texture: Some(picture), ..Emission::default() };
    scene.materials[2] = Material { shading: Shading::Unlit, ..two_tone() };
    check("emission", &scene, &row_view(3));
}

#[test]
fn outlines_of_every_kind() {
    let line = |width, color, lighting_mix| Material {
        outline: Some(Outline { width, color, lighting_mix, ..Outline::default() }),
        ..two_tone()
    };
    let world = OutlineWidth::World { metres: 0.025 };
    let mut scene = row(vec![
        line(world, [0.1, 0.02, 0.05], 0.0),
        line(world, [0.6, 0.4, 0.4], 1.0),
        line(OutlineWidth::Screen { height_ratio: 0.03 }, [0.02, 0.1, 0.3], 0.0),
        line(world, [0.1, 0.02, 0.05], 0.0),
    ]);
    // Along the contour v runs from pole to pole: the line swells four times.
    let mask = texture(&mut scene, 64, 64, |_, y| [0, (y % 16 * 17) as u8, 0, 255]);
    if let Some(outline) = &mut scene.materials[3].outline {
        outline.width_mask = Some(mask);
    }
    check("outline", &scene, &row_view(4));
}

/// Lines in the colours of what they surround: its shade, its light, another hue, and by part.
#[test]
fn outlines_in_the_colour_of_the_surface() {
    let tinted = |tint: OutlineTint| Material {
        outline: Some(Outline {
            width: OutlineWidth::World { metres: 0.03 },
            tint: Some(tint),
            clamp_px: Some([0.0, 100.0]),
            ..Outline::default()
        }),
        ..two_tone()
    };
    let mut scene = row(vec![
        tinted(OutlineTint::default()),
        tinted(OutlineTint { from: TintSource::Lit, ..OutlineTint::default() }),
        tinted(OutlineTint { hue_rad: 1.5, saturation: 1.6, ..OutlineTint::default() }),
        tinted(OutlineTint::default()),
    ]);
    let part_ids = texture(&mut scene, 64, 32, |_, y| [(y / 4) as u8, 0, 0, 255]);
    let mut colors = [[0.0; 3]; 8];
    for (i, color) in colors.iter_mut().enumerate() {
        *color = [0.1 + 0.1 * i as f32, 0.05, 0.8 - 0.1 * i as f32];
    }
    let parts = Some(PartColors { part_ids, colors });
    if let Some(outline) = &mut scene.materials[3].outline {
        outline.tint = Some(OutlineTint { parts, ..OutlineTint::default() });
    }
    check("outline-tint", &scene, &row_view(4));
}

#[test]
fn outlines_close_over_hard_edges() {
    let mut material = two_tone();
    let width = OutlineWidth::World { metres: 0.04 };
    material.outline = Some(Outline { width, color: [0.1, 0.02, 0.05], lighting_mix: 0.0, ..Outline::default() });
    let mut scene = scene(vec![(cube(0.33), material)]);
    scene.nodes[0].transform.rotation = Quat::from_rotation_x(0.5) * Quat::from_rotation_y(0.6);
    check("outline-cube", &scene, &view(192, 4.0));
}

#[test]
fn alpha_cut_blended_and_blended_with_depth() {
    let alpha = |mode, write_depth| Material { alpha: Alpha { mode, write_depth, ..Alpha::default() }, ..two_tone() };
    let mut scene = row(vec![
        alpha(AlphaMode::Opaque, false),
        alpha(AlphaMode::Mask, false),
        alpha(AlphaMode::Blend, false),
        alpha(AlphaMode::Blend, true),
    ]);
    let holes = texture(&mut scene, 64, 64, |x, y| {
        let (dx, dy) = ((x % 16) as f32 - 7.5, (y % 16) as f32 - 7.5);
        [255, 255, 255, (255.0 - 32.0 * (7.5 - (dx * dx + dy * dy).sqrt())).clamp(20.0, 255.0) as u8]
    });
    for material in &mut scene.materials {
        material.base.texture = Some(holes);
    }
    let plate = Material { base: Base { color: [0.2, 0.5, 0.4, 1.0], texture: None }, ..two_tone() };
    let mut wide = square([0.0, 0.0], 0.157, -1.5);
    wide.positions.iter_mut().for_each(|p| p[0] *= 14.0);
    wide.material = scene.materials.len();
    scene.materials.push(plate);
    scene.meshes[0].primitives.push(wide);
    check("alpha", &scene, &row_view(4));
}

#[test]
fn uv_animation_scrolls_turns_and_obeys_its_mask() {
    let mut scene = row(vec![toon(|t| t.shade_color = [0.5, 0.4, 0.6]); 4]);
    let picture = texture(&mut scene, 64, 64, quarters);
    let mask = texture(&mut scene, 64, 64, |_, y| [0, 0, if y < 32 { 255 } else { 0 }, 255]);
    let moves = [
        UvAnimation::default(),
        UvAnimation { scroll_u_per_s: 0.5, scroll_v_per_s: 0.25, ..UvAnimation::default() },
        UvAnimation { rotation_rad_per_s: 1.0, ..UvAnimation::default() },
        UvAnimation { scroll_u_per_s: 0.5, mask: Some(mask), ..UvAnimation::default() },
    ];
    for (material, uv_animation) in scene.materials.iter_mut().zip(moves) {
        material.base = Base { color: [1.0; 4], texture: Some(picture) };
        material.uv_animation = uv_animation;
    }
    let mut view = row_view(4);
    view.time_s = 0.5;
    check("uv-animation", &scene, &view);
}

#[test]
fn vertex_colours_multiply_both_tones() {
    let mut scene = row(vec![Material { base: Base::default(), ..two_tone() }]);
    let ball = &mut scene.meshes[0].primitives[0];
    ball.colors = ball.normals.iter().map(|n| [n[0] * 0.5 + 0.5, n[1] * 0.5 + 0.5, 0.6, 1.0]).collect();
    check("vertex-colours", &scene, &row_view(1));
}

#[test]
fn lamps_of_two_kinds_beside_the_sun() {
    let mut view = row_view(4);
    view.lights.directional.intensity = 0.35;
    let lamp = |x, color, spot| PunctualLight {
        position: Vec3::new(x, 0.6, 0.8),
        color: LinearRgb(color),
        intensity: 0.5,
        range: 2.5,
        spot,
    };
    let cone = SpotCone { direction: Vec3::new(0.0, -0.5, -0.8).normalize(), inner_rad: 0.2, outer_rad: 0.4 };
    view.lights.punctual = vec![lamp(-1.2, [1.0, 0.6, 0.3], None), lamp(1.5, [0.4, 0.6, 1.0], Some(cone))];
    check("lamps", &row(vec![two_tone(); 4]), &view);
}

#[test]
fn a_transparent_background_keeps_edges_and_glass() {
    let mut glass = two_tone();
    glass.base.color[3] = 0.4;
    glass.alpha = Alpha { mode: AlphaMode::Blend, ..Alpha::default() };
    let mut view = row_view(2);
    view.background = Background::Transparent;
    check("transparent", &row(vec![two_tone(), glass]), &view);
}

#[test]
fn a_light_background_shows_the_same_edges() {
    let mut view = row_view(2);
    view.background = Background::Color(Srgb([0xf4, 0xf1, 0xea]));
    let width = OutlineWidth::World { metres: 0.02 };
    let mut lined = two_tone();
    lined.outline = Some(Outline { width, ..Outline::default() });
    check("light-background", &row(vec![two_tone(), lined]), &view);
}
