//! What the gallery shows.

use hikage::Look;
use hikage::color::{LinearRgb, Srgb};
use hikage::material::{
    Base, Blink, Decal, Decals, DepthRim, Dissolve, DitherFade, Emission, Fire, Fluff, Gem, Glow, Hair, InnerLines,
    Material, Shading, ShapedHighlight, Stocking, TextureRef, Toon,
};
use hikage::motion::Stance;
use hikage::scene::{Bloom, Framing, Image, Post, PunctualLight, Sampler, Scene, Texture, ToneCurve};

use super::{eyes, skin};

/// One sheet: a picture of rows of panels.
pub(super) struct Sheet {
    /// Name of its file.
    pub name: &'static str,
    pub title: &'static str,
    /// What to look at, and the section of a look file that does it.
    pub caption: &'static str,
    pub rows: Vec<Row>,
}

/// A row: one scene.
pub(super) struct Row {
    /// As the file describes her, without a look.
    pub is_plain: bool,
    pub change: fn(&mut Scene),
    pub panels: Vec<Panel>,
}

/// One picture.
pub(super) struct Panel {
    pub caption: String,
    pub camera: Camera,
    /// Width over height.
    pub aspect: f32,
    pub stance: Stance,
    pub expression: Option<&'static str>,
    /// Angles of the key light to her left and upwards.
    pub light_deg: [f32; 2],
    pub lamp: Option<PunctualLight>,
    /// Colour and intensity of a lamp over her left hand.
    pub flame: Option<(LinearRgb, f32)>,
    /// Intensity of the key light.
    pub key: f32,
    /// Turn of her head to her left.
    pub head_deg: f32,
    pub coolness: Option<f32>,
    pub time_s: f32,
    pub background: Option<Srgb>,
    /// Changes of the scene: two share the picture, the first in its left half.
    pub variants: Vec<Change>,
}

/// What makes another scene of one.
pub(super) type Change = Box<dyn Fn(&mut Scene)>;

