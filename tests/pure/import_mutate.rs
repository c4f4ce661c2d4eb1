//! Seeded mutation of good files in this process: whatever the bytes, the importer answers with a scene or an error, and what
//! moves in the scene moves without harm.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::time::Instant;

use glam::Mat4;
use hikage::import::{Limits, load_bytes};
use hikage::motion::{Animator, Blink, Clip, Gaze, Pose, Skeleton};
use hikage::scene::Scene;
use serde_json::{Value, json};

use crate::gltf::{self, F32, Glb, I16, U8, floats, picture, shorts};

const EXECUTIONS: u64 = 200_000;

/// SplitMix64: small, seedable, good enough to pick bytes.
struct Rng(u64);

impl Rng {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }
}

/// Limits that keep a run short; what they guard is tested by the corpora.
fn limits() -> Limits {
    Limits {
        vertices: 2_000,
        indices: 10_000,
        geometry_bytes: 1 << 20,
        image_size: 64,
        nodes: 100,
        ..Limits::default()
    }
}

/// Good files that between them touch every part of the importer.
fn seeds() -> Vec<Glb> {
    let mut skinned = Glb::triangle();
    skinned.attribute("JOINTS_0", U8, "VEC4", &[0, 1, 0, 0].repeat(3), 3, false);
    skinned.attribute("WEIGHTS_0", F32, "VEC4", &floats(&[0.5, 0.5, 0., 0.].repeat(3)), 3, false);
    let matrices = skinned.accessor(F32, "MAT4", &floats(&glam::Mat4::IDENTITY.to_cols_array().repeat(2)), 2, false);
    skinned.json["nodes"] =
        json!([{"mesh": 0, "skin": 0, "children": [1]}, {"children": [2]}, {"rotation": [0, 0, 0, 1]}]);
    skinned.push("skins", json!({"joints": [1, 2], "inverseBindMatrices": matrices}));
    let target = skinned.accessor(F32, "VEC3", &floats(&[0.1; 9]), 3, false);
    skinned.primitive()["targets"] = json!([{"POSITION": target}]);
    let times = skinned.accessor(F32, "SCALAR", &floats(&[0., 1.]), 2, false);
    let values = skinned.accessor(F32, "VEC4", &floats(&[0., 0., 0., 1., 0., 1., 0., 0.]), 2, false);
    let channel = json!({"sampler": 0, "target": {"node": 1, "path": "rotation"}});
    skinned.push("animations", json!({"samplers": [{"input": times, "output": values}], "channels": [channel]}));

    let mut textured = Glb::triangle();
    textured.texture(&picture(image::ImageFormat::Png), "image/png");
    textured.texture(&picture(image::ImageFormat::WebP), "image/webp");
    textured.push("samplers", json!({"wrapS": 33071, "minFilter": 9984}));
    textured.push(
        "materials",
        json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}, "normalTexture": {"index": 1, "scale": 0.5},
               "emissiveTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0]}}}, "alphaMode": "MASK"}),
    );
    textured.primitive()["material"] = json!(0);
    let indices = textured.accessor(U8, "SCALAR", &[0, 1, 2], 3, false);
    textured.primitive()["indices"] = json!(indices);

    let mut vrm1 = Glb::triangle();
    let head = vrm1.vrm1();
    let target = vrm1.accessor(F32, "VEC3", &floats(&[0.1; 9]), 3, false);
    vrm1.primitive()["targets"] = json!([{"POSITION": target}]);
    vrm1.push("materials", json!({"name": "face", "extensions": {"VRMC_materials_mtoon": {"specVersion": "1.0", "outlineWidthMode": "worldCoordinates"}}}));
    vrm1.primitive()["material"] = json!(0);
    let constraints = [
        (2, json!({"roll": {"source": 3, "rollAxis": "X"}})),
        (3, json!({"aim": {"source": head, "aimAxis": "NegativeZ", "weight": 0.5}})),
        (4, json!({"rotation": {"source": 1}})),
        // A circle.
        (5, json!({"rotation": {"source": 6}})),
        (6, json!({"roll": {"source": 5, "rollAxis": "Y"}})),
    ];
    for (node, constraint) in constraints {
        vrm1.json["nodes"][node]["extensions"] = json!({"VRMC_node_constraint": {"constraint": constraint}});
    }
    let ext = &mut vrm1.json["extensions"]["VRMC_vrm"];
    ext["expressions"] = json!({"preset": {
        "happy": {"morphTargetBinds": [{"node": 0, "index": 0, "weight": 1}], "overrideBlink": "blend",
                  "materialColorBinds": [{"material": 0, "type": "color", "targetValue": [1, 0, 0, 1]}]},
        "blink": {"isBinary": true, "overrideBlink": "block", "textureTransformBinds": [{"material": 0, "scale": [1, 2]}]}}});
    ext["lookAt"] = json!({"type": "bone", "offsetFromHeadBone": [0, 0.1, 0], "rangeMapVerticalUp": {"inputMaxValue": 60, "outputScale": 5}});
    ext["firstPerson"] =
        json!({"meshAnnotations": [{"node": 0, "type": "thirdPersonOnly"}, {"node": 1, "type": "auto"}]});
    let extended = |shape: Value| json!({"node": 1, "shape": {"sphere": {"radius": 1}}, "extensions": {"VRMC_springBone_extended_collider": {"shape": shape}}});
    vrm1.json["extensions"]["VRMC_springBone"] = json!({
        "colliders": [{"node": 1, "shape": {"capsule": {"radius": 1, "tail": [0, 1, 0]}}}, extended(json!({"plane": {"normal": [0, 1, 0]}})),
                      extended(json!({"sphere": {"radius": 2, "inside": true}}))],
        "colliderGroups": [{"colliders": [2, 0]}, {"colliders": [1, 0]}],
        "springs": [{"joints": [{"node": head - 2, "gravityPower": 1, "gravityDir": [0, -2, 0]}, {"node": head - 1, "hitRadius": 0.1}, {"node": head}],
                     "colliderGroups": [1, 0], "center": 1}]});

    let mut vrm0 = Glb::triangle();
    vrm0.push("nodes", json!({"name": "hips", "children": [2], "translation": [0, 1, 0]}));
    vrm0.push("nodes", json!({"name": "head", "translation": [0, 1, 0]}));
    vrm0.push("materials", json!({"name": "a"}));
    vrm0.json["extensions"]["VRM"] = json!({
        "humanoid": {"humanBones": [{"bone": "hips", "node": 1}, {"bone": "head", "node": 2}]},
        "materialProperties": [{"shader": "VRM/MToon", "floatProperties": {"_ShadeToony": 0.9}, "vectorProperties": {"_Color": [1, 1, 1, 1]},
                                "keywordMap": {"_ALPHABLEND_ON": true}, "renderQueue": 3000}],
        "blendShapeMaster": {"blendShapeGroups": [{"presetName": "joy", "binds": [{"mesh": 0, "index": 0, "weight": 50}],
            "materialValues": [{"materialName": "a", "propertyName": "_MainTex_ST", "targetValue": [1, 2, 0, 0.5]}]}]},
        "firstPerson": {"firstPersonBoneOffset": {"x": 0, "y": 0.1, "z": 0}, "lookAtTypeName": "BlendShape", "meshAnnotations": [{"mesh": 0, "firstPersonFlag": "ThirdPersonOnly"}],
            "lookAtVerticalUp": {"xRange": 40, "yRange": 2, "curve": [0, 0, 0, 0.5, 0.5, 0.3, 1, 2, 1, 1, 0, 0]}},
        "secondaryAnimation": {"colliderGroups": [{"node": 2, "colliders": [{"radius": 0.5}]}], "boneGroups": [{"bones": [1], "colliderGroups": [0], "gravityPower": 1, "gravityDir": {"x": 0, "y": -1, "z": 0}, "center": 0}]}});

    let mut packed = Glb::triangle();
    let data = meshopt::encode_vertex_buffer(&[[0f32, 0., 0.], [1., 0., 0.], [0., 1., 0.]]).expect("encodes");
    let source = packed.view(&data);
    let source = packed.json["bufferViews"][source].clone();
    packed.json["bufferViews"][0]["extensions"] = json!({"EXT_meshopt_compression": {"buffer": 0, "byteOffset": source["byteOffset"],
        "byteLength": source["byteLength"], "byteStride": 12, "count": 3, "mode": "ATTRIBUTES"}});
    let at = packed.view(&[1]);
    let values = packed.view(&floats(&[2., 2., 2.]));
    packed.json["accessors"][1]["sparse"] =
        json!({"count": 1, "indices": {"bufferView": at, "componentType": U8}, "values": {"bufferView": values}});
    vec![skinned, textured, vrm1, vrm0, packed, moving(), movement()]
}

