//! What `cargo xtask same` draws.

use std::path::{Path, PathBuf};

const MODELS: &str = "../shared/models";

/// The map of looks that need one; any picture does.
pub(super) const MAP: &str = "tests/readme/face-plain.png";

/// One command, which writes one picture or a folder of them.
pub(super) struct View {
    pub name: String,
    /// The command line without the output and the adapter.
    pub args: Vec<String>,
    /// A look file that the command gets as `--look`.
    pub look: Option<&'static str>,
    pub writes: Writes,
    /// Whether the command takes an adapter.
    pub draws: bool,
    /// The one driver that draws it, where it takes long on the other and shows nothing there that shorter ones do not.
    pub only_on: Option<&'static str>,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Writes {
    Picture,
    Folder,
}

/// Models besides the spheres: file, and options for views of it, each drawn plain and with the anime look.
const CHARACTERS: [(&str, &[&str]); 12] = [
    (
        "Seed-san_rebuilt.vrm",
        &[
            "",
            "--yaw 40 --view full --light -60,40",
            "--yaw 160 --samples 1 --view bust",
            "--view face --expression happy=0.6,blinkLeft --pose bend --background none",
        ],
    ),
    (
        "Godette_vrm_v4.vrm",
        &["", "--yaw -35 --view full --samples 1", "--view face --expression aa=0.5,blink --light 70,10"],
    ),
    ("m2m_human-sophia.glb", &["--view full", "--yaw 60 --view face --samples 1"]),
    ("KayKit_Mage.glb", &["--view full --pose relaxed", "--yaw -120 --view bust --samples 1"]),
    ("KayKit_Knight.glb", &["--view full --yaw 20"]),
    ("Fox.glb", &["--view full --yaw 50"]),
    ("mtoon_UV_Animation_Test.vrm", &["--view full", "--view full --time 0.7", "--view full --time 12.3 --samples 1"]),
    (
        "expressions_isBinary_Overridden.vrm",
        &["--view full", "--view full --expression happy=0.4,blink=0.6", "--view full --expression blink --samples 1"],
    ),
    ("EmissionMigration_v0.107.0.vrm", &["--view full", "--view full --samples 1 --yaw 20"]),
    ("singleBlendshapeCube_sparse.glb", &["--view full --yaw 30"]),
    ("arkavo/mtoon_default.vrm", &["--view full"]),
    ("arkavo/mtoon_rimLightingMix_0p5.vrm", &["--view full --light 100,20"]),
];

/// Views of the built-in character, and whether they are drawn on lavapipe alone.
const BUILT_IN: [(&str, bool); 6] = [
    ("--look anime --view bust --yaw 20 --light -30,35 --pose offer --expression flame --background none", false),
    ("--look anime --view full --yaw -50 --samples 1 --coolness 1 --time 0.9", false),
    ("--look plain --view bust --yaw 25", false),
    ("--look anime --view face --yaw 35 --light 120,10 --coolness 0.3 --expression happy=0.5", true),
    ("--look anime --view portrait --yaw -90 --samples 1 --pose bend", true),
    ("--look plain --view face --samples 1 --expression blink=0.5 --background #203040", true),
];

/// What is shown of a pixel besides the picture.
const CHANNELS: [&str; 22] = [
    "normal",
    "depth",
    "part-id",
    "face-shadow",
    "transition",
    "face-paint",
    "highlight",
    "bangs-shadow",
    "layer",
    "depth-rim",
    "eyes-through",
    "shade-ramp",
    "fur",
    "self-shadow",
    "stone",
    "sparkle",
    "fire",
    "fluff",
    "dissolve",
    "emission",
    "overlay",
    "inner-lines",
];

/// Channels that are drawn on SwiftShader too: of the built-in character, and of a character without authored maps. Spheres
/// show the others there.
const ON_BOTH: [&[&str]; 2] = [
    &["face-shadow"],
    &[
        "normal",
        "depth",
        "part-id",
        "face-shadow",
        "highlight",
        "bangs-shadow",
        "layer",
        "depth-rim",
        "eyes-through",
        "self-shadow",
    ],
];

/// Sheets of the gallery that are drawn on SwiftShader.
const SHORT_GALLERY: &str = "gallery --panel 64 --only fluff,gems,diamond,vanishing";

