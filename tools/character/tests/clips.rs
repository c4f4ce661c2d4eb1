//! Laws that the animation clips keep.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use glam::{Affine3A, Quat, Vec3};
use hikage_character::clips::{self, Clip, Track};
use hikage_character::model::Model;
use hikage_character::vrma;
use serde_json::Value;

static MODEL: LazyLock<Model> = LazyLock::new(hikage_character::build);
static CLIPS: LazyLock<Vec<Clip>> = LazyLock::new(clips::all);

/// Clips whose feet leave the ground.
const GAITS: [&str; 2] = ["walk", "run"];

fn clip(name: &str) -> &'static Clip {
    CLIPS.iter().find(|c| c.name == name).unwrap_or_else(|| panic!("no clip {name}"))
}

/// Value of a track at a time, held beyond its ends.
fn sample<T: Copy>(track: &Track<T>, time: f32, between: impl Fn(T, T, f32) -> T) -> T {
    let i = track.iter().rposition(|(t, _)| *t <= time).unwrap_or(0);
    let (t0, a) = track[i];
    track.get(i + 1).map_or(a, |(t1, b)| between(a, *b, (time - t0) / (t1 - t0)))
}

/// Rotation of each bone against its parent.
fn rotations(clip: &Clip, time: f32) -> BTreeMap<&str, Quat> {
    clip.rotations.iter().map(|(name, track)| (name.as_str(), sample(track, time, Quat::slerp))).collect()
}

/// Place and rotation of every bone in the world.
fn world(clip: &Clip, time: f32) -> Vec<Affine3A> {
    let turns = rotations(clip, time);
    let bones = &MODEL.skeleton.bones;
    let mut world: Vec<Affine3A> = Vec::with_capacity(bones.len());
    for bone in bones {
        let turn = turns.get(bone.name.as_str()).copied().unwrap_or(Quat::IDENTITY);
        let local = match bone.parent {
            Some(parent) => {
                world[parent] * Affine3A::from_rotation_translation(turn, bone.position - bones[parent].position)
            }
            None => Affine3A::from_rotation_translation(turn, sample(&clip.hips, time, Vec3::lerp)),
        };
        world.push(local);
    }
    world
}

/// Times at this rate over the clip, and its end.
fn times(clip: &Clip, rate: f32) -> impl Iterator<Item = f32> {
    let count = (clip.length * rate).round() as usize;
    let length = clip.length;
    (0..=count).map(move |i| length * i as f32 / count as f32)
}

/// Bend between two bones that follow each other, degrees.
fn bend(world: &[Affine3A], joints: [&str; 3]) -> (f32, Vec3) {
    let [a, b, c] = joints.map(|name| Vec3::from(world[MODEL.skeleton.find(name)].translation));
    let (upper, lower) = ((b - a).normalize(), (c - b).normalize());
    (upper.dot(lower).clamp(-1.0, 1.0).acos().to_degrees(), upper.cross(lower))
}

#[test]
fn every_name_is_a_clip() {
    assert_eq!(CLIPS.iter().map(|c| c.name).collect::<Vec<_>>(), clips::NAMES);
    assert!(clips::build("fly").is_none());
    for clip in CLIPS.iter() {
        assert_eq!(clips::build(clip.name).as_ref(), Some(clip), "{} differs each time", clip.name);
    }
}

fn check_keys<T>(clip: &Clip, what: &str, track: &Track<T>) {
    let last = track.last().map_or(0.0, |(t, _)| *t);
    assert!(!track.is_empty() && track[0].0 == 0.0, "{} {what} does not begin at 0", clip.name);
    assert!(last <= clip.length, "{} {what} goes beyond the end", clip.name);
    assert!(track.windows(2).all(|w| w[0].0 < w[1].0), "{} {what}: times do not rise", clip.name);
}

#[test]
fn keys_rise_from_zero_and_end_with_the_clip() {
    for clip in CLIPS.iter() {
        for (bone, track) in &clip.rotations {
            check_keys(clip, bone, track);
            assert!(track.iter().all(|(_, q)| q.is_normalized()), "{} {bone}", clip.name);
            assert!(track.windows(2).all(|w| w[0].1.dot(w[1].1) >= 0.0), "{} {bone} turns the long way", clip.name);
            assert!(track.len() == 1 || track[track.len() - 1].0 == clip.length, "{} {bone}", clip.name);
        }
        check_keys(clip, "hips", &clip.hips);
        for (name, track) in &clip.expressions {
            check_keys(clip, name, track);
            assert!(track.iter().all(|(_, w)| (0.0..=1.0).contains(w)), "{} {name}", clip.name);
        }
        if !clip.gaze.is_empty() {
            check_keys(clip, "gaze", &clip.gaze);
        }
    }
}