#[derive(Clone, Copy)]
pub(super) enum Camera {
    /// A framing, from so many degrees to her left.
    Framed(Framing, f32),
    /// What of a mesh or a material lies on her left, from so many degrees to her left and above; at rest.
    Close { part: &'static str, yaw: f32, pitch: f32 },
    /// So much of the height of a head, from so many degrees to its left; at rest.
    Head { yaw: f32, height: f32 },
    /// The left ear, from so many degrees to the left; at rest.
    Ear { yaw: f32 },
    /// The left eye or both, from so many degrees to the left; at rest.
    Eyes { both: bool, yaw: f32 },
}

fn same(_: &mut Scene) {}

fn row(change: fn(&mut Scene), panels: impl IntoIterator<Item = Panel>) -> Row {
    Row { is_plain: false, change, panels: panels.into_iter().collect() }
}

/// Key light from her right to behind her left.
const LIGHT_YAWS: [f32; 7] = [-75.0, -45.0, -15.0, 15.0, 45.0, 75.0, 110.0];

fn light_sweep(camera: Camera, aspect: f32, what: &str) -> Vec<Panel> {
    LIGHT_YAWS
        .iter()
        .map(|yaw| Panel {
            caption: format!("{what}light {yaw:.0}\u{b0}"),
            camera,
            aspect,
            light_deg: [*yaw, 30.0],
            ..Panel::default()
        })
        .collect()
}

pub(super) fn each_material(scene: &mut Scene, name: &str, change: impl Fn(&mut Material)) {
    scene.materials.iter_mut().filter(|m| m.name.starts_with(name)).for_each(change);
}

const BROOCH: Camera = Camera::Close { part: "Brooch", yaw: 8.0, pitch: 5.0 };
const AMBER: Camera = Camera::Close { part: "Accessory_Amber", yaw: 0.0, pitch: 0.0 };
const CUFF: Camera = Camera::Close { part: "Jacket_Cuff", yaw: 35.0, pitch: 15.0 };
const COLLAR: Camera = Camera::Close { part: "Jacket_Fur", yaw: 25.0, pitch: 10.0 };

/// All sheets, in the order of the page.
pub(super) fn all() -> Vec<Sheet> {
    let mut list = head();
    list.extend(cloth());
    list.extend(ornaments());
    list.extend(whole());
    list.push(natural());
    list.extend([skin::sheet(), eyes::natural(), eyes::drawn()]);
    list
}

/// Natural light: her hair in its own colour, then in those of presets, then drawn and half drawn.
fn natural() -> Sheet {
    let light = |yaw: f32, light: f32| Panel {
        caption: format!("camera {yaw:.0}\u{b0}, light {light:.0}\u{b0}"),
        camera: Camera::Framed(Framing::Portrait, yaw),
        light_deg: [light, 35.0],
        ..Panel::default()
    };
    let panels = || [light(0.0, -30.0), light(50.0, 10.0), light(180.0, 200.0), light(-20.0, 150.0)];
    let lit = |change| Row { is_plain: true, change, panels: panels().into() };
    Sheet {
        name: "natural",
        title: "Natural light and hair",
        caption: "The natural look: physical surfaces in a studio (environment), hair as fibres (hair). Her own colour, the \
                  presets brown, blond and black, then Kajiya-Kay highlights on toon shade (anime_silk) and half of each \
                  (natural = 0.5).",
        rows: vec![
            lit(|scene| Look::Natural.apply(scene)),
            lit(|scene| combed(scene, Hair::brown())),
            lit(|scene| combed(scene, Hair::blond())),
            lit(|scene| combed(scene, Hair::black())),
            lit(|scene| silk(scene, 0.0)),
            lit(|scene| silk(scene, 0.5)),
        ],
    }
}

/// The natural look with such hair.
fn combed(scene: &mut Scene, hair: Hair) {
    Look::Natural.apply(scene);
    let highlight_color = [1.8; 3];
    scene.materials.iter_mut().filter_map(|m| m.hair.as_mut()).for_each(|h| *h = Hair { highlight_color, ..hair });
}

/// Her file's toon shade under drawn highlights, as far as it stays.
fn silk(scene: &mut Scene, natural: f32) {
    let hair = Hair { natural, ..Hair::anime_silk() };
    each_material(scene, "Hair", |m| m.hair = Some(hair));
}

fn head() -> Vec<Sheet> {
    let turned = |yaw: f32| Panel {
        caption: format!("camera {yaw:.0}\u{b0}"),
        camera: Camera::Framed(Framing::Portrait, yaw),
        ..Panel::default()
    };
    vec![
        Sheet {
            name: "face-shadow",
            title: "Face shadow",
            caption: "A painted threshold map says at which angle of the light each place of the face turns dark \
                      (face_shadow). Above as the file describes her, below with the look.",
            rows: vec![
                Row {
                    is_plain: true,
                    change: same,
                    panels: light_sweep(Camera::Framed(Framing::Face, 0.0), 1.0, "plain, "),
                },
                row(same, light_sweep(Camera::Framed(Framing::Face, 0.0), 1.0, "")),
            ],
        },
        Sheet {
            name: "hair",
            title: "Hair: highlight, bangs' shadow, brows through hair",
            caption: "The painted highlight moves as a whole with view and light (highlight); bangs cast a soft shadow on \
                      the face (bangs_shadow), and eyes and brows are seen through them (eyes_through).",
            rows: vec![row(same, [-90.0, -45.0, -20.0, 0.0, 20.0, 45.0, 135.0].map(turned))],
        },
        Sheet {
            name: "rim",
            title: "Rim light",
            caption: "A rim of constant width from the depth of the picture (depth_rim). First as shipped; then with a second \
                      colour on the shaded side; then with an orange lamp on her right.",
            rows: vec![
                row(same, light_sweep(Camera::Framed(Framing::Portrait, 25.0), 1.0, "")),
                row(
                    |scene| {
                        for rim in scene.materials.iter_mut().filter_map(|m| m.depth_rim.as_mut()) {
                            *rim = DepthRim { shade_color: [0.2, 0.35, 0.9], width_px: 10.0, ..*rim };
                        }
                    },
                    light_sweep(Camera::Framed(Framing::Portrait, 25.0), 1.0, "two sides, "),
                ),
                row(
                    |scene| {
                        for rim in scene.materials.iter_mut().filter_map(|m| m.depth_rim.as_mut()) {
                            rim.width_px = 9.0;
                        }
                    },
                    light_sweep(Camera::Framed(Framing::Portrait, 25.0), 1.0, "lamp, ").into_iter().map(|panel| {
                        Panel {
                            key: 0.5,
                            lamp: Some(PunctualLight {
                                position: glam::Vec3::new(-0.7, 1.5, -0.7),
                                color: LinearRgb([1.0, 0.5, 0.1]),
                                intensity: 0.5,
                                range: 0.0,
                                spot: None,
                            }),
                            background: Some(Srgb([0x28, 0x2c, 0x3c])),
                            ..panel
                        }
                    }),
                ),
            ],
        },
    ]
}

fn cloth() -> Vec<Sheet> {
    vec![
        Sheet {
            name: "fur",
            title: "Hand-painted fur",
            caption: "Few strokes in the light, all of them where light turns into shade, half of them in shade; the border has \
                      the shape of the clumps (fur_detail).",
            rows: vec![row(same, light_sweep(COLLAR, 1.0, ""))],
        },
        Sheet {
            name: "fluff",
            title: "Fluff",
            caption: "Shells of short hair with gravity and wind (fluff): as shipped, plush, long.",
            rows: vec![
                row(same, light_sweep(CUFF, 1.0, "")),
                row(
                    |scene| each_material(scene, "Jacket_Cuff", |m| m.fluff = Some(Fluff::plush())),
                    light_sweep(CUFF, 1.0, "plush, "),
                ),
                row(
                    |scene| each_material(scene, "Jacket_Cuff", |m| m.fluff = Some(Fluff::long())),
                    light_sweep(CUFF, 1.0, "long, "),
                ),
            ],
        },
        Sheet {
            name: "stocking-decal",
            title: "Stockings and decals",
            caption: "Knit is denser where it is seen aslant (stocking): as shipped, with the knit painted; sheer and opaque \
                      over bare skin. A heart laid over the sleeve takes its shade and its ramp (decals).",
            rows: vec![
                row(same, legs("")),
                row(|scene| over_skin(scene, Stocking::sheer()), legs("sheer, ")),
                row(|scene| over_skin(scene, Stocking::opaque()), legs("opaque, ")),
                row(decal, light_sweep(Camera::Framed(Framing::Bust, 65.0), 0.6, "decal, ")),
            ],
        },
    ]
}

fn legs(what: &str) -> Vec<Panel> {
    light_sweep(Camera::Close { part: "Stocking", yaw: 15.0, pitch: 0.0 }, 0.6, what)
}

/// Knit over the skin itself.
fn over_skin(scene: &mut Scene, stocking: Stocking) {
    each_material(scene, "Stocking", |m| {
        m.base = Base { color: [0.98, 0.74, 0.62, 1.0], texture: None };
        m.shading =
            Shading::Toon(Toon { shade_color: [0.86, 0.47, 0.38], toony: 0.97, shift: -0.03, ..Toon::default() });
        m.shade_ramp = None;
        m.stocking = Some(stocking);
    });
}

/// A heart on the sleeves of the jacket, painted here.
fn decal(scene: &mut Scene) {
    const SIDE: u32 = 256;
    let pixels = (0..SIDE * SIDE).flat_map(|i| {
        let at = |k: u32| (k as f32 + 0.5) / SIDE as f32 * 2.6 - 1.3;
        let (x, y) = (at(i % SIDE), -at(i / SIDE));
        let heart = (x * x + y * y - 0.7).powi(3) - x * x * y.powi(3);
        [0xff, 0x5a, 0x7a, if heart < 0.0 { 255 } else { 0 }]
    });
    scene.images.push(Image { width: SIDE, height: SIDE, pixels: pixels.collect(), ..Image::default() });
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler: Sampler::default() });
    let map = TextureRef { texture: scene.textures.len() - 1, ..TextureRef::default() };
    each_material(scene, "Jacket", |m| {
        let heart = Decal { middle: [0.735, 0.44], size: [0.08, 0.14], ..Decal::default() };
        m.decals = Some(Decals { map: Some(map), placed: vec![heart] });
    });
}