/// Looks of a sphere: name, options, and what its file says. Its only part has the role `other`.
const SPHERE_LOOKS: &[(&str, &str, &str)] = &[
    ("amber", "--channel stone", "[role.other]\ngem = \"amber\""),
    ("ruby", "", "[role.other]\ngem = { preset = \"ruby\", inclusions = \"map.png\", layers = 4, uv_per_m = 3 }"),
    ("jade", "--yaw 30 --samples 1", "[role.other]\ngem = \"jade\""),
    ("brilliant", "--channel stone", "[role.other]\ndiamond = \"brilliant\""),
    (
        "diamond",
        "",
        "[role.other]\ndiamond = { preset = \"glass\", facets = 6, bounces = 4 }\nglow = { highlight = 1 }",
    ),
    ("orange", "--channel fire --time 0.4", "[role.other]\nalpha = { mode = \"blend\" }\nfire = \"orange\""),
    (
        "blue",
        "--time 1.3 --background none",
        "[post]\nbloom = { strength = 0.8 }\n[role.other]\nalpha = { mode = \"blend\" }\nfire = { preset = \"blue\", heat = \
         \"map.png\" }\nglow = { emission = 1 }",
    ),
    ("glitter", "--channel sparkle", "[role.other]\nsparkle = \"glitter\""),
    ("snow", "--yaw 20 --samples 1", "[role.other]\nsparkle = \"snow\""),
    ("dust", "", "[role.other]\nsparkle = { preset = \"dust\", spacing_px = 6, color = \"#ffd0a0\" }"),
    ("sheer", "--channel overlay", "[role.other]\nstocking = \"sheer\""),
    ("opaque", "", "[role.other]\nstocking = { preset = \"opaque\", color = \"#401020\" }"),
    (
        "decals",
        "",
        "[role.other.decals]\nmap = \"map.png\"\nplaced = [{ middle = [0.25, 0.4], size = [0.2, 0.3], rotation_deg = 30 }, { \
         middle = [0.3, 0.6], size = [0.3, 0.2], multiplies = true, color = \"#ff8040\" }, { sheet = [0.2, 0.2, 0.5, 0.5], \
         middle = [0.75, 0.5], size = [0.2, 0.2] }]",
    ),
    (
        "decal",
        "--channel overlay",
        "[role.other.decals]\nmap = \"map.png\"\nplaced = [{ middle = [0.75, 0.5], size = [0.4, 0.4] }]",
    ),
    ("dissolve", "", "[role.other]\ndissolve = { amount = 0.4, border = 0.1, color = [2, 0.5, 0.1] }"),
    ("dissolve-glow", "--channel dissolve", "[role.other]\ndissolve = { amount = 0.6, cell_mm = 30 }"),
    ("fade", "", "[role.other]\ndither_fade = { opacity = 0.4 }"),
    ("fade-near", "--samples 1", "[role.other]\ndither_fade = { opacity = 0.9, near_m = [0.5, 20] }"),
    ("trim", "--channel fluff", "[role.other]\nfluff = \"trim\""),
    ("plush", "--time 0.6", "[role.other]\nfluff = \"plush\""),
    ("long", "--time 1.1 --samples 1", "[role.other]\nfluff = { preset = \"long\", shells = 12, gravity_mm = 20 }"),
    (
        "filmic",
        "--background none",
        "[post]\ntone = \"filmic\"\nbloom = { strength = 0.9, radius = 0.06 }\n[role.other]\nemission = { color = [1, 2, 0.5] \
         }\nglow = { emission = 1 }",
    ),
    ("neutral", "", "[post]\ntone = \"neutral\"\n[light]\nintensity = 2.5\ncolor = \"#ffe0c0\""),
    ("antialias", "--samples 1", "[post]\nantialias = true"),
    ("inner-lines", "", "[role.other]\ninner_lines = { width_px = 3, fold_deg = 10, step_mm = 5 }"),
    ("inner-lines-only", "--channel inner-lines", "[role.other]\ninner_lines = { fold_deg = 5, between_parts = true }"),
    (
        "tint-lit",
        "--light 60,30",
        "[role.other.outline]\nwidth = { world = { metres = 0.02 } }\ntint = { from = \"lit\", gamma = 2, hue_deg = 20, saturation \
         = 1.3 }\nlighting_mix = 0.7",
    ),
    (
        "tint-shade",
        "--samples 1",
        "[role.other.outline]\nwidth = { screen = { height_ratio = 0.01 } }\ntint = { from = \"shade\", factor = [0.5, 0.6, 0.7] \
         }\nwidth_mask = \"map.png\"",
    ),
    (
        "clamp",
        "",
        "[role.other.outline]\nwidth = { world = { metres = 0.05 } }\nclamp_px = [1, 2.5]\npush_mm = 4\ncolor = \"#8c4a44\"",
    ),
    (
        "response",
        "--light 90,0",
        "[light]\nintensity = 3\ncolor = \"#ff8080\"\nambient = [0.2, 0.3, 0.4]\n[role.other]\nlight_response = { min = 0.2, max = \
         0.8, monochrome = 0.5 }",
    ),
    ("layer", "", "[role.other]\nlayer = { index = 2, stay_lit = 0.6 }"),
    ("layer-only", "--channel layer", "[role.other]\nlayer = { index = 1, stay_lit = 0.3 }"),
    ("matcap", "--yaw 15", "[role.other]\nmatcap = { texture = \"map.png\", color = [0.8, 0.7, 0.6] }"),
    (
        "rim",
        "--light -120,30",
        "[role.other.rim]\ncolor = [0.9, 0.8, 0.4]\nfresnel_power = 3\nlift = 0.1\nlighting_mix = 0.4\nmask = \"map.png\"",
    ),
    (
        "depth-rim",
        "--light 60,40",
        "[role.other.depth_rim]\nwidth_px = 6\nstrength = 0.8\nshade_color = [0.2, 0.3, 0.9]\ntint = 0.5",
    ),
    ("depth-rim-only", "--channel depth-rim", "[role.other.depth_rim]\nwidth_px = 4\nwidth_mask = \"map.png\""),
    (
        "shade",
        "--light 50,20",
        "[role.other.shade_ramp]\nwidth = 0.6\nshade_hue_deg = [10, -20]\nshade_saturation = [1.2, 0.8]\nterminator_color = [0.9, \
         0.4, 0.3]",
    ),
    (
        "ramp",
        "--light -50,20 --coolness 0.4",
        "[role.other.shade_ramp]\nmaps = { warm = \"map.png\", cool = \"map.png\", rows = 8, row = 3 }",
    ),
    ("ramp-only", "--channel shade-ramp --light -50,20", "[role.other.shade_ramp]\nwidth = 0.4"),
    ("fur", "--light 70,20", "[role.other]\nfur_detail = { detail_normal = \"map.png\", softness = 0.1 }"),
    (
        "fur-only",
        "--channel fur --light 70,20",
        "[role.other]\nfur_detail = { detail_normal = \"map.png\", detail_color = \"map.png\", shares = [0.3, 0.9, 0.5] }",
    ),
    (
        "paint",
        "--light -40,20",
        "[role.other.face_paint]\nmap = \"map.png\"\nblush_strength = 0.8\nshadow_line_strength = 0.5\nnose_line_strength = 0.7",
    ),
    ("paint-only", "--channel face-paint", "[role.other]\nface_paint = { map = \"map.png\", blush_strength = 1 }"),
    (
        "highlight",
        "",
        "[role.other.highlight]\nmap = \"map.png\"\nstrength = 0.9\nlight_v = 0.1\nview_v = 0.2\nsecond_strength = \
         0.5\nbreakup = 0.4",
    ),
    ("highlight-only", "--channel highlight --yaw 30", "[role.other]\nhighlight = { map = \"map.png\", turn_u = 0.1 }"),
    ("round", "", "[role.other]\nshaped_highlight = \"round\""),
    ("square", "--yaw 20", "[role.other]\nshaped_highlight = { preset = \"square\", rotate_deg = 30 }"),
    ("window", "--channel highlight", "[role.other]\nshaped_highlight = \"window\""),
    ("strokes", "--light 20,40", "[role.other]\nshaped_highlight = { preset = \"strokes\", size_deg = 30 }"),
    (
        "brushed",
        "--light 10,30",
        "[role.other]\nmatcap = { texture = \"map.png\", color = [1, 1, 1] }\nshaped_highlight = { preset = \"brushed\", matcap_mix = \
         0.5 }",
    ),
    ("painted", "", "[role.other]\nshaped_highlight = { map = \"map.png\", map_width = 0.4, in_shade = 0.5 }"),
    ("transition", "--light 60,20", "[role.other]\ntransition = { width = 0.3, strength = 0.9, color = \"#ff9070\" }"),
    ("transition-only", "--channel transition --light 60,20", "[role.other]\ntransition = { width = 0.2 }"),
    (
        "shadow",
        "--light 40,50",
        "[self_shadow]\nside = 512\n[role.other]\ncast_shadow = { casts = true, received = 0.8 }",
    ),
    (
        "shadow-only",
        "--channel self-shadow",
        "[self_shadow]\n[role.other]\ncast_shadow = { casts = true, received = 1 }",
    ),
    (
        "scroll",
        "--time 0.3",
        "[role.other.emission]\ncolor = [0.3, 0.9, 0.6]\ntexture = \"map.png\"\nscroll_per_s = [0.2, -0.5]\nblink = { period_s = 1.5, \
         low = 0.2 }",
    ),
    ("blink", "--channel emission --time 0.9", "[role.other.emission]\ncolor = [0.3, 0.9, 0.6]\nblink = { low = 0.1 }"),
    (
        "uv-animation",
        "--time 0.8",
        "[role.other]\nbase = { texture = \"map.png\" }\nuv_animation = { scroll_u_per_s = 0.2, scroll_v_per_s = -0.1, \
         rotation_rad_per_s = 0.7 }",
    ),
    ("mask", "", "[role.other]\nbase = { texture = \"map.png\" }\nalpha = { mode = \"mask\", cutoff = 0.4 }"),
    (
        "blend",
        "--background none",
        "[role.other]\nbase = { color = [0.8, 0.5, 0.4, 0.5] }\nalpha = { mode = \"blend\" }",
    ),
    ("unlit", "", "[role.other]\nbase = { texture = \"map.png\" }\nshading = \"unlit\""),
    (
        "toon",
        "--light 80,10",
        "[role.other.shading.toon]\nshade_texture = \"map.png\"\nshift = -0.2\nshift_texture = \"map.png\"\nshift_texture_scale = \
         0.3\ntoony = 0.6\ngi_equalization = 0.2",
    ),
    ("normal-only", "--channel normal --samples 1", "[role.other.normal_map]\nscale = 2"),
    (
        "everything",
        "--time 0.5 --light -50,30",
        "[post]\ntone = \"filmic\"\nbloom = {}\n[self_shadow]\n[role.other]\nsparkle = \"glitter\"\nstocking = \"sheer\"\nglow = \
         {}\ndissolve = { amount = 0.2 }\ndither_fade = { opacity = 0.9 }\ninner_lines = {}\nshade_ramp = {}\ntransition = \
         {}\ndepth_rim = {}\nlight_response = {}\ncast_shadow = {}\nshaped_highlight = \"round\"\nmatcap = { texture = \"map.png\", \
         color = [0.3, 0.3, 0.3] }\nemission = { color = [0.1, 0.2, 0.3] }\ndecals = { map = \"map.png\", placed = [{}] }",
    ),
];

