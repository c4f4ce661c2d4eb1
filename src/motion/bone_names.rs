//! Humanoid bones by the names that tools and asset packs give them, where a file does not say which they are.

use std::collections::BTreeMap;

use crate::scene::{HumanBone, Scene};

/// Humanoid bones of a scene: as its file says (VRM, VRMA), else by the names of its nodes. Empty where neither tells: at least
/// hips, head, and upper parts of both arms and legs must be there.
pub(crate) fn bones_of(scene: &Scene) -> BTreeMap<HumanBone, usize> {
    if let Some(rig) = &scene.animation_rig {
        return rig.bones.clone();
    }
    match &scene.character {
        Some(character) if !character.bones.is_empty() => character.bones.clone(),
        _ => by_names(scene),
    }
}

fn by_names(scene: &Scene) -> BTreeMap<HumanBone, usize> {
    use HumanBone::{Chest, Head, Hips, LeftUpperArm, LeftUpperLeg, RightUpperArm, RightUpperLeg, Spine, UpperChest};
    let mut bones = BTreeMap::new();
    let mut spines = Vec::new();
    for (node, name) in scene.nodes.iter().map(|n| n.name.as_str()).enumerate() {
        match part(name) {
            Some(Part::Bone(bone)) => {
                bones.entry(bone).or_insert(node);
            }
            Some(Part::Spine) => spines.push(node),
            None => {}
        }
    }
    // Spines by their order from the hips, however they are numbered; the first, the middle and the last of many.
    if bones.contains_key(&Chest) {
        spines.truncate(1);
    } else if spines.len() > 3 {
        spines = vec![spines[0], spines[spines.len() / 2], spines[spines.len() - 1]];
    }
    for (bone, node) in [Spine, Chest, UpperChest].into_iter().zip(spines) {
        bones.entry(bone).or_insert(node);
    }
    let needed = [Hips, Head, LeftUpperArm, RightUpperArm, LeftUpperLeg, RightUpperLeg];
    if needed.iter().all(|bone| bones.contains_key(bone)) {
        bones
    } else {
        BTreeMap::new()
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    Bone(HumanBone),
    /// One of those between hips and chest.
    Spine,
}

/// Names of the middle, without side.
const MIDDLE: &[(&[&str], &str)] = &[
    (&["hips", "hip", "pelvis"], "hips"),
    (&["chest"], "chest"),
    (&["upperchest"], "upperChest"),
    (&["neck"], "neck"),
    (&["head"], "head"),
];

/// Names of a side. Of several joints between forearm and fingers, the first is the hand.
const SIDE: &[(&[&str], &str)] = &[
    (&["shoulder", "clavicle", "collar"], "Shoulder"),
    (&["upperarm", "arm"], "UpperArm"),
    (&["lowerarm", "forearm", "elbow"], "LowerArm"),
    (&["hand", "wrist"], "Hand"),
    (&["upperleg", "upleg", "thigh"], "UpperLeg"),
    (&["lowerleg", "leg", "calf", "shin", "knee"], "LowerLeg"),
    (&["foot", "ankle"], "Foot"),
    (&["toes", "toe", "toebase", "ball"], "Toes"),
    (&["eye", "faceeye"], "Eye"),
];

const FINGERS: &[(&[&str], &str)] = &[
    (&["thumb"], "Thumb"),
    (&["index"], "Index"),
    (&["middle"], "Middle"),
    (&["ring"], "Ring"),
    (&["little", "pinky"], "Little"),
];

/// What a name says: prefixes of tools off, side found, the rest looked up.
fn part(name: &str) -> Option<Part> {
    let name = name.rsplit(':').next()?;
    let mut words = words(name);
    if words.first().is_some_and(|w| w == "j") && words.get(1).is_some_and(|w| w == "bip") {
        words.drain(..2);
        // VRoid's middle bones are of side C.
        if words.first().is_some_and(|w| w == "c") {
            words.remove(0);
        }
    }
    words.retain(|w| {
        !matches!(w.as_str(), "bip" | "bip01" | "bip001" | "mixamorig" | "def" | "armature" | "jnt" | "joint")
    });
    let side = words.iter().position(|w| matches!(w.as_str(), "l" | "r" | "left" | "right"));
    let prefix = side.map(|at| {
        if words.remove(at).starts_with('l') {
            "left"
        } else {
            "right"
        }
    });
    let number = words.last().and_then(|w| w.parse::<u32>().ok());
    if number.is_some() {
        words.pop();
    }
    let rest: String = words.concat();
    let bone = |name: String| HumanBone::from_name(&name).map(Part::Bone);
    let Some(prefix) = prefix else {
        if rest == "spine" {
            return Some(Part::Spine);
        }
        let found = MIDDLE.iter().find(|(names, _)| names.contains(&rest.as_str()) && number.is_none_or(|n| n <= 1))?;
        return bone(found.1.to_owned());
    };
    if let Some((_, part)) = SIDE.iter().find(|(names, _)| names.contains(&rest.as_str())) {
        return if number.is_none_or(|n| n <= 1) {
            bone(format!("{prefix}{part}"))
        } else {
            None
        };
    }
    let finger = rest.strip_prefix("hand").unwrap_or(&rest);
    let finger = finger
        .strip_prefix('f')
        .filter(|f| {
            f.starts_with("index") || f.starts_with("middle") || f.starts_with("ring") || f.starts_with("pinky")
        })
        .unwrap_or(finger);
    let (found, tail) = FINGERS
        .iter()
        .find_map(|(names, part)| names.iter().find_map(|n| finger.strip_prefix(n).map(|tail| (*part, tail))))?;
    let joint = match (tail, number) {
        ("proximal", _) | ("", Some(1)) => 0,
        ("intermediate", _) | ("", Some(2)) => 1,
        ("distal", _) | ("", Some(3)) => 2,
        _ => return None,
    };
    let joint = if found == "Thumb" {
        ["Metacarpal", "Proximal", "Distal"][joint]
    } else {
        ["Proximal", "Intermediate", "Distal"][joint]
    };
    bone(format!("{prefix}{found}{joint}"))
}

/// Words of a name, lower case: parted by marks, and where letters become large or numbers begin.
fn words(name: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut last = ' ';
    for c in name.chars().take(80) {
        let begins = !last.is_alphanumeric()
            || last.is_lowercase() && c.is_uppercase()
            || last.is_alphabetic() && c.is_ascii_digit();
        if c.is_alphanumeric() {
            match words.last_mut().filter(|_| !begins) {
                Some(word) => word.extend(c.to_lowercase()),
                None => words.push(c.to_lowercase().collect()),
            }
        }
        last = c;
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_tools_and_packs_are_known() {
        use HumanBone::*;
        for (name, bone) in [
            ("mixamorig:Hips", Hips),
            ("mixamorig:LeftArm", LeftUpperArm),
            ("mixamorigRightForeArm", RightLowerArm),
            ("mixamorig:LeftUpLeg", LeftUpperLeg),
            ("mixamorig:RightLeg", RightLowerLeg),
            ("mixamorig:LeftToeBase", LeftToes),
            ("mixamorig:LeftHandThumb1", LeftThumbMetacarpal),
            ("mixamorig:RightHandIndex3", RightIndexDistal),
            ("mixamorig:LeftHandPinky2", LeftLittleIntermediate),
            ("upperarm.l", LeftUpperArm),
            ("lowerleg.r", RightLowerLeg),
            ("toes.l", LeftToes),
            ("hips", Hips),
            ("chest", Chest),
            ("J_Bip_L_UpperArm", LeftUpperArm),
            ("J_Bip_C_Hips", Hips),
            ("J_Bip_R_Index2", RightIndexIntermediate),
            ("upperarm_l", LeftUpperArm),
            ("clavicle_r", RightShoulder),
            ("thumb_01_l", LeftThumbMetacarpal),
            ("pelvis", Hips),
            ("upper_arm.L", LeftUpperArm),
            ("f_index.01.R", RightIndexProximal),
            ("DEF-forearm.L", LeftLowerArm),
            ("shin.r", RightLowerLeg),
        ] {
            assert_eq!(part(name), Some(Part::Bone(bone)), "{name}");
        }
        for name in ["mixamorig:Spine", "mixamorig:Spine1", "spine_02", "spine.003", "J_Bip_C_Spine"] {
            assert_eq!(part(name), Some(Part::Spine), "{name}");
        }
        for name in
            ["handslot.l", "kneeIK.l", "control-heel-roll.r", "Knight_Head", "head_end", "hair_A.001", "elbowIK.l", ""]
        {
            assert_eq!(part(name), None, "{name}");
        }
    }
}
