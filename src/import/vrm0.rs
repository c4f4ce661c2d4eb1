//! The `VRM` extension of VRM 0.x, converted to the terms of 1.0.

use std::collections::BTreeMap;

use glam::{Quat, Vec3};

use crate::color::linear_from_srgb;
use crate::scene::{
    Character, Collider, ColliderShape, ColorBind, ColorTarget, CurveKey, Expression, HumanBone, LookAt, Meta,
    MorphBind, Node, RangeMap, Spring, SpringJoint, Transform, UvBind,
};

use super::fault::Limits;
use super::json::Json;
use super::mtoon0::linear_from_emission;
use super::spring::colliders_of;
use super::vrm1::{Context, bind_weight, check_bones, first_person, node_targets, range_map};
use super::warnings::Warnings;

/// Reads the extension.
pub(super) fn read(ext: &Json, cx: &Context, limits: &Limits, warnings: &mut Warnings) -> Character {
    let mut character = Character { vrm_version: "0.x".into(), meta: meta(&ext.at("meta")), ..Character::default() };
    for json in ext.at("humanoid").list("humanBones") {
        match (bone(json.text("bone")), cx.graph.maybe_node(&json, "node")) {
            (Some(bone), Some(node)) => {
                if character.bones.contains_key(&bone) {
                    warnings.add(
                        json.pointer(),
                        format!("humanoid bone {} is given twice: the first is kept", bone.name()),
                    );
                }
                character.bones.entry(bone).or_insert(node);
            }
            _ => warnings.add(json.pointer(), "unknown humanoid bone or node: skipped"),
        }
    }
    check_bones(&character.bones, ext.pointer(), cx.graph, warnings);
    let mut materials: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (index, name) in cx.materials.iter().enumerate() {
        materials.entry(name).or_default().push(index);
    }
    let mut left = limits.nodes.saturating_mul(10);
    for json in ext.at("blendShapeMaster").list("blendShapeGroups") {
        character.expressions.push(expression(&json, cx, &materials, &mut left, warnings));
    }
    let person = ext.at("firstPerson");
    character.look_at = person.is_object().then(|| look_at(&person, warnings));
    for json in person.list("meshAnnotations") {
        for node in nodes_of_mesh(&json, cx) {
            character.first_person.insert(*node, first_person(json.text("firstPersonFlag")));
        }
    }
    character
}

/// Bones whose names changed, and those that did not.
fn bone(name: &str) -> Option<HumanBone> {
    HumanBone::from_name(match name {
        "leftThumbProximal" => "leftThumbMetacarpal",
        "leftThumbIntermediate" => "leftThumbProximal",
        "rightThumbProximal" => "rightThumbMetacarpal",
        "rightThumbIntermediate" => "rightThumbProximal",
        other => other,
    })
}

fn meta(json: &Json) -> Meta {
    let text = |key: &str| json.text(key).to_owned();
    let some = |key: &str| Some(text(key)).filter(|t| !t.is_empty()).into_iter().collect();
    const READ: [&str; 7] = ["title", "version", "author", "contactInformation", "reference", "licenseName", "texture"];
    let rest = json.entries().unwrap_or_default().into_iter().filter(|(key, _)| !READ.contains(key));
    Meta {
        name: text("title"),
        version: text("version"),
        authors: some("author"),
        copyright: String::new(),
        contact: text("contactInformation"),
        references: some("reference"),
        license: text("licenseName"),
        permissions: rest.filter_map(|(key, value)| Some((key.to_owned(), value.display()?))).collect(),
    }
}

/// Nodes that carry the mesh of an entry: VRM 0.x refers to meshes, 1.0 to nodes.
fn nodes_of_mesh<'a>(json: &Json, cx: &Context<'a>) -> &'a [usize] {
    let mesh = json.maybe_index("mesh", cx.users.len());
    mesh.and_then(|m| cx.users.get(m)).map_or(&[], Vec::as_slice)
}

