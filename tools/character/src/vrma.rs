//! Writes a clip as a VRM Animation file (`VRMC_vrm_animation` 1.0).

use glam::Quat;
use serde_json::{Map, Value, json};

use crate::animation::Animation;
use crate::clips::Clip;
use crate::glb::{Binary, container};
use crate::skeleton::Skeleton;

/// Bytes of `NAME.vrma`: the humanoid at rest, a node for each expression (its weight is the node's x) and one for the
/// gaze (its rotation).
#[must_use]
pub fn write(clip: &Clip) -> Vec<u8> {
    let skeleton = Skeleton::humanoid();
    let mut binary = Binary::default();
    let mut nodes: Vec<Value> = skeleton.nodes();
    let mut roots = vec![0];
    let mut animation =
        Animation::of_bones(&mut binary, clip, |name| skeleton.bones.iter().position(|b| b.name == name));
    let mut node = |name: &str| {
        nodes.push(json!({ "name": name }));
        roots.push(nodes.len() - 1);
        nodes.len() - 1
    };

    let mut presets = Map::new();
    for (name, track) in &clip.expressions {
        let index = node(name);
        animation.add(&mut binary, index, "translation", track, |weight| [weight, 0.0, 0.0]);
        presets.insert((*name).to_owned(), json!({ "node": index }));
    }
    // Eyes are moved by the gaze alone.
    let bones: Map<String, Value> = skeleton
        .bones
        .iter()
        .enumerate()
        .filter(|(_, bone)| bone.human && !bone.name.ends_with("Eye"))
        .map(|(i, bone)| (bone.name.clone(), json!({ "node": i })))
        .collect();
    let mut extension = json!({ "specVersion": "1.0", "humanoid": { "humanBones": bones } });
    if !presets.is_empty() {
        extension["expressions"] = json!({ "preset": presets });
    }
    if !clip.gaze.is_empty() {
        let index = node("lookAt");
        animation.add(&mut binary, index, "rotation", &clip.gaze, |gaze| direction(gaze).to_array());
        let eyes = skeleton.place("leftEye") - skeleton.place("head");
        extension["lookAt"] = json!({ "node": index, "offsetFromHeadBone": [0.0, eyes.y, eyes.z] });
    }

    let document = json!({
        "asset": {
            "version": "2.0",
            "generator": concat!("hikage-character ", env!("CARGO_PKG_VERSION")),
            "copyright": "CC0 1.0",
        },
        "extensionsUsed": ["VRMC_vrm_animation"],
        "scene": 0,
        "scenes": [{ "name": clip.name, "nodes": roots }],
        "nodes": nodes,
        "animations": [animation.value(clip.name)],
        "extensions": { "VRMC_vrm_animation": extension },
    });
    container(document, binary)
}

/// Rotation of the node of a gaze.
fn direction([yaw, pitch]: [f32; 2]) -> Quat {
    Quat::from_rotation_y(yaw.to_radians()) * Quat::from_rotation_x(pitch.to_radians())
}
