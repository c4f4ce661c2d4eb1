//! What moves a character: clips, VRMA, gaze maps, springs, constraints, and their faults.

use std::time::Instant;

use glam::{Quat, Vec3};
use hikage::Error;
use hikage::scene::{
    Animation, AnimationValues, Character, CurveKey, ExpressionOverride, HumanBone, Interpolation, LookAt, RangeMap,
    Scene,
};
use serde_json::{Value, json};

use super::close;
use crate::gltf::{F32, Glb, I16, U8, floats, shorts};

/// Adds a clip of one sampler for each channel: target, interpolation, times, output accessor.
fn clip(glb: &mut Glb, channels: &[(Value, &str, &[f32], usize)]) {
    let (mut samplers, mut list) = (Vec::new(), Vec::new());
    for (target, interpolation, times, output) in channels {
        let input = glb.accessor(F32, "SCALAR", &floats(times), times.len(), false);
        list.push(json!({"sampler": samplers.len(), "target": target}));
        samplers.push(json!({"input": input, "output": output, "interpolation": interpolation}));
    }
    glb.push("animations", json!({"name": "clip", "samplers": samplers, "channels": list}));
}

fn vec3s(glb: &mut Glb, values: &[f32]) -> usize {
    glb.accessor(F32, "VEC3", &floats(values), values.len() / 3, false)
}

/// The pointers of warnings whose message holds a text.
fn places<'a>(scene: &'a Scene, text: &str) -> Vec<&'a str> {
    scene.warnings.iter().filter(|w| w.message.contains(text)).map(|w| w.pointer.as_str()).collect()
}

fn character(scene: &Scene) -> &Character {
    scene.character.as_ref().expect("a character")
}

fn loaded(glb: &Glb) -> Scene {
    glb.load().expect("loads")
}

#[test]
fn clips_keep_keys_of_all_kinds() {
    let mut glb = Glb::triangle();
    let target = vec3s(&mut glb, &[0.1; 9]);
    glb.primitive()["targets"] = json!([{"POSITION": target}, {"POSITION": target}]);
    let moved = vec3s(&mut glb, &[0., 0., 0., 1., 2., 3.]);
    let turned = glb.accessor(I16, "VEC4", &shorts(&[0, 0, 0, 32767, 0, 23170, 0, 23170, 0, -32768, 0, 0]), 3, true);
    let spline = vec3s(&mut glb, &[0., 0., 0., 1., 1., 1., 3., 3., 3., 4., 4., 4., 2., 2., 2., 0., 0., 0.]);
    let weights = glb.accessor(U8, "SCALAR", &[0, 255, 51, 0], 4, true);
    let target = |path: &str| json!({"node": 0, "path": path});
    clip(
        &mut glb,
        &[
            (target("translation"), "STEP", &[0., 1.], moved),
            (target("rotation"), "LINEAR", &[0., 0.5, 1.], turned),
            (target("scale"), "CUBICSPLINE", &[0.25, 2.], spline),
            (target("weights"), "LINEAR", &[0., 1.], weights),
        ],
    );
    let scene = loaded(&glb);
    let [moved, turned, scaled, weighed] = &scene.animations[0].channels[..] else { panic!("four channels") };
    let modes = [moved, turned, scaled, weighed].map(|c| c.interpolation);
    assert_eq!(modes, [Interpolation::Step, Interpolation::Linear, Interpolation::CubicSpline, Interpolation::Linear]);
    assert_eq!(moved.values, AnimationValues::Translation(vec![[0.; 3], [1., 2., 3.]]));
    assert_eq!((&turned.times[..], &scaled.times[..]), (&[0., 0.5, 1.][..], &[0.25, 2.][..]));
    let AnimationValues::Rotation(rows) = &turned.values else { panic!("no rotation") };
    let half = std::f32::consts::FRAC_1_SQRT_2;
    assert!(close(rows.as_flattened(), &[0., 0., 0., 1., 0., half, 0., half, 0., -1., 0., 0.], 1e-6), "{rows:?}");
    assert!(rows.iter().all(|q| (Quat::from_array(*q).length() - 1.0).abs() < 1e-6), "unit again: {rows:?}");
    let AnimationValues::Scale(rows) = &scaled.values else { panic!("no scale") };
    assert_eq!((rows.len(), rows[1], rows[3]), (6, [1.; 3], [4.; 3]), "in-tangent, value, out-tangent");
    let AnimationValues::MorphWeights(values) = &weighed.values else { panic!("no weights") };
    assert!(close(values, &[0., 1., 0.2, 0.], 1e-6));
    assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
}

