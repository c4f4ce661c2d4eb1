//! Facial expressions by the rules of VRM 1.0: weights, binary ones, overrides, material changes.

use hikage::{
    material::{Base, Material, Shading, TextureRef, Toon},
    motion::{Pose, Shifts},
    scene::{
        Character, ColorBind, ColorTarget, Expression, ExpressionOverride, MorphBind, Node, Pupils, Scene, UvBind,
    },
};

fn morph(name: &str, target: usize) -> Expression {
    Expression {
        name: name.to_owned(),
        morphs: vec![MorphBind { node: 0, target, weight: 1.0 }],
        ..Expression::default()
    }
}

/// Targets: 0 blink, 1 aa, 2 happy, 3 binary.
fn scene() -> Scene {
    let mut happy = morph("happy", 2);
    happy.morphs[0].weight = 0.5;
    happy.override_blink = ExpressionOverride::Block;
    happy.override_mouth = ExpressionOverride::Blend;
    happy.colors = vec![
        ColorBind { material: 0, target: ColorTarget::Color, value: [1.0, 0.0, 0.0, 0.5] },
        ColorBind { material: 0, target: ColorTarget::ShadeColor, value: [0.4, 0.4, 0.4, 1.0] },
        ColorBind { material: 9, target: ColorTarget::Color, value: [0.0; 4] },
    ];
    happy.uv_transforms = vec![UvBind { material: 0, scale: [2.0, 1.0], offset: [0.25, 0.0] }];
    let mut binary = morph("wink", 3);
    binary.is_binary = true;
    let material = Material {
        base: Base { color: [0.0, 1.0, 0.0, 1.0], texture: Some(TextureRef::default()) },
        shading: Shading::Toon(Toon::default()),
        ..Material::default()
    };
    Scene {
        nodes: vec![Node { morph_weights: vec![0.0, 0.1, 0.0, 0.0], ..Node::default() }],
        materials: vec![material],
        character: Some(Character {
            expressions: vec![morph("blink", 0), morph("aa", 1), happy, binary],
            ..Character::default()
        }),
        ..Scene::default()
    }
}

fn weights(expressions: &[(&str, f32)]) -> Vec<f32> {
    let scene = scene();
    let mut pose = Pose::rest(&scene);
    let list: Vec<_> = expressions.iter().map(|(name, w)| ((*name).to_owned(), *w)).collect();
    pose.set_expressions(&scene, &list).expect("known names");
    pose.morph_weights[0].clone()
}

#[test]
fn morphs_that_expressions_drive_start_at_nothing() {
    assert_eq!(weights(&[("blink", 0.5), ("aa", 0.25)]), [0.5, 0.25, 0.0, 0.0]);
    assert_eq!(weights(&[]), [0.0, 0.1, 0.0, 0.0], "the file's own where nothing is expressed");
    assert_eq!(weights(&[("blink", 7.0)]), [1.0, 0.0, 0.0, 0.0], "weights are clamped");
    assert_eq!(weights(&[("blink", f32::NAN)]), [0.0, 0.1, 0.0, 0.0]);
}

#[test]
fn binary_expressions_round_at_a_half() {
    assert_eq!(weights(&[("wink", 0.5)])[3], 0.0);
    assert_eq!(weights(&[("wink", 0.51)])[3], 1.0);
}

#[test]
fn blocking_and_blending_take_others_back() {
    // `happy` at 0.4: blinking is blocked, the mouth keeps 60 %.
    let all = weights(&[("happy", 0.4), ("blink", 1.0), ("aa", 1.0)]);
    for (found, expected) in all.iter().zip([0.0, 0.6, 0.2, 0.0]) {
        assert!((found - expected).abs() < 1e-6, "{all:?}");
    }
}

#[test]
fn colours_and_uvs_move_towards_their_targets() {
    let scene = scene();
    let mut pose = Pose::rest(&scene);
    pose.set_expressions(&scene, &[("happy".to_owned(), 0.5)]).expect("known");
    let posed = pose.shifts.applied(0, &scene.materials[0]);
    assert_eq!(posed.base.color, [0.5, 0.5, 0.0, 0.75]);
    let Shading::Toon(toon) = posed.shading else { panic!("toon") };
    assert_eq!(toon.shade_color, [0.2; 3]);
    let uv = posed.base.texture.expect("a texture").transform;
    assert_eq!((uv.scale, uv.offset), ([1.5, 1.0], [0.125, 0.0]));
    // Whatever an actor has made of the material is shifted in its turn.
    let mut edited = scene.materials[0].clone();
    edited.base.color = [0.0, 0.0, 1.0, 1.0];
    assert_eq!(pose.shifts.applied(0, &edited).base.color[2], 0.5);
    assert_eq!(pose.shifts.applied(1, &edited), edited, "another material");
    pose.set_expressions(&scene, &[]).expect("known");
    assert_eq!(pose.shifts, Shifts::default(), "nothing stays when expressions end");
}

#[test]
fn pupils_widen_and_narrow_with_expressions() {
    let mut scene = scene();
    let scale = |scene: &Scene, expressions: &[(&str, f32)]| {
        let mut pose = Pose::rest(scene);
        pose.express(scene, expressions);
        pose.pupil_scale
    };
    assert_eq!(scale(&scene, &[("happy", 1.0)]), 1.0, "without pupils");
    let expressions = [("happy", 1.5), ("aa", 0.5), ("wink", 2.0), ("blink", 0.2)];
    let expressions = expressions.map(|(name, factor)| (name.to_owned(), factor)).into();
    scene.pupils = Some(Pupils { expressions, ..Pupils::default() });
    for (weights, expected) in [
        (&[][..], 1.0),
        (&[("happy", 1.0)], 1.5),
        (&[("happy", 0.5)], 1.25),
        (&[("happy", 9.0)], 1.5),
        (&[("aa", 1.0)], 0.5),
        (&[("aa", 0.5), ("wink", 0.6)], 1.5),
        // What another expression takes back is not seen in the pupils either.
        (&[("happy", 0.4), ("aa", 1.0), ("blink", 1.0)], 1.2 * 0.7),
        (&[("wink", 0.4)], 1.0),
    ] {
        let found = scale(&scene, weights);
        assert!((found - expected).abs() < 1e-6, "{weights:?}: {found} {expected}");
    }
    let mut pose = Pose::rest(&scene);
    pose.pupil_scale = 2.0;
    pose.set_expressions(&scene, &[]).expect("known");
    assert_eq!((pose.pupil_scale, Pose::default().pupil_scale), (1.0, 1.0), "nothing stays when expressions end");
}

#[test]
fn unknown_names_are_refused_with_the_known_ones() {
    let scene = scene();
    let error = Pose::rest(&scene).set_expressions(&scene, &[("hapy".to_owned(), 1.0)]).expect_err("unknown");
    let text = error.to_string();
    assert!(text.contains("hapy") && text.contains("blink, aa, happy, wink"), "{text}");
}