fn ornaments() -> Vec<Sheet> {
    let shape = |change: fn(&mut Scene), what: &str| row(change, light_sweep(BROOCH, 1.0, what));
    let gem = |change: fn(&mut Scene), what: &str| {
        let mut panels = light_sweep(AMBER, 0.8, what);
        panels.extend([-40.0, 40.0].map(|yaw| Panel {
            caption: format!("{what}camera {yaw:.0}\u{b0}"),
            camera: Camera::Close { part: "Accessory_Amber", yaw, pitch: 0.0 },
            aspect: 0.8,
            ..Panel::default()
        }));
        row(change, panels)
    };
    let flame = |change: fn(&mut Scene), what: &str, color: [f32; 3], background: [u8; 3]| {
        let panels = (0..7).map(move |i| Panel {
            key: 0.6,
            flame: Some((LinearRgb(color), 0.02 + 0.004 * (i as f32 * 0.3 * std::f32::consts::TAU).sin())),
            caption: format!("{what}{:.2} s", i as f32 * 0.3),
            camera: Camera::Framed(Framing::Bust, 10.0),
            stance: Stance::Offer,
            expression: Some("flame"),
            time_s: i as f32 * 0.3,
            background: Some(Srgb(background)),
            ..Panel::default()
        });
        row(change, panels)
    };
    vec![
        Sheet {
            name: "metal",
            title: "Shaped highlights on metal",
            caption: "The painted shape of the brooch; then squared and split into the panes of a window, squashed and split \
                      into strokes, and brushed (shaped_highlight). The matcap takes the place of the lit colour in part.",
            rows: vec![
                shape(same, ""),
                shape(|scene| shape_of_metal(scene, ShapedHighlight::window()), "window, "),
                shape(|scene| shape_of_metal(scene, ShapedHighlight::strokes()), "strokes, "),
                shape(|scene| shape_of_metal(scene, ShapedHighlight::brushed()), "brushed, "),
            ],
        },
        Sheet {
            name: "gems",
            title: "Amber, ruby, jade",
            caption: "Light is refracted in, absorbed with depth and gathered on the side away from it; inclusions lie at three \
                      depths (gem).",
            rows: vec![
                gem(same, ""),
                gem(|scene| each_material(scene, "Accessory_Amber", |m| m.gem = Some(Gem::ruby())), "ruby, "),
                gem(|scene| each_material(scene, "Accessory_Amber", |m| m.gem = Some(Gem::jade())), "jade, "),
            ],
        },
        Sheet {
            name: "diamond",
            title: "Diamond",
            caption: "Rays are thrown back between facets, each colour by its own index; facets flash as the camera turns by three \
                      degrees a panel (diamond, sparkle).",
            rows: vec![row(
                same,
                (0..8).map(|i| Panel {
                    caption: format!("camera {}\u{b0}", 40 + 3 * i),
                    camera: Camera::Close { part: "HairPin", yaw: 40.0 + 3.0 * i as f32, pitch: 25.0 },
                    ..Panel::default()
                }),
            )],
        },
        Sheet {
            name: "fire",
            title: "Fire",
            caption: "A drawn shape that noise eats away, over its period of two seconds; it blooms, and a lamp in it lights her (fire, glow, post).",
            rows: vec![
                flame(same, "", [1.0, 0.45, 0.12], [0x24, 0x28, 0x38]),
                flame(
                    |scene| {
                        each_material(scene, "Accessory_Flame", |m| {
                            m.fire = m.fire.map(|f| Fire { heat: f.heat, ..Fire::blue() });
                        });
                    },
                    "blue, ",
                    [0.12, 0.45, 1.0],
                    [0x24, 0x28, 0x38],
                ),
            ],
        },
    ]
}

