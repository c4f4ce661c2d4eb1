//! Look files: what they change, and what they say about mistakes.

use std::path::{Path, PathBuf};

use hikage::LookFile;
use hikage::import::{Limits, load_bytes};
use hikage::material::{AngleMapping, OutlineWidth, Shading};
use hikage::picture::write_png;
use hikage::scene::{Character, Expression, Image, Pupils, Role, Scene};

fn heroine() -> Scene {
    load_bytes("hikage.vrm", &hikage_character::file(), None, &Limits::default()).expect("the file is read")
}

/// Small scene with a face, hair and a cloth, all without textures.
fn doll() -> Scene {
    use hikage::material::Material;
    use hikage::scene::{Mesh, Node, Primitive};
    let part = |material, role| Primitive { material, role, ..Primitive::default() };
    let mesh = |name: &str, primitive| Mesh { name: name.into(), primitives: vec![primitive], ..Mesh::default() };
    let material = |name: &str| Material { name: name.into(), ..Material::default() };
    Scene {
        nodes: (0..3).map(|mesh| Node { mesh: Some(mesh), ..Node::default() }).collect(),
        meshes: vec![
            mesh("Head", part(0, Role::Face)),
            mesh("Hair_mae", part(1, Role::Hair)),
            mesh("Dress", part(2, Role::Cloth)),
        ],
        materials: vec![material("Face"), material("Hair"), material("Dress")],
        ..Scene::default()
    }
}

fn apply(text: &str, scene: &mut Scene) -> Result<(), String> {
    apply_at(Path::new("girl.look.toml"), text, scene)
}

fn apply_at(path: &Path, text: &str, scene: &mut Scene) -> Result<(), String> {
    LookFile::parse(path, text).and_then(|look| look.apply(scene, None)).map_err(|e| e.to_string())
}

/// A folder of its own for one test.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("look-file-{name}"));
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

#[test]
fn sections_change_what_they_name_and_nothing_else() {
    let mut scene = doll();
    let text = r##"
        base = "plain"
        [parts]
        Hair_mae = "hair-front"
        [light]
        direction_deg = [90, 0]
        intensity = 0.5
        color = "#ff0000"
        [bangs]
        soft_width_mm = 4
        direction_deg = [-30, 45]
        [eyes_through]
        opacity = 0.25
        [pupils]
        dilation_s = 2
        [role.hair-front]
        double_sided = true
        [role.hair-front.depth_rim]
        width_px = 6
        [role.face]
        transition = { width = 0.3 }
        [material.Dress.base]
        color = "#808080"
        [material.Dress.outline]
        color = [0.1, 0.2, 0.3]
        width = { screen = { height_ratio = 0.002 } }
        [material.Dress.shading.toon]
        shade_color = "#000000"
    "##;
    apply(text, &mut scene).expect("a good look");
    assert_eq!(scene.meshes[1].primitives[0].role, Role::HairFront);
    let lights = scene.lights.as_ref().expect("lights");
    assert!((lights.directional.to_light - glam::Vec3::X).length() < 1e-6 && lights.directional.intensity == 0.5);
    assert_eq!(lights.directional.color.0, [1.0, 0.0, 0.0]);
    let bangs = scene.bangs.expect("bangs");
    assert!((bangs.soft_width_m - 0.004).abs() < 1e-7);
    assert!((bangs.direction_rad.expect("a direction")[0] + 30f32.to_radians()).abs() < 1e-6);
    assert_eq!(bangs.hardness, hikage::scene::Bangs::default().hardness, "what is not named stays");
    assert_eq!(scene.eyes_through.expect("eyes").opacity, 0.25);
    assert_eq!(scene.pupils, Some(Pupils { dilation_s: 2.0, ..Pupils::default() }));
    let [face, hair, dress] = [&scene.materials[0], &scene.materials[1], &scene.materials[2]];
    assert_eq!(face.transition.expect("a transition").width, 0.3);
    assert!(hair.double_sided && hair.depth_rim.expect("a rim").width_px == 6.0 && face.depth_rim.is_none());
    assert!((dress.base.color[0] - 0.2158).abs() < 1e-3 && dress.base.color[3] == 1.0, "{:?}", dress.base.color);
    let outline = dress.outline.expect("an outline");
    assert_eq!((outline.width, outline.color), (OutlineWidth::Screen { height_ratio: 0.002 }, [0.1, 0.2, 0.3]));
    assert!(matches!(dress.shading, Shading::Toon(t) if t.shade_color == [0.0; 3] && t.toony == 0.9));
}

