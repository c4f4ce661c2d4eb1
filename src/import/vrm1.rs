//! `VRMC_vrm` 1.0: meta, humanoid, expressions, look-at, first person. A fault in them never keeps the model from loading.

use std::collections::{BTreeMap, BTreeSet};

use glam::Vec3;

use crate::material::Material;
use crate::scene::{
    Character, ColorBind, ColorTarget, Expression, ExpressionOverride, FirstPerson, HumanBone, LookAt, Meta, MorphBind,
    RangeMap, UvBind,
};

use super::fault::quoted;
use super::graph::Graph;
use super::json::Json;
use super::warnings::Warnings;

/// What reading VRM data needs.
pub(super) struct Context<'a> {
    pub(super) graph: &'a Graph,
    /// Morph targets of each mesh.
    pub(super) targets: &'a [usize],
    /// Nodes that carry each mesh.
    pub(super) users: &'a [Vec<usize>],
    /// Names of the materials.
    pub(super) materials: &'a [String],
    /// The materials themselves.
    pub(super) made: &'a [Material],
}

/// Bones that VRM requires.
const REQUIRED: [HumanBone; 15] = [
    HumanBone::Hips,
    HumanBone::Spine,
    HumanBone::Head,
    HumanBone::LeftUpperLeg,
    HumanBone::LeftLowerLeg,
    HumanBone::LeftFoot,
    HumanBone::RightUpperLeg,
    HumanBone::RightLowerLeg,
    HumanBone::RightFoot,
    HumanBone::LeftUpperArm,
    HumanBone::LeftLowerArm,
    HumanBone::LeftHand,
    HumanBone::RightUpperArm,
    HumanBone::RightLowerArm,
    HumanBone::RightHand,
];

/// Presets of VRM 1.0.
pub(super) const PRESETS: [&str; 18] = [
    "happy", "angry", "sad", "relaxed", "surprised", "aa", "ih", "ou", "ee", "oh", "blink", "blinkLeft", "blinkRight",
    "lookUp", "lookDown", "lookLeft", "lookRight", "neutral",
];

/// Reads the extension.
pub(super) fn read(ext: &Json, cx: &Context, warnings: &mut Warnings) -> Character {
    let mut character = Character { vrm_version: "1.0".into(), meta: meta(&ext.at("meta")), ..Character::default() };
    let version = ext.text("specVersion");
    if !matches!(version, "1.0" | "1.0-beta" | "") {
        warnings.add(ext.pointer(), format!("unknown VRM specVersion {}: read as 1.0", quoted(version)));
    }
    for (name, bone) in ext.at("humanoid").at("humanBones").entries().unwrap_or_default() {
        match (HumanBone::from_name(name), cx.graph.maybe_node(&bone, "node")) {
            (Some(human), Some(node)) => {
                character.bones.insert(human, node);
            }
            _ => warnings.add(bone.pointer(), "unknown humanoid bone or node: skipped"),
        }
    }
    check_bones(&character.bones, ext.pointer(), cx.graph, warnings);
    let expressions = ext.at("expressions");
    for (group, preset) in [("preset", true), ("custom", false)] {
        for (name, json) in expressions.at(group).entries().unwrap_or_default() {
            if preset && !PRESETS.contains(&name) {
                warnings.add(json.pointer(), format!("unknown preset expression {}", quoted(name)));
            }
            character.expressions.push(expression(name, preset, &json, cx, warnings));
        }
    }
    character.look_at = ext.at("lookAt").is_object().then(|| look_at(&ext.at("lookAt")));
    for json in ext.at("firstPerson").list("meshAnnotations") {
        let Some(node) = cx.graph.maybe_node(&json, "node") else {
            warnings.add(json.pointer(), "first-person annotation of an unknown node: skipped");
            continue;
        };
        character.first_person.insert(node, first_person(json.text("type")));
    }
    character
}