/// Keys of every kind for every property.
fn moving() -> Glb {
    let mut glb = Glb::triangle();
    let target = glb.accessor(F32, "VEC3", &floats(&[0.1; 9]), 3, false);
    glb.primitive()["targets"] = json!([{"POSITION": target}]);
    glb.push("nodes", json!({"matrix": glam::Mat4::IDENTITY.to_cols_array()}));
    glb.json["nodes"][0]["children"] = json!([1]);
    let times = glb.accessor(F32, "SCALAR", &floats(&[0., 0.5]), 2, false);
    let outputs = [
        (glb.accessor(F32, "VEC3", &floats(&[0., 1., 0., 1., 0., 0.]), 2, false), "STEP", 0, "translation"),
        (glb.accessor(I16, "VEC4", &shorts(&[0, 0, 0, 32767, 0, 32767, 0, 0]), 2, true), "LINEAR", 0, "rotation"),
        (glb.accessor(F32, "VEC3", &floats(&[1.; 18]), 6, false), "CUBICSPLINE", 0, "scale"),
        (glb.accessor(U8, "SCALAR", &[0, 255], 2, true), "LINEAR", 0, "weights"),
        (glb.accessor(F32, "VEC4", &floats(&[0.5; 24]), 6, false), "CUBICSPLINE", 1, "rotation"),
        (glb.accessor(F32, "VEC3", &floats(&[0., 1., 0., 1., 0., 0.]), 2, false), "LINEAR", 1, "translation"),
    ];
    let samplers = outputs.map(|(output, mode, ..)| json!({"input": times, "output": output, "interpolation": mode}));
    let target = |(i, (_, _, node, path))| json!({"sampler": i, "target": {"node": node, "path": path}});
    let channels: Vec<Value> = outputs.into_iter().enumerate().map(target).collect();
    glb.push("animations", json!({"name": "all", "samplers": samplers, "channels": channels}));
    glb
}

