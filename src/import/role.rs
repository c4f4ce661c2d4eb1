//! Guesses what each mesh part of a character is: from names in the conventions of English, Japanese and Chinese authors
//! and of VRoid Studio, then checked against bones and geometry, which do not lie.

#![allow(clippy::arithmetic_side_effects, reason = "float vectors cannot overflow; integers use checked methods")]

use std::collections::{BTreeMap, BTreeSet};

use glam::{Mat4, Vec3};

use crate::scene::{HumanBone, Mesh, Primitive, Role, Scene};

use super::vrm1::OFFSET_FROM_HEAD_M;

/// Words for a role: `whole` match a whole word of the name, `part` match anywhere in it.
struct Words {
    role: Role,
    whole: &'static [&'static str],
    part: &'static [&'static str],
}

/// In order of precedence: eyebrows hold the word eye, spectacles (眼鏡) the sign for it.
const WORDS: &[Words] = &[
    Words {
        role: Role::Lash,
        whole: &["lash", "lashes"],
        part: &[
            "eyelash",
            "eyeline",
            "eyeextra",
            "matuge",
            "matsuge",
            "まつげ",
            "まつ毛",
            "マツゲ",
            "睫",
            "アイライン",
        ],
    },
    Words {
        role: Role::Brow,
        whole: &["mayu", "brow", "brows"],
        part: &["facebrow", "eyebrow", "mayuge", "眉", "まゆ", "マユ"],
    },
    Words {
        role: Role::Accessory,
        whole: &[
            "hat", "cap", "helmet", "horn", "horns", "acc", "gear", "belt", "metal", "plastic", "halo", "crown",
            "tail", "wing", "wings",
        ],
        part: &[
            "glass", "megane", "眼鏡", "眼镜", "メガネ", "めがね", "earring", "accessor", "ribbon", "necklace",
            "backpack", "weapon", "sword", "headphone", "飾", "饰", "アクセ", "リボン", "帽", "耳环", "ピアス", "角",
        ],
    },
    Words {
        role: Role::EyeWhite,
        whole: &["sclera"],
        part: &["eyewhite", "eye_white", "whiteeye", "shirome", "sirome", "白目", "眼白"],
    },
    Words {
        role: Role::EyeHighlight,
        whole: &[],
        part: &[
            "eyehighlight",
            "eye_highlight",
            "eyehilight",
            "highlight_eye",
            "瞳孔高光",
            "目ハイライト",
            "目の光",
            "眼高光",
        ],
    },
    Words {
        role: Role::Eye,
        whole: &["eye", "eyes", "iris", "cornea", "pupil", "pupils", "hitomi"],
        part: &["eyeiris", "eyeball", "瞳", "目", "眼"],
    },
    Words {
        role: Role::Mouth,
        whole: &["mouth", "teeth", "tooth", "tongue", "kuchi", "kuti", "bero"],
        part: &["facemouth", "口", "舌", "歯", "齿", "牙"],
    },
    Words {
        role: Role::HairFront,
        whole: &["bang", "bangs", "fringe", "ahoge"],
        part: &[
            "hairfront",
            "fronthair",
            "hair_front",
            "front_hair",
            "maegami",
            "前髪",
            "前发",
            "前髮",
            "刘海",
            "瀏海",
            "アホ毛",
            "hairside",
            "sidehair",
            "hair_side",
            "side_hair",
            "yokogami",
            "横髪",
            "もみあげ",
            "鬓",
            "鬢",
        ],
    },
    Words {
        role: Role::Hair,
        whole: &["kami", "ponytail", "twintail", "braid"],
        part: &["hair", "髪", "髮", "头发", "ヘア"],
    },
    Words {
        role: Role::Face, whole: &["face", "kao"], part: &["face", "顔", "颜", "脸", "臉", "かお", "フェイス"]
    },
    Words {
        role: Role::Cloth,
        whole: &[
            "wear", "tops", "bottoms", "coat", "suit", "tie", "sock", "socks", "boots", "shoe", "shoes", "pants",
            "fuku", "huku", "kutu", "kutsu",
        ],
        part: &[
            "cloth",
            "dress",
            "skirt",
            "shirt",
            "jacket",
            "sleeve",
            "uniform",
            "onepiece",
            "apron",
            "costume",
            "fabric",
            "stocking",
            "glove",
            "sweater",
            "hoodie",
            "outfit",
            "服",
            "衣",
            "裙",
            "スカート",
            "靴",
            "鞋",
            "裤",
            "袖",
            "スーツ",
        ],
    },
    Words {
        role: Role::Skin,
        whole: &["skin", "body", "hada", "karada"],
        part: &["肌", "身体", "皮膚", "皮肤", "ボディ"],
    },
];

