//! Profile files and profiles by name: what they give, and what they say about mistakes.

use std::path::{Path, PathBuf};

use hikage::material::{Material, Skin, SkinDiffuse};
use hikage::scene::Scene;
use hikage::skin::{DiffusionProfile, Transmission};
use hikage::{LookFile, ProfileFile};

/// A folder of its own for one test.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("profile-file-{name}"));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// A material called Face under a look that lies in a folder.
fn face(folder: &Path, look: &str) -> Result<Material, String> {
    let face = Material { name: "Face".into(), ..Material::default() };
    let mut scene = Scene { materials: vec![face], ..Scene::default() };
    let text = format!("base = \"plain\"\n[material.Face]\n{look}");
    LookFile::parse(folder.join("girl.look.toml"), &text)
        .and_then(|look| look.apply(&mut scene, None))
        .map_err(|e| e.to_string())?;
    Ok(scene.materials.remove(0))
}

fn skin(folder: &Path, look: &str) -> Result<Skin, String> {
    face(folder, look).map(|face| face.skin.expect("skin"))
}

#[test]
fn a_file_gives_what_it_names_over_the_defaults() {
    let text = "name = \"Ear\"\nscattering_distance_mm = [1, 0.5, 0.25]\ntransmission = \"thick\"\nior = 1.5";
    let file = ProfileFile::parse("a/ear.profile.toml", text).expect("a profile");
    let expected = DiffusionProfile {
        scattering_distance_mm: [1.0, 0.5, 0.25],
        transmission: Transmission::Thick,
        ior: 1.5,
        ..DiffusionProfile::default()
    };
    assert_eq!(file, ProfileFile { name: "Ear".to_owned(), profile: expected });
    let bare = ProfileFile::parse("a/ear.profile.toml", "").expect("a profile");
    assert_eq!(bare, ProfileFile { name: "ear".to_owned(), profile: DiffusionProfile::default() });
}

#[test]
fn mistakes_are_named_with_their_key() {
    let cases = [
        (
            "scatering_distance_mm = [1, 1, 1]",
            &["\"scatering_distance_mm\"", "nearest is \"scattering_distance_mm\""][..],
        ),
        ("preset = \"jade\"", &["preset"]),
        ("scattering_distance_mm = [0, 0.3, 0.2]", &["scattering_distance_mm", "is 0", "0.001..1000"]),
        ("scattering_distance_mm = [0.7, -0.3, 0.2]", &["scattering_distance_mm", "is -0.3", "0.001..1000"]),
        ("scattering_distance_mm = [0.7, nan, 0.2]", &["scattering_distance_mm", "not finite"]),
        ("scattering_distance_mm = [0.7, 0.3, inf]", &["scattering_distance_mm", "not finite"]),
        ("scattering_distance_mm = [0.7, 0.3, 1e300]", &["scattering_distance_mm", "not finite"]),
        ("scattering_distance_mm = [0.7, 0.3]", &["scattering_distance_mm", "length"]),
        ("scattering_distance_mm = 0.7", &["scattering_distance_mm", "expected an array"]),
        ("scattering_distance_mm = \"far\"", &["scattering_distance_mm", "far"]),
        ("ior = \"glass\"", &["ior", "glass"]),
        ("ior = 0.5", &["ior", "is 0.5", "1..3"]),
        ("world_scale = false", &["world_scale", "boolean"]),
        ("texturing = \"pre\"", &["texturing", "\"pre\"", "post"]),
        ("transmission = \"thck\"", &["transmission", "\"thck\"", "\"thick\""]),
        ("thickness_remap_mm = [0, -1]", &["thickness_remap_mm", "is -1"]),
        ("name = 3", &["name", "expected a text"]),
        ("ior = 1.4\nior = 1.5", &["line 2"]),
        ("ior = [", &["line 1"]),
    ];
    for (text, expected) in cases {
        let message = ProfileFile::parse("ear.profile.toml", text).expect_err(text).to_string();
        for part in expected {
            assert!(message.contains(part), "{text:?}: {message:?} lacks {part:?}");
        }
        assert!(message.starts_with("ear.profile.toml: ") && !message.contains('\n'), "{message}");
    }
}

#[test]
fn files_that_are_none_are_refused() {
    let folder = folder("refused");
    let message = |path: &Path| ProfileFile::read(path).expect_err("no profile").to_string();
    assert!(message(&folder).contains("not a regular file"));
    assert!(message(&folder.join("none.profile.toml")).contains("none.profile.toml"));
    let large = folder.join("large.profile.toml");
    std::fs::write(&large, "#".repeat((1 << 20) + 1)).expect("a file");
    assert!(message(&large).contains("over the limit"));
    std::fs::write(&large, [0xff, 0xfe, 0x00]).expect("a file");
    assert!(message(&large).contains("UTF-8"), "{}", message(&large));
}

#[test]
fn looks_refer_to_profiles_by_name_by_file_or_write_them() {
    let folder = folder("looks");
    std::fs::write(folder.join("ear.profile.toml"), "scattering_distance_mm = [1, 0.5, 0.25]").expect("a file");
    let by = |profile| Skin { profile, ..Skin::default() };
    let ear = DiffusionProfile { scattering_distance_mm: [1.0, 0.5, 0.25], ..DiffusionProfile::default() };
    assert_eq!(skin(&folder, "skin = { profile = \"ear.profile.toml\" }"), Ok(by(ear)));
    assert_eq!(skin(&folder, "skin = { profile = { scattering_distance_mm = [1, 0.5, 0.25] } }"), Ok(by(ear)));
    let jade = DiffusionProfile::named("jade").expect("a preset");
    assert_eq!(skin(&folder, "skin = { profile = \"jade\" }"), Ok(by(jade)));
    let of_eye = face(&folder, "eye = { profile = \"jade\" }").map(|face| face.eye.expect("an eye").profile);
    assert_eq!(of_eye, Ok(jade));
    let over = skin(&folder, "skin = { preset = \"skin_dark\", profile = \"jade\", diffuse = \"lambert\" }");
    assert_eq!(over, Ok(Skin { diffuse: SkinDiffuse::Lambert, ..Skin { profile: jade, ..Skin::skin_dark() } }));
}

#[test]
fn looks_name_what_is_wrong_with_a_profile() {
    let folder = folder("wrong");
    std::fs::write(folder.join("bad.profile.toml"), "ior = 9").expect("a file");
    for (look, expected) in [
        (
            "skin = { profile = \"jaed\" }",
            &["girl.look.toml", "skin.profile", "\"jaed\"", "\"jade\"", ".profile.toml"][..],
        ),
        ("skin = { profile = \"none.profile.toml\" }", &["none.profile.toml"]),
        ("skin = { profile = \"../up.profile.toml\" }", &["skin.profile", "leads out of the folder"]),
        ("skin = { profile = \"bad.profile.toml\" }", &["bad.profile.toml", "ior", "is 9"]),
        ("skin = { profile = { ior = 9 } }", &["girl.look.toml", "skin.profile.ior", "is 9"]),
        (
            "skin = { profile = { scattering_distance_mm = [inf, 1, 1] } }",
            &["profile.scattering_distance_mm", "not finite"],
        ),
        ("skin = { profile = { scattering_distance_m = [1, 1, 1] } }", &["\"scattering_distance_mm\""]),
        ("skin = { profile = 3 }", &["girl.look.toml", "skin.profile", "expected a table"]),
    ] {
        let message = skin(&folder, look).expect_err(look);
        for part in expected {
            assert!(message.contains(part), "{look:?}: {message:?} lacks {part:?}");
        }
        assert!(!message.contains('\n'), "{message}");
    }
}
