//! The extensions `VRMC_vrm` and `VRMC_springBone` of VRM 1.0.

use serde_json::{Map, Value, json};

use crate::model::Model;

/// `VRMC_vrm`; parts follow the bones among the nodes, from `first_part`.
pub(crate) fn humanoid(model: &Model, first_part: usize) -> Value {
    let bones: Map<String, Value> = model
        .skeleton
        .bones
        .iter()
        .enumerate()
        .filter(|(_, bone)| bone.human)
        .map(|(i, bone)| (bone.name.clone(), json!({ "node": i })))
        .collect();
    let eyes = model.skeleton.place("leftEye") - model.skeleton.place("head");
    let range = json!({ "inputMaxValue": 90.0, "outputScale": 1.0 });
    json!({
        "specVersion": "1.0",
        "meta": {
            "name": "Hikage",
            "version": env!("CARGO_PKG_VERSION"),
            "authors": ["The Hikage developers"],
            "licenseUrl": "https://vrm.dev/licenses/1.0/",
            "otherLicenseUrl": "https://creativecommons.org/publicdomain/zero/1.0/",
            "avatarPermission": "everyone",
            "allowExcessivelyViolentUsage": true,
            "allowExcessivelySexualUsage": false,
            "commercialUsage": "corporation",
            "allowPoliticalOrReligiousUsage": true,
            "allowAntisocialOrHateUsage": false,
            "creditNotation": "unnecessary",
            "allowRedistribution": true,
            "modification": "allowModificationRedistribution",
        },
        "humanoid": { "humanBones": bones },
        "lookAt": {
            "type": "expression",
            "offsetFromHeadBone": [0.0, eyes.y, eyes.z],
            "rangeMapHorizontalInner": range, "rangeMapHorizontalOuter": range,
            "rangeMapVerticalDown": range, "rangeMapVerticalUp": range,
        },
        "firstPerson": {},
        "expressions": expressions(model, first_part),
    })
}

fn expressions(model: &Model, first_part: usize) -> Value {
    let (mut preset, mut custom) = (Map::new(), Map::new());
    for expression in &model.expressions {
        let mut binds = Vec::new();
        for (index, part) in model.parts.iter().enumerate() {
            for (target, morph) in part.morphs.iter().enumerate() {
                if let Some((_, weight)) = expression.morphs.iter().find(|(name, _)| *name == morph.name) {
                    binds.push(json!({ "node": first_part + index, "index": target, "weight": weight }));
                }
            }
        }
        let value = json!({
            "morphTargetBinds": binds,
            "isBinary": false,
            "overrideBlink": if expression.blocks_blink { "block" } else { "none" },
            "overrideLookAt": if expression.blends_look { "blend" } else { "none" },
            "overrideMouth": "none",
        });
        let list = if expression.preset { &mut preset } else { &mut custom };
        list.insert(expression.name.to_owned(), value);
    }
    let mut value = json!({ "preset": preset });
    if !custom.is_empty() {
        value["custom"] = Value::Object(custom);
    }
    value
}

/// `VRMC_springBone`.
pub(crate) fn spring_bone(model: &Model) -> Value {
    let colliders: Vec<Value> = model
        .colliders
        .iter()
        .map(|c| {
            let shape = match c.tail {
                Some(tail) => json!({ "capsule": {
                    "offset": c.offset.to_array(), "tail": tail.to_array(), "radius": c.radius
                } }),
                None => json!({ "sphere": { "offset": c.offset.to_array(), "radius": c.radius } }),
            };
            json!({ "node": c.bone, "shape": shape })
        })
        .collect();
    let mut names: Vec<&str> = model.colliders.iter().map(|c| c.group).collect();
    names.sort_unstable();
    names.dedup();
    let groups: Vec<Value> = names
        .iter()
        .map(|name| {
            let members: Vec<usize> =
                model.colliders.iter().enumerate().filter(|(_, c)| c.group == *name).map(|(i, _)| i).collect();
            json!({ "name": name, "colliders": members })
        })
        .collect();
    let springs: Vec<Value> = model
        .springs
        .iter()
        .map(|s| {
            let joints: Vec<Value> = s
                .joints
                .iter()
                .enumerate()
                .map(|(i, bone)| {
                    let [root, tip] = s.stiffness;
                    let stiffness = root + (tip - root) * i as f32 / (s.joints.len() - 1).max(1) as f32;
                    json!({
                        "node": bone, "hitRadius": s.radius, "stiffness": stiffness, "dragForce": s.drag,
                        "gravityPower": s.gravity, "gravityDir": [0.0, -1.0, 0.0],
                    })
                })
                .collect();
            let groups: Vec<usize> =
                s.colliders.iter().filter_map(|name| names.iter().position(|n| n == name)).collect();
            json!({ "name": s.name, "joints": joints, "colliderGroups": groups })
        })
        .collect();
    let mut value = json!({ "specVersion": "1.0" });
    for (key, list) in [("colliders", colliders), ("colliderGroups", groups), ("springs", springs)] {
        if !list.is_empty() {
            value[key] = Value::Array(list);
        }
    }
    value
}