#[test]
fn an_anime_look_is_the_base_and_false_switches_sections_off() {
    let mut scene = heroine();
    apply(
        "[role.hair]\nhighlight = false\n[role.hair-front]\nhighlight = false\n[role.face]\nface_paint = false",
        &mut scene,
    )
    .expect("a good look");
    let face = scene.materials.iter().find(|m| m.name == "Face").expect("a face");
    assert!(face.face_shadow.is_some() && face.bangs_shadow.is_some() && face.face_paint.is_none());
    assert!(scene.materials.iter().filter(|m| m.name.starts_with("Hair")).all(|m| m.highlight.is_none()));
    // Skin, white of the eye and mouth have shadow colours of their own.
    let of = |name: &str| {
        let material = scene.materials.iter().find(|m| m.name == name).expect(name);
        material.bangs_shadow.expect(name).color
    };
    let colors = [of("Face"), of("EyeWhite"), of("Mouth")];
    assert!(colors[0] != colors[1] && colors[1] != colors[2] && colors[0] != colors[2], "{colors:?}");
    let mut scene = heroine();
    apply("eyes_through = false\nbangs = false", &mut scene).expect("a good look");
    assert!(scene.eyes_through.is_none() && scene.bangs.is_none());
}

/// Pupils change with the expressions that a character has, by their names, whatever these end in.
#[test]
fn pupils_follow_the_expressions_of_the_character() {
    let named = |name: &str| Expression { name: name.to_owned(), ..Expression::default() };
    let character = Character { expressions: vec![named("surprised"), named("star_mm")], ..Character::default() };
    let doll = || Scene { character: Some(character.clone()), ..doll() };
    let mut scene = doll();
    let text = "[pupils]\nreflex = 0.5\nexpressions = { surprised = 0.7, star_mm = 2 }";
    apply(text, &mut scene).expect("a good look");
    let expressions = [("surprised".to_owned(), 0.7), ("star_mm".to_owned(), 2.0)].into();
    let expected = Pupils { reflex: 0.5, expressions, ..Pupils::default() };
    assert_eq!(scene.pupils, Some(expected.clone()));
    scene.check().expect("a good scene");
    // One is changed or switched off, the others stay; so does all of it in a template.
    let template = LookFile::template(&scene);
    apply("[pupils.expressions]\nstar_mm = false\nsurprised = 0.8", &mut scene).expect("a good look");
    assert_eq!(scene.pupils.expect("pupils").expressions, [("surprised".to_owned(), 0.8)].into());
    scene = doll();
    apply(&template, &mut scene).expect("a template is a good look");
    assert_eq!(scene.pupils, Some(expected.clone()));
    apply("pupils = false", &mut scene).expect("a good look");
    assert_eq!(scene.pupils, None);

    for (pupils, words) in [
        ("expressions = { suprised = 0.7 }", &["pupils.expressions", "\"suprised\"", "\"surprised\""][..]),
        ("expressions = { surprised = 9 }", &["pupils.expressions", "is 9", "0.2..3"]),
        ("expressions = { surprised = nan }", &["pupils", "expressions.surprised", "not finite"]),
        ("expressions = { surprised = \"wide\" }", &["pupils", "wide"]),
        ("reflex = 2", &["pupils.reflex", "is 2", "0..1"]),
        ("luminance = 0", &["pupils.luminance", "is 0", "0.001..100000"]),
        ("dilation = 2", &["pupils", "\"dilation\"", "\"dilation_s\""]),
    ] {
        let message = apply(&format!("[pupils]\n{pupils}"), &mut doll()).expect_err(pupils);
        for part in words {
            assert!(message.contains(part), "{pupils:?}: {message:?} lacks {part:?}");
        }
        assert!(message.starts_with("girl.look.toml") && !message.contains('\n'), "{message}");
    }
    // A scene made in code is checked the same.
    let nobody = Scene { pupils: Some(expected), ..Scene::default() };
    let error = nobody.check().expect_err("no such expression").to_string();
    assert!(error.contains("pupils.expressions[\"star_mm\"]"), "{error}");
}

