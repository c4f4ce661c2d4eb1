//! A look from outside: an application's section has its keys in look files, its shader and its channel like ours.

use hikage::material::{Material, Section, TextureRef, register};
use hikage::scene::{Image, Scene};
use hikage::{Channel, Gpu, LookFile, Renderer};

use crate::support::{Shoot, Shot, gpu, scene, sphere, staged, two_tone, view};

macro_rules! tint {
    ($name:ident, $key:literal, $text:expr) => {
        hikage::section! {
            /// A tint from outside.
            #[derive(Copy)]
            $name = $key { channel: Some((concat!($key, "-share"), "Share of the tint.")), wgsl: Some($text) }
            {
                /// Colour, linear.
                color: [f32; 3] = [1.0, 0.0, 0.0], in 0.0..=1.0;
                /// Share of it.
                share: f32 = 1.0, in 0.0..=1.0;
                /// Where it is, red channel.
                mask: Option<TextureRef> = None, read LINEAR;
            }
            presets {
                /// Half of it.
                half { share: 0.5 }
            }
        }

        impl Section for $name {}
    };
}

tint!(
    OwnTint,
    "own_tint",
    "import package::bind::shown::shown;
import package::bind::surface::{Shaded, Surface};
import package::bind::uv::{UvTransform, texture_uv};
import package::material::{material, own_tint_mask, own_tint_mask_sampler};

struct OwnTint {
    color: vec3f,
    share: f32,
    mask_uv: UvTransform,
}

fn own_tint_shine(s: ptr<function, Surface>, l: ptr<function, Shaded>) {
    var share = material.own_tint.share;
    @if(own_tint_mask) share *= textureSample(
        own_tint_mask, own_tint_mask_sampler, texture_uv(s.uv, material.own_tint.mask_uv)
    ).r;
    l.direct = mix(l.direct, material.own_tint.color, share);
    l.ambient *= 1.0 - share;
    @if(channel_own_tint_share) shown = vec3f(share);
}
"
);

tint!(
    BrokenSyntax,
    "broken_syntax",
    "struct BrokenSyntax { color: vec3f, share: f32 }

fn broken_syntax_shine(s: ptr<function, Surface>, l: ptr<function, Shaded>) {
    l.direct +;
}
"
);

tint!(
    BrokenType,
    "broken_type",
    "import package::bind::surface::{Shaded, Surface};
import package::material::material;

struct BrokenType {
    color: vec3f,
    share: f32,
}

fn broken_type_shine(s: ptr<function, Surface>, l: ptr<function, Shaded>) {
    l.direct = material.broken_type.share;
}
"
);

tint!(
    BrokenHook,
    "broken_hook",
    "import package::bind::surface::{Shaded, Surface};

struct BrokenHook {
    color: vec3f,
    share: f32,
}

fn broken_hook_shine(l: ptr<function, Shaded>, s: ptr<function, Surface>) {
    l.direct = vec3f(0.0);
}
"
);

tint!(
    BrokenNumbers,
    "broken_numbers",
    "import package::bind::surface::{Shaded, Surface};

struct BrokenNumbers {
    color: vec3f,
    shares: f32,
}

fn broken_numbers_shine(s: ptr<function, Surface>, l: ptr<function, Shaded>) {
    l.direct = vec3f(0.0);
}
"
);

/// A ball in front of the camera, by a renderer that was made after the registration.
fn picture(gpu: &Gpu, scene: &Scene, view: &Shot) -> Image {
    let renderer = Renderer::new(gpu).expect("a renderer");
    let mut uploaded = staged(renderer.upload(scene));
    renderer.shoot(&mut uploaded, view).expect("a picture")
}