#[test]
fn of_two_channels_on_one_property_the_first_is_kept() {
    let mut glb = Glb::triangle();
    let [first, second] = [1.0, 2.0].map(|x| vec3s(&mut glb, &[x; 3]));
    let target = |path: &str| json!({"node": 0, "path": path});
    clip(
        &mut glb,
        &[
            (target("translation"), "LINEAR", &[0.], first),
            (target("scale"), "LINEAR", &[0.], first),
            (target("translation"), "LINEAR", &[0.], second),
        ],
    );
    clip(&mut glb, &[(target("translation"), "LINEAR", &[0.], second)]);
    let scene = loaded(&glb);
    let counts: Vec<usize> = scene.animations.iter().map(|a| a.channels.len()).collect();
    assert_eq!(counts, [2, 1], "another clip may move the same");
    assert_eq!(scene.animations[0].channels[0].values, AnimationValues::Translation(vec![[1.0; 3]]));
    assert_eq!(places(&scene, "translation of the node as well: the first is kept"), ["/animations/0/channels/2"]);
}

#[test]
fn clips_and_samplers_without_anything_are_said() {
    let mut glb = Glb::triangle();
    glb.push("animations", json!({"samplers": [], "channels": []}));
    glb.push("animations", json!({"name": "nothing"}));
    let none = glb.accessor(F32, "SCALAR", &[], 0, false);
    let output = vec3s(&mut glb, &[]);
    clip(&mut glb, &[]);
    let sampler = json!({"input": none, "output": output});
    let channel = json!({"sampler": 0, "target": {"node": 0, "path": "scale"}});
    glb.push("animations", json!({"samplers": [sampler], "channels": [channel]}));
    let lost = json!({"sampler": 0, "target": {"path": "scale"}});
    glb.push("animations", json!({"samplers": [sampler], "channels": [lost]}));
    let scene = loaded(&glb);
    assert_eq!(scene.animations.len(), 5, "indices of clips are those of the file");
    assert!(scene.animations.iter().all(|a| a.channels.is_empty()));
    assert_eq!(places(&scene, "clip without channels: it moves nothing (3 times, here first)"), ["/animations/0"]);
    assert_eq!(places(&scene, "without keys"), ["/animations/3/samplers/0"]);
    assert_eq!(places(&scene, "without a node"), ["/animations/4/channels/0/target"]);

    glb.json["animations"][3]["samplers"] = json!([]);
    let error = glb.load().expect_err("a sampler that is not there").to_string();
    assert!(error.contains("/animations/3/channels/0/sampler") && error.contains("samplers"), "{error}");
}

#[test]
fn keys_that_are_not_finite_cost_their_channel() {
    let mut glb = Glb::triangle();
    let good = vec3s(&mut glb, &[0., 0., 0., 1., 1., 1.]);
    let bad = vec3s(&mut glb, &[0., f32::NAN, 0., 1., f32::NEG_INFINITY, 1.]);
    let quaternions = glb.accessor(F32, "VEC4", &floats(&[0., 0., 0., f32::INFINITY, 0., 0., 0., 1.]), 2, false);
    let target = |path: &str| json!({"node": 0, "path": path});
    clip(
        &mut glb,
        &[
            (target("translation"), "LINEAR", &[0., f32::INFINITY], good),
            (target("translation"), "LINEAR", &[f32::NAN, 1.], good),
            (target("scale"), "LINEAR", &[0., 1.], bad),
            (target("rotation"), "LINEAR", &[0., 1.], quaternions),
            (target("translation"), "LINEAR", &[0., 2.], good),
        ],
    );
    let scene = loaded(&glb);
    let [kept] = &scene.animations[0].channels[..] else { panic!("one channel") };
    assert_eq!(kept.times, [0., 2.], "a channel that was skipped takes nothing from the next");
    let at = |i: usize| format!("/animations/0/channels/{i}/target");
    let expected: Vec<String> = (0..4).map(at).collect();
    assert_eq!(places(&scene, "NaN or infinite values: channel skipped"), expected);
    assert_eq!(places(&scene, &format!("sampler output /accessors/{bad} has 2 NaN")), [at(2)]);
}

#[test]
fn clips_for_nodes_that_are_not_there_are_refused() {
    let mut glb = Glb::triangle();
    let output = vec3s(&mut glb, &[0.; 3]);
    clip(&mut glb, &[(json!({"node": 0, "path": "scale"}), "LINEAR", &[0.], output)]);
    for (node, found) in [(json!(99), "99"), (json!(-1), "-1"), (json!("hips"), "hips")] {
        glb.json["animations"][0]["channels"][0]["target"]["node"] = node;
        let Err(Error::Input { pointer, message, .. }) = glb.load() else { panic!("expected an input error") };
        assert_eq!(pointer, "/animations/0/channels/0/target/node");
        assert!(message.contains(found), "{message}");
    }
}