/// A file of movements: hips, head, an expression, the gaze.
fn movement() -> Glb {
    let mut glb = Glb::new();
    glb.json = json!({
        "asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], "buffers": [{"byteLength": 0}],
        "nodes": [{"translation": [0, 1, 0], "children": [1]}, {"rotation": [0, 0, 0, 1]}, {}, {}],
        "extensions": {"VRMC_vrm_animation": {"specVersion": "1.0", "humanoid": {"humanBones": {"hips": {"node": 0}, "head": {"node": 1}}},
            "expressions": {"preset": {"happy": {"node": 2}}, "custom": {"wink": {"node": 2}}}, "lookAt": {"node": 3}}}});
    let times = glb.accessor(F32, "SCALAR", &floats(&[0., 0.5]), 2, false);
    let places = glb.accessor(F32, "VEC3", &floats(&[0., 1., 0., 1., 0., 0.]), 2, false);
    let turns = glb.accessor(F32, "VEC4", &floats(&[0., 0., 0., 1., 0., 1., 0., 0.]), 2, false);
    let channels =
        [(0, 0, "translation"), (1, 0, "rotation"), (1, 1, "rotation"), (0, 2, "translation"), (1, 3, "rotation")];
    glb.push("animations", json!({
        "samplers": [{"input": times, "output": places}, {"input": times, "output": turns, "interpolation": "STEP"}],
        "channels": channels.map(|(sampler, node, path)| json!({"sampler": sampler, "target": {"node": node, "path": path}}))}));
    glb
}

