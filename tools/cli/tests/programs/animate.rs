//! Characters in motion: what `animate` writes, and `render --clip`.

use std::collections::BTreeSet;
use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use image::AnimationDecoder as _;
use image::codecs::{gif::GifDecoder, webp::WebPDecoder};
use serde_json::{Map, Value, json};

use crate::cli::{fails, files, hikage, succeeds};
use crate::gltf::{F32, Glb, floats};

/// Bones with their parents and places against them.
const BONES: &[(&str, usize, [f32; 3])] = &[
    ("hips", 0, [0.0, 0.9, 0.0]),
    ("spine", 0, [0.0, 0.2, 0.0]),
    ("head", 1, [0.0, 0.3, 0.0]),
    ("leftUpperLeg", 0, [0.1, -0.1, 0.0]),
    ("leftLowerLeg", 3, [0.0, -0.4, 0.0]),
    ("leftFoot", 4, [0.0, -0.4, 0.0]),
    ("rightUpperLeg", 0, [-0.1, -0.1, 0.0]),
    ("rightLowerLeg", 6, [0.0, -0.4, 0.0]),
    ("rightFoot", 7, [0.0, -0.4, 0.0]),
    ("leftUpperArm", 1, [0.15, 0.2, 0.0]),
    ("leftLowerArm", 9, [0.25, 0.0, 0.0]),
    ("leftHand", 10, [0.25, 0.0, 0.0]),
    ("rightUpperArm", 1, [-0.15, 0.2, 0.0]),
    ("rightLowerArm", 12, [-0.25, 0.0, 0.0]),
    ("rightHand", 13, [-0.25, 0.0, 0.0]),
];

/// A humanoid of a triangle a bone, with a swinging plait, and an animation of its own that turns the plait.
fn doll() -> Vec<u8> {
    let mut glb = Glb::triangle();
    let small = floats(&[-0.1, 0., 0., 0., -0.3, 0., 0.1, 0., 0.]);
    let positions = glb.accessor(F32, "VEC3", &small, 3, false);
    glb.primitive()["attributes"]["POSITION"] = json!(positions);
    let mut nodes: Vec<Value> =
        BONES.iter().map(|(name, _, at)| json!({"name": name, "translation": at, "mesh": 0, "children": []})).collect();
    for (i, (_, parent, _)) in BONES.iter().enumerate().skip(1) {
        nodes[*parent]["children"].as_array_mut().expect("children").push(json!(i));
    }
    let plait = nodes.len();
    nodes[2]["children"] = json!([plait]);
    nodes.push(json!({"name": "plait", "translation": [0.0, 0.1, -0.1], "mesh": 0, "children": [plait + 1]}));
    nodes.push(json!({"name": "plait end", "translation": [0.0, -0.3, 0.0]}));
    glb.json["nodes"] = json!(nodes);
    let times = glb.accessor(F32, "SCALAR", &floats(&[0.0, 1.0, 2.0]), 3, false);
    let turns = glb.accessor(F32, "VEC4", &floats(&[0., 0., 0., 1., 0., 0., 0.6, 0.8, 0., 0., 0., 1.]), 3, false);
    glb.push(
        "animations",
        json!({
            "name": "Nod", "samplers": [{"input": times, "output": turns}],
            "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}]
        }),
    );
    let bones: Map<String, Value> =
        BONES.iter().enumerate().map(|(i, (name, ..))| ((*name).to_owned(), json!({"node": i}))).collect();
    glb.json["extensionsUsed"] = json!(["VRMC_vrm", "VRMC_springBone"]);
    glb.json["extensions"] = json!({
        "VRMC_vrm": {
            "specVersion": "1.0", "meta": {"name": "Doll", "authors": ["nobody"], "licenseUrl": "https://vrm.dev/licenses/1.0/"},
            "humanoid": {"humanBones": bones}
        },
        "VRMC_springBone": {
            "specVersion": "1.0",
            "springs": [{"joints": [
                {"node": plait, "stiffness": 0.2, "gravityPower": 0.2, "dragForce": 0.2}, {"node": plait + 1}
            ]}]
        }
    });
    glb.bytes()
}

fn folder(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("animate").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).expect("temporary folder");
    fs::write(path.join("doll.vrm"), doll()).expect("model");
    path
}

/// Pixels of all frames, which have this size.
fn frames(file: &Path, size: (u32, u32)) -> Vec<Vec<u8>> {
    let bytes = Cursor::new(fs::read(file).expect("animation"));
    let frames = if file.extension().is_some_and(|e| e == "gif") {
        GifDecoder::new(bytes).expect("GIF").into_frames().collect_frames()
    } else {
        WebPDecoder::new(bytes).expect("WebP").into_frames().collect_frames()
    };
    let raw = |frame: image::Frame| {
        assert_eq!(frame.buffer().dimensions(), size);
        frame.into_buffer().into_raw()
    };
    frames.expect("frames").into_iter().map(raw).collect()
}

