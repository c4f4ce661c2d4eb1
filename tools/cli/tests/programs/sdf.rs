//! `hikage sdf` from drawings to maps and back, and what it says to bad input. No test here needs a GPU.

use std::fs;
use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use hikage::picture::write_png;
use hikage::scene::Image;

/// A folder of one's own, empty.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("sdf-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// Runs `hikage sdf` in a folder, with words parted by spaces.
fn sdf(folder: &Path, words: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hikage"));
    command.arg("sdf").args(words.split_whitespace()).current_dir(folder).output().expect("runs")
}

fn done(folder: &Path, words: &str) -> String {
    let output = sdf(folder, words);
    assert!(output.status.success(), "{words}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("text")
}

/// The one line of a failure; nothing may have been written.
fn failed(folder: &Path, words: &str) -> String {
    let before = listing(folder);
    let output = sdf(folder, words);
    let text = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(1), "{words}: {text}");
    assert_eq!(text.trim_end().lines().count(), 1, "{words}: {text}");
    assert_eq!(listing(folder), before, "{words} left files");
    text
}

fn listing(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").flatten();
    let mut names: Vec<String> = entries.filter_map(|e| e.file_name().into_string().ok()).collect();
    names.sort();
    names
}

/// Writes a mask that is lit from a column on.
fn mask(path: &Path, width: u32, height: u32, from: u32) {
    let grey = |i: u32| if i % width >= from { [255; 4] } else { [0, 0, 0, 255] };
    let pixels = (0..width * height).flat_map(grey).collect();
    write_png(path, &Image { width, height, pixels, ..Image::default() }).expect("writes");
}

/// `a.png` to `c.png`, nested.
fn keys(folder: &Path) -> &'static str {
    for (name, from) in [("a.png", 4), ("b.png", 20), ("c.png", 60)] {
        mask(&folder.join(name), 64, 48, from);
    }
    "--key 0=a.png --key 90=b.png --key 180=c.png"
}

#[test]
fn keys_come_back_from_every_kind_of_map() {
    let folder = folder("round");
    let keys = keys(&folder);
    for kind in [
        "--layout single",
        "--layout single --bits 8",
        "--layout single --bits 8 --dither",
        "--layout liltoon --mirror --bits 8",
        "--layout 0.5,right,left,1 --mirror --profile genshin",
        "--layout single --profile 0:1,180:0",
    ] {
        done(&folder, &format!("bake {keys} {kind} -o map.png --jobs 1"));
        let option = |name: &str| {
            let value = kind.split(name).nth(1).and_then(|rest| rest.split_whitespace().next());
            value.map_or_else(String::new, |value| format!("--from{}{value}", name.replacen("--", "-", 1)))
        };
        let read = format!("{} {}", option("--layout "), option("--profile "));
        done(&folder, &format!("unpack map.png --angles 0,90,180 -o . {read}"));
        for (angle, key) in [("000", "a"), ("090", "b"), ("180", "c")] {
            let [found, drawn] =
                [angle, key].map(|n| hikage::picture::read_png(folder.join(format!("{n}.png"))).expect("reads"));
            assert!(found.pixels == drawn.pixels, "{angle} degrees, {kind}");
        }
    }
}

#[test]
fn conversion_there_and_back_keeps_the_keys() {
    let folder = folder("convert");
    let keys = keys(&folder);
    done(&folder, &format!("bake {keys} --mirror -o map.png"));
    done(&folder, "convert map.png --layout single --profile genshin --bits 8 -o other.png");
    done(
        &folder,
        "convert other.png --from-layout single --from-profile genshin --profile linear --bits 16 -o back.png",
    );
    done(&folder, "unpack back.png --from-layout single --angles 90 -o .");
    let [found, drawn] = ["090.png", "b.png"].map(|n| hikage::picture::read_png(folder.join(n)).expect("reads"));
    assert!(found.pixels == drawn.pixels);
}