/// Neither time nor memory follows what a small file claims.
#[test]
fn a_billion_keys_are_refused_at_once() {
    let mut glb = Glb::triangle();
    let output = vec3s(&mut glb, &[0.; 3]);
    clip(&mut glb, &[(json!({"node": 0, "path": "scale"}), "LINEAR", &[0.], output)]);
    let input = output + 1;
    let start = Instant::now();
    for count in [1_000_000_000u64, 100_000_000, u64::MAX] {
        let mut glb = Glb { json: glb.json.clone(), bin: glb.bin.clone() };
        for accessor in [input, output] {
            glb.json["accessors"][accessor]["count"] = json!(count);
        }
        let error = glb.load().expect_err("too many").to_string();
        assert!(error.contains("/accessors/") && error.contains("count") && !error.contains('\n'), "{error}");
        // Without a view nothing of the file backs the zeros.
        for accessor in [input, output] {
            glb.json["accessors"][accessor].as_object_mut().expect("an accessor").remove("bufferView");
        }
        let error = glb.load().expect_err("too many").to_string();
        assert!(error.contains("/accessors/") && error.contains("count"), "{error}");
    }
    assert!(start.elapsed().as_secs_f32() < 1.0, "{:?}", start.elapsed());
}

#[test]
fn moved_nodes_may_have_a_matrix() {
    let mut glb = Glb::triangle();
    // A quarter turn about +Y, twice as large.
    glb.json["nodes"][0]["matrix"] = json!([0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 1, 2, 3, 1]);
    let output = vec3s(&mut glb, &[0.; 3]);
    clip(&mut glb, &[(json!({"node": 0, "path": "translation"}), "LINEAR", &[0.], output)]);
    let scene = loaded(&glb);
    assert_eq!(scene.animations[0].channels.len(), 1);
    let rest = scene.nodes[0].transform;
    assert!(rest.rotation.abs_diff_eq(Quat::from_rotation_y(std::f32::consts::FRAC_PI_2), 1e-6), "{rest:?}");
    assert!(rest.translation == Vec3::new(1., 2., 3.) && rest.scale.abs_diff_eq(Vec3::splat(2.), 1e-6), "{rest:?}");
}

/// A file of movements: hips, head, both eyes, two expressions, the gaze.
fn movement() -> Glb {
    let mut glb = Glb::new();
    glb.json = json!({
        "asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], "buffers": [{"byteLength": 0}],
        "extensionsUsed": ["VRMC_vrm_animation"], "extensionsRequired": ["VRMC_vrm_animation"],
        "nodes": [{"name": "hips", "translation": [0, 1, 0], "children": [1]}, {"name": "head"}, {"name": "left eye"},
                  {"name": "happy"}, {"name": "wink"}, {"name": "gaze"}],
        "extensions": {"VRMC_vrm_animation": {
            "humanoid": {"humanBones": {"hips": {"node": 0}, "head": {"node": 1}}},
            "expressions": {"preset": {"happy": {"node": 3}}, "custom": {"wink": {"node": 4}}},
            "lookAt": {"node": 5, "offsetFromHeadBone": [0, 0.06, 0.05]}}}
    });
    let output = vec3s(&mut glb, &[0., 1., 0., 0., 1.1, 0.]);
    clip(&mut glb, &[(json!({"node": 0, "path": "translation"}), "LINEAR", &[0., 1.], output)]);
    glb
}