/// VRM 1.0's name of a preset.
fn preset(name: &str) -> Option<&'static str> {
    Some(match name.to_ascii_lowercase().as_str() {
        "neutral" => "neutral",
        "a" => "aa",
        "i" => "ih",
        "u" => "ou",
        "e" => "ee",
        "o" => "oh",
        "blink" => "blink",
        "blink_l" => "blinkLeft",
        "blink_r" => "blinkRight",
        "joy" => "happy",
        "angry" => "angry",
        "sorrow" => "sad",
        "fun" => "relaxed",
        "lookup" => "lookUp",
        "lookdown" => "lookDown",
        "lookleft" => "lookLeft",
        "lookright" => "lookRight",
        _ => return None,
    })
}

fn expression(
    json: &Json,
    cx: &Context,
    materials: &BTreeMap<&str, Vec<usize>>,
    left: &mut u64,
    warnings: &mut Warnings,
) -> Expression {
    let preset = preset(json.text("presetName"));
    let name = preset.map_or_else(|| json.text("name").chars().take(1000).collect(), str::to_owned);
    let mut out =
        Expression { name, preset: preset.is_some(), is_binary: json.flag("isBinary"), ..Expression::default() };
    for bind in json.list("binds") {
        let before = out.morphs.len();
        for &node in nodes_of_mesh(&bind, cx) {
            // One entry counts for every node of the mesh, so a small file could ask for any number.
            *left = left.saturating_sub(1);
            if *left == 0 {
                warnings.add(bind.pointer(), "too many binds of expressions: the rest is left out");
                return out;
            }
            if let Some(target) = bind.maybe_index("index", node_targets(cx, node)) {
                out.morphs.push(MorphBind { node, target, weight: bind_weight(&bind, 100.0, warnings) });
            }
        }
        if out.morphs.len() == before {
            warnings.add(bind.pointer(), "expression drives a morph target that does not exist: bind skipped");
        }
    }
    for value in json.list("materialValues") {
        let mut known = false;
        for material in materials.get(value.text("materialName")).into_iter().flatten() {
            *left = left.saturating_sub(1);
            known |= *left > 0 && material_value(*material, &value, cx, &mut out);
        }
        if !known {
            warnings.add(value.pointer(), "expression drives an unknown material or property: bind skipped");
        }
    }
    out
}

/// Scale and offset of a material's own UVs.
fn own_uvs(material: usize, cx: &Context) -> ([f32; 2], [f32; 2]) {
    let texture = cx.made.get(material).and_then(|m| m.base.texture);
    texture.map_or(([1.0; 2], [0.0; 2]), |t| (t.transform.scale, t.transform.offset))
}

fn material_value(material: usize, json: &Json, cx: &Context, out: &mut Expression) -> bool {
    let mut value = [0.0f32; 4];
    for (slot, item) in value.iter_mut().zip(json.list("targetValue")) {
        *slot = item.as_f32().unwrap_or(0.0);
    }
    let [x, y, z, w] = value;
    let property = json.text("propertyName");
    let target = match property {
        "_Color" => ColorTarget::Color,
        "_EmissionColor" => ColorTarget::EmissionColor,
        "_ShadeColor" => ColorTarget::ShadeColor,
        "_RimColor" => ColorTarget::RimColor,
        "_OutlineColor" => ColorTarget::OutlineColor,
        // Unity's v starts at the bottom. The other two move along one axis only, and leave the other as the material has it.
        "_MainTex_ST" => {
            out.uv_transforms.push(UvBind { material, scale: [x, y], offset: [z, 1.0 - w - y] });
            return true;
        }
        "_MainTex_ST_S" => {
            let ([_, scale], [_, offset]) = own_uvs(material, cx);
            out.uv_transforms.push(UvBind { material, scale: [x, scale], offset: [z, offset] });
            return true;
        }
        "_MainTex_ST_T" => {
            let ([scale, _], [offset, _]) = own_uvs(material, cx);
            out.uv_transforms.push(UvBind { material, scale: [scale, y], offset: [offset, 1.0 - w - y] });
            return true;
        }
        _ => return false,
    };
    // As in the materials: all are sRGB, emission may be over 1.
    let decode = if target == ColorTarget::EmissionColor {
        linear_from_emission
    } else {
        linear_from_srgb
    };
    let [r, g, b] = [x, y, z].map(|c| decode(c.max(0.0)).min(f32::MAX));
    out.colors.push(ColorBind { material, target, value: [r, g, b, w] });
    true
}