/// The text that stands for the anime look of a scene gives that look.
#[test]
fn a_template_comes_back() {
    let (mut scene, mut before) = (heroine(), heroine());
    hikage::Look::Anime(hikage::Anime::default()).apply(&mut before);
    let text = LookFile::template(&before);
    assert!(text.contains("[role.face.face_shadow]") && text.contains("[material.HairBack.highlight]"), "{text}");
    apply(&text, &mut scene).expect("a template is a good look");
    for (after, before) in scene.materials.iter().zip(&before.materials) {
        assert!(after == before, "{} changed", before.name);
    }
    assert_eq!((scene.bangs, scene.eyes_through), (before.bangs, before.eyes_through));
}

/// Nobody whose face is not known takes cast shadows in the anime look; a warning says so, and its advice brings them back.
#[test]
fn cast_shadows_want_a_known_face() {
    let mut unknown = heroine();
    let name = {
        let of_face = |m: &&mut hikage::scene::Mesh| m.primitives.iter().any(|p| p.role == Role::Face);
        let face = unknown.meshes.iter_mut().find(of_face).expect("a face");
        face.primitives.iter_mut().filter(|p| p.role == Role::Face).for_each(|p| p.role = Role::Other);
        face.name.clone()
    };
    let mut told = unknown.clone();
    hikage::Look::Anime(hikage::Anime::default()).apply(&mut unknown);
    assert!(unknown.self_shadow.is_none() && unknown.materials.iter().all(|m| m.cast_shadow.is_none()));
    assert!(unknown.warnings.iter().any(|w| w.message.contains("no part is known to be the face")));
    // A file that says nothing of bones names its nodes; what has no head has no face to be cut.
    let mut thing = told.clone();
    thing.character = None;
    let mut named = thing.clone();
    hikage::Look::Anime(hikage::Anime::default()).apply(&mut named);
    assert!(named.self_shadow.is_none());
    thing.nodes.iter_mut().for_each(|node| node.name = "part".to_owned());
    hikage::Look::Anime(hikage::Anime::default()).apply(&mut thing);
    assert!(thing.self_shadow.is_some());
    apply(&format!("base = \"anime\"\n[parts]\n{name} = \"face\""), &mut told).expect("a good look");
    assert!(told.self_shadow.is_some() && told.warnings.iter().all(|w| !w.message.contains("no part is known")));
}

/// Hair gets a band of light, or a warning says why it gets none.
#[test]
fn hair_bands_are_left_out_for_a_reason() {
    use hikage::scene::Primitive;
    let mut bare = heroine();
    bare.materials.iter_mut().for_each(|m| m.authored.highlight = None);
    let is_hair = |p: &Primitive| matches!(p.role, Role::Hair | Role::HairFront);
    let made = |mut scene: Scene| {
        hikage::Look::Anime(hikage::Anime::default()).apply(&mut scene);
        let why = scene.warnings.iter().find_map(|w| w.message.strip_prefix("hair band left out: ").map(str::to_owned));
        (scene, why.unwrap_or_default())
    };
    let hair = |scene: &mut Scene, change: &dyn Fn(&mut Primitive)| {
        let parts = scene.meshes.iter_mut().flat_map(|m| &mut m.primitives);
        parts.filter(|p| is_hair(p)).for_each(change);
    };
    let (banded, why) = made(bare.clone());
    let lit = banded.materials.iter().position(|m| m.highlight.is_some_and(|h| h.map.uv_set == 1)).expect("a band");
    assert!(why.is_empty(), "{why}");

    let mut mapped = bare.clone();
    hair(&mut mapped, &|p| p.uvs.resize(2, vec![[0.0; 2]; p.positions.len()]));
    assert!(made(mapped).1.contains("second set"));

    let mut coarse = bare.clone();
    hair(&mut coarse, &|p| p.indices.truncate(30));
    assert!(made(coarse).1.contains("too few"));

    // Hair of which nothing is left before the ears but what lies under the marks, as light and view from the front have them.
    let highlight = banded.materials[lit].highlight.expect("a band");
    let marks = &banded.images[banded.textures[highlight.map.texture].image];
    let is_marked = |part: &Primitive, t: &[u32]| {
        let [u, v] = [0, 1].map(|k| t.iter().map(|i| part.uvs[1][*i as usize][k]).sum::<f32>() / 3.0);
        let place = |c: f32, side: u32| ((c * side as f32).max(0.0) as u32).min(side - 1);
        let y = place(v + highlight.light_v + highlight.view_v, marks.height);
        marks.pixels[(y * marks.width + place(u, marks.width)) as usize * 4] > 128
    };
    let mut covered = bare;
    for (mesh, with) in covered.meshes.iter_mut().zip(&banded.meshes) {
        for (part, with) in mesh.primitives.iter_mut().zip(&with.primitives).filter(|(p, _)| is_hair(p)) {
            let behind = |t: &[u32]| t.iter().all(|i| part.positions[*i as usize][2] < -0.05);
            let kept = part.indices.chunks_exact(3).filter(|t| behind(t) || (with.uvs.len() > 1 && is_marked(with, t)));
            part.indices = kept.flatten().copied().collect();
        }
    }
    let why = made(covered).1;
    assert!(why.contains("would cover"), "{why}");
}