/// Lower-case words of a name; capitals after small letters start a word, as in `HairBack`.
fn words(name: &str) -> Vec<String> {
    let mut spaced = String::new();
    let mut small = false;
    for c in name.chars().take(200) {
        if small && c.is_uppercase() {
            spaced.push(' ');
        }
        small = c.is_lowercase() || c.is_numeric();
        spaced.push(c);
    }
    let lower = spaced.to_lowercase();
    let split = lower.split(|c: char| !c.is_alphanumeric());
    split.map(|w| w.trim_end_matches(|c: char| c.is_ascii_digit()).to_owned()).filter(|w| !w.is_empty()).collect()
}

/// The role that a name states.
pub(super) fn from_name(name: &str) -> Option<Role> {
    let words = words(name);
    let joined = name.chars().take(200).collect::<String>().to_lowercase();
    // VRoid Studio ends its material names with the kind of part.
    let vroid = joined.starts_with('n') && joined.contains("_00_");
    if vroid && joined.contains("_body_") && joined.contains("_skin") {
        return Some(Role::Skin);
    }
    if vroid && joined.contains("_cloth") {
        return Some(Role::Cloth);
    }
    let states = |w: &&Words| {
        w.part.iter().any(|p| joined.contains(p)) || words.iter().any(|word| w.whole.contains(&word.as_str()))
    };
    WORDS.iter().find(states).map(|w| w.role)
}

/// Where the head is, for judging geometry.
struct Head {
    /// Nodes of the head bone and everything below it.
    nodes: BTreeSet<usize>,
    /// Eye bones and everything below them.
    eyes: BTreeSet<usize>,
    /// Point between the eyes, world space.
    gaze: Vec3,
    /// Distance from the head bone to that point, metres.
    size: f32,
}

/// Fills the roles of all primitives.
pub(super) fn assign(scene: &mut Scene) {
    let world = scene.rest_world_from_nodes();
    let head = find_head(scene, &world);
    let driven = expression_targets(scene);
    // The first node of each mesh stands for it.
    let carriers: BTreeMap<usize, usize> =
        scene.nodes.iter().enumerate().rev().filter_map(|(i, n)| Some((n.mesh?, i))).collect();
    let mut roles: Vec<Vec<Role>> = Vec::new();
    for (index, mesh) in scene.meshes.iter().enumerate() {
        let carrier = carriers.get(&index).copied();
        let node_name = carrier.and_then(|c| scene.nodes.get(c)).map_or("", |n| n.name.as_str());
        let list = mesh.primitives.iter().map(|primitive| {
            let material = scene.materials.get(primitive.material).map_or("", |m| m.name.as_str());
            // The name of a mesh of many materials says little about each.
            let named = from_name(material).or_else(|| {
                let alone = mesh.primitives.len() == 1;
                alone.then(|| from_name(&mesh.name).or_else(|| from_name(node_name))).flatten()
            });
            let (Some(head), Some(carrier)) = (&head, carrier) else { return named.unwrap_or_default() };
            let is_driven =
                mesh.morph_names.iter().enumerate().any(|(t, _)| driven.contains(&(index, t)) && moves(primitive, t));
            judge(scene, &world, head, mesh, primitive, carrier, named, is_driven)
        });
        roles.push(list.collect());
    }
    for (mesh, roles) in scene.meshes.iter_mut().zip(roles) {
        for (primitive, role) in mesh.primitives.iter_mut().zip(roles) {
            primitive.role = role;
        }
    }
}

fn moves(primitive: &Primitive, target: usize) -> bool {
    primitive.morphs.get(target).is_some_and(|m| !m.vertices.is_empty())
}