fn vector(json: &Json) -> Vec3 {
    Vec3::new(json.f32_or("x", 0.0), json.f32_or("y", 0.0), json.f32_or("z", 0.0))
}

fn look_at(json: &Json, warnings: &mut Warnings) -> LookAt {
    let uses_bones = json.text("lookAtTypeName") != "BlendShape";
    let mut map = |key: &str| {
        let json = json.at(key);
        let curve = curve(&json, warnings);
        RangeMap { curve, ..range_map(&json, "xRange", "yRange", uses_bones) }
    };
    let offset = vector(&json.at("firstPersonBoneOffset"));
    LookAt {
        // Unity is left-handed.
        offset_from_head: Vec3::new(offset.x, offset.y, -offset.z),
        uses_bones,
        horizontal_inner: map("lookAtHorizontalInner"),
        horizontal_outer: map("lookAtHorizontalOuter"),
        vertical_down: map("lookAtVerticalDown"),
        vertical_up: map("lookAtVerticalUp"),
    }
}

/// The curve that every exporter writes: the angle's own share.
const STRAIGHT: [f32; 8] = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 0.0];

/// Keys of a gaze curve; none where it is straight or of no use.
fn curve(map: &Json, warnings: &mut Warnings) -> Vec<CurveKey> {
    let json = map.at("curve");
    if json.is_null() {
        return Vec::new();
    }
    curve_keys(&json).unwrap_or_else(|| {
        let message = "curve of the gaze is no list of keys of four numbers in order of time: taken as straight";
        warnings.add(json.pointer(), message);
        Vec::new()
    })
}

fn curve_keys(json: &Json) -> Option<Vec<CurveKey>> {
    let numbers = json.items().ok()?.iter().map(|n| n.as_f32().ok()).collect::<Option<Vec<f32>>>()?;
    if numbers == STRAIGHT {
        return Some(Vec::new());
    }
    let (groups, rest) = numbers.as_chunks::<4>();
    let key = |&[time, value, in_tangent, out_tangent]: &[f32; 4]| CurveKey { time, value, in_tangent, out_tangent };
    let keys: Vec<CurveKey> = groups.iter().map(key).collect();
    (rest.is_empty() && keys.is_sorted_by(|a, b| a.time < b.time)).then_some(keys)
}

/// Length of the tail that VRM 0.x imagines behind the last bone of a chain, metres.
const TAIL_M: f32 = 0.07;