/// Every mistake names the file, the place, and the nearest thing that exists.
#[test]
fn mistakes_are_named_with_what_was_meant() {
    let cases = [
        ("bass = \"anime\"", &["girl.look.toml", "line 1", "\"bass\"", "\"base\""][..]),
        ("\n\nbase = \"manga\"", &["line 3", "\"manga\"", "anime"]),
        ("base = [", &["line 1"]),
        ("[role.hairfront]\n", &["hairfront", "\"hair-front\""]),
        ("[parts]\nHaed = \"face\"", &["parts", "\"Haed\"", "\"Head\""]),
        ("[material.Fase]\n", &["material.\"Fase\"", "\"Face\""]),
        ("[role.face.bangs_shadow]\nstrenth = 1", &["role.face", "\"strenth\"", "\"strength\""]),
        ("[role.face]\nbangs_shadwo = {}", &["role.face", "\"bangs_shadwo\"", "\"bangs_shadow\""]),
        ("[bangs]\nhardnes = 3", &["bangs", "\"hardnes\"", "\"hardness\""]),
        ("[light]\ndirection_deg = [0]", &["light"]),
        ("[light]\nyaw = 3", &["light", "\"yaw\""]),
        ("bangs = true", &["bangs", "false to switch it off"]),
        ("[role.face.base]\ncolor = \"red\"", &["role.face", "\"red\"", "#rrggbb"]),
        ("[role.face.transition]\nwidth = nan", &["role.face", "transition.width", "not finite"]),
        ("[role.face.transition]\nwidth = \"wide\"", &["role.face", "wide"]),
        ("[role.face.base]\ntexture = \"../up.png\"", &["role.face", "../up.png", "leads out of the folder"]),
        ("[role.face.base]\ntexture = \"/etc/passwd\"", &["leads out of the folder"]),
        ("[role.face.base]\ntexture = \"none.png\"", &["none.png"]),
        ("[role.face.face_shadow]\nmap = \"none.png\"", &["none.png"]),
        ("[role.face.face_shadow]\nstack = []", &["either map or stack"]),
        ("[role.face.face_shadow]\nstack = [{ fron = \"a.png\" }]", &["\"fron\"", "\"front\""]),
        ("[role.face.face_shadow]\nsoftness_deg = true", &["softness_deg", "expected a number"]),
        // Numbers out of their range, with it.
        ("[role.face.face_shadow]\nsoftness = 99", &["role.face.face_shadow.softness", "is 99", "0.001..0.5"]),
        ("[role.face.sparkle]\nspacing_px = -3", &["sparkle.spacing_px", "is -3", "2..64"]),
        ("[role.face.depth_rim]\nwidth_px = -1e9", &["depth_rim.width_px", "0..64"]),
        ("[role.face.outline.tint]\ngamma = 0.1", &["outline.tint.gamma", "0.5..4"]),
        ("[role.face.gem]\nlayers = 9", &["gem.layers", "is 9", "1..4"]),
        ("[role.face.alpha]\nqueue_offset = 40", &["alpha.queue_offset", "is 40", "-9..9"]),
        ("[bangs]\nsoft_width_mm = 900", &["bangs.soft_width_m", "0.0005..0.05"]),
        ("[post]\nbloom = { strength = 9 }", &["post.bloom.strength", "0..4"]),
    ];
    for (text, expected) in cases {
        let message = apply(text, &mut doll()).expect_err(text);
        for part in expected {
            assert!(message.contains(part), "{text:?}: {message:?} lacks {part:?}");
        }
        assert!(message.starts_with("girl.look.toml") || message.contains("none.png"), "{message}");
        assert!(!message.contains('\n'), "{message}");
    }
}