/// Says which required bones are missing, shared, or not below the hips.
pub(super) fn check_bones(bones: &BTreeMap<HumanBone, usize>, pointer: &str, graph: &Graph, warnings: &mut Warnings) {
    let missing: Vec<&str> = REQUIRED.iter().filter(|b| !bones.contains_key(b)).map(|b| b.name()).collect();
    if !missing.is_empty() {
        warnings.add(pointer, format!("required humanoid bones are missing: {}", missing.join(", ")));
    }
    let nodes: BTreeSet<usize> = bones.values().copied().collect();
    if nodes.len() < bones.len() {
        warnings.add(pointer, "several humanoid bones share one node");
    }
    if let Some(hips) = bones.get(&HumanBone::Hips)
        && let Some((bone, _)) = bones.iter().find(|(_, node)| *node != hips && !graph.is_below(*hips, **node))
    {
        warnings.add(pointer, format!("humanoid bone {} is not below the hips", bone.name()));
    }
}

fn meta(json: &Json) -> Meta {
    let text = |key: &str| json.text(key).to_owned();
    let list = |key: &str| json.list(key).iter().filter_map(|v| v.as_str().ok()).map(str::to_owned).collect();
    const READ: [&str; 9] = [
        "name",
        "version",
        "authors",
        "copyrightInformation",
        "contactInformation",
        "references",
        "licenseUrl",
        "thumbnailImage",
        "thirdPartyLicenses",
    ];
    let rest = json.entries().unwrap_or_default().into_iter().filter(|(key, _)| !READ.contains(key));
    Meta {
        name: text("name"),
        version: text("version"),
        authors: list("authors"),
        copyright: text("copyrightInformation"),
        contact: text("contactInformation"),
        references: list("references"),
        license: text("licenseUrl"),
        permissions: rest.filter_map(|(key, value)| Some((key.to_owned(), value.display()?))).collect(),
    }
}

/// Expressions that act on the lids, the gaze and the mouth.
const LIDS: [&str; 3] = ["blink", "blinkLeft", "blinkRight"];
pub(super) const GAZE: [&str; 4] = ["lookUp", "lookDown", "lookLeft", "lookRight"];
const MOUTH: [&str; 5] = ["aa", "ih", "ou", "ee", "oh"];

/// What an expression does to a group; one of that group itself may do nothing to it.
fn change(name: &str, json: &Json, key: &str, group: &[&str], warnings: &mut Warnings) -> ExpressionOverride {
    let change = match json.text(key) {
        "block" => ExpressionOverride::Block,
        "blend" => ExpressionOverride::Blend,
        _ => return ExpressionOverride::None,
    };
    if !group.contains(&name) {
        return change;
    }
    warnings.add(json.pointer(), format!("{key} of expression {name} is for other kinds of expressions: ignored"));
    ExpressionOverride::None
}

fn expression(name: &str, preset: bool, json: &Json, cx: &Context, warnings: &mut Warnings) -> Expression {
    let mut change = |key: &str, group: &[&str]| change(name, json, key, group, warnings);
    let mut out = Expression {
        name: name.chars().take(1000).collect(),
        preset,
        is_binary: json.flag("isBinary"),
        override_blink: change("overrideBlink", &LIDS),
        override_look_at: change("overrideLookAt", &GAZE),
        override_mouth: change("overrideMouth", &MOUTH),
        ..Expression::default()
    };
    for bind in json.list("morphTargetBinds") {
        let node = cx.graph.maybe_node(&bind, "node");
        let targets = node.map_or(0, |n| node_targets(cx, n));
        match (node, bind.maybe_index("index", targets)) {
            (Some(node), Some(target)) => {
                out.morphs.push(MorphBind { node, target, weight: bind_weight(&bind, 1.0, warnings) })
            }
            _ => warnings.add(bind.pointer(), "expression drives a morph target that does not exist: bind skipped"),
        }
    }
    for bind in json.list("materialColorBinds") {
        let target = match bind.text("type") {
            "color" => Some(ColorTarget::Color),
            "emissionColor" => Some(ColorTarget::EmissionColor),
            "shadeColor" => Some(ColorTarget::ShadeColor),
            "matcapColor" => Some(ColorTarget::MatcapColor),
            "rimColor" => Some(ColorTarget::RimColor),
            "outlineColor" => Some(ColorTarget::OutlineColor),
            _ => None,
        };
        match (bind.maybe_index("material", cx.materials.len()), target) {
            (Some(material), Some(target)) => {
                out.colors.push(ColorBind { material, target, value: bind.floats_or("targetValue", [1.0; 4]) });
            }
            _ => warnings.add(bind.pointer(), "expression drives an unknown material or colour: bind skipped"),
        }
    }
    for bind in json.list("textureTransformBinds") {
        match bind.maybe_index("material", cx.materials.len()) {
            Some(material) => out.uv_transforms.push(UvBind {
                material,
                scale: bind.floats_or("scale", [1.0; 2]),
                offset: bind.floats_or("offset", [0.0; 2]),
            }),
            None => warnings.add(bind.pointer(), "expression moves the UVs of an unknown material: bind skipped"),
        }
    }
    out
}