#[test]
fn a_section_of_an_application_draws_by_its_look_file_and_has_a_channel() {
    let gpu = gpu();
    let stale = Renderer::new(&gpu);
    register::<OwnTint>().expect("valid");
    register::<OwnTint>().expect("the same again");
    let mut scene = scene(vec![(sphere(0.5, 32, 64), Material { name: "Ball".to_owned(), ..two_tone() })]);
    let file = |text: &str| LookFile::parse("own.look.toml", &format!("base = \"plain\"\n{text}"));
    let name = "Ball";
    let set = format!("[material.{name:?}]\nown_tint = {{ preset = \"half\", color = \"#00ff00\" }}\n");
    file(&set).expect("TOML").apply(&mut scene, None).expect("known keys");
    let tint = scene.materials[0].own::<OwnTint>().expect("the section");
    assert_eq!((tint.share, tint.color), (0.5, [0.0, 1.0, 0.0]));

    let channel = Channel::from_name("own_tint-share").expect("a channel");
    let shown = picture(&gpu, &scene, &Shot { channel, ..view(64, 2.0) });
    let middle = (32 * 64 + 32) * 4;
    // Half of linear white lies between two codes.
    assert!(shown.pixels[middle..middle + 3].iter().all(|c| [187, 188].contains(c)), "{:?}", &shown.pixels[middle..]);
    scene.materials[0].own_mut::<OwnTint>().expect("the section").share = 1.0;
    let green = picture(&gpu, &scene, &view(64, 2.0));
    let error = stale.expect("a renderer").upload(&scene).expect_err("made before").to_string();
    assert!(error.contains("own_tint") && error.contains("register"), "{error}");
    assert_eq!(green.pixels[middle..middle + 3], [0, 255, 0]);

    let wrong = format!("[material.{name:?}.own_tint]\nshare = 3\n");
    let error = file(&wrong).expect("TOML").apply(&mut scene, None).expect_err("out of its range").to_string();
    assert!(error.contains("own_tint.share") && error.contains("is 3") && error.contains("0..1"), "{error}");
    let unknown = format!("[material.{name:?}.own_tint]\nsahre = 1\n");
    let error = file(&unknown).expect("TOML").apply(&mut scene, None).expect_err("no such key").to_string();
    assert!(error.contains("the nearest is \"share\""), "{error}");
    file(&format!("[material.{name:?}]\nown_tint = false\n")).expect("TOML").apply(&mut scene, None).expect("off");
    assert!(scene.materials[0].own::<OwnTint>().is_none());
}

#[test]
fn wrong_wgsl_is_one_error_with_file_and_line() {
    for (error, words) in [
        (register::<BrokenSyntax>().expect_err("syntax"), ["broken_syntax.wgsl", "line 4"]),
        (register::<BrokenType>().expect_err("type"), ["broken_type.wgsl", "line 10"]),
        (register::<BrokenHook>().expect_err("parameters"), ["broken_hook.wgsl", "line 8"]),
        (
            register::<BrokenNumbers>().expect_err("members"),
            ["broken_numbers.wgsl", "the member shares; its fields are color, share"],
        ),
    ] {
        let message = error.to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
        assert!(!message.contains('\n'), "{message}");
    }
}

tint!(
    Unhooked,
    "unhooked",
    "struct Unhooked {
    color: vec3f,
    share: f32,
}

fn unhooked_shien(share: f32) -> f32 {
    return share;
}
"
);

#[test]
fn a_section_that_no_stage_calls_is_refused() {
    let error = register::<Unhooked>().expect_err("dead").to_string();
    assert!(error.contains("unhooked_shine") && error.contains("no function"), "{error}");
}

tint!(
    OwnHoles,
    "own_holes",
    "import package::bind::uv::UvTransform;
import package::bind::varying::Varying;
import package::material::material;

struct OwnHoles {
    color: vec3f,
    share: f32,
    mask_uv: UvTransform,
}

fn own_holes_samples(at: Varying) -> u32 {
    return select(15u, 0u, material.own_holes.share > 0.5);
}
"
);

/// Passes go by the stages in which a section takes part, not by its name.
#[test]
fn a_section_of_an_application_leaves_samples_out() {
    register::<OwnHoles>().expect("valid");
    let gpu = gpu();
    let mut scene = scene(vec![(sphere(0.5, 32, 64), two_tone())]);
    let view = Shot { background: hikage::Background::Transparent, ..view(64, 2.0) };
    for (holes, is_there) in [(OwnHoles::half(), true), (OwnHoles::default(), false)] {
        scene.materials[0].set_own(Some(holes));
        assert_eq!(picture(&gpu, &scene, &view).pixels.iter().any(|c| *c > 0), is_there);
    }
}

#[test]
fn names_that_are_taken_are_refused() {
    hikage::section! {
        /// Has the name of one of ours.
        #[derive(Copy)]
        Other = "sparkle" { wgsl: Some("struct Other { x: f32 }") }
        { /// A number.
          x: f32 = 0.0, in 0.0..=1.0; }
    }
    impl Section for Other {}
    let error = register::<Other>().expect_err("taken").to_string();
    assert!(error.contains("sparkle") && error.contains("choose another"), "{error}");
}