fn shape_of_metal(scene: &mut Scene, shape: ShapedHighlight) {
    each_material(scene, "Metal", |m| {
        m.shaped_highlight = m.shaped_highlight.map(|s| ShapedHighlight { matcap_mix: s.matcap_mix, ..shape });
    });
}

fn whole() -> Vec<Sheet> {
    let coolness = |value: f32, what: &str| {
        light_sweep(Camera::Framed(Framing::Bust, 20.0), 0.8, what)
            .into_iter()
            .map(move |panel| Panel { coolness: Some(value), ..panel })
    };
    let burning = |change: fn(&mut Scene), caption: &str| (change, caption.to_owned());
    let vanishing = [
        burning(|s| vanish(s, Some(0.15), None), "dissolve 0.15"),
        burning(|s| vanish(s, Some(0.35), None), "dissolve 0.35"),
        burning(|s| vanish(s, Some(0.55), None), "dissolve 0.55"),
        burning(|s| vanish(s, Some(0.75), None), "dissolve 0.75"),
        burning(|s| vanish(s, None, Some(0.75)), "fade 0.75"),
        burning(|s| vanish(s, None, Some(0.3)), "fade 0.3"),
    ];
    let bright = |tone: &str| {
        [1.0f32, 0.0].map(|coolness| Panel {
            caption: format!("{tone}, {}", if coolness > 0.5 { "cool" } else { "warm" }),
            camera: Camera::Framed(Framing::Bust, 15.0),
            stance: Stance::Offer,
            expression: Some("flame"),
            coolness: Some(coolness),
            background: Some(Srgb([0x24, 0x28, 0x38])),
            ..Panel::default()
        })
    };
    vec![
        Sheet {
            name: "warm-cool",
            title: "Warm and cool",
            caption: "Painted ramps from shade to light for warm and for cool light, blended by the light's colour or by hand \
                      (shade_ramp, light.coolness); her own shadow has exactly the ramp's dark end (self_shadow).",
            rows: vec![row(same, coolness(0.0, "warm, ")), row(same, coolness(1.0, "cool, "))],
        },
        Sheet {
            name: "lines",
            title: "Coloured outlines and inner lines",
            caption: "Black lines of the file; lines in a dark tone of what they surround (outline.tint); and lines inside of the \
                      shape from depth, normal and part (inner_lines).",
            rows: vec![
                Row { is_plain: true, change: same, panels: lines("plain") },
                row(same, lines("tinted")),
                row(
                    |scene| {
                        let lines = InnerLines { width_px: 3.0, ..InnerLines::default() };
                        // Tufts have their own.
                        let is_fur = |m: &Material| m.fur_detail.is_some() || m.fluff.is_some();
                        for name in ["Jacket", "Skirt", "Boots", "Cloth", "Stocking", "Metal", "Body"] {
                            each_material(scene, name, |m| m.inner_lines = (!is_fur(m)).then_some(lines));
                        }
                    },
                    lines("inner lines"),
                ),
            ],
        },
        Sheet {
            name: "vanishing",
            title: "Dissolve and fade",
            caption: "Noise eats her away with a glowing border (dissolve); pixels are left out in an even pattern (dither_fade).",
            rows: vanishing
                .into_iter()
                .map(|(change, caption)| {
                    let panel = |yaw: f32| Panel {
                        caption: if yaw == 0.0 { caption.clone() } else { String::new() },
                        camera: Camera::Framed(Framing::Bust, yaw),
                        background: Some(Srgb([0x24, 0x28, 0x38])),
                        ..Panel::default()
                    };
                    row(change, [0.0, 60.0, 180.0].map(panel))
                })
                .collect(),
        },
        Sheet {
            name: "emission",
            title: "Light of its own",
            caption: "A drawn pattern runs down the skirt (emission.scroll_per_s) while the amber swells and ebbs \
                      (emission.blink); both bloom.",
            rows: ["Skirt", "Accessory_Amber"]
                .map(|part| {
                    let panel = |i: u8| Panel {
                        caption: format!("{:.2} s", f32::from(i) * 0.25),
                        camera: Camera::Close { part, yaw: 15.0, pitch: 0.0 },
                        key: 0.6,
                        time_s: f32::from(i) * 0.25,
                        background: Some(Srgb([0x24, 0x28, 0x38])),
                        ..Panel::default()
                    };
                    row(runes, (0..7).map(panel))
                })
                .into(),
        },
        Sheet {
            name: "post",
            title: "Bloom and tone curves",
            caption: "Only what glows spreads (post.bloom, glow): fire, the diamond, the brooch. Tone curves bring light beyond \
                      white back and leave painted colours (post.tone): none, filmic, neutral.",
            rows: vec![
                row(|scene| scene.post = None, bright("off")),
                row(same, bright("bloom")),
                row(|scene| tone(scene, ToneCurve::Filmic), bright("filmic")),
                row(|scene| tone(scene, ToneCurve::Neutral), bright("neutral")),
            ],
        },
    ]
}