#[test]
fn loops_close_and_run_smoothly_over_the_seam() {
    for clip in CLIPS.iter().filter(|c| c.looped) {
        for (bone, track) in &clip.rotations {
            assert_eq!(track[0].1, track[track.len() - 1].1, "{} {bone}", clip.name);
        }
        let way = clip.hips[clip.hips.len() - 1].1 - clip.hips[0].1;
        assert!(way.truncate().length() < 1e-6, "{}: the hips end {way} away", clip.name);
        assert_eq!(GAITS.contains(&clip.name), way.z > 0.1, "{}", clip.name);
        assert!(clip.gaze.first().map(|g| g.1) == clip.gaze.last().map(|g| g.1), "{}", clip.name);
        // What the speed of a bone changes by from one step to the next is at the seam as elsewhere; for legs as at the
        // other foot's strike, half a stride later.
        let step = 1.0 / 30.0;
        let track = |bone: &str| clip.rotations.iter().find(|(name, _)| name == bone).map(|(_, track)| track);
        let change = |bone: &str, t: f32| {
            let around = |t: f32| t.rem_euclid(clip.length);
            let track = track(bone).unwrap_or_else(|| panic!("{bone} does not move"));
            let [a, b, c] = [t - step, t, t + step].map(|t| sample(track, around(t), Quat::slerp));
            (a.inverse() * b).angle_between(b.inverse() * c).to_degrees()
        };
        let all: Vec<f32> = times(clip, 30.0).collect();
        for (bone, _) in &clip.rotations {
            let other = if bone.contains("left") {
                bone.replace("left", "right")
            } else {
                bone.replace("right", "left")
            };
            let seam = change(bone, 0.0);
            let inner = all[1..all.len() - 1].iter();
            let most = inner.map(|t| change(bone, *t).max(change(&other, *t))).fold(0.0, f32::max);
            println!("{} {bone}: {seam:.1}° of {most:.1}°", clip.name);
            assert!(seam <= most * 1.05 + 0.2, "{} {bone}: {seam}° at the seam, {most}° elsewhere", clip.name);
        }
    }
}

#[test]
fn gaits_have_the_speed_of_their_names() {
    for (name, range) in [("walk", 1.2..1.45), ("run", 3.3..4.1)] {
        let clip = clip(name);
        let first = clip.hips[0].1.z;
        let speed = (clip.hips[clip.hips.len() - 1].1.z - first) / clip.length;
        assert!(range.contains(&speed), "{name}: {speed} m/s");
        // The hips never go far from where the mean speed would have them.
        for time in times(clip, 60.0) {
            let away = sample(&clip.hips, time, Vec3::lerp).z - first - speed * time;
            assert!(away.abs() < 0.03, "{name} at {time}: {away} m");
        }
    }
}

/// Places of the lowest points of the boots over time, skinned as in a player.
fn soles(clip: &Clip, rate: f32) -> Vec<(f32, Vec<Vec3>)> {
    let boots = MODEL.part("Boots").expect("she wears boots");
    // Where foot and toes share the sole it creases and slides on itself.
    let whole = |v: &hikage_character::mesh::Vertex| v.weights.iter().any(|(_, weight)| *weight > 0.85);
    let lowest: Vec<_> = boots.vertices.iter().filter(|v| v.position.y < 0.0035 && whole(v)).collect();
    let bones = &MODEL.skeleton.bones;
    times(clip, rate)
        .map(|time| {
            let world = world(clip, time);
            let place = |v: &&hikage_character::mesh::Vertex| {
                let moved = v.weights.iter().map(|(bone, weight)| {
                    let bone = usize::from(*bone);
                    world[bone].transform_point3(v.position - bones[bone].position) * *weight
                });
                moved.sum()
            };
            (time, lowest.iter().map(place).collect())
        })
        .collect()
}

#[test]
fn soles_stay_over_the_ground() {
    for clip in CLIPS.iter() {
        for (time, points) in soles(clip, 120.0) {
            let low = points.iter().map(|p| p.y).fold(f32::INFINITY, f32::min);
            assert!(low > -0.005, "{} at {time} s: {} mm", clip.name, low * 1e3);
            if !GAITS.contains(&clip.name) {
                assert!(low < 0.002, "{} at {time} s: she floats {} mm", clip.name, low * 1e3);
            }
        }
    }
}