#[test]
fn new_projects_bake_check_and_watch() {
    let folder = folder("new");
    let said = done(&folder, "new face --size 256");
    assert!(said.contains("face.sdf.toml") && folder.join("face/wireframe.png").is_file(), "{said}");
    let first = done(&folder, "bake face/face.sdf.toml -o map.png --time");
    assert!(first.contains("12 keys") && first.contains("processor"), "{first}");
    let bytes = fs::read(folder.join("map.png")).expect("a map");
    done(&folder, "bake face/face.sdf.toml -o map.png --jobs 1");
    assert!(fs::read(folder.join("map.png")).expect("a map") == bytes, "other bytes with one thread");
    assert!(!done(&folder, "check face/face.sdf.toml").contains("fault"));
    let said = done(&folder, "watch face/face.sdf.toml -o watched.png --times 1");
    assert!(said.contains("face.sdf.toml: watched.png in"), "{said}");
    assert!(fs::read(folder.join("watched.png")).expect("a map") == bytes);
}

#[test]
fn watching_bakes_again_when_a_drawing_is_saved() {
    let folder = folder("watch");
    let words = format!("sdf watch {} --layout single -o map.png --times 3", keys(&folder));
    let mut command = Command::new(env!("CARGO_BIN_EXE_hikage"));
    command.args(words.split_whitespace()).current_dir(&folder);
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("runs");
    let mut said = BufReader::new(child.stdout.take().expect("a pipe")).lines();
    let mut line = || said.next().expect("a line").expect("text");
    assert!(line().starts_with("a.png, b.png, c.png: map.png in"));
    let first = fs::read(folder.join("map.png")).expect("a map");
    // As editors save: beside it, then renamed.
    mask(&folder.join("new.png"), 64, 48, 30);
    fs::rename(folder.join("new.png"), folder.join("b.png")).expect("renames");
    assert!(line().starts_with("b.png: map.png in"));
    assert!(fs::read(folder.join("map.png")).expect("a map") != first);
    mask(&folder.join("c.png"), 64, 48, 10);
    let changed = line();
    assert!(changed.starts_with("c.png: map.png in"), "{changed}");
    assert!(line().contains("dark at 90 and lit again at 180"));
    assert!(child.wait().expect("ends").success());
}

#[test]
fn drawings_made_from_a_mesh_bake_without_a_fault() {
    let folder = folder("from");
    fs::write(folder.join("girl.vrm"), hikage_character::file()).expect("writes");
    let shared = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/models/Seed-san_rebuilt.vrm");
    let mut models = vec![folder.join("girl.vrm")];
    if shared.is_file() {
        models.push(shared);
    } else {
        eprintln!("not tested: {} is absent", shared.display());
    }
    for (i, model) in models.iter().enumerate() {
        done(&folder, &format!("new face{i} --size 512 --from {}", model.display()));
        let said = done(&folder, &format!("check face{i}/face.sdf.toml"));
        assert!(!said.contains("fault") && !said.contains("colour space"), "{}: {said}", model.display());
        done(&folder, &format!("bake face{i}/face.sdf.toml -o map.png"));
    }
}

#[test]
fn contradictions_are_told_drawn_and_repaired_on_demand() {
    let folder = folder("wrong");
    let keys = keys(&folder);
    mask(&folder.join("c.png"), 64, 48, 10);
    let told = failed(&folder, &format!("bake {keys} --layout single -o map.png"));
    assert!(told.contains("480 texels, between 90 and 180 degrees") && told.contains("first at 10, 0"), "{told}");
    let output = sdf(&folder, &format!("check {keys} --layout single -o wrong.png"));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.code() == Some(1) && text.contains("fault: left: 480 texels are dark at 90 and lit again at 180"),
        "{text}"
    );
    let drawn = hikage::picture::read_png(folder.join("wrong.png")).expect("reads");
    assert_eq!(drawn.pixels.chunks_exact(4).filter(|p| p[0] == 255 && p[1] == 40).count(), 480);
    let before = fs::read(folder.join("c.png")).expect("a key");
    let output = sdf(&folder, &format!("bake {keys} --layout single --repair -o map.png"));
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success() && text.contains("480 texels"), "{text}");
    assert!(fs::read(folder.join("c.png")).expect("a key") == before, "the source was changed");
}