#[test]
fn vrma_says_what_its_nodes_stand_for() {
    let mut glb = movement();
    let scene = loaded(&glb);
    let rig = scene.animation_rig.as_ref().expect("a rig");
    assert_eq!(rig.bones, [(HumanBone::Hips, 0), (HumanBone::Head, 1)].into());
    assert_eq!(rig.expressions, [("happy".to_owned(), 3), ("wink".to_owned(), 4)]);
    assert_eq!((rig.look_at, scene.animations.len()), (Some(5), 1));
    assert!(scene.character.is_none() && scene.warnings.is_empty(), "{:?}", scene.warnings);
    assert!(loaded(&Glb::triangle()).animation_rig.is_none());

    let ext = &mut glb.json["extensions"]["VRMC_vrm_animation"];
    ext["specVersion"] = json!("2.0");
    ext["humanoid"]["humanBones"]["leftEye"] = json!({"node": 2});
    ext["humanoid"]["humanBones"]["tail"] = json!({"node": 2});
    ext["expressions"]["preset"]["lookUp"] = json!({"node": 4});
    ext["expressions"]["custom"]["lookLeft"] = json!({"node": 4});
    ext["expressions"]["custom"]["happy"] = json!({"node": 4});
    let scene = loaded(&glb);
    assert_eq!(scene.animation_rig.as_ref(), Some(rig), "nothing of it is read");
    let root = "/extensions/VRMC_vrm_animation";
    assert_eq!(places(&scene, "specVersion"), [root]);
    assert_eq!(places(&scene, "bone leftEye, whose"), [format!("{root}/humanoid/humanBones/leftEye")]);
    assert_eq!(places(&scene, "\"lookUp\", whose"), [format!("{root}/expressions/preset/lookUp")]);
    assert_eq!(places(&scene, "\"lookLeft\", whose"), [format!("{root}/expressions/custom/lookLeft")]);
    assert_eq!(places(&scene, "given twice"), [format!("{root}/expressions/custom/happy")]);
    assert_eq!(places(&scene, "unknown humanoid bone"), [format!("{root}/humanoid/humanBones/tail")]);
    assert_eq!(scene.warnings.len(), 6, "{:?}", scene.warnings);
}

#[test]
fn vrma_with_wrong_types_still_loads() {
    let ext = |path: &str, value: Value| {
        let mut glb = movement();
        *glb.json.pointer_mut(&format!("/extensions/VRMC_vrm_animation{path}")).expect("it is there") = value;
        loaded(&glb)
    };
    let bad = [json!(5), json!("text"), json!([1]), json!(true), json!(null)];
    for value in &bad {
        let scene = ext("", value.clone());
        assert!(scene.animation_rig.is_none(), "{value}");
        assert_eq!(places(&scene, "not an object"), ["/extensions/VRMC_vrm_animation"], "{value}");
    }
    for (path, lost) in [("/humanoid/humanBones", 'b'), ("/expressions/preset", 'e'), ("/lookAt", 'l')] {
        for value in &bad {
            let scene = ext(path, value.clone());
            let rig = scene.animation_rig.as_ref().expect("a rig");
            assert_eq!(rig.bones.is_empty(), lost == 'b', "{path} {value}");
            assert_eq!(rig.expressions.len(), if lost == 'e' { 1 } else { 2 }, "{path} {value}");
            assert_eq!(rig.look_at.is_none(), lost == 'l', "{path} {value}");
            // A missing group is fine, and null is as good as missing.
            assert!(value.is_null() || scene.warnings.len() == 1, "{path} {value}: {:?}", scene.warnings);
        }
    }
    for path in ["/humanoid/humanBones/head/node", "/expressions/custom/wink/node", "/lookAt/node"] {
        for value in [json!(-1), json!("hips"), json!(99), json!(1e30), json!([]), json!(null)] {
            let scene = ext(path, value.clone());
            let place = format!("/extensions/VRMC_vrm_animation{}", path.strip_suffix("/node").expect("a node"));
            assert_eq!(places(&scene, "skipped"), [place], "{path} {value}");
        }
    }
    let scene = ext("/humanoid/humanBones/hips/node", json!(-1));
    assert_eq!(places(&scene, "required humanoid bones are missing: hips").len(), 1);
    let scene = ext("/humanoid/humanBones/head/node", json!(0));
    assert_eq!(places(&scene, "share one node").len(), 1);
}

/// A VRM 1.0 character with this gaze.
fn gaze1(look_at: Value) -> LookAt {
    let mut glb = Glb::triangle();
    glb.vrm1();
    glb.json["extensions"]["VRMC_vrm"]["lookAt"] = look_at;
    character(&loaded(&glb)).look_at.clone().expect("a gaze")
}

/// The least VRM 0.x character.
fn vrm0() -> Glb {
    let mut glb = Glb::triangle();
    glb.push("nodes", json!({"name": "hips", "children": [2]}));
    glb.push("nodes", json!({"name": "head", "translation": [0, 1, 0]}));
    glb.json["scenes"][0]["nodes"] = json!([0, 1]);
    glb.json["extensions"]["VRM"] = json!({
        "humanoid": {"humanBones": [{"bone": "hips", "node": 1}, {"bone": "head", "node": 2}]}});
    glb
}