#[test]
fn files_that_are_none_are_refused() {
    let folder = folder("refused");
    let message = |path: &Path| LookFile::read(path).expect_err("no look").to_string();
    assert!(message(&folder).contains("not a regular file"));
    assert!(message(&folder.join("none.look.toml")).contains("none.look.toml"));
    let large = folder.join("large.look.toml");
    std::fs::write(&large, "#".repeat((1 << 20) + 1)).expect("a file");
    assert!(message(&large).contains("over the limit"));
    std::fs::write(&large, [0xff, 0xfe, 0x00]).expect("a file");
    assert!(message(&large).contains("UTF-8"), "{}", message(&large));
    assert_eq!(LookFile::beside(Path::new("a/girl.v2.vrm")), Path::new("a/girl.v2.look.toml"));
}

fn grey(width: u32, height: u32, value: u8) -> Image {
    let pixels = [value, value, value, 255].repeat((width * height) as usize);
    Image { width, height, pixels, ..Image::default() }
}

/// Maps of a face by pitch, with second maps and masks; textures of any section.
#[test]
fn maps_and_textures_are_read_from_beside_the_file() {
    let folder = folder("maps");
    let file = folder.join("girl.look.toml");
    for (name, value) in [("low.png", 10), ("high.png", 200), ("back.png", 90), ("masks.png", 255)] {
        write_png(folder.join(name), &grey(4, 2, value)).expect("a picture");
    }
    let text = r#"
        base = "plain"
        [role.face.face_shadow]
        layout = "mirrored"
        angle = "cosine"
        masks = "masks.png"
        stack = [
            { pitch_deg = -10, front = "low.png", back = "back.png" },
            { pitch_deg = 40, front = "high.png", back = "back.png" },
        ]
        [role.face.base]
        texture = "low.png"
        [role.face.matcap]
        texture = "high.png"
        [role.face.highlight]
        map = "high.png"
    "#;
    let mut scene = doll();
    apply_at(&file, text, &mut scene).expect("a good look");
    let face = &scene.materials[0];
    let shadow = face.face_shadow.expect("a shadow");
    assert_eq!(shadow.angle, AngleMapping::Cosine);
    let map = &scene.face_maps[shadow.map];
    assert_eq!((map.width, map.height, map.front.len(), map.back.len(), map.masks.len()), (4, 2, 2, 2, 8));
    assert!((map.pitches_rad[1] - 40f32.to_radians()).abs() < 1e-6 && map.is_8_bit);
    assert_eq!(map.front[0][0], [10 * 257, 10 * 257, 0, 65535], "one grey channel for both sides");
    let image = |texture: usize| scene.images[scene.textures[texture].image].pixels[0];
    assert_eq!(image(face.base.texture.expect("a texture").texture), 10);
    assert_eq!(
        (image(face.matcap.expect("a matcap").texture.texture), image(face.highlight.expect("one").map.texture)),
        (200, 200)
    );

    // Maps of other sizes cannot lie in one array.
    write_png(folder.join("wide.png"), &grey(8, 2, 1)).expect("a picture");
    let wide = text.replace("front = \"high.png\"", "front = \"wide.png\"");
    let message = apply_at(&file, &wide, &mut doll()).expect_err("sizes differ");
    assert!(message.contains("other sizes"), "{message}");
    let some = text.replace(
        "{ pitch_deg = 40, front = \"high.png\", back = \"back.png\" }",
        "{ pitch_deg = 40, front = \"high.png\" }",
    );
    assert!(apply_at(&file, &some, &mut doll()).expect_err("one back map").contains("1 back maps for 2 pitches"));
    let twice = text.replace("pitch_deg = 40", "pitch_deg = -10");
    assert!(apply_at(&file, &twice, &mut doll()).expect_err("one pitch twice").contains("growing"));
}