#[test]
fn bad_input_gets_one_line_and_writes_nothing() {
    let folder = folder("bad");
    let keys = keys(&folder);
    let whole = fs::read(folder.join("a.png")).expect("a key");
    let write = |name: &str, bytes: &[u8]| fs::write(folder.join(name), bytes).expect("writes");
    write("cut.png", &whole[..whole.len() - 30]);
    mask(&folder.join("small.png"), 32, 48, 3);
    // A palette of 16 bits does not exist, and nobody has 30,000 x 30,000 texels.
    let header = |width: u32, height: u32, bits: u8, color: u8| {
        let mut body = b"IHDR".to_vec();
        body.extend(width.to_be_bytes());
        body.extend(height.to_be_bytes());
        body.extend([bits, color, 0, 0, 0]);
        let mut bytes = whole.clone();
        bytes[12..29].copy_from_slice(&body);
        let crc = crc(&body);
        bytes[29..33].copy_from_slice(&crc.to_be_bytes());
        bytes
    };
    write("palette.png", &header(64, 48, 16, 3));
    write("bomb.png", &header(30_000, 30_000, 8, 0));
    write("nan.toml", b"size = 64\nkeys = [0, nan]\n");
    write("angle.toml", b"size = 64\nkeys = [0, 200]\n");
    write("twice.toml", b"size = 64\nkeys = [0, 90, 90]\n");
    write("shape.toml", b"size = 64\nkeys = [0, 90]\n[[shape]]\nname = \"cheek\"\nkind = \"light\"\nkeys = [{ angle = 0, path = \"M 0 0 A 1\" }]\n");
    write("huge.toml", b"size = 30000\nkeys = [0, 90]\n");
    write("missing.toml", b"keys = [0, { angle = 90, file = \"none.png\" }]\n");
    for (words, expected) in [
        ("bake --key 0=cut.png --key 90=b.png --layout single -o map.png", &["cut.png", "truncated"][..]),
        ("bake --key 0=a.png --key 90=palette.png --layout single -o map.png", &["palette.png"]),
        ("bake --key 0=a.png --key 90=small.png --layout single -o map.png", &["small.png", "32 x 48", "64 x 48"]),
        ("bake --key 0=bomb.png --key 90=b.png --layout single -o map.png", &["bomb.png", "30000", "16384"]),
        ("bake --key 0=a.png --key 0=b.png --layout single -o map.png", &["two keys have the angle 0"]),
        ("bake --key 0=none.png --key 90=b.png --layout single -o map.png", &["none.png"]),
        ("bake nan.toml -o map.png", &["nan.toml", "NaN"]),
        ("bake angle.toml -o map.png", &["angle.toml", "200", "180"]),
        ("bake twice.toml -o map.png", &["twice.toml", "two keys have the angle 90"]),
        ("bake shape.toml -o map.png", &["shape.toml", "cheek", "arc"]),
        ("bake huge.toml -o map.png", &["30000", "16384"]),
        ("bake missing.toml -o map.png", &["none.png"]),
        ("watch missing.toml -o map.png", &["none.png"]),
        ("bake nothing.toml -o map.png", &["nothing.toml"]),
        ("convert cut.png -o map.png", &["cut.png", "truncated"]),
        ("unpack bomb.png --angles 0 -o .", &["bomb.png"]),
        ("check nan.toml", &["NaN"]),
        ("preview nan.toml -o sheet.png", &["NaN"]),
        ("new bad/below/nowhere", &["nowhere"]),
    ] {
        let told = failed(&folder, words);
        assert!(expected.iter().all(|e| told.contains(e)), "{words}: {told}");
    }
    let told = failed(&folder, &format!("bake {keys} -o map.png"));
    assert!(told.contains("--mirror"), "{told}");
    let told = failed(&folder, &format!("bake {keys} --layout single -o nowhere/map.png"));
    assert!(told.contains("nowhere"), "{told}");
    for words in [
        "bake",
        "bake --key 300=a.png -o map.png",
        "bake --key 0=a.png --bits 12 -o map.png",
        "preview a.toml -o a.txt",
    ] {
        assert_eq!(sdf(&folder, words).status.code(), Some(2), "{words}");
    }
}

/// The check sum of a PNG's chunk.
fn crc(bytes: &[u8]) -> u32 {
    let bit = |crc: u32| {
        if crc & 1 == 1 {
            0xedb8_8320 ^ (crc >> 1)
        } else {
            crc >> 1
        }
    };
    !bytes.iter().fold(u32::MAX, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| bit(crc)))
}
