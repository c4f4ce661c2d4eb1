//! Compositions by name: each draws a picture of its own of any model, and options win over it.

use std::path::{Path, PathBuf};

use crate::cli::{fails, folder, succeeds};

const NAMES: [&str; 5] = ["cover", "portrait", "turnaround", "night", "sunset"];

/// A picture of a model, small.
fn drawn(dir: &Path, model: &[&str], options: &[&str]) -> image::RgbaImage {
    let args = [&["render", "-o", "out.png", "--size", "96x96"][..], model, options].concat();
    succeeds(dir, &args);
    image::open(dir.join("out.png")).expect("picture").to_rgba8()
}

#[test]
fn every_preset_draws_any_model() {
    let dir = folder("presets");
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models/m2m_human-sophia.glb");
    let mut models = vec![None, Some(PathBuf::from("triangle.gltf"))];
    if shared.is_file() {
        models.push(Some(shared));
    } else {
        eprintln!("not tested: {} is absent", shared.display());
    }
    for model in models {
        let path = model.as_ref().map(|path| path.display().to_string());
        let model: Vec<&str> = path.iter().map(String::as_str).collect();
        let pictures = NAMES.map(|name| drawn(&dir, &model, &["--preset", name]));
        for (i, a) in pictures.iter().enumerate() {
            assert!(a.pixels().all(|p| p.0[3] == 255), "{model:?}: {} is seen through", NAMES[i]);
            assert!(pictures[..i].iter().all(|b| a != b), "{model:?}: {}", NAMES[i]);
        }
    }
}

#[test]
fn options_win_over_a_preset() {
    let dir = folder("preset-options");
    let model = ["triangle.gltf"];
    let night = drawn(&dir, &model, &["--preset", "night"]);
    assert_eq!(night, drawn(&dir, &model, &["--preset", "night"]));
    let [r, g, b, _] = night.get_pixel(0, 0).0;
    assert!(b > r && b > g, "{r} {g} {b}");
    let red = drawn(&dir, &model, &["--preset", "night", "--background", "#ff0000"]);
    assert_eq!(red.get_pixel(0, 0).0, [255, 0, 0, 255]);
    for option in [["--light", "150,10"], ["--yaw", "50"], ["--background", "none"]] {
        let other = drawn(&dir, &model, &[&["--preset", "night"][..], &option].concat());
        assert!(other != night, "{option:?}");
    }
    succeeds(&dir, &["render", "triangle.gltf", "-o", "own.png", "--preset", "sunset"]);
    assert_eq!(image::image_dimensions(dir.join("own.png")).expect("picture"), (1440, 960));
}

#[test]
fn an_unknown_preset_names_those_that_there_are() {
    let dir = folder("preset-name");
    let error = fails(&dir, &["render", "triangle.gltf", "-o", "out.png", "--preset", "noon"], 2);
    for name in NAMES {
        assert!(error.contains(name), "{error}");
    }
}