/// Flips, overwrites, cuts, repeats and inserts bytes.
fn mutate_bytes(bytes: &mut Vec<u8>, rng: &mut Rng) {
    for _ in 0..=rng.below(4) {
        if bytes.is_empty() {
            return;
        }
        let at = rng.below(bytes.len());
        match rng.below(6) {
            0 => bytes[at] ^= 1 << rng.below(8),
            1 => bytes[at] = [0, 0xFF, 0x7F, 0x80, b'"', b'9', b'-'][rng.below(7)],
            2 => bytes.truncate(at),
            3 => {
                let end = (at + rng.below(16)).min(bytes.len());
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
            4 => bytes.insert(at, rng.next() as u8),
            _ => {
                let words = [0u32, 1, 0xFFFF_FFFF, 0x7FFF_FFFF, 0x7FC0_0000, 0x7F80_0000, 0x7F7F_FFFF, 0xFF7F_FFFF];
                let word = words[rng.below(words.len())];
                let end = (at + 4).min(bytes.len());
                bytes[at..end].copy_from_slice(&word.to_le_bytes()[..end - at]);
            }
        }
    }
}

/// Replaces, removes or repeats one value somewhere in the JSON.
fn mutate_json(at: &mut Value, rng: &mut Rng) {
    let go_on = rng.below(5) > 0;
    match at {
        Value::Object(map) if !map.is_empty() => {
            let key = map.keys().nth(rng.below(map.len())).expect("not empty").clone();
            if go_on {
                mutate_json(map.get_mut(&key).expect("it is there"), rng);
            } else {
                map.remove(&key);
            }
        }
        Value::Array(list) if !list.is_empty() => {
            let index = rng.below(list.len());
            if go_on {
                mutate_json(&mut list[index], rng);
            } else {
                let copy = list[index].clone();
                list.push(copy);
            }
        }
        leaf => *leaf = odd_value(rng),
    }
}

/// A value that is wrong, extreme, or right somewhere else.
fn odd_value(rng: &mut Rng) -> Value {
    let values = [
        json!(null),
        json!(0),
        json!(1),
        json!(2),
        json!(-1),
        json!(5),
        json!(255),
        json!(65535),
        json!(4_294_967_295u64),
        json!(9_223_372_036_854_775_807u64),
        json!(u64::MAX),
        json!(1e39),
        json!(-1e300),
        json!(0.5),
        json!(1e-45),
        json!(3.4e38),
        json!(-3.4e38),
        json!([]),
        json!({}),
        json!(""),
        json!("VEC3"),
        json!("CUBICSPLINE"),
        json!("weights"),
        json!("../x"),
        json!("data:,"),
        json!(true),
        json!([0]),
        json!([1, 2, 3]),
        json!([0, 0, 0, 0]),
    ];
    let kinds = [5120, 5121, 5122, 5123, 5125, 5126];
    match rng.below(10) {
        0 => json!(kinds[rng.below(6)]),
        1 => json!(["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"][rng.below(7)]),
        2 => json!(rng.below(12)),
        _ => values[rng.below(values.len())].clone(),
    }
}

/// A few frames of all that moves: its clip, the gaze, expressions, constraints, springs. A file of movements moves the hero.
/// Whatever the file says, nothing of the pose may be NaN or infinite: what is.
fn animate(scene: &Scene, hero: &Scene) -> Option<String> {
    let moved = if scene.animation_rig.is_some() { hero } else { scene };
    let skeleton = Skeleton::of(moved);
    let mut animator = Animator::default();
    animator.gaze = Gaze::at([1.0, 2.0, 3.0]).with_head(0.5);
    animator.gaze.saccades = Some(1);
    animator.blink = Some(Blink::default());
    if let Ok(clip) = Clip::of(scene, 0, moved) {
        animator.player.play(&Arc::new(clip));
    }
    for expression in moved.character.iter().flat_map(|c| &c.expressions) {
        animator.set_expression(&skeleton, &expression.name, 0.75).expect("it has it");
    }
    let (mut world, mut pose) = (Mat4::from_rotation_y(0.1), Pose::rest(moved));
    for _ in 0..3 {
        world.w_axis.x += 0.1;
        animator.update(&skeleton, &mut world, &mut pose, 0.04);
        for (node, local) in pose.locals.iter().enumerate() {
            if !(local.translation.is_finite() && local.rotation.is_finite() && local.scale.is_finite()) {
                return Some(format!("node {node}: {local:?}"));
            }
        }
        if let Some(weights) = pose.morph_weights.iter().find(|list| !list.iter().all(|w| w.is_finite())) {
            return Some(format!("morph weights {weights:?}"));
        }
    }
    (!world.is_finite()).then(|| format!("world {world}"))
}

/// Runs one thread's share; returns how many files loaded.
fn run(thread: u64, threads: u64, seeds: &[(Value, Vec<u8>, Vec<u8>)], hero: &Scene) -> u64 {
    let limits = limits();
    let mut loaded = 0;
    for execution in (thread..EXECUTIONS).step_by(threads as usize) {
        let mut rng = Rng(execution);
        let (json, bin, whole) = &seeds[rng.below(seeds.len())];
        let kind = rng.below(3);
        let bytes = if kind == 0 {
            let mut bytes = whole.clone();
            mutate_bytes(&mut bytes, &mut rng);
            bytes
        } else if kind == 1 {
            let mut bin = bin.clone();
            mutate_bytes(&mut bin, &mut rng);
            // Cut data is the other kinds' business: here values, indices and images change.
            bin.resize(bin.len().max(whole.len()), 0);
            gltf::glb(&serde_json::to_vec(json).expect("JSON"), &bin)
        } else {
            let mut json = json.clone();
            for _ in 0..=rng.below(3) {
                mutate_json(&mut json, &mut rng);
            }
            gltf::glb(&serde_json::to_vec(&json).expect("JSON"), bin)
        };
        let Ok(result) = catch_unwind(AssertUnwindSafe(|| load_bytes("mutant", &bytes, None, &limits))) else {
            panic!("the importer panicked on execution {execution}");
        };
        let Ok(scene) = result else { continue };
        loaded += 1;
        match catch_unwind(AssertUnwindSafe(|| animate(&scene, hero))) {
            Ok(None) => {}
            Ok(Some(what)) => panic!("motion of execution {execution} is not finite: {what}"),
            Err(_) => panic!("motion panicked on execution {execution}"),
        }
    }
    loaded
}

#[test]
fn two_hundred_thousand_mutants_do_no_harm() {
    let seeds = seeds();
    let hero = seeds[2].load().expect("the seed itself loads");
    let seeds: Vec<_> = seeds
        .into_iter()
        .map(|mut glb| {
            glb.load().expect("the seed itself loads");
            glb.json["buffers"][0]["byteLength"] = json!(glb.bin.len());
            let whole = glb.bytes();
            (glb.json, glb.bin, whole)
        })
        .collect();
    let start = Instant::now();
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u64);
    let loaded: u64 = std::thread::scope(|scope| {
        let work: Vec<_> = (0..threads)
            .map(|t| {
                scope.spawn({
                    let (seeds, hero) = (&seeds, &hero);
                    move || run(t, threads, seeds, hero)
                })
            })
            .collect();
        work.into_iter().map(|w| w.join().expect("no thread panics")).sum()
    });
    println!("{EXECUTIONS} mutants, {loaded} loaded, {:?}", start.elapsed());
    // Mutants that all fail at the first byte would test nothing.
    assert!(loaded > EXECUTIONS / 20 && loaded < EXECUTIONS, "{loaded} of {EXECUTIONS} loaded");
}