/// Mesh and morph target of everything that expressions move.
fn expression_targets(scene: &Scene) -> BTreeSet<(usize, usize)> {
    let expressions = scene.character.iter().flat_map(|c| &c.expressions);
    let binds = expressions.flat_map(|e| &e.morphs);
    binds.filter_map(|b| Some((scene.nodes.get(b.node)?.mesh?, b.target))).collect()
}

fn find_head(scene: &Scene, world: &[Mat4]) -> Option<Head> {
    let node = scene.bone_node(HumanBone::Head)?;
    let eyes: Vec<usize> =
        [HumanBone::LeftEye, HumanBone::RightEye].iter().filter_map(|b| scene.bone_node(*b)).collect();
    let place = |n: usize| world.get(n).map(|m| m.w_axis.truncate());
    let origin = place(node)?;
    let offset = scene.character.as_ref()?.look_at.as_ref().map_or(Vec3::ZERO, |l| l.offset_from_head);
    let at_offset = world.get(node)?.transform_point3(offset);
    let is_far = offset.length() > 0.02;
    // What stands in for an offset that the file lacks tells nothing about this head; bones of eyes do.
    let is_said = is_far && offset.to_array() != OFFSET_FROM_HEAD_M;
    let gaze = match *eyes.iter().filter_map(|e| place(*e)).collect::<Vec<_>>() {
        [left, right] if !is_said => (left + right) * 0.5,
        _ if is_far => at_offset,
        _ => {
            let neck = scene.bone_node(HumanBone::Neck).and_then(place).map_or(0.1, |n| n.distance(origin));
            origin + Vec3::new(0.0, 0.8, 0.8) * neck
        }
    };
    let size = gaze.distance(origin).max(0.02);
    let of_eyes = eyes.iter().flat_map(|e| scene.descendants(*e)).collect();
    Some(Head { nodes: scene.descendants(node), eyes: of_eyes, gaze, size })
}

/// Share of a primitive's vertices that follow a set of nodes.
fn share(scene: &Scene, primitive: &Primitive, carrier: usize, set: &BTreeSet<usize>) -> f32 {
    let shares = scene.shares(carrier, primitive, set);
    shares.iter().sum::<f32>() / shares.len().max(1) as f32
}

#[allow(clippy::too_many_arguments, reason = "all of it is evidence, and there is one caller")]
fn judge(
    scene: &Scene,
    world: &[Mat4],
    head: &Head,
    mesh: &Mesh,
    primitive: &Primitive,
    carrier: usize,
    named: Option<Role>,
    is_driven: bool,
) -> Role {
    let on_head = share(scene, primitive, carrier, &head.nodes);
    match named {
        Some(Role::Eye | Role::EyeHighlight | Role::EyeWhite | Role::Lash | Role::Brow | Role::Mouth | Role::Face)
            if on_head < 0.3 =>
        {
            Role::Accessory
        }
        Some(Role::Hair | Role::HairFront) => {
            let front = in_front_of_face(scene, world, head, primitive, carrier);
            if named == Some(Role::HairFront) || front {
                Role::HairFront
            } else {
                Role::Hair
            }
        }
        Some(Role::Skin) if on_head > 0.6 && (is_driven || mesh.primitives.len() > 1) => Role::Face,
        Some(role) => role,
        None if !head.eyes.is_empty() && share(scene, primitive, carrier, &head.eyes) > 0.5 => Role::Eye,
        None if is_driven && on_head > 0.5 => Role::Face,
        None => Role::Other,
    }
}

/// Whether a good part of the primitive hangs before the face at its height.
fn in_front_of_face(scene: &Scene, world: &[Mat4], head: &Head, primitive: &Primitive, carrier: usize) -> bool {
    let matrix = scene.rest_placement(world, carrier);
    let before = primitive.positions.iter().filter(|p| {
        let at = (matrix.transform_point3(Vec3::from_array(**p)) - head.gaze) / head.size;
        at.z > -0.25 && at.y.abs() < 0.8 && at.x.abs() < 0.9
    });
    before.count().saturating_mul(20) > primitive.positions.len()
}