/// A VRM 0.x character whose gaze drives expressions, with a curve of 40 degrees and full weight 2.
fn gaze0(curve: Value) -> (RangeMap, usize) {
    let mut glb = vrm0();
    glb.json["extensions"]["VRM"]["firstPerson"] = json!({"lookAtTypeName": "BlendShape",
        "lookAtHorizontalOuter": {"xRange": 40, "yRange": 2, "curve": curve}});
    let scene = loaded(&glb);
    let places = places(&scene, "curve of the gaze");
    assert!(places.iter().all(|p| *p == "/extensions/VRM/firstPerson/lookAtHorizontalOuter/curve"), "{places:?}");
    (character(&scene).look_at.as_ref().expect("a gaze").horizontal_outer.clone(), places.len())
}

fn degrees(map: &RangeMap, angle: f32) -> f32 {
    map.map(angle.to_radians())
}

#[test]
fn gaze_maps_are_straight_up_to_their_end() {
    let look = gaze1(json!({"type": "bone", "rangeMapHorizontalInner": {"inputMaxValue": 60, "outputScale": 12},
        "rangeMapVerticalUp": {"inputMaxValue": 0, "outputScale": 5}}));
    assert_eq!(look.offset_from_head, Vec3::new(0., 0.06, 0.), "the offset of files without one");
    let inner = &look.horizontal_inner;
    for (angle, expected) in [(0., 0.), (15., 3.), (-30., 6.), (60., 12.), (179., 12.), (f32::INFINITY, 12.)] {
        assert!((degrees(inner, angle).to_degrees() - expected).abs() < 1e-5, "{angle}");
    }
    assert_eq!(inner.map(f32::NAN), 0.0);
    assert!((degrees(&look.horizontal_outer, 45.).to_degrees() - 5.).abs() < 1e-5, "90 to 10 degrees by default");
    let up = &look.vertical_up;
    assert_eq!(degrees(up, 0.), 0.);
    for angle in [0.01, -1., 90.] {
        assert!((degrees(up, angle).to_degrees() - 5.).abs() < 1e-5, "any gaze has the whole effect: {angle}");
    }
    let said = gaze1(json!({"type": "expression", "offsetFromHeadBone": [0, 0, 0]}));
    assert_eq!((said.offset_from_head, said.vertical_down.output_scale), (Vec3::ZERO, 1.0));
}

#[test]
fn gaze_curves_of_vrm0_are_hermite_splines() {
    for straight in [json!([0, 0, 0, 1, 1, 1, 1, 0]), json!([]), json!(null)] {
        let (map, warned) = gaze0(straight);
        assert_eq!((map.curve.len(), warned), (0, 0));
        assert!((degrees(&map, 10.) - 0.5).abs() < 1e-6);
    }

    // Flat at both ends: smoothstep, 3u² - 2u³.
    let (map, _) = gaze0(json!([0, 0, 0, 0, 1, 1, 0, 0]));
    assert_eq!(map.curve[1], CurveKey { time: 1., value: 1., in_tangent: 0., out_tangent: 0. });
    for (angle, expected) in [(0., 0.), (10., 0.3125), (20., 1.), (-30., 1.6875), (40., 2.), (90., 2.)] {
        assert!((degrees(&map, angle) - expected).abs() < 1e-6, "{angle}: {}", degrees(&map, angle));
    }

    // Three keys, the middle one with slopes 1 before and 2 after it, none at the ends' places.
    let (map, warned) = gaze0(json!([0.25, 0.1, 7, 0, 0.5, 0.4, 1, 2, 0.75, 1, -1, 7]));
    assert_eq!((map.curve.len(), warned), (3, 0));
    let expected = [
        (0., 0.1),
        (5., 0.1),
        (10., 0.1),
        // u = 1/2 of a quarter: (0.1 + 0.4) / 2 + 0.25 (0 - 1) / 8
        (15., 0.218_75),
        (20., 0.4),
        // u = 1/2: (0.4 + 1) / 2 + 0.25 (2 - -1) / 8
        (25., 0.793_75),
        // u = 1/4: 27/32 · 0.4 + 5/32 · 1 + 0.25 (9/64 · 2 + 3/64)
        (22.5, 0.575_781_2),
        (30., 1.),
        (39., 1.),
    ];
    for (angle, share) in expected {
        assert!((degrees(&map, angle) - 2. * share).abs() < 1e-5, "{angle}: {}", degrees(&map, angle));
    }
    let (map, _) = gaze0(json!([0.5, 0.25, 1, 1]));
    assert!([0., 20., 40.].iter().all(|a| degrees(&map, *a) == 0.5), "one key is the value everywhere");
}