#[test]
fn planted_feet_do_not_slide() {
    for clip in CLIPS.iter() {
        let frames = soles(clip, 120.0);
        let mut worst = 0.0f32;
        for point in 0..frames[0].1.len() {
            // A point stands from when it comes within 3.5 mm of the ground until it leaves again.
            let mut stood: Option<Vec3> = None;
            for (time, points) in &frames {
                let p = points[point];
                stood = if p.y < 0.0035 { stood.or(Some(p)) } else { None };
                if let Some(from) = stood {
                    let slid = (p - from).with_y(0.0).length();
                    worst = worst.max(slid);
                    assert!(slid < 0.005, "{} at {time} s: {} mm at {p}", clip.name, slid * 1e3);
                }
            }
        }
        println!("{}: {} mm", clip.name, worst * 1e3);
    }
}

#[test]
fn joints_bend_as_joints_do() {
    for clip in CLIPS.iter() {
        for time in times(clip, 60.0) {
            let world = world(clip, time);
            for side in ["left", "right"] {
                let name = |bone: &str| format!("{side}{bone}");
                let joints = [name("UpperLeg"), name("LowerLeg"), name("Foot")];
                let (knee, axis) = bend(&world, joints.each_ref().map(String::as_str));
                // The axis of a knee that bends shows to her left.
                let pelvis = world[MODEL.skeleton.find("hips")].matrix3.x_axis;
                let knee = knee * axis.dot(pelvis.into()).signum();
                let most = if clip.name == "run" { 130.0 } else { 75.0 };
                assert!((4.0..most).contains(&knee), "{} at {time} s: {side} knee {knee}°", clip.name);
                let joints = [name("UpperArm"), name("LowerArm"), name("Hand")];
                let (elbow, _) = bend(&world, joints.each_ref().map(String::as_str));
                assert!((8.0..150.0).contains(&elbow), "{} at {time} s: {side} elbow {elbow}°", clip.name);
            }
            let turns = rotations(clip, time);
            for (bone, most) in [
                ("spine", 15.0),
                ("chest", 15.0),
                ("upperChest", 15.0),
                ("neck", 35.0),
                ("head", 35.0),
                ("leftFoot", 60.0),
                ("rightFoot", 60.0),
                ("leftToes", 50.0),
                ("rightToes", 50.0),
                ("leftHand", 45.0),
                ("rightHand", 45.0),
            ] {
                let angle = turns.get(bone).map_or(0.0, |q| q.angle_between(Quat::IDENTITY).to_degrees());
                assert!(angle < most, "{} at {time} s: {bone} {angle}°", clip.name);
            }
        }
    }
}

/// Most that any bone turns in a thirtieth of a second, degrees: legs are fast in gaits, nothing else is.
#[test]
fn no_bone_jumps() {
    for clip in CLIPS.iter() {
        for (bone, track) in &clip.rotations {
            let leg = ["Leg", "Foot", "Toes"].iter().any(|end| bone.ends_with(end));
            let most = match clip.name {
                "walk" if leg => 15.0,
                "run" if leg => 32.0,
                _ => 12.0,
            };
            let turns: Vec<Quat> = times(clip, 30.0).map(|t| sample(track, t, Quat::slerp)).collect();
            for (i, pair) in turns.windows(2).enumerate() {
                let angle = pair[0].angle_between(pair[1]).to_degrees();
                assert!(angle < most, "{} {bone} after {} s: {angle}°", clip.name, i as f32 / 30.0);
            }
        }
    }
}

#[test]
fn all_that_stands_starts_and_ends_alike() {
    let idle = world(clip("idle"), 0.0);
    for name in ["wave", "turn"] {
        let clip = clip(name);
        for time in [0.0, clip.length] {
            for (i, (a, b)) in idle.iter().zip(world(clip, time)).enumerate() {
                let bone = &MODEL.skeleton.bones[i].name;
                let away = a.translation.distance(b.translation);
                let turned = Quat::from_mat3a(&a.matrix3).angle_between(Quat::from_mat3a(&b.matrix3)).to_degrees();
                assert!(away < 5e-4 && turned < 0.2, "{name} at {time} s: {bone} {away} m, {turned}°");
            }
        }
        for (expression, track) in &clip.expressions {
            assert_eq!(sample(track, clip.length, |a, b, t| a + (b - a) * t), 0.0, "{name} ends {expression}");
        }
    }
}