/// A look of a whole character over her anime look.
const SEED_SAN: &str = "\
[bangs]
soft_width_mm = 6
direction_deg = [-20, 30]
[eyes_through]
opacity = 0.7
[self_shadow]
side = 1024
[post]
tone = \"neutral\"
bloom = { strength = 0.5 }
[light]
direction_deg = [-35, 25]
coolness = 0.6
[role.hair-front]
sparkle = \"dust\"
[role.accessory]
glow = {}
inner_lines = { width_px = 2 }
[material.huku_bake]
stocking = \"opaque\"
dissolve = { amount = 0.2 }
decals = { map = \"map.png\", placed = [{ middle = [0.5, 0.5], size = [0.4, 0.4] }] }
[material.arm_plastic]
gem = \"ruby\"
[material.robo_face]
diamond = \"brilliant\"
[material.glass]
fire = \"blue\"
[material.backpack_plastic]
fluff = \"trim\"
[material.armgear_plastic]
shaped_highlight = { preset = \"window\", matcap_mix = 0.5 }
[material.body_bake]
face_paint = { map = \"map.png\", blush_strength = 0.5 }
light_response = { min = 0.3, max = 0.9 }
";

/// All views in the order of drawing, the longest first; and the models that are not there.
pub(super) fn all() -> (Vec<View>, Vec<PathBuf>) {
    let mut missing = Vec::new();
    let mut has = |file: &str| {
        let path = Path::new(MODELS).join(file);
        let found = path.is_file();
        if !found {
            missing.push(path.clone());
        }
        found.then(|| path.to_string_lossy().into_owned())
    };
    let sheet = |model: &str, options: &str| {
        view(&format!("sheet {} {options}", stem(model)), &format!("sheet {model} --panel 64 {options}"))
    };
    let seed_san = has("Seed-san_rebuilt.vrm");
    let gallery = |name: &str, command: &str| View { writes: Writes::Folder, ..view(name, command) };
    let mut views = vec![
        on_lavapipe(gallery("gallery", "gallery --panel 64")),
        View { only_on: Some("swiftshader"), ..gallery("gallery, a part", SHORT_GALLERY) },
        sheet("", "--look anime"),
    ];
    views.extend(BUILT_IN.map(|(options, slow)| {
        let view = render("", "200x200", options);
        if slow { on_lavapipe(view) } else { view }
    }));
    views.extend(channels("", "--view bust --yaw 15", ON_BOTH[0]));
    views.push(on_lavapipe(view("sdf preview", "sdf preview tools/character/face.sdf.toml --panel 64")));
    if let Some(model) = &seed_san {
        views.extend(["anime", "plain"].map(|look| sheet(model, &format!("--look {look}"))));
        views.extend(["light", "distance"].map(|s| on_lavapipe(sheet(model, &format!("--look anime --sweep {s}")))));
        views.push(sheet(model, "--look anime --sweep head"));
        views.extend(channels(model, "--yaw 15", ON_BOTH[1]));
        for options in ["--view full --yaw 20", "--view bust --yaw -150 --samples 1 --time 0.6"] {
            views.push(View { look: Some(SEED_SAN), ..render(model, "200x200", options) });
        }
    }
    for (file, list) in CHARACTERS {
        let Some(model) = has(file) else { continue };
        for options in list {
            views.extend(
                ["plain", "anime"].map(|look| render(&model, "200x200", format!("--look {look} {options}").trim())),
            );
        }
    }
    let mut spheres: Vec<String> = std::fs::read_dir(Path::new(MODELS).join("spheres"))
        .map(|entries| entries.flatten().filter_map(|e| e.file_name().into_string().ok()).collect())
        .unwrap_or_default();
    spheres.retain(|name| name.ends_with(".vrm"));
    spheres.sort();
    for model in spheres.iter().filter_map(|name| has(&format!("spheres/{name}"))) {
        views.push(render(&model, "160x160", "--look plain --view full --yaw 20 --light -40,30"));
        views.push(render(&model, "160x160", "--look anime --view full --yaw -30 --samples 1 --background none"));
    }
    if let Some(model) = has("spheres/mtoon_sphere_normalmap.vrm") {
        for (name, options, look) in SPHERE_LOOKS {
            let drawn = render(&model, "160x160", &format!("--view full {options}"));
            views.push(View { name: format!("sphere {name}"), look: Some(look), ..drawn });
        }
    }
    views.push(View { draws: false, ..view("sdf bake", "sdf bake tools/character/face.sdf.toml") });
    views.push(View { draws: false, writes: Writes::Folder, ..view("texture fur", "texture fur --size 256") });
    (views, missing)
}

/// A view of every channel.
fn channels(model: &str, options: &str, on_both: &[&str]) -> Vec<View> {
    let draw = |channel: &&str| {
        let view = render(model, "200x200", &format!("--look anime {options} --channel {channel}"));
        if on_both.contains(channel) {
            view
        } else {
            on_lavapipe(view)
        }
    };
    CHANNELS.iter().map(draw).collect()
}

fn on_lavapipe(view: View) -> View {
    View { only_on: Some("lavapipe"), ..view }
}

fn render(model: &str, size: &str, options: &str) -> View {
    view(&format!("{} {options}", stem(model)), &format!("render {model} --size {size} {options}"))
}

fn view(name: &str, command: &str) -> View {
    View {
        name: name.trim().to_owned(),
        args: command.split_whitespace().map(str::to_owned).collect(),
        look: None,
        writes: Writes::Picture,
        draws: true,
        only_on: None,
    }
}

fn stem(model: &str) -> &str {
    Path::new(model).file_stem().and_then(|s| s.to_str()).unwrap_or("hikage")
}