/// Reads colliders and springs. Chains follow first children; each further child starts a chain of its own. The imagined
/// tail of VRM 0.x becomes a node.
pub(super) fn read_springs(
    ext: &Json,
    cx: &Context,
    nodes: &mut Vec<Node>,
    character: &mut Character,
    limits: &Limits,
    warnings: &mut Warnings,
) {
    let json = ext.at("secondaryAnimation");
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for group in json.list("colliderGroups") {
        let mut list = Vec::new();
        if let Some(node) = cx.graph.maybe_node(&group, "node") {
            for collider in group.list("colliders") {
                let offset = vector(&collider.at("offset"));
                let offset = Vec3::new(offset.x, offset.y, -offset.z);
                list.push(character.colliders.len());
                let shape =
                    ColliderShape::Sphere { offset, radius: collider.f32_or("radius", 0.0).max(0.0), inside: false };
                character.colliders.push(Collider { node, shape });
            }
        } else {
            warnings.add(group.pointer(), "collider group on an unknown node: skipped");
        }
        groups.push(list);
    }
    let children = children(nodes);
    let mut taken = vec![false; nodes.len()];
    let mut tails = BTreeMap::new();
    // References to colliders are copied for each chain, so their number needs a bound.
    let mut references = limits.nodes.saturating_mul(10);
    for group in json.list("boneGroups") {
        let colliders = colliders_of(&group, &groups, &mut references);
        let gravity = group.get("gravityDir").map_or(Vec3::NEG_Y, |dir| vector(&dir));
        let joint = SpringJoint {
            node: 0,
            hit_radius: group.f32_or("hitRadius", 0.0).max(0.0),
            // The misspelling is the specification's.
            stiffness: group.f32_or("stiffiness", 1.0).max(0.0),
            gravity_power: group.f32_or("gravityPower", 0.0),
            // Unity's world to ours, in which the character faces +Z as well.
            gravity_dir: Vec3::new(-gravity.x, gravity.y, gravity.z),
            drag: group.f32_or("dragForce", 0.5).clamp(0.0, 1.0),
        };
        let spring = Spring {
            name: group.text("comment").chars().take(1000).collect(),
            joints: Vec::new(),
            center: cx.graph.maybe_node(&group, "center"),
            colliders,
        };
        for root in group.list("bones") {
            let Some(root) = root.as_index(cx.graph.from_gltf.len(), "").ok().and_then(|i| cx.graph.node(i)) else {
                warnings.add(root.pointer(), "spring bone on an unknown node: skipped");
                continue;
            };
            for chain in chains(root, &children, &mut taken) {
                references = references.saturating_sub(spring.colliders.len() as u64);
                if references == 0 {
                    warnings.add(json.pointer(), "too many spring chains and colliders: the rest is left out");
                    return;
                }
                let mut joints: Vec<SpringJoint> =
                    chain.iter().map(|node| SpringJoint { node: *node, ..joint }).collect();
                if let Some(tail) = chain.last().and_then(|last| tail_of(*last, nodes, &mut tails)) {
                    joints.push(SpringJoint { node: tail, ..joint });
                }
                character.springs.push(Spring { joints, ..spring.clone() });
            }
        }
    }
}

fn children(nodes: &[Node]) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        if let Some(list) = node.parent.and_then(|p| children.get_mut(p)) {
            list.push(index);
        }
    }
    children
}

/// Chains below a root; nodes that swing already are left out.
fn chains(root: usize, children: &[Vec<usize>], taken: &mut [bool]) -> Vec<Vec<usize>> {
    let mut out = Vec::new();
    let mut starts = vec![root];
    while let Some(start) = starts.pop() {
        let mut chain = Vec::new();
        let mut next = Some(start);
        while let Some(node) = next {
            match taken.get_mut(node) {
                Some(slot) if !*slot => *slot = true,
                _ => break,
            }
            chain.push(node);
            let mut below = children.get(node).into_iter().flatten().copied();
            next = below.next();
            starts.extend(below);
        }
        if !chain.is_empty() {
            out.push(chain);
        }
    }
    out
}

/// The node that stands for the tail behind a leaf, made on first use.
#[allow(clippy::arithmetic_side_effects, reason = "float vectors cannot overflow")]
fn tail_of(leaf: usize, nodes: &mut Vec<Node>, tails: &mut BTreeMap<usize, usize>) -> Option<usize> {
    if let Some(known) = tails.get(&leaf) {
        return Some(*known);
    }
    let node = nodes.get(leaf)?;
    let rotation: Quat = node.transform.rotation;
    let along = rotation.inverse() * node.transform.translation.try_normalize()?;
    let tail = Node {
        name: format!("{} (tail)", node.name),
        parent: Some(leaf),
        transform: Transform { translation: along * TAIL_M, ..Transform::default() },
        ..Node::default()
    };
    nodes.push(tail);
    let index = nodes.len().saturating_sub(1);
    tails.insert(leaf, index);
    Some(index)
}
