//! `VRMC_vrm_animation` 1.0: which nodes of the file stand for bones, expressions and the gaze. A fault in it never keeps
//! the file from loading.

use std::collections::{BTreeMap, BTreeSet};

use crate::scene::{AnimationRig, HumanBone};

use super::fault::quoted;
use super::graph::Graph;
use super::json::Json;
use super::vrm1::{GAZE, PRESETS};
use super::warnings::Warnings;

/// Reads the extension of the file's root; `None` where there is none.
pub(super) fn read(root: &Json, graph: &Graph, warnings: &mut Warnings) -> Option<AnimationRig> {
    let ext = root.at("extensions").get("VRMC_vrm_animation")?;
    if !ext.is_object() {
        warnings.add(ext.pointer(), "VRMC_vrm_animation is not an object: skipped");
        return None;
    }
    let version = ext.text("specVersion");
    if !matches!(version, "1.0" | "1.0-draft" | "") {
        warnings.add(ext.pointer(), format!("unknown VRMC_vrm_animation specVersion {}: read as 1.0", quoted(version)));
    }
    let look_at = ext.get("lookAt").and_then(|json| {
        let node = graph.maybe_node(&json, "node");
        if node.is_none() {
            warnings.add(json.pointer(), "gaze on an unknown node: skipped");
        }
        node
    });
    Some(AnimationRig {
        bones: bones(&ext.at("humanoid").at("humanBones"), graph, warnings),
        expressions: expressions(&ext.at("expressions"), graph, warnings),
        look_at,
    })
}

fn bones(json: &Json, graph: &Graph, warnings: &mut Warnings) -> BTreeMap<HumanBone, usize> {
    let mut out = BTreeMap::new();
    for (name, bone) in entries(json, "humanBones", warnings) {
        match (HumanBone::from_name(name), graph.maybe_node(&bone, "node")) {
            (Some(human @ (HumanBone::LeftEye | HumanBone::RightEye)), _) => warnings
                .add(bone.pointer(), format!("track of bone {}, whose movement is the gaze's: skipped", human.name())),
            (Some(human), Some(node)) => {
                out.insert(human, node);
            }
            _ => warnings.add(bone.pointer(), "unknown humanoid bone or node: skipped"),
        }
    }
    if !out.is_empty() && !out.contains_key(&HumanBone::Hips) {
        warnings.add(json.pointer(), "required humanoid bones are missing: hips");
    }
    let nodes: BTreeSet<usize> = out.values().copied().collect();
    if nodes.len() < out.len() {
        warnings.add(json.pointer(), "several humanoid bones share one node");
    }
    out
}

fn expressions(json: &Json, graph: &Graph, warnings: &mut Warnings) -> Vec<(String, usize)> {
    let mut out = Vec::new();
    let mut known: BTreeSet<&str> = BTreeSet::new();
    for (group, preset) in [("preset", true), ("custom", false)] {
        for (name, track) in entries(&json.at(group), group, warnings) {
            if GAZE.contains(&name) {
                warnings.add(
                    track.pointer(),
                    format!("track of expression {}, whose movement is the gaze's: skipped", quoted(name)),
                );
                continue;
            }
            let Some(node) = graph.maybe_node(&track, "node") else {
                warnings.add(track.pointer(), "expression on an unknown node: skipped");
                continue;
            };
            if preset && !PRESETS.contains(&name) {
                warnings.add(track.pointer(), format!("unknown preset expression {}", quoted(name)));
            }
            if known.insert(name) {
                out.push((name.chars().take(1000).collect(), node));
            } else {
                let name = quoted(name);
                warnings.add(track.pointer(), format!("expression {name} is given twice: the first is kept"));
            }
        }
    }
    out
}

/// Entries of an object that may be missing; a warning where it is something else.
fn entries<'a>(json: &Json<'a>, what: &str, warnings: &mut Warnings) -> Vec<(&'a str, Json<'a>)> {
    if !json.is_object() && !json.is_null() {
        warnings.add(json.pointer(), format!("{what} is not an object: skipped"));
    }
    json.entries().unwrap_or_default()
}