/// A chain of diamonds, painted here, that runs down the skirt, and an amber that breathes.
fn runes(scene: &mut Scene) {
    const SIDE: u32 = 1024;
    let pixels = (0..SIDE * SIDE).flat_map(|i| {
        let at = |k: u32, n: f32| ((k as f32 + 0.5) / SIDE as f32 * n).fract() * 2.0 - 1.0;
        let (x, y) = (at(i % SIDE, 20.0), at(i / SIDE, 2.0));
        let away = x.abs() * 1.4 + y.abs();
        let line = 1.0 - ((away - 0.62).abs() / 0.2).min(1.0);
        let v = (line * 255.0) as u8;
        [v, v, v, 255]
    });
    scene.images.push(Image { width: SIDE, height: SIDE, pixels: pixels.collect(), ..Image::default() });
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler: Sampler::default() });
    let texture = Some(TextureRef { texture: scene.textures.len() - 1, ..TextureRef::default() });
    each_material(scene, "Skirt", |m| {
        m.emission = Emission { color: [0.1, 0.8, 1.6], texture, scroll_per_s: [0.0, -0.5], ..Emission::default() };
        m.glow = Some(Glow::default());
    });
    each_material(scene, "Accessory_Amber", |m| {
        m.emission = Emission { color: [0.8, 0.26, 0.04], blink: Some(Blink::default()), ..Emission::default() };
        m.glow = Some(Glow::default());
    });
}

fn tone(scene: &mut Scene, tone: ToneCurve) {
    scene.post = Some(Post { bloom: Some(Bloom::default()), tone, ..Post::default() });
}

fn lines(what: &str) -> Vec<Panel> {
    [-35.0f32, 0.0, 35.0, 90.0, 180.0]
        .map(|yaw| Panel {
            caption: format!("{what}, {yaw:.0}\u{b0}"),
            camera: Camera::Framed(Framing::Bust, yaw),
            ..Panel::default()
        })
        .into()
}

fn vanish(scene: &mut Scene, amount: Option<f32>, opacity: Option<f32>) {
    for material in &mut scene.materials {
        material.dissolve = amount.map(|amount| Dissolve { amount, ..Dissolve::default() });
        material.dither_fade = opacity.map(|opacity| DitherFade { opacity, ..DitherFade::default() });
    }
}