#[test]
fn gaze_curves_of_no_use_are_taken_as_straight() {
    for curve in [
        json!(5),
        json!("straight"),
        json!({}),
        json!([0, 0, 0]),
        json!([0, 0, 0, 1, 1]),
        json!([0, 0, "0", 1]),
        json!([0, 0, 0, 1e39]),
        json!([0, 0, 0, null, 1, 1, 1, 0]),
        json!([1, 1, 1, 0, 0, 0, 0, 1]),
        json!([0, 0, 0, 1, 0, 1, 1, 0]),
    ] {
        let (map, warned) = gaze0(curve.clone());
        assert_eq!((map.curve.len(), warned), (0, 1), "{curve}");
        assert!((degrees(&map, 20.) - 1.).abs() < 1e-6);
    }
    // As far as numbers go: finite all the same.
    for curve in [json!([-3e38, 0, 0, 3e38, 3e38, 1, -3e38, 0]), json!([0, -3e38, 0, 3e38, 1, 3e38, -3e38, 0])] {
        let (map, warned) = gaze0(curve.clone());
        assert_eq!((map.curve.len(), warned), (2, 0), "{curve}");
        assert!((0..90).all(|a| degrees(&map, a as f32).is_finite()), "{curve}");
    }
}

/// A VRM 1.0 character with these springs.
fn sprung(ext: Value) -> Scene {
    let mut glb = Glb::triangle();
    glb.vrm1();
    glb.json["extensions"]["VRMC_springBone"] = ext;
    loaded(&glb)
}

#[test]
fn gravity_keeps_its_length_and_defaults_are_the_schemas() {
    let joint = |node: usize, dir: Value| json!({"node": node, "gravityDir": dir});
    let scene = sprung(
        json!({"springs": [{"joints": [joint(1, json!([0, -3, 4])), joint(2, json!([0, 0, 0])), {"node": 3}]}]}),
    );
    let joints = &character(&scene).springs[0].joints;
    let dirs: Vec<Vec3> = joints.iter().map(|j| j.gravity_dir).collect();
    assert_eq!(dirs, [Vec3::new(0., -3., 4.), Vec3::ZERO, Vec3::NEG_Y]);
    let plain = joints[2];
    assert_eq!((plain.hit_radius, plain.stiffness, plain.gravity_power, plain.drag), (0., 1., 0., 0.5));

    let mut glb = vrm0();
    let group = |bone: usize, dir: Value| json!({"bones": [bone], "gravityDir": dir});
    glb.json["extensions"]["VRM"]["secondaryAnimation"]["boneGroups"] =
        json!([group(2, json!({"x": 3, "y": -4, "z": 2})), group(0, json!({"x": 0, "y": 0, "z": 0})), {"bones": [1]}]);
    let scene = loaded(&glb);
    let springs = &character(&scene).springs;
    let dirs: Vec<Vec3> = springs.iter().map(|s| s.joints[0].gravity_dir).collect();
    assert_eq!(dirs, [Vec3::new(-3., -4., 2.), Vec3::ZERO, Vec3::NEG_Y]);
    let plain = springs[2].joints[0];
    assert_eq!((plain.hit_radius, plain.stiffness, plain.gravity_power, plain.drag), (0., 1., 0., 0.5));
}

#[test]
fn colliders_push_in_the_order_of_the_file() {
    let ball = |node: usize| json!({"node": node, "shape": {"sphere": {"radius": 0.1}}});
    let scene = sprung(json!({
        "colliders": [ball(1), ball(2), ball(99), ball(3), ball(4)],
        // Indices of colliders close up where one of the file is left out.
        "colliderGroups": [{"colliders": [4, 0, 4]}, {"colliders": [3, 2, 0, 1]}, {"colliders": [-1, "0", 9]}],
        "springs": [{"joints": [{"node": 5}, {"node": 6}], "colliderGroups": [1, 2, 0, 1, 7]},
                    {"joints": [{"node": 7}, {"node": 8}], "colliderGroups": [0, 1]}]}));
    let lists: Vec<&[usize]> = character(&scene).springs.iter().map(|s| &s.colliders[..]).collect();
    assert_eq!(lists, [[2, 0, 1, 3], [3, 0, 2, 1]]);

    let mut glb = vrm0();
    let group = |node: usize, balls: usize| json!({"node": node, "colliders": vec![json!({"radius": 0.1}); balls]});
    glb.json["extensions"]["VRM"]["secondaryAnimation"] = json!({
        "colliderGroups": [group(1, 2), group(99, 2), group(2, 1)],
        "boneGroups": [{"bones": [2], "colliderGroups": [2, 1, 0, 2]}]});
    assert_eq!(character(&loaded(&glb)).springs[0].colliders, [2, 0, 1]);
}