/// How many of them are unlike all others.
fn distinct(frames: &[Vec<u8>]) -> usize {
    frames.iter().collect::<BTreeSet<_>>().len()
}

#[test]
fn an_animation_is_written_in_every_form_and_always_the_same() {
    let dir = folder("forms");
    let animate = |more: &[&str]| {
        let usual = ["animate", "doll.vrm", "--clip", "walk", "--size", "64x80"];
        succeeds(&dir, &[&usual[..], more].concat());
    };
    let short = ["--seconds", "0.3", "--fps", "10", "-o"];
    for name in ["a.webp", "b.webp", "a.gif", "new/frames/"] {
        animate(&[&short[..], &[name]].concat());
    }
    let webp = frames(&dir.join("a.webp"), (64, 80));
    assert_eq!((webp.len(), distinct(&webp)), (3, 3));
    assert!(fs::read(dir.join("a.webp")).expect("file") == fs::read(dir.join("b.webp")).expect("file"));
    let gif = frames(&dir.join("a.gif"), (64, 80));
    assert_eq!((gif.len(), distinct(&gif)), (3, 3));

    let written = dir.join("new/frames");
    assert_eq!(files(&written), ["frame-0000.png", "frame-0001.png", "frame-0002.png"]);
    for (i, frame) in webp.iter().enumerate() {
        let picture = hikage::picture::read_png(written.join(format!("frame-000{i}.png"))).expect("a frame");
        assert!(picture.pixels == *frame, "frame {i}");
    }
    // A shorter one beside what is there.
    fs::write(written.join("note.txt"), "mine").expect("file");
    let args = ["animate", "doll.vrm", "--clip", "walk", "--size", "64x80", "--seconds", "0.1", "--fps", "10"];
    let output = hikage(&dir, &[&args[..], &["-o", "new/frames"]].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success() && said.contains("frame-0001.png: is of an earlier animation"), "{said}");
    assert_eq!(files(&written).len(), 4);

    // Two sides of it, and a sheet of four moments, two in a line.
    animate(&["--seconds", "0.1", "--fps", "10", "--yaw", "0,90", "-o", "sides.webp"]);
    assert_eq!(frames(&dir.join("sides.webp"), (128, 80)).len(), 1);
    animate(&["--frames", "4", "-o", "sheet.png"]);
    let sheet = hikage::picture::read_png(dir.join("sheet.png")).expect("a sheet");
    assert_eq!((sheet.width, sheet.height), (2 * 72 + 8, 2 * 112 + 8));
}

#[test]
fn what_plays_decides_length_and_movement() {
    let dir = folder("plays");
    let animate = |name: &str, more: &[&str]| {
        let usual = ["animate", "doll.vrm", "--size", "32x40", "--fps", "5", "-o", name];
        succeeds(&dir, &[&usual[..], more].concat());
        frames(&dir.join(name), (32, 40))
    };
    // Its own clip takes 2 s, the only mover; wind blows the plait for the 4 s of no clip.
    let own = animate("own.webp", &["--clip", "#Nod"]);
    assert_eq!(own.len(), 10);
    assert!(distinct(&own) >= 5);
    let wind = animate("wind.webp", &["--wind", "1,0,0"]);
    assert_eq!(wind.len(), 20);
    assert!(distinct(&wind) > 10);
    let by_number = animate("number.webp", &["--clip", "doll.vrm#0"]);
    assert!(by_number == own);
    // Half and half, in step; and over the ground with the camera.
    let both = animate("both.webp", &["--clip", "walk=0.5", "--clip", "run=0.5"]);
    assert!((3..5).contains(&both.len()), "{} frames", both.len());
    let travel = animate("travel.webp", &["--clip", "walk", "--travel", "--ground", "grid", "--seconds", "0.4"]);
    let stays = animate("stays.webp", &["--clip", "walk", "--ground", "grid", "--seconds", "0.4"]);
    assert!(travel != stays);
}

