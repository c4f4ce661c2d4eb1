//! The program as its users see it: exit status, messages, and files that are written whole or not at all.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};

/// One triangle in front of the camera.
const TRIANGLE: &str = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "buffers": [{"byteLength": 36,
   "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;

/// A fresh folder for one test, with `triangle.gltf` in it.
pub(crate) fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("cli").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).expect("temporary folder");
    fs::write(path.join("triangle.gltf"), TRIANGLE).expect("model");
    path
}

pub(crate) fn hikage(folder: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hikage"));
    command.args(args).current_dir(folder).output().expect("the program starts")
}

/// Runs, expects the status, and returns standard error, which is one line for everything but usage.
#[track_caller]
pub(crate) fn fails(folder: &Path, args: &[&str], status: i32) -> String {
    let output = hikage(folder, args);
    let error = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(status), "{args:?}: {error}");
    assert!(error.starts_with("error: ") || error.contains("\nerror: "), "{error}");
    if status != 2 {
        let lines = error.lines().filter(|l| l.starts_with("error: ")).count();
        assert!(lines == 1 && error.ends_with('\n'), "{error}");
    }
    error
}

#[track_caller]
pub(crate) fn succeeds(folder: &Path, args: &[&str]) -> String {
    let output = hikage(folder, args);
    assert_eq!(output.status.code(), Some(0), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

pub(crate) fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("folder");
    let mut names: Vec<_> = entries.flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn help_names_every_command_and_the_exit_statuses() {
    let dir = folder("help");
    let help = succeeds(&dir, &["--help"]);
    for word in ["render", "sheet", "animate", "inspect", "bench", "adapters", "Exit status", "NO_COLOR", "--timeout"] {
        assert!(help.contains(word), "{word} in {help}");
    }
    assert!(!help.contains("compare-references"));
    for command in ["render", "sheet", "animate", "inspect", "bench", "adapters"] {
        assert!(succeeds(&dir, &[command, "--help"]).contains("Usage: hikage"), "{command}");
    }
    assert!(succeeds(&dir, &["--version"]).starts_with("hikage "));
}

#[test]
fn wrong_usage_is_status_2_and_names_the_argument() {
    let dir = folder("usage");
    let render = ["render", "triangle.gltf", "-o", "out.png"];
    for (option, value) in [
        ("--size", "0x5"),
        ("--size", "99999999x1"),
        ("--size", "4x"),
        ("--yaw", "NaN"),
        ("--light", "10"),
        ("--light", "0,91"),
        ("--background", "#12345"),
        ("--samples", "2"),
        ("--accumulate", "0"),
        ("--accumulate", "100000"),
        ("--expression", "happy=2"),
        ("--expression", "=1"),
        ("--view", "sideways"),
        ("--time", "-1"),
        ("--channel", "none"),
        ("--timeout", "0"),
    ] {
        let joined = format!("{option}={value}");
        let error = fails(&dir, &[&render[..], &[joined.as_str()]].concat(), 2);
        assert!(error.contains(option), "{error}");
    }
    fails(&dir, &["render", "triangle.gltf"], 2);
    fails(&dir, &["render", "triangle.gltf", "-o", "out.jpg"], 2);
    fails(&dir, &["paint"], 2);
    assert_eq!(hikage(&dir, &[]).status.code(), Some(2));
    assert_eq!(files(&dir), ["triangle.gltf"]);
}

#[test]
fn a_missing_or_senseless_file_is_status_1_and_named() {
    let dir = folder("missing");
    fs::write(dir.join("noise.vrm"), b"\x01\x02\x03 no model").expect("file");
    fs::write(dir.join("noise.png"), b"no picture").expect("file");
    fs::write(dir.join("noise.wgsl"), b"fn main( {").expect("file");
    for name in ["none.vrm", "noise.vrm"] {
        let error = fails(&dir, &["render", name, "-o", "out.png"], 1);
        assert!(error.contains(name), "{error}");
    }
    for name in ["none.vrm", "none.png", "none.wgsl", "noise.vrm", "noise.png", "noise.wgsl", "."] {
        let error = fails(&dir, &["inspect", name], 1);
        assert!(error.contains(name), "{error}");
    }
    assert_eq!(files(&dir), ["noise.png", "noise.vrm", "noise.wgsl", "triangle.gltf"]);
}

#[test]
fn messages_cannot_steer_the_terminal() {
    let dir = folder("escape");
    let error = fails(&dir, &["inspect", "a\u{1b}[31m\nb\u{202e}.vrm"], 1);
    assert!(!error.contains('\u{1b}') && !error.contains('\u{202e}'), "{error:?}");
    assert!(error.contains("\\u{1b}[31m\\nb\\u{202e}"), "{error:?}");
}

#[test]
fn a_shot_with_a_wrong_key_or_value_is_status_1_and_says_which() {
    let dir = folder("shot");
    for (text, named) in [
        (r#"{"sise": [4, 4]}"#, "sise"),
        (r#"{"camera": {"fov": 20}}"#, "fov"),
        (r#"{"light": {"to_light": [0, 0, 0]}}"#, "light.to_light"),
        (r#"{"light": {"intensity": -1}}"#, "light.intensity"),
        (r#"{"camera": {"eye": [1e39, 0, 0]}}"#, "eye"),
        (r#"{"camera": {"fov_y_deg": 180}}"#, "camera.fov_y_deg"),
        (r#"{"camera": {"near": 5, "far": 2}}"#, "camera.far"),
        (r#"{"camera": {"eye": [0, 1, 0], "target": [0, 1, 0]}}"#, "camera"),
        (r#"{"size": [0, 4]}"#, "size"),
        (r#"{"background": "red"}"#, "background"),
        (r#"{"size": "#, "line 1"),
        ("[]", "shot.json"),
    ] {
        fs::write(dir.join("shot.json"), text).expect("shot");
        let error = fails(&dir, &["render", "triangle.gltf", "-o", "out.png", "--shot", "shot.json"], 1);
        assert!(error.contains(named) && error.contains("shot.json"), "{text}: {error}");
    }
    fs::write(dir.join("shot.json"), vec![b' '; 2 << 20]).expect("shot");
    let error = fails(&dir, &["render", "triangle.gltf", "-o", "out.png", "--shot", "shot.json"], 1);
    assert!(error.contains("limit"), "{error}");
    assert_eq!(files(&dir), ["shot.json", "triangle.gltf"]);
}

#[test]
fn an_output_that_cannot_be_written_is_said_before_drawing() {
    let dir = folder("output");
    fs::create_dir(dir.join("taken.png")).expect("folder");
    let error = fails(&dir, &["render", "triangle.gltf", "-o", "none/out.png"], 1);
    assert!(error.contains("none does not exist"), "{error}");
    let error = fails(&dir, &["render", "triangle.gltf", "-o", "taken.png"], 1);
    assert!(error.contains("not a regular file"), "{error}");
    let error = fails(&dir, &["render", "triangle.gltf", "-o", "out.png", "--report", "none/report.json"], 1);
    assert!(error.contains("none does not exist"), "{error}");
    assert_eq!(files(&dir), ["taken.png", "triangle.gltf"]);
}

/// Folders that a command writes into are made, with those above them; what is no folder is named.
#[test]
fn a_folder_for_the_output_is_made() {
    let dir = folder("new-folder");
    succeeds(&dir, &["texture", "fur", "-o", "new/fur", "--size", "64"]);
    succeeds(&dir, &["texture", "fur", "-o", "new/fur", "--size", "64"]);
    assert_eq!(files(&dir.join("new/fur")), ["fur.png", "fur_normal.png"]);
    succeeds(&dir, &["sdf", "unpack", "new/fur/fur.png", "-o", "masks", "--angles", "0,45"]);
    assert_eq!(files(&dir.join("masks")), ["000.png", "045.png"]);
    for command in [&["texture", "fur"][..], &["sdf", "unpack", "new/fur/fur.png", "--angles", "0"], &["gallery"]] {
        let error = fails(&dir, &[command, &["-o", "triangle.gltf"]].concat(), 1);
        assert!(error.contains("triangle.gltf: is not a folder"), "{error}");
    }
    assert_eq!(files(&dir), ["masks", "new", "triangle.gltf"]);
}

#[test]
fn inspect_tells_what_a_model_an_image_and_a_shader_hold() {
    let dir = folder("inspect");
    let text = succeeds(&dir, &["inspect", "triangle.gltf"]);
    assert!(text.contains("1 triangles, 3 vertices") && text.contains("Meshes (1)"), "{text}");
    assert!(!text.contains('\u{1b}'), "no colours without a terminal");
    let json: serde_json::Value =
        serde_json::from_str(&succeeds(&dir, &["inspect", "triangle.gltf", "--json"])).expect("JSON");
    assert_eq!((&json["triangles"], &json["kind"]), (&1.into(), &"model".into()));

    let picture = hikage::scene::Image { width: 3, height: 2, pixels: vec![200; 24], ..Default::default() };
    hikage::picture::write_png(dir.join("p.png"), &picture).expect("picture");
    fs::copy(dir.join("p.png"), dir.join("unnamed")).expect("copy");
    assert_eq!(succeeds(&dir, &["inspect", "p.png"]), "png, 3 x 2 pixels, 8 bits a channel\n");
    assert_eq!(succeeds(&dir, &["inspect", "unnamed"]), "png, 3 x 2 pixels, 8 bits a channel\n");

    fs::write(dir.join("s.wgsl"), "@compute @workgroup_size(1) fn main() {}").expect("shader");
    assert!(succeeds(&dir, &["inspect", "s.wgsl"]).contains("main"));
}

#[test]
fn profiles_are_listed_shown_and_drawn() {
    let dir = folder("profile");
    let list = succeeds(&dir, &["profile", "list"]);
    for name in ["skin-light", "skin-dark", "jade", "wax", "milk", "marble"] {
        assert!(list.contains(name), "{name} in {list}");
    }
    let parsed = |text: String| serde_json::from_str::<serde_json::Value>(&text).expect("JSON");
    assert_eq!(parsed(succeeds(&dir, &["profile", "list", "--json"])).as_array().map(Vec::len), Some(6));
    fs::write(dir.join("ear.profile.toml"), "scattering_distance_mm = [1, 0.5, 0.25]\nior = 1.5").expect("file");
    let text = succeeds(&dir, &["profile", "show", "ear.profile.toml", "-o", "ear.png"]);
    assert!(text.starts_with("ear\n") && text.contains("1.00 0.500 0.250 mm") && text.contains("10.4 mm"), "{text}");
    let picture = hikage::picture::read_png(dir.join("ear.png")).expect("a picture");
    assert_eq!((picture.width, picture.height), (1200, 800));
    let json = parsed(succeeds(&dir, &["profile", "show", "jade", "--json"]));
    assert_eq!((&json["name"], &json["profile"]["ior"]), (&"jade".into(), &1.5.into()));

    fs::write(dir.join("bad.profile.toml"), "scattering_distance_mm = [0, 1, 1]").expect("file");
    for (name, words) in [
        ("jaed", &["jaed", "jade", ".profile.toml"][..]),
        ("none.profile.toml", &["none.profile.toml"]),
        ("bad.profile.toml", &["bad.profile.toml", "scattering_distance_mm", "is 0"]),
    ] {
        let error = fails(&dir, &["profile", "show", name, "-o", "out.png"], 1);
        assert!(words.iter().all(|w| error.contains(w)), "{error}");
    }
    fails(&dir, &["profile", "show", "jade", "-o", "out.jpg"], 2);
    assert_eq!(files(&dir), ["bad.profile.toml", "ear.png", "ear.profile.toml", "triangle.gltf"]);
}

// From here on an adapter is needed.

#[test]
fn inspect_finds_no_fault_in_the_built_in_character() {
    let dir = folder("built-in");
    fs::write(dir.join("hikage.vrm"), hikage_character::file()).expect("file");
    let text = succeeds(&dir, &["inspect", "hikage.vrm"]);
    assert!(text.contains("VRM 1.0") && !text.to_lowercase().contains("warning"), "{text}");
}

/// Without a session, a driver would complain; the program gives it a folder of the user's own, where it can.
#[cfg(target_os = "linux")]
#[test]
fn without_a_session_nothing_is_said_and_nothing_else_changes() {
    use std::os::unix::fs::PermissionsExt as _;
    let dir = folder("session");
    fs::create_dir(dir.join("temporary")).expect("folder");
    let run = |variable: Option<&str>, temporary: &Path, args: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hikage"));
        command.args(args).current_dir(&dir).env_remove("XDG_RUNTIME_DIR").env("TMPDIR", temporary);
        let output = command.envs(variable.map(|v| ("XDG_RUNTIME_DIR", v))).output().expect("the program starts");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    let session = dir.to_str().expect("UTF-8");
    for args in [
        &["adapters"][..],
        &["render", "triangle.gltf", "-o", "out.png", "--size", "8x8"],
        &["render", "triangle.gltf", "-o", "out.png", "--expression", "no such=1"],
        &["inspect", "none.vrm"],
        &["paint"],
        &["--help"],
    ] {
        let expected = run(Some(session), &dir, args);
        for variable in [None, Some(""), Some("relative")] {
            // A folder relative to this one, too.
            for temporary in [&dir.join("temporary"), Path::new("temporary")] {
                assert_eq!(run(variable, temporary, args), expected, "{args:?}, {variable:?}");
            }
        }
        // Where no folder can be had, the program goes on; what a driver says is its own.
        let (status, said, _) = run(None, &dir.join("none"), args);
        assert_eq!((status, &said), (expected.0, &expected.1), "{args:?}");
    }
    let [made] = &files(&dir.join("temporary"))[..] else { panic!("one folder is made") };
    assert!(made.starts_with("hikage-"), "{made}");
    let open = |mode| fs::set_permissions(dir.join("temporary").join(made), fs::Permissions::from_mode(mode));
    let mode = fs::metadata(dir.join("temporary").join(made)).expect("a folder").permissions().mode();
    assert_eq!(mode & 0o777, 0o700);
    // One that others may write into is not used, and nothing ends for it.
    open(0o777).expect("permissions");
    assert_eq!(run(None, &dir.join("temporary"), &["adapters"]).0, Some(0));
}

#[test]
fn adapters_are_listed_and_an_unknown_one_is_status_3_and_names_them() {
    let dir = folder("adapters");
    let list: Vec<serde_json::Value> =
        serde_json::from_str(&succeeds(&dir, &["adapters", "--json"])).expect("a JSON list");
    let name = list[0]["name"].as_str().expect("a name");
    assert!(succeeds(&dir, &["adapters"]).contains(name));

    let render = ["render", "triangle.gltf", "-o", "out.png", "--adapter", "no such adapter"];
    let error = fails(&dir, &render, 3);
    assert!(error.contains(name) && error.contains("no such adapter"), "{error}");
    assert_eq!(files(&dir), ["triangle.gltf"]);
}

#[test]
fn render_writes_the_picture_and_the_report_and_nothing_else() {
    let dir = folder("render");
    fs::write(dir.join("shot.json"), r#"{"size": [40, 30], "background": "none", "camera": {"eye": [0, 0, 5]}}"#)
        .expect("shot");
    let args = ["render", "triangle.gltf", "-o", "out.png", "--shot", "shot.json", "--report", "report.json"];
    succeeds(&dir, &args);
    let first = fs::read(dir.join("out.png")).expect("picture");
    let picture = hikage::picture::read_png(dir.join("out.png")).expect("PNG");
    assert_eq!((picture.width, picture.height), (40, 30));
    let report: serde_json::Value =
        serde_json::from_slice(&fs::read(dir.join("report.json")).expect("report")).expect("JSON");
    assert_eq!(report["options"]["size"], serde_json::json!([40, 30]));
    assert_eq!(report["options"]["background"], "none");
    assert_eq!(report["options"]["eye"], serde_json::json!([0.0, 0.0, 5.0]));
    assert!(report["ms"]["total"].as_f64().is_some_and(|ms| ms > 0.0));
    assert!(report["adapter"]["name"].is_string());

    // Options win over the shot, and the same command gives the same bytes.
    succeeds(&dir, &args);
    assert_eq!(fs::read(dir.join("out.png")).expect("picture"), first);
    succeeds(&dir, &[&args[..], &["--size", "8x9", "--background", "#102030", "--samples", "1"]].concat());
    let picture = hikage::picture::read_png(dir.join("out.png")).expect("PNG");
    assert_eq!((picture.width, picture.height, picture.pixels[3]), (8, 9, 255));
    assert_eq!(files(&dir), ["out.png", "report.json", "shot.json", "triangle.gltf"]);
}

/// What needs an environment says how to have one, and writes nothing without.
#[test]
fn an_environment_that_is_missing_is_status_1_and_one_is_offered() {
    let dir = folder("environment");
    fs::write(dir.join("bad.hdr"), b"no picture").expect("file");
    fs::write(dir.join("shot.json"), r#"{"background": "environment"}"#).expect("shot");
    let render = ["render", "triangle.gltf", "-o", "out.png", "--size", "32x32"];
    for (options, named) in [
        (&["--background", "environment"][..], "the background is the environment"),
        (&["--background", "environment", "--environment", "none"], "the background is the environment"),
        (&["--shot", "shot.json"], "environment"),
        (&["--environment-turn", "30"], "--environment-turn"),
    ] {
        let error = fails(&dir, &[&render[..], options].concat(), 1);
        assert!(error.contains(named) && error.contains("add --environment studio"), "{options:?}: {error}");
    }
    let error = fails(&dir, &[&render[..], &["--environment", "bad.hdr"]].concat(), 1);
    assert!(error.contains("bad.hdr") && error.contains("Radiance file"), "{error}");
    let error = fails(&dir, &[&render[..], &["--environment", "stduio"]].concat(), 2);
    assert!(error.contains("--environment") && error.contains("studio, sky, none"), "{error}");
    assert_eq!(files(&dir), ["bad.hdr", "shot.json", "triangle.gltf"]);

    let draw = |options: &[&str]| {
        succeeds(&dir, &[&render[..], options].concat());
        hikage::picture::read_png(dir.join("out.png")).expect("PNG")
    };
    // A corner beside the triangle.
    let behind = |picture: &hikage::scene::Image| picture.pixels[..4].to_vec();
    let studio = draw(&["--background", "environment", "--environment", "studio"]);
    assert!(behind(&studio) != [0x80, 0x80, 0x80, 0xff] && behind(&studio)[3] == 0xff, "{:?}", behind(&studio));
    let sky = draw(&["--shot", "shot.json", "--environment", "sky"]);
    assert_ne!(behind(&sky), behind(&studio));
    let unseen = draw(&["--environment", "sky"]);
    assert_eq!(behind(&unseen), [0x80, 0x80, 0x80, 0xff], "it is seen without being asked for");
}

#[test]
fn a_sheet_shows_any_model_and_the_built_in_one_without_a_file() {
    let dir = folder("sheet");
    succeeds(&dir, &["sheet", "triangle.gltf", "-o", "sheet.png", "--panel", "64"]);
    let picture = hikage::picture::read_png(dir.join("sheet.png")).expect("PNG");
    // Without a humanoid: four portraits and four whole views.
    assert_eq!((picture.width, picture.height), (4 * 72 + 8, 8 + (64 + 24 + 8) + (112 + 24 + 8)));
    succeeds(&dir, &["render", "-o", "heroine.png", "--size", "64x64", "--background", "none"]);
    let picture = hikage::picture::read_png(dir.join("heroine.png")).expect("PNG");
    let seen = picture.pixels.chunks_exact(4).filter(|p| p[3] == 255).count();
    assert!((1000..3500).contains(&seen), "{seen} of 4096 pixels are hers");
    assert_eq!(files(&dir), ["heroine.png", "sheet.png", "triangle.gltf"]);
}

#[test]
fn a_gallery_is_a_page_of_sheets() {
    let dir = folder("gallery");
    let error = fails(&dir, &["gallery", "-o", "none", "--only", "metal,sheep"], 1);
    assert!(error.contains("sheep") && error.contains("metal"), "{error}");
    assert_eq!(files(&dir), ["triangle.gltf"]);
    succeeds(&dir, &["gallery", "-o", "new", "--only", "diamond", "--panel", "64"]);
    let dir = dir.join("new");
    assert_eq!(files(&dir), ["diamond.png", "index.html"]);
    let page = fs::read_to_string(dir.join("index.html")).expect("a page");
    assert!(page.contains("src=\"diamond.png\"") && page.contains("</html>"), "{page}");
    let sheet = hikage::picture::read_png(dir.join("diamond.png")).expect("a sheet");
    assert!(sheet.width > 8 * 64 && sheet.height > 64, "{} x {}", sheet.width, sheet.height);
}

#[test]
fn bench_tells_what_each_look_costs() {
    let dir = folder("bench-each");
    let args = ["bench", "triangle.gltf", "--look", "anime", "--each", "--json", "--size", "32x32", "--frames", "1"];
    let costs: serde_json::Value = serde_json::from_str(&succeeds(&dir, &args)).expect("JSON");
    let costs = costs.as_array().expect("a list");
    assert_eq!(costs[0]["look"], "all");
    for look in ["outline", "self_shadow"] {
        let cost = costs.iter().find(|c| c["look"] == look).unwrap_or_else(|| panic!("{look} is missing"));
        assert!(cost["ratio"].as_f64().is_some_and(|r| r > 0.0), "{cost}");
    }
}

#[test]
fn an_unknown_expression_is_status_1_and_leaves_the_old_picture() {
    let dir = folder("expression");
    fs::write(dir.join("out.png"), b"old").expect("file");
    let args = ["render", "triangle.gltf", "-o", "out.png", "--size", "8x8", "--expression", "grin=0.5"];
    let error = fails(&dir, &args, 1);
    assert!(error.contains("grin"), "{error}");
    assert_eq!(fs::read(dir.join("out.png")).expect("file"), b"old");
    assert_eq!(files(&dir), ["out.png", "triangle.gltf"]);
}

#[test]
fn a_timeout_ends_the_program_in_time() {
    let dir = folder("timeout");
    let start = Instant::now();
    let args =
        ["bench", "triangle.gltf", "--frames", "10000", "--actors", "4096", "--size", "2048x2048", "--timeout", "0.5"];
    let output = hikage(&dir, &args);
    assert!(start.elapsed() < Duration::from_secs(20));
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(matches!(output.status.code(), Some(1 | 3)) && error.contains("--timeout"), "{error}");
}

#[test]
fn bench_reports_frame_floor_and_their_ratio() {
    let dir = folder("bench");
    let args = ["bench", "triangle.gltf", "--size", "32x32", "--frames", "3"];
    let report: serde_json::Value =
        serde_json::from_str(&succeeds(&dir, &[&args[..], &["--json"]].concat())).expect("JSON");
    for key in ["frame_ms", "floor_ms", "floor_ratio", "draws", "triangles"] {
        assert!(!report[key].is_null(), "{key} in {report}");
    }
    assert!(succeeds(&dir, &args).contains("frame / floor"));
}

/// A look file beside the model is used without being named; `--look` wins over it.
#[test]
fn a_look_beside_the_model_is_used() {
    let folder = folder("look");
    let draw = |out: &str, look: &[&str]| {
        let args = [
            &["render", "triangle.gltf", "-o", out, "--size", "32x32", "--view", "full", "--background", "none"],
            look,
        ]
        .concat();
        succeeds(&folder, &args);
        fs::read(folder.join(out)).expect("a picture")
    };
    let bare = draw("bare.png", &[]);
    fs::write(folder.join("triangle.look.toml"), "base = \"plain\"\n[role.other.base]\ncolor = \"#ff0000\"\n")
        .expect("a look");
    let red = draw("red.png", &[]);
    assert!(red != bare, "the look beside the model does nothing");
    assert!(draw("plain.png", &["--look", "plain"]) == bare, "--look plain is not plain");
    fs::rename(folder.join("triangle.look.toml"), folder.join("other.look.toml")).expect("another name");
    assert!(draw("named.png", &["--look", "other.look.toml"]) == red, "a named look is another");

    fs::write(folder.join("bad.look.toml"), "[role.other.base]\ncolour = \"#ff0000\"\n").expect("a look");
    let error = fails(&folder, &["render", "triangle.gltf", "-o", "bad.png", "--look", "bad.look.toml"], 1);
    assert!(error.contains("bad.look.toml") && error.contains("\"colour\"") && error.contains("\"color\""), "{error}");
    let error = fails(&folder, &["render", "triangle.gltf", "-o", "bad.png", "--look", "none.look.toml"], 1);
    assert!(error.contains("none.look.toml"), "{error}");
    let error = fails(&folder, &["render", "triangle.gltf", "-o", "bad.png", "--look", "pretty"], 2);
    assert!(error.contains("plain, anime, natural or a look file"), "{error}");
    assert!(!folder.join("bad.png").exists());
}

/// Without `--look` the built-in character has her own look, which `plain` takes away; other models stay as they are.
#[test]
fn the_built_in_character_brings_her_look() {
    let folder = folder("own-look");
    let draw = |model: &[&str], look: &[&str]| {
        let args = ["render", "-o", "out.png", "--size", "48x48", "--view", "face", "--pose", "relaxed"];
        succeeds(&folder, &[&args[..], model, look].concat());
        fs::read(folder.join("out.png")).expect("a picture")
    };
    let [own, anime, plain] = [&[][..], &["--look", "anime"], &["--look", "plain"]].map(|look| draw(&[], look));
    assert!(own == anime && own != plain, "her look is not the default");
    fs::write(folder.join("hikage.vrm"), hikage_character::file()).expect("file");
    assert!(draw(&["hikage.vrm"], &[]) == plain, "a file brings a look that nobody named");
    let sheet = |look: &[&str]| {
        succeeds(&folder, &[&["sheet", "-o", "sheet.png", "--panel", "64", "--sweep", "head"], look].concat());
        fs::read(folder.join("sheet.png")).expect("a sheet")
    };
    assert!(sheet(&[]) == sheet(&["--look", "anime"]), "a sheet has another default");
}

/// The look file that is written gives the anime look, and a sheet of a sweep shows it.
#[test]
fn a_look_to_start_from_is_the_anime_look() {
    let folder = folder("look-template");
    succeeds(&folder, &["look", "-o", "her.look.toml"]);
    let text = fs::read_to_string(folder.join("her.look.toml")).expect("a look");
    for section in
        ["[bangs]", "[eyes_through]", "[role.face.face_shadow]", "[role.eye.layer]", "[role.hair-front.depth_rim]"]
    {
        assert!(text.contains(section), "{section} is missing:\n{text}");
    }
    let draw = |out: &str, look: &str| {
        succeeds(&folder, &["render", "-o", out, "--size", "48x48", "--view", "face", "--look", look]);
        fs::read(folder.join(out)).expect("a picture")
    };
    assert!(draw("a.png", "anime") == draw("b.png", "her.look.toml"), "the written look is another");
    succeeds(&folder, &["sheet", "--look", "anime", "--sweep", "distance", "--panel", "64", "-o", "sheet.png"]);
    assert!(folder.join("sheet.png").exists());
    fails(&folder, &["look", "-o", "her.txt"], 2);
}