/// 16 bits stay 16 bits.
#[test]
fn wide_maps_keep_their_bits() {
    let folder = folder("wide");
    let path = folder.join("wide.png");
    let picture = image::ImageBuffer::<image::Luma<u16>, _>::from_fn(4, 1, |x, _| image::Luma([x as u16 * 1000 + 7]));
    picture.save(&path).expect("a picture");
    let mut scene = doll();
    let text = "base = \"plain\"\n[role.face.face_shadow]\nmap = \"wide.png\"\nlayout = \"mirrored\"";
    apply_at(&folder.join("girl.look.toml"), text, &mut scene).expect("a good look");
    let map = &scene.face_maps[0];
    assert!(!map.is_8_bit);
    let green: Vec<u16> = map.front[0].iter().map(|t| t[1]).collect();
    assert_eq!(green, [7, 1007, 2007, 3007]);
}

#[test]
fn presets_stand_for_their_numbers_and_may_be_changed() {
    use hikage::material::{Fire, Gem};
    use hikage::scene::ToneCurve;
    let mut scene = doll();
    let text = r#"
        base = "plain"
        [post]
        tone = "filmic"
        bloom = { strength = 0.9 }
        [material.Face]
        gem = "ruby"
        [material.Hair]
        gem = { preset = "jade", depth_mm = 4 }
        [material.Dress]
        alpha = { mode = "blend" }
        fire = "blue"
        shaped_highlight = { preset = "square", rotate_deg = 90 }
    "#;
    apply(text, &mut scene).expect("a look");
    let of = |i: usize| &scene.materials[i];
    assert_eq!(of(0).gem, Some(Gem::ruby()));
    assert_eq!(of(1).gem, Some(Gem { depth_m: 0.004, ..Gem::jade() }));
    assert_eq!(of(2).fire, Some(Fire::blue()));
    let shape = of(2).shaped_highlight.expect("a shape");
    assert!(shape.square == 1.0 && (shape.rotate_rad - std::f32::consts::FRAC_PI_2).abs() < 1e-6, "{shape:?}");
    let post = scene.post.expect("post");
    assert!(post.tone == ToneCurve::Filmic && post.bloom.expect("bloom").strength == 0.9);
    for (text, words) in [
        ("[material.Face]\ngem = \"rubby\"", &["preset of gem", "rubby", "ruby"][..]),
        ("[material.Face]\ngem = { preset = 3 }", &["gem.preset"]),
        ("[material.Face]\nfire = \"blue\"", &["material.\"Face\"", "fire", "blend"]),
        ("[material.Face]\ndecals = { placed = [{ middle = [0.2, 0.3] }] }", &["decals", "map"]),
        ("[material.Face]\ndecals = { placed = [{ size_deg = 3 }] }", &["size_rad"]),
        ("[post]\ntone = \"film\"", &["post", "filmic"]),
    ] {
        let error = apply(text, &mut doll()).expect_err("an error");
        assert!(words.iter().all(|w| error.contains(w)), "{error}");
    }
}

/// Fire keeps the shape that the file authored, and decals are read with their units, their colours and their sheet.
#[test]
fn fire_keeps_its_shape_and_decals_are_placed() {
    let folder = folder("decals");
    let sheet = folder.join("sheet.png");
    image::ImageBuffer::from_pixel(2, 2, image::Rgba([255u8, 0, 0, 128])).save(&sheet).expect("a picture");
    let mut scene = doll();
    let heat = hikage::material::TextureRef { texture: 7, ..Default::default() };
    scene.materials[1].authored.heat = Some(heat);
    let text = r##"
        base = "plain"
        [material.Face.decals]
        map = "sheet.png"
        placed = [{ middle = [0.2, 0.3], rotation_deg = 90, color = "#ff0000" }, { size = [0.5, 0.5] }]
        [material.Hair]
        alpha = { mode = "blend" }
        fire = { preset = "blue", cells = 6 }
    "##;
    apply_at(&folder.join("girl.look.toml"), text, &mut scene).expect("a good look");
    let decals = scene.materials[0].decals.as_ref().expect("decals");
    assert_eq!(decals.map.map(|m| m.texture), Some(scene.textures.len() - 1));
    let [first, second] = decals.placed.as_slice() else { panic!("two decals: {decals:?}") };
    assert!((first.rotation_rad - std::f32::consts::FRAC_PI_2).abs() < 1e-6 && first.middle == [0.2, 0.3]);
    assert_eq!((first.color, second.color), ([1.0, 0.0, 0.0, 1.0], [1.0; 4]));
    let fire = scene.materials[1].fire.expect("fire");
    assert_eq!((fire.heat, fire.cells), (Some(heat), 6));
    assert_eq!(fire.colors, hikage::material::Fire::blue().colors);
}