/// The JSON chunk and the binary chunk of a GLB file.
fn open(file: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().expect("four bytes")) as usize;
    assert_eq!((&file[..4], word(4), word(8)), (&b"glTF"[..], 2, file.len()));
    let length = word(12);
    assert_eq!((&file[16..20], length % 4), (&b"JSON"[..], 0));
    assert_eq!((word(20 + length), &file[24 + length..28 + length]), (file.len() - length - 28, &b"BIN\0"[..]));
    (serde_json::from_slice(&file[20..20 + length]).expect("valid JSON"), &file[28 + length..])
}

/// Index at `path` in `value`, below the length of the list that it points into.
fn index(value: &Value, list: &Value) -> usize {
    let index = value.as_u64().unwrap_or_else(|| panic!("{value} is no index")) as usize;
    assert!(index < list.as_array().map_or(0, Vec::len), "{index} points nowhere");
    index
}

/// Numbers of an accessor of floats.
fn numbers(document: &Value, binary: &[u8], accessor: usize) -> (Vec<f32>, usize) {
    let accessor = &document["accessors"][accessor];
    let view = &document["bufferViews"][index(&accessor["bufferView"], &document["bufferViews"])];
    assert_eq!(accessor["componentType"], 5126);
    let width = match accessor["type"].as_str() {
        Some("SCALAR") => 1,
        Some("VEC3") => 3,
        Some("VEC4") => 4,
        other => panic!("{other:?}"),
    };
    let [from, length] = ["byteOffset", "byteLength"].map(|key| view[key].as_u64().expect("a size") as usize);
    assert_eq!(accessor["count"].as_u64(), Some((length / 4 / width) as u64));
    let bytes = &binary[from..from + length];
    (bytes.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().expect("four bytes"))).collect(), width)
}

/// Every channel of every animation points to what is there; inputs rise from 0 and have bounds.
fn check_animations(document: &Value, binary: &[u8]) {
    for animation in document["animations"].as_array().expect("animations") {
        for channel in animation["channels"].as_array().expect("channels") {
            let sampler = &animation["samplers"][index(&channel["sampler"], &animation["samplers"])];
            index(&channel["target"]["node"], &document["nodes"]);
            assert_eq!(sampler["interpolation"], "LINEAR");
            let [input, output] = ["input", "output"].map(|key| index(&sampler[key], &document["accessors"]));
            let (times, _) = numbers(document, binary, input);
            let (values, width) = numbers(document, binary, output);
            assert_eq!(values.len(), times.len() * width);
            assert_eq!(width, if channel["target"]["path"] == "rotation" { 4 } else { 3 });
            assert!(times[0] == 0.0 && times.windows(2).all(|w| w[0] < w[1]));
            let bound = |key: &str| document["accessors"][input][key][0].as_f64().map(|b| b as f32);
            assert_eq!((bound("min"), bound("max")), (times.first().copied(), times.last().copied()));
            assert!(values.iter().all(|v| v.is_finite()));
        }
    }
}

#[test]
fn vrm_animations_are_valid_files() {
    for clip in CLIPS.iter() {
        let file = vrma::write(clip);
        assert!(file == vrma::write(clip), "{} differs each time", clip.name);
        let (document, binary) = open(&file);
        assert_eq!(document["buffers"][0]["byteLength"].as_u64(), Some(binary.len() as u64));
        assert_eq!(document["animations"].as_array().map(Vec::len), Some(1));
        check_animations(&document, binary);
        let extension = &document["extensions"]["VRMC_vrm_animation"];
        assert_eq!(extension["specVersion"], "1.0");
        let bones = extension["humanoid"]["humanBones"].as_object().expect("bones");
        for (name, bone) in bones {
            assert_eq!(document["nodes"][index(&bone["node"], &document["nodes"])]["name"], name.as_str());
        }
        assert!(bones.contains_key("hips") && !bones.contains_key("leftEye"), "eyes belong to the gaze");
        for (name, _) in &clip.expressions {
            index(&extension["expressions"]["preset"][name]["node"], &document["nodes"]);
        }
        if !clip.gaze.is_empty() {
            index(&extension["lookAt"]["node"], &document["nodes"]);
        }
    }
}

#[test]
fn clips_are_in_her_file_only_when_asked_for() {
    let plain = hikage_character::file();
    assert!(open(&plain).0.get("animations").is_none());
    let file = hikage_character::file_with_clips();
    let (document, binary) = open(&file);
    let names: Vec<&str> = document["animations"]
        .as_array()
        .expect("animations")
        .iter()
        .filter_map(|animation| animation["name"].as_str())
        .collect();
    assert_eq!(names, clips::NAMES);
    check_animations(&document, binary);
}
