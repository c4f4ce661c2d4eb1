//! The windowed examples run on a virtual X server and show characters.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    sync::Mutex,
    time::{Duration, Instant},
};

#[path = "support/gltf.rs"]
mod gltf;

/// An unlit red square, 2 m wide, around (0, 1, 0).
fn red_square() -> Vec<u8> {
    use gltf::{F32, Glb, floats};
    let mut glb = Glb::new();
    let corners = [-1., 0., 0., 1., 0., 0., 1., 2., 0., -1., 0., 0., 1., 2., 0., -1., 2., 0.];
    glb.attribute("POSITION", F32, "VEC3", &floats(&corners), 6, false);
    glb.primitive()["material"] = serde_json::json!(0);
    glb.push(
        "materials",
        serde_json::json!({
            "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}, "extensions": {"KHR_materials_unlit": {}}
        }),
    );
    glb.json["extensionsUsed"] = serde_json::json!(["KHR_materials_unlit"]);
    glb.bytes()
}

/// Ends the process when the test ends, however it ends.
struct Killed(Child);

impl Drop for Killed {
    fn drop(&mut self) {
        // Already gone is as good.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Servers start one after another: the first makes the folder of all sockets.
static STARTING: Mutex<()> = Mutex::new(());

/// A virtual screen with an example on it.
struct Screen {
    app: Killed,
    _server: Killed,
    file: PathBuf,
}

impl Screen {
    /// `None` where there is no Xvfb.
    fn with(name: &str, arguments: &[&Path]) -> Option<Self> {
        let installed = Command::new("Xvfb").arg("-help").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok();
        if !cfg!(target_os = "linux") || !installed {
            eprintln!("NOT RUN: no Xvfb on this machine; `apt-get install xvfb libxkbcommon-x11-0` brings it");
            return None;
        }
        let folder = folder(name);
        let file = folder.join("Xvfb_screen0");
        let _ = fs::remove_file(&file);
        let number = 90 + (std::process::id() * 2 + u32::from(name == "game")) % 200;
        let display = format!(":{number}");
        let starting = STARTING.lock();
        let server = Killed(
            Command::new("Xvfb")
                .args([&display, "-screen", "0", "800x800x24", "-nolisten", "tcp", "-fbdir"])
                .arg(&folder)
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .spawn()
                .expect("Xvfb starts"),
        );
        wait_for("the X server", || fs::exists(format!("/tmp/.X11-unix/X{number}")).unwrap_or(false));
        drop(starting);
        let app = Killed(
            Command::new(example(name))
                .args(arguments)
                .env("DISPLAY", &display)
                .env_remove("WAYLAND_DISPLAY")
                .spawn()
                .expect("the example starts"),
        );
        Some(Self { app, _server: server, file })
    }

    /// The first picture that is as wanted.
    fn picture(&mut self, what: &str, is_wanted: impl Fn(&hikage::scene::Image) -> bool) -> hikage::scene::Image {
        let mut seen = None;
        wait_for(what, || {
            if let Some(status) = self.app.0.try_wait().expect("the example's state") {
                panic!("the example ended: {status}");
            }
            seen = read_screen(&self.file).filter(|s| is_wanted(s));
            seen.is_some()
        });
        let shown = seen.expect("a picture");
        let file = self.file.with_file_name(format!("{}.png", what.replace(' ', "-")));
        hikage::picture::write_png(&file, &shown).expect("a picture file");
        println!("screenshot: {}", file.display());
        shown
    }
}

fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("window").join(name);
    fs::create_dir_all(&folder).expect("a folder for the screen");
    folder
}

fn has(color: [u8; 3]) -> impl Fn(&hikage::scene::Image) -> bool {
    move |screen| screen.pixels.chunks_exact(4).any(|p| p[..3] == color)
}

#[test]
fn the_window_shows_the_character() {
    let model = folder("window").join("square.glb");
    fs::write(&model, red_square()).expect("a model");
    let Some(mut screen) = Screen::with("window", &[&model]) else { return };
    let shown = screen.picture("a picture in the window", has([0x9f, 0xb4, 0xc7]));
    let center = &shown.pixels[(400 * 800 + 400) * 4..][..3];
    let corner = &shown.pixels[(20 * 800 + 20) * 4..][..3];
    assert_eq!(corner, [0x9f, 0xb4, 0xc7], "the background stands in the corner");
    assert!(center[0] > 200 && center[1] < 140, "the red square stands in the middle: {center:?}");
}

#[test]
fn the_playground_is_played() {
    let Some(mut screen) = Screen::with("game", &[Path::new("--auto")]) else { return };
    let count = |screen: &hikage::scene::Image, is: fn(i32, i32, i32) -> bool| {
        let pixels = screen.pixels.chunks_exact(4).map(|p| [p[0], p[1], p[2]].map(i32::from));
        pixels.filter(|[r, g, b]| is(*r, *g, *b)).count()
    };
    let lilac = |r, g, b| r > 130 && g < r && b > r + 15;
    let ginger = |r, g, b| r > 150 && r > g + 45 && g >= b;
    let first = screen.picture("the playground", has([0xb9, 0xd3, 0xe6]));
    assert!(count(&first, lilac) > 400, "the player stands before the camera");
    assert!(count(&first, ginger) > 40, "and another one there");
    // The player walks, and the camera with it: boxes and ground go by, the other comes nearer.
    let changed = |screen: &hikage::scene::Image| {
        let pairs = screen.pixels.chunks_exact(4).zip(first.pixels.chunks_exact(4));
        pairs.filter(|(a, b)| a != b).count()
    };
    let later = screen.picture("the playground later", |screen| changed(screen) > 60_000);
    assert!(count(&later, lilac) > 400, "the camera has not kept up");
}

fn wait_for(what: &str, mut ready: impl FnMut() -> bool) {
    let start = Instant::now();
    while !ready() {
        assert!(start.elapsed() < Duration::from_secs(300), "waiting for {what}");
        std::thread::sleep(Duration::from_millis(100));
    }
}

/// Cargo builds examples beside the tests.
fn example(name: &str) -> PathBuf {
    let deps = std::env::current_exe().expect("the test's own path");
    let profile = deps.parent().and_then(Path::parent).expect("the profile's folder");
    profile.join("examples").join(name)
}

/// Reads the X server's frame buffer: an XWD file, version 7, of 32-bit pixels.
fn read_screen(path: &Path) -> Option<hikage::scene::Image> {
    let bytes = fs::read(path).ok()?;
    let field = |index: usize| Some(u32::from_be_bytes(bytes.get(index * 4..index * 4 + 4)?.try_into().ok()?) as usize);
    let (header, width, height) = (field(0)?, field(4)?, field(5)?);
    let (little_endian, line, colors) = (field(7)? == 0, field(12)?, field(19)?);
    let first = header + colors * 12;
    let mut pixels = Vec::with_capacity(width * height * 4);
    for y in 0..height {
        for texel in bytes.get(first + y * line..)?.get(..width * 4)?.chunks_exact(4) {
            let [b, g, r] = if little_endian {
                [texel[0], texel[1], texel[2]]
            } else {
                [texel[3], texel[2], texel[1]]
            };
            pixels.extend([r, g, b, 255]);
        }
    }
    Some(hikage::scene::Image { width: width as u32, height: height as u32, pixels, ..Default::default() })
}