/// Groups that name each other's colliders over and over must not cost their product.
#[test]
fn a_flood_of_collider_references_is_cut() {
    let n = 1_200;
    let all: Vec<usize> = (0..n).collect();
    let mut glb = Glb::triangle();
    glb.json["nodes"] = json!(vec![json!({}); 2 * n]);
    let head = glb.vrm1();
    let springs: Vec<Value> = (0..n).map(|i| json!({"joints": [{"node": i}], "colliderGroups": all})).collect();
    glb.json["extensions"]["VRMC_springBone"] = json!({
        "colliders": vec![json!({"node": head, "shape": {"sphere": {}}}); n],
        "colliderGroups": vec![json!({"colliders": all}); n], "springs": springs});
    let start = Instant::now();
    let scene = loaded(&glb);
    assert_eq!(places(&scene, "too many springs and colliders").len(), 1);
    assert!(start.elapsed().as_secs_f32() < 5.0, "{:?}", start.elapsed());
}

#[test]
fn springs_over_missing_nodes_end_before_them() {
    let scene = sprung(json!({"springs": [
        {"joints": [{"node": 1}, {"node": 2}, {"node": 99}, {"node": 3}], "center": 99},
        {"joints": [{"node": -1}, {"node": 4}]}, {"joints": [{"node": "hips"}]}, {"joints": 5}, {"joints": [5]}, 7]}));
    let springs = &character(&scene).springs;
    assert_eq!((springs.len(), springs[0].joints.len(), springs[0].center), (1, 2, None));
    let root = "/extensions/VRMC_springBone/springs";
    assert_eq!(places(&scene, "joint on an unknown node"), [format!("{root}/0/joints/2")]);
    assert_eq!(places(&scene, "without usable joints"), [format!("{root}/1")]);

    let mut glb = vrm0();
    glb.json["extensions"]["VRM"]["secondaryAnimation"]["boneGroups"] =
        json!([{"bones": [99, -1, "2", 2], "center": 99}]);
    let scene = loaded(&glb);
    assert_eq!(character(&scene).springs.len(), 1);
    let place = "/extensions/VRM/secondaryAnimation/boneGroups/0/bones/0";
    assert_eq!(places(&scene, "spring bone on an unknown node: skipped (3 times"), [place]);
}

#[test]
fn constraints_in_circles_or_without_a_source_are_left_out() {
    let mut glb = Glb::triangle();
    let head = glb.vrm1();
    let mut constrain = |node: usize, constraint: Value| {
        glb.json["nodes"][node]["extensions"] = json!({"VRMC_node_constraint": {"constraint": constraint}});
    };
    constrain(1, json!({"rotation": {"source": 2}}));
    constrain(2, json!({"aim": {"source": 3, "aimAxis": "PositiveX"}}));
    constrain(3, json!({"roll": {"source": 1, "rollAxis": "Z"}}));
    constrain(4, json!({"rotation": {"source": 1, "weight": 7}}));
    constrain(5, json!({"rotation": {"source": 99}}));
    constrain(6, json!({"rotation": {"source": -1}}));
    constrain(7, json!({"roll": {"source": 1, "rollAxis": "W"}}));
    constrain(8, json!({"rotation": {"source": 8}}));
    constrain(9, json!(5));
    constrain(10, json!({"twist": {}}));
    constrain(11, json!({"rotation": {"source": head, "weight": "much"}}));
    let scene = loaded(&glb);
    let kept: Vec<(usize, f32)> = character(&scene).constraints.iter().map(|c| (c.node, c.weight)).collect();
    assert_eq!(kept, [(4, 1.0), (11, 1.0)], "weights are clamped");
    for (node, name) in [(1, "hips"), (2, "spine"), (3, "leftUpperLeg")] {
        let message = format!("constraint of node \"{name}\" is part of a circle: skipped");
        assert_eq!(places(&scene, &message), [format!("/nodes/{node}")]);
    }
    assert_eq!(places(&scene, "constraint of an unknown kind or source, or on itself: skipped (6 times"), ["/nodes/5"]);
}

#[test]
fn expressions_cannot_override_their_own_kind() {
    let mut glb = Glb::triangle();
    glb.vrm1();
    let all = json!({"overrideBlink": "block", "overrideLookAt": "blend", "overrideMouth": "block"});
    glb.json["extensions"]["VRMC_vrm"]["expressions"] =
        json!({"preset": {"blinkLeft": all, "lookUp": all, "oh": all, "happy": all}, "custom": {"mine": all}});
    let scene = loaded(&glb);
    use ExpressionOverride::{Blend, Block, None};
    for (name, expected) in [
        ("blinkLeft", [None, Blend, Block]),
        ("lookUp", [Block, None, Block]),
        ("oh", [Block, Blend, None]),
        ("happy", [Block, Blend, Block]),
        ("mine", [Block, Blend, Block]),
    ] {
        let e = character(&scene).expressions.iter().find(|e| e.name == name).expect("the expression");
        assert_eq!([e.override_blink, e.override_look_at, e.override_mouth], expected, "{name}");
    }
    let root = "/extensions/VRMC_vrm/expressions/preset";
    assert_eq!(places(&scene, "overrideLookAt of expression lookUp"), [format!("{root}/lookUp")]);
    assert_eq!(places(&scene, "kinds of expressions: ignored").len(), 3);
}