/// Smooth edges go by their name; what was once written still says the same.
#[test]
fn antialiasing_goes_by_name_or_switch() {
    use hikage::scene::Antialias;
    for (value, expected) in [
        ("\"none\"", Antialias::None),
        ("\"fxaa\"", Antialias::Fxaa),
        ("\"temporal\"", Antialias::Temporal),
        ("false", Antialias::None),
        ("true", Antialias::Fxaa),
    ] {
        for before in ["\"fxaa\"", "\"none\""] {
            let mut scene = doll();
            apply(&format!("base = \"plain\"\n[post]\nantialias = {before}"), &mut scene).expect("a look");
            apply(&format!("base = \"plain\"\n[post]\nantialias = {value}"), &mut scene).expect("a look");
            assert_eq!(scene.post.map(|p| p.antialias), Some(expected), "{before}, then {value}");
        }
    }
    let error = apply("[post]\nantialias = \"smooth\"", &mut doll()).expect_err("unknown");
    assert!(error.contains("smooth") && error.contains("fxaa"), "{error}");
    let error = apply("[post]\nantialias = 2", &mut doll()).expect_err("a number");
    assert!(error.contains("\"none\", \"fxaa\" or \"temporal\""), "{error}");
    assert!(
        LookFile::template(&{
            let mut scene = doll();
            apply("[post]\nantialias = false", &mut scene).expect("a look");
            scene
        })
        .contains("antialias = \"none\"")
    );
}

/// A Radiance file of flat texels: RGBE has 1 as 128 and an exponent of 129.
fn hdr(width: u32, height: u32) -> Vec<u8> {
    let header = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n").into_bytes();
    [header, [128u8, 128, 128, 129].repeat((width * height) as usize)].concat()
}

#[test]
fn light_from_all_around_goes_by_name_or_by_a_picture_beside_the_file() {
    use hikage::scene::Environment;
    let folder = folder("environment");
    let file = folder.join("girl.look.toml");
    std::fs::write(folder.join("noon.hdr"), hdr(4, 2)).expect("a picture");
    let with = |text: &str| {
        let mut scene = doll();
        apply_at(&file, text, &mut scene).unwrap_or_else(|e| panic!("{text:?}: {e}"));
        scene.lights.and_then(|l| l.environment)
    };
    for (text, expected) in [
        ("base = \"plain\"", None),
        ("[environment]", Some(Environment::studio())),
        ("[environment]\nsource = \"studio\"", Some(Environment::studio())),
        ("[environment]\nsource = \"sky\"\nstrength = 2", Some(Environment { strength: 2.0, ..Environment::sky() })),
        ("base = \"natural\"\nenvironment = false", None),
    ] {
        assert!(with(text) == expected, "{text:?} gives another environment");
    }
    let noon = with("[environment]\nsource = \"noon.hdr\"\nturn_deg = 90").expect("an environment");
    assert_eq!((noon.radiance.size(), noon.radiance.texels()[0]), ([4, 2], [1.0; 3]));
    assert_eq!((noon.turn_rad, noon.strength), (std::f32::consts::FRAC_PI_2, 1.0));
    // That of the base look stays under lights of the file.
    let natural = with("base = \"natural\"");
    assert!(natural.is_some() && with("base = \"natural\"\n[light]\nintensity = 0.5") == natural);

    std::fs::write(folder.join("text.hdr"), "PNG and so on").expect("a file");
    std::fs::write(folder.join("cut.hdr"), &hdr(64, 32)[..200]).expect("a file");
    std::fs::write(folder.join("square.hdr"), hdr(4, 4)).expect("a file");
    for (section, words) in [
        ("source = \"text.hdr\"", &["text.hdr", "Radiance file"][..]),
        ("source = \"cut.hdr\"", &["cut.hdr", "cut off"]),
        ("source = \"square.hdr\"", &["square.hdr", "twice as wide"]),
        ("source = \"none.hdr\"", &["none.hdr"]),
        ("source = \"stduio\"", &["environment.source", "stduio", "\"studio\"", ".hdr"]),
        ("source = \"../noon.hdr\"", &["girl.look.toml", "environment.source", "leads out of the folder"]),
        ("source = 3", &["girl.look.toml", "environment", "string"]),
        ("sorce = \"sky\"", &["environment", "\"sorce\"", "\"source\""]),
        ("strength = -1", &["environment.strength", "is -1", "0..1000"]),
        ("turn_rad = nan", &["environment", "turn_rad", "not finite"]),
    ] {
        let message = apply_at(&file, &format!("[environment]\n{section}"), &mut doll()).expect_err(section);
        for part in words {
            assert!(message.contains(part), "{section:?}: {message:?} lacks {part:?}");
        }
        assert!(!message.contains('\n'), "{message}");
    }
}

