//! What the gallery shows.

use hikage::color::{LinearRgb, Srgb};
use hikage::material::{
    Decal, Decals, DepthRim, Dissolve, DitherFade, Fire, Fluff, Gem, InnerLines, Material, ShapedHighlight, Stocking,
    TextureRef,
};
use hikage::motion::Stance;
use hikage::scene::{Bloom, Framing, Image, Post, PunctualLight, Sampler, Scene, Texture, ToneCurve};

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
    /// Turn of her head to her left.
    pub head_deg: f32,
    pub coolness: Option<f32>,
    pub time_s: f32,
    pub background: Option<Srgb>,
}

#[derive(Clone, Copy)]
pub(super) enum Camera {
    /// A framing, from so many degrees to her left.
    Framed(Framing, f32),
    /// What of a mesh or a material lies on her left, from so many degrees to her left and above; at rest.
    Close { part: &'static str, yaw: f32, pitch: f32 },
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

fn each_material(scene: &mut Scene, name: &str, change: impl Fn(&mut Material)) {
    scene.materials.iter_mut().filter(|m| m.name.starts_with(name)).for_each(change);
}

const FULL: Camera = Camera::Framed(Framing::Full, 20.0);
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
    list
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
                    same,
                    light_sweep(Camera::Framed(Framing::Portrait, 25.0), 1.0, "lamp, ").into_iter().map(|panel| {
                        Panel {
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
                    |scene| {
                        each_material(scene, "Jacket_Cuff", |m| {
                            m.fluff = Some(Fluff { length_m: 0.003, density: 260.0, shells: 10, ..Fluff::default() });
                        });
                    },
                    light_sweep(CUFF, 1.0, "plush, "),
                ),
                row(
                    |scene| {
                        each_material(scene, "Jacket_Cuff", |m| {
                            m.fluff = Some(Fluff {
                                length_m: 0.015,
                                density: 110.0,
                                shells: 24,
                                gravity_m: 0.006,
                                ..Fluff::default()
                            });
                        });
                    },
                    light_sweep(CUFF, 1.0, "long, "),
                ),
            ],
        },
        Sheet {
            name: "stocking-decal",
            title: "Stockings and decals",
            caption: "Knit is denser where it is seen aslant (stocking): as shipped, and twice as dense; hearts laid over the \
                      skirt take its shade (decals).",
            rows: vec![
                row(same, legs("")),
                row(stockings, legs("dense, ")),
                row(decal, light_sweep(FULL, 0.55, "decal, ")),
            ],
        },
    ]
}

fn legs(what: &str) -> Vec<Panel> {
    light_sweep(Camera::Close { part: "Stocking", yaw: 15.0, pitch: 0.0 }, 0.6, what)
}

fn stockings(scene: &mut Scene) {
    each_material(scene, "Stocking", |m| {
        m.stocking = m.stocking.map(|s| Stocking { cover: 0.25, ..s });
    });
}

/// A heart on the left of the jacket, painted here.
fn decal(scene: &mut Scene) {
    const SIDE: u32 = 64;
    let pixels = (0..SIDE * SIDE).flat_map(|i| {
        let at = |k: u32| (k as f32 + 0.5) / SIDE as f32 * 2.6 - 1.3;
        let (x, y) = (at(i % SIDE), -at(i / SIDE));
        let heart = (x * x + y * y - 0.7).powi(3) - x * x * y.powi(3);
        [0xff, 0x5a, 0x7a, if heart < 0.0 { 255 } else { 0 }]
    });
    scene.images.push(Image { width: SIDE, height: SIDE, pixels: pixels.collect(), ..Image::default() });
    scene.textures.push(Texture { image: scene.images.len() - 1, sampler: Sampler::default() });
    let map = TextureRef { texture: scene.textures.len() - 1, ..TextureRef::default() };
    each_material(scene, "Skirt", |m| {
        let placed = (0..3)
            .map(|i| Decal { middle: [0.2 + 0.3 * i as f32, 0.55], size: [0.08, 0.16], ..Decal::default() })
            .collect();
        m.decals = Some(Decals { map, placed });
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
    let flame = |change: fn(&mut Scene), what: &str, background: [u8; 3]| {
        let panels = (0..7).map(|i| Panel {
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
            caption: "The painted shape of the brooch; a squared and split one; a brushed one (shaped_highlight). The matcap \
                      takes the place of the lit colour in part.",
            rows: vec![
                shape(same, ""),
                shape(
                    |scene| {
                        each_material(scene, "Metal", |m| {
                            m.shaped_highlight = m.shaped_highlight.map(|s| ShapedHighlight {
                                map: None,
                                square: 1.0,
                                split: [0.06, 0.05],
                                size_rad: 0.3,
                                rotate_rad: 0.3,
                                ..s
                            });
                        });
                    },
                    "split, ",
                ),
                shape(
                    |scene| {
                        each_material(scene, "Metal", |m| {
                            m.shaped_highlight = m.shaped_highlight.map(|s| ShapedHighlight {
                                map: None,
                                anisotropy: 0.9,
                                size_rad: 0.14,
                                ..s
                            });
                        });
                    },
                    "brushed, ",
                ),
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
            caption: "A drawn shape that noise eats away, over its period of two seconds; it blooms (fire, glow, post).",
            rows: vec![
                flame(same, "", [0x24, 0x28, 0x38]),
                flame(
                    |scene| {
                        each_material(scene, "Accessory_Flame", |m| {
                            m.fire = m.fire.map(|f| Fire { heat: f.heat, ..Fire::blue() });
                        });
                    },
                    "blue, ",
                    [0xdf, 0xe7, 0xee],
                ),
            ],
        },
    ]
}

fn whole() -> Vec<Sheet> {
    let coolness = |value: f32, what: &str| {
        light_sweep(FULL, 0.55, what).into_iter().map(move |panel| Panel { coolness: Some(value), ..panel })
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
                        let lined = ["Jacket", "Skirt", "Boots", "Cloth", "Stocking", "Metal"];
                        for name in lined {
                            each_material(scene, name, |m| m.inner_lines = Some(InnerLines::default()));
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