#[test]
fn uv_and_emission_of_vrm0_expressions_are_converted() {
    let mut glb = vrm0();
    let texture = glb.texture(&crate::gltf::picture(image::ImageFormat::Png), "image/png");
    glb.push("materials", json!({"name": "m"}));
    let vrm = &mut glb.json["extensions"]["VRM"];
    vrm["materialProperties"] = json!([{"shader": "VRM/MToon", "textureProperties": {"_MainTex": texture},
        "vectorProperties": {"_MainTex": [0.1, 0.2, 0.5, 0.25]}}]);
    let value = |name: &str, to: Value| json!({"materialName": "m", "propertyName": name, "targetValue": to});
    vrm["blendShapeMaster"]["blendShapeGroups"] = json!([{"presetName": "fun", "materialValues": [
        value("_MainTex_ST", json!([2, 4, 0.1, 0.2])), value("_MainTex_ST_S", json!([2, 4, 0.1, 0.2])),
        value("_MainTex_ST_T", json!([2, 4, 0.1, 0.2])), value("_EmissionColor", json!([0.5, 2, -1, 1]))]}]);
    let scene = loaded(&glb);
    let own = scene.materials[0].base.texture.expect("a texture").transform;
    assert!(close(&own.offset, &[0.1, 0.55], 1e-6) && own.scale == [0.5, 0.25], "{own:?}");
    let expression = &character(&scene).expressions[0];
    let expected = [([2., 4.], [0.1, -3.2]), ([2., 0.25], [0.1, 0.55]), ([0.5, 4.], [0.1, -3.2])];
    for (bind, (scale, offset)) in expression.uv_transforms.iter().zip(expected) {
        assert!(close(&bind.scale, &scale, 1e-6) && close(&bind.offset, &offset, 1e-6), "{bind:?}");
    }
    assert_eq!(expression.uv_transforms.len(), 3);
    // As the material's own emission is read.
    assert!(close(&expression.colors[0].value, &[0.214_041_14, 2f32.powf(2.2), 0., 1.], 1e-5));
}

#[test]
fn first_person_flags_of_both_versions() {
    use hikage::scene::FirstPerson::{Auto, Both, FirstPersonOnly, ThirdPersonOnly};
    let names =
        [("auto", Auto), ("both", Both), ("thirdPersonOnly", ThirdPersonOnly), ("firstPersonOnly", FirstPersonOnly)];
    let mut glb = Glb::triangle();
    glb.vrm1();
    let flags = |key: &str| names.iter().enumerate().map(|(i, (n, _))| json!({key: i, "type": n})).collect::<Vec<_>>();
    let mut list = flags("node");
    list.extend([json!({"node": 99, "type": "both"}), json!(5)]);
    glb.json["extensions"]["VRMC_vrm"]["firstPerson"] = json!({"meshAnnotations": list});
    let scene = loaded(&glb);
    let read: Vec<_> = character(&scene).first_person.values().copied().collect();
    assert_eq!(read, names.map(|(_, flag)| flag));
    assert_eq!(places(&scene, "annotation of an unknown node").len(), 1);

    let mut glb = vrm0();
    glb.json["nodes"][2]["mesh"] = json!(0);
    glb.json["extensions"]["VRM"]["firstPerson"] =
        json!({"meshAnnotations": [{"mesh": 0, "firstPersonFlag": "FirstPersonOnly"}, {"mesh": -1}, "x"]});
    let scene = loaded(&glb);
    let carriers: Vec<usize> = scene.mesh_nodes().map(|(node, _)| node).collect();
    assert_eq!(character(&scene).first_person, carriers.iter().map(|n| (*n, FirstPersonOnly)).collect());
}

/// Names of clips, for those that choose one.
#[test]
fn clips_have_names() {
    let mut glb = movement();
    glb.json["animations"][0]["name"] = json!("Walk");
    let names: Vec<String> = loaded(&glb).animations.into_iter().map(|Animation { name, .. }| name).collect();
    assert_eq!(names, ["Walk"]);
}