/// Physical surfaces take the place of toon ones, and what the file does not name is that of the base look.
#[test]
fn physical_surfaces_are_a_shading_of_a_material() {
    use hikage::material::Standard;
    let folder = folder("standard");
    let file = folder.join("girl.look.toml");
    write_png(folder.join("worn.png"), &grey(4, 2, 90)).expect("a picture");
    let with = |text: &str| {
        let mut scene = doll();
        apply_at(&file, text, &mut scene).unwrap_or_else(|e| panic!("{text:?}: {e}"));
        scene
    };
    let scene = with(
        "base = \"plain\"\n[material.Dress]\nshading = { standard = { metallic = 1, roughness = 0.25, map = \"worn.png\" } }",
    );
    let Shading::Standard(surface) = scene.materials[2].shading else { panic!("{:?}", scene.materials[2].shading) };
    let map = surface.map.expect("a map");
    assert_eq!(scene.images[scene.textures[map.texture].image].pixels[0], 90);
    assert_eq!(surface, Standard { metallic: 1.0, roughness: 0.25, map: Some(map), ..Standard::default() });
    assert!(matches!(scene.materials[0].shading, Shading::Toon(_)), "another material changed");
    let of = |text: &str| with(text).materials[0].shading;
    let Shading::Standard(skin) = of("base = \"natural\"") else { panic!("the natural look is physical") };
    assert_ne!(skin.roughness, Standard::default().roughness);
    assert_eq!(
        of("base = \"natural\"\n[role.face.shading.standard]\nior = 1.4"),
        Shading::Standard(Standard { ior: 1.4, ..skin })
    );
    assert_eq!(of("base = \"natural\"\n[role.face]\nshading = \"unlit\""), Shading::Unlit);
    let toon = of("base = \"natural\"\n[role.face.shading.toon]\ntoony = 0.5");
    assert!(matches!(toon, Shading::Toon(t) if t.toony == 0.5), "{toon:?}");

    for (shading, words) in [
        ("{ standard = { roughness = 2 } }", &["standard.roughness", "is 2", "0..1"][..]),
        ("{ standard = { metallic = -0.5 } }", &["standard.metallic", "is -0.5", "0..1"]),
        ("{ standard = { ior = 0.5 } }", &["standard.ior", "is 0.5", "1..3"]),
        ("{ standard = { ior = inf } }", &["standard.ior", "not finite"]),
        ("{ standard = { rougness = 0.5 } }", &["\"rougness\"", "\"roughness\""]),
        ("{ standrad = { roughness = 0.5 } }", &["\"standrad\"", "\"standard\""]),
        ("{ standard = { map = \"none.png\" } }", &["none.png"]),
    ] {
        let text = format!("base = \"plain\"\n[material.Dress]\nshading = {shading}");
        let message = apply_at(&file, &text, &mut doll()).expect_err(shading);
        for part in words {
            assert!(message.contains(part), "{shading:?}: {message:?} lacks {part:?}");
        }
        assert!(message.contains("material.\"Dress\"") || message.contains("none.png"), "{message}");
        assert!(!message.contains('\n'), "{message}");
    }
}