#[test]
fn a_still_shows_a_moment_of_a_clip() {
    let dir = folder("still");
    let render = |name: &str, more: &[&str]| {
        let usual = ["render", "doll.vrm", "--size", "64x80", "--view", "full", "-o", name];
        succeeds(&dir, &[&usual[..], more].concat());
        fs::read(dir.join(name)).expect("picture")
    };
    let clip = |name: &str, time: &str| render(name, &["--clip", "walk", "--time", time]);
    let (rest, step) = (render("rest.png", &[]), clip("step.png", "0.4"));
    assert!(rest != step && step != clip("other.png", "0.6"));
    assert!(step == clip("again.png", "0.4"));
    // Time alone moves nothing; wind, a gaze and another base pose do.
    assert!(rest == render("later.png", &["--time", "0.4"]));
    let wind = render("wind.png", &["--wind", "2,0,0"]);
    assert!(rest != wind && wind != render("wind2.png", &["--wind", "-2,0,0"]));
    let look = |at: &str| render("look.png", &["--look-at", at]);
    assert!(look("2,1,0.5") != look("-2,1,0.5"));
    assert!(look("camera") != look("2,1,0.5"));
    let bent = render("bent.png", &["--clip", "walk=0", "--pose", "bend"]);
    assert!(bent != render("eased.png", &["--clip", "walk=0"]));
}

#[test]
fn what_cannot_be_animated_is_said_with_a_remedy() {
    let dir = folder("errors");
    fs::write(dir.join("still.glb"), Glb::triangle().bytes()).expect("model");
    for (args, said) in [
        (&["doll.vrm", "--clip", "jump", "-o", "a.gif"][..], "idle, walk, run, wave, turn"),
        (&["doll.vrm", "--clip", "jump.vrma", "-o", "a.gif"], "jump.vrma: "),
        (&["doll.vrm", "--clip", "#Jump", "-o", "a.gif"], "it has: Nod"),
        (&["still.glb", "--clip", "#1", "-o", "a.gif"], "the file has no animations"),
        (&["still.glb", "--clip", "walk", "-o", "a.gif"], "--clip walk: "),
        (&["still.glb", "-o", "a.gif"], "--clip FILE"),
        (&["doll.vrm", "-o", "a.gif"], "--clip '#Nod'"),
        (&["doll.vrm", "--clip", "walk", "--seconds", "61", "--fps", "60", "-o", "a.webp"], "limit of 3600"),
        (&["doll.vrm", "--clip", "walk", "--frames", "3", "-o", "a.gif"], "--fps"),
        (&["doll.vrm", "--clip", "walk", "--frames", "200", "--size", "8000x8000", "-o", "a.png"], "--frames"),
        (&["doll.vrm", "--clip", "walk", "-o", "none/a.gif"], "none does not exist"),
        (&["doll.vrm", "--clip", "walk", "-o", "doll.vrm/"], "doll.vrm"),
        (&["doll.vrm", "--clip", "walk", "--background", "environment", "-o", "a.gif"], "--look natural"),
        (&["doll.vrm", "--expression", "joy", "--clip", "walk", "-o", "a.gif"], "joy"),
    ] {
        let error = fails(&dir, &[&["animate"], args].concat(), 1);
        assert!(error.contains(said), "{args:?}: {error}");
    }
    for (option, value) in [
        ("--fps", "0"),
        ("--fps", "61"),
        ("--seconds", "0"),
        ("--seconds", "nan"),
        ("--frames", "0"),
        ("--clip", "walk=2"),
        ("--look-at", "left"),
        ("--wind", "1,2"),
        ("--blink", "now"),
        ("--output", "a.jpg"),
    ] {
        let joined = format!("{option}={value}");
        let output = ["animate", "doll.vrm", "-o", "a.gif"];
        let args = if option == "--output" {
            &output[..2]
        } else {
            &output[..]
        };
        let error = fails(&dir, &[args, &[joined.as_str()]].concat(), 2);
        assert!(error.contains(option), "{error}");
    }
    assert_eq!(files(&dir), ["doll.vrm", "still.glb"]);
}

#[test]
fn inspect_tells_what_clips_move() {
    let dir = folder("inspect");
    let text = succeeds(&dir, &["inspect", "doll.vrm"]);
    assert!(text.contains("Animations (1)") && text.contains("Nod"), "{text}");
    let wave = hikage_character::clips::build("wave").expect("a clip");
    fs::write(dir.join("wave.vrma"), hikage_character::vrma::write(&wave)).expect("clip");
    let text = succeeds(&dir, &["inspect", "wave.vrma"]);
    assert!(text.contains("moves") && text.contains(" bones, expressions ") && text.contains("wave"), "{text}");
    let json: Value = serde_json::from_str(&succeeds(&dir, &["inspect", "wave.vrma", "--json"])).expect("JSON");
    assert!(json["moves"]["bones"].as_array().is_some_and(|list| list.contains(&json!("hips"))), "{json}");
    assert_eq!(json["animations"][0]["name"], "wave");
}