/// Largest weight of a morph under an expression: the specification's is 1, files that exaggerate have a few.
const MOST_WEIGHT: f32 = 100.0;

/// Weight of a morph under an expression, written in parts of `whole`.
pub(super) fn bind_weight(bind: &Json, whole: f32, warnings: &mut Warnings) -> f32 {
    let weight = bind.f32_or("weight", whole) / whole;
    if weight.abs() > MOST_WEIGHT {
        warnings.add(bind.pointer(), format!("weight of a morph is far beyond 1: taken as {MOST_WEIGHT}"));
    }
    weight.clamp(-MOST_WEIGHT, MOST_WEIGHT)
}

/// How many morph targets the mesh of a node has.
pub(super) fn node_targets(cx: &Context, node: usize) -> usize {
    let mesh = cx.graph.nodes.get(node).and_then(|n| n.mesh);
    mesh.and_then(|m| cx.targets.get(m)).copied().unwrap_or(0)
}

/// Reads the name of a first-person flag; VRM 0.x capitalises it.
pub(super) fn first_person(name: &str) -> FirstPerson {
    match name {
        "both" | "Both" => FirstPerson::Both,
        "thirdPersonOnly" | "ThirdPersonOnly" => FirstPerson::ThirdPersonOnly,
        "firstPersonOnly" | "FirstPersonOnly" => FirstPerson::FirstPersonOnly,
        _ => FirstPerson::Auto,
    }
}

/// Where the gaze starts in files that do not say it, as three-vrm has it: between the eyes, metres.
pub(super) const OFFSET_FROM_HEAD_M: [f32; 3] = [0.0, 0.06, 0.0];

fn look_at(json: &Json) -> LookAt {
    let uses_bones = json.text("type") != "expression";
    let map = |key: &str| range_map(&json.at(key), "inputMaxValue", "outputScale", uses_bones);
    LookAt {
        offset_from_head: Vec3::from_array(json.floats_or("offsetFromHeadBone", OFFSET_FROM_HEAD_M)),
        uses_bones,
        horizontal_inner: map("rangeMapHorizontalInner"),
        horizontal_outer: map("rangeMapHorizontalOuter"),
        vertical_down: map("rangeMapVerticalDown"),
        vertical_up: map("rangeMapVerticalUp"),
    }
}

/// The straight map; degrees to radians. The output is an angle only where bones turn.
pub(super) fn range_map(json: &Json, input: &str, output: &str, uses_bones: bool) -> RangeMap {
    let output_scale = json.f32_or(output, if uses_bones { 10.0 } else { 1.0 });
    RangeMap {
        input_max_rad: json.f32_or(input, 90.0).max(0.0).to_radians(),
        output_scale: if uses_bones {
            output_scale.to_radians()
        } else {
            output_scale
        },
        curve: Vec::new(),
    }
}
