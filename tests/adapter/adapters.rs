//! Every adapter of the machine draws the same pictures.

use hikage::{
    Background, Gpu,
    golden::{Tolerance, compare, sheet},
    material::{Alpha, AlphaMode, Outline, OutlineWidth, Rim},
    picture::write_png,
    scene::{Image, Scene},
};

use crate::support::{Lent, Shot, cube, render, scene, sphere, square, texture, two_tone, view};

/// Inside, two colour steps, and no more than one over a flat tile (values at the middle of a step round either way).
/// Along edges one of four samples may fall to the other side, in small groups.
const TOLERANCE: Tolerance = Tolerance { channel: 2, outliers: 0.003, blob: 8, drift: 1.0 };

#[test]
fn all_adapters_draw_the_same() {
    let gpus = gpus();
    let names: Vec<&str> = gpus.iter().map(|g| g.info().name.as_str()).collect();
    if gpus.len() < 2 {
        eprintln!("NOT RUN: needs two adapters, found {names:?}; a second Vulkan driver such as SwiftShader will do");
        return;
    }
    eprintln!("adapters: {names:?}");
    let mut faults = Vec::new();
    for (name, scene, view) in scenes() {
        let pictures: Vec<Image> = gpus.iter().map(|gpu| render(gpu, &scene, &view)).collect();
        for (a, b) in (0..gpus.len()).flat_map(|b| (0..b).map(move |a| (a, b))) {
            let report = compare(&pictures[a], &pictures[b], &TOLERANCE).expect("pictures of one size");
            eprintln!(
                "{name}: {} against {}: {} outliers ({:.3} %), largest group {}, largest difference {}, drift {:.3}",
                names[a],
                names[b],
                report.outliers,
                report.outlier_share() * 100.0,
                report.largest_blob.map_or(0, |b| b.pixels),
                report.max_abs,
                report.drift,
            );
            if let Some(fault) = report.fault(&TOLERANCE) {
                let path = format!("{}/adapters-{name}-{a}-{b}.png", env!("CARGO_TARGET_TMPDIR"));
                let sheet = sheet(&pictures[a], &pictures[b], Some(&report)).expect("a sheet");
                write_png(&path, &sheet).expect("a picture file");
                faults.push(format!("{name}, {} against {}: {fault}; see {path}", names[a], names[b]));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// One of each name: a driver may be listed twice.
fn gpus() -> Vec<Lent> {
    let mut names: Vec<String> = Gpu::adapters().into_iter().map(|a| a.name).collect();
    names.sort();
    names.dedup();
    names.iter().map(|name| Lent::of(name)).collect()
}

fn scenes() -> Vec<(&'static str, Scene, Shot)> {
    let ball = || sphere(0.5, 48, 96);
    let plain = two_tone();

    let mut lined = two_tone();
    let width = OutlineWidth::Screen { height_ratio: 0.012 };
    lined.outline = Some(Outline { width, color: [0.05, 0.02, 0.1], lighting_mix: 0.0, ..Outline::default() });

    let mut rimmed = two_tone();
    rimmed.rim = Rim { color: [0.2, 0.5, 0.9], fresnel_power: 3.0, lift: 0.1, ..Rim::default() };

    let mut glass = two_tone();
    glass.base.color = [0.2, 0.6, 0.9, 0.4];
    glass.alpha = Alpha { mode: AlphaMode::Blend, ..Alpha::default() };
    let mut transparent = scene(vec![(cube(0.35), plain.clone()), (square([0.1, 0.1], 0.4, 0.6), glass)]);
    transparent.nodes[0].transform.rotation = glam::Quat::from_euler(glam::EulerRot::YXZ, 0.6, 0.4, 0.0);

    let mut painted = scene(vec![(ball(), plain.clone())]);
    let checks = texture(&mut painted, 64, 64, |x, y| {
        if (x / 8 + y / 8) % 2 == 0 {
            [240; 4]
        } else {
            [90, 60, 30, 255]
        }
    });
    painted.materials[0].base.texture = Some(checks);

    let opaque = view(256, 4.0);
    let clear = Shot { background: Background::Transparent, ..opaque.clone() };
    vec![
        ("two-tone", scene(vec![(ball(), plain)]), opaque.clone()),
        ("outline", scene(vec![(ball(), lined)]), clear.clone()),
        ("rim", scene(vec![(ball(), rimmed)]), opaque.clone()),
        ("transparency", transparent, clear),
        ("texture", painted, opaque),
    ]
}
