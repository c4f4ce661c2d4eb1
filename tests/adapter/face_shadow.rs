//! The anime look's face shadow on whole characters.

use std::sync::OnceLock;

use glam::{Mat4, Quat, Vec3};
use hikage::color::LinearRgb;
use hikage::material::{AngleMapping, FaceShadow};
use hikage::motion::Pose;
use hikage::scene::{Ambient, Framing, HumanBone, Image, Role, Scene};
use hikage::sdf::FaceMap;
use hikage::{Look, Renderer};

use crate::support::{self, Lent, Shoot, Shot, gpu, staged};

fn heroine() -> Scene {
    let mut scene = support::anime_heroine();
    support::keep(&mut scene, &[Role::Face]);
    // The face's own shadow alone: what else the look adds has tests of its own.
    for material in &mut scene.materials {
        (material.bangs_shadow, material.highlight, material.depth_rim) = (None, None, None);
    }
    scene
}

fn draw(gpu: &Lent, scene: &Scene, pose: &Pose, view: &Shot) -> Image {
    support::with_renderer(gpu, |renderer| {
        let mut uploaded = staged(renderer.upload(scene));
        uploaded.actors[0].pose = pose.clone();
        renderer.shoot(&mut uploaded, view).expect("a picture")
    })
}

/// Light from an angle to the character's left, level.
fn lit_from(view: &Shot, degrees: f32) -> Shot {
    let mut view = view.clone();
    let (s, c) = degrees.to_radians().sin_cos();
    view.lights.directional.to_light = Vec3::new(s, 0.0, c);
    view
}

/// Of the whole character: what of her is drawn does not move it.
fn portrait() -> Shot {
    static VIEW: OnceLock<Shot> = OnceLock::new();
    let framed = || {
        let mut view = Shot::framed(&support::heroine(), Framing::Face, 0.0, [192, 192]);
        view.lights.ambient = Ambient::uniform(LinearRgb::splat(0.1));
        view
    };
    VIEW.get_or_init(framed).clone()
}

/// Pixels of the cheeks, mouth and chin, before which no hair hangs.
fn cheeks(image: &Image) -> Vec<[u8; 4]> {
    (135..152).flat_map(|y| (82..110).map(move |x| (x, y))).map(|(x, y)| support::pixel(image, x, y)).collect()
}

fn apart(a: &[[u8; 4]], b: &[[u8; 4]], by: u8) -> usize {
    a.iter().zip(b).filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > by)).count()
}

#[test]
fn only_faces_get_a_map_and_a_plain_look_changes_nothing() {
    let scene = heroine();
    let faces: Vec<usize> =
        scene.meshes.iter().flat_map(|m| &m.primitives).filter(|p| p.role == Role::Face).map(|p| p.material).collect();
    for (index, material) in scene.materials.iter().enumerate() {
        assert_eq!(material.face_shadow.is_some(), faces.contains(&index), "{}", material.name);
    }
    let mut plain = scene.clone();
    Look::Plain.apply(&mut plain);
    assert_eq!((plain.materials, plain.textures.len()), (scene.materials, scene.textures.len()));
}

/// Camera, character and light turned alike show the same picture.
#[test]
fn turning_everything_changes_nothing() {
    let (gpu, scene) = (gpu(), heroine());
    let pose = Pose::rest(&scene);
    let view = lit_from(&portrait(), 55.0);
    let reference = draw(&gpu, &scene, &pose, &view);
    for turn in [Quat::from_rotation_y(2.2), Quat::from_euler(glam::EulerRot::YXZ, -0.8, 0.5, 1.0)] {
        let mut turned = view.clone();
        turned.instances = vec![Mat4::from_quat(turn)];
        for v in [
            &mut turned.camera.eye,
            &mut turned.camera.target,
            &mut turned.camera.up,
            &mut turned.lights.directional.to_light,
        ] {
            *v = turn * *v;
        }
        let picture = draw(&gpu, &scene, &pose, &turned);
        // The line of the mouth may fall on other sides of sample points by the rounding of the turn.
        let (a, b) = (cheeks(&reference), cheeks(&picture));
        let wrong = apart(&a, &b, 2);
        assert!(wrong * 100 < a.len(), "{turn}: {wrong} of {} pixels", a.len());
    }
}

/// The face is lit in the frame of the head bone: light that turns with the head leaves its shadow as it is.
#[test]
fn the_shadow_turns_with_the_head() {
    let (gpu, scene) = (gpu(), heroine());
    let head = scene.bone_node(HumanBone::Head).expect("a head");
    let face = |degrees: f32, turn: f32| {
        let mut pose = Pose::rest(&scene);
        pose.locals[head].rotation = Quat::from_rotation_y(turn.to_radians());
        let mut view = lit_from(&portrait(), degrees);
        let (target, turn) = (view.camera.target, Quat::from_rotation_y(turn.to_radians()));
        // The camera goes round the head bone with it.
        let axis = scene.rest_world_from_nodes()[head].w_axis.truncate();
        view.camera.eye = axis + turn * (view.camera.eye - axis);
        view.camera.target = axis + turn * (target - axis);
        cheeks(&draw(&gpu, &scene, &pose, &view))
    };
    let reference = face(70.0, 0.0);
    let turned = face(70.0 + 30.0, 30.0);
    let wrong = apart(&reference, &turned, 8);
    assert!(wrong * 50 < reference.len(), "{wrong} of {} pixels", reference.len());
    // The same light on a turned head is another picture.
    assert!(apart(&reference, &face(70.0, 30.0), 8) * 50 > reference.len(), "the light does not matter");
}

/// Over half a turn of the light in steps of 1 degree no texel of the face lights up again, nor does one jump.
#[test]
fn a_sweep_of_the_light_never_goes_back() {
    let (gpu, mut scene) = (gpu(), heroine());
    for material in &mut scene.materials {
        // Near the neck it follows the normals, which may turn to the light.
        (material.transition, material.shade_ramp) = (None, None);
    }
    let view = portrait();
    let renderer = Renderer::new(&gpu).expect("a renderer");
    let mut uploaded = staged(renderer.upload(&scene));
    let mut last: Option<Vec<u8>> = None;
    let (mut brightest, mut darkest) = (0u8, 255u8);
    for degrees in 0..=180 {
        let image = renderer.shoot(&mut uploaded, &lit_from(&view, degrees as f32)).expect("a picture");
        let now: Vec<u8> = cheeks(&image).into_iter().map(|p| p[1]).collect();
        if let Some(last) = &last {
            let grown = last.iter().zip(&now).filter(|(a, b)| **b > a.saturating_add(1)).count();
            assert_eq!(grown, 0, "pixels light up again at {degrees} degrees");
        }
        brightest = brightest.max(*now.iter().max().unwrap_or(&0));
        darkest = darkest.min(*now.iter().min().unwrap_or(&255));
        last = Some(now);
    }
    assert!(brightest - darkest > 30, "nothing darkened: {darkest} to {brightest}");
}

/// Her face under a map of one texel a layer.
fn with_map(map: FaceMap) -> Scene {
    let mut scene = heroine();
    for face_map in &mut scene.face_maps {
        *face_map = map.clone();
    }
    for material in &mut scene.materials {
        // Nothing but the map: no tint, no drawing.
        (material.transition, material.shade_ramp, material.face_paint) = (None, None, None);
        material.face_shadow = material.face_shadow.map(|f| FaceShadow { softness: 0.1, ..f });
    }
    scene
}

/// One texel: the same threshold on both sides, no normal shading, full strength.
fn texel(tau: f32) -> Vec<[u16; 4]> {
    let code = (tau * 65535.0).round() as u16;
    vec![[code, code, 0, u16::MAX]]
}

/// Mean green of the cheeks under light from an angle and a height.
fn cheek(gpu: &Lent, scene: &Scene, yaw_deg: f32, pitch_deg: f32) -> f32 {
    let mut view = portrait();
    let (yaw, pitch) = (yaw_deg.to_radians(), pitch_deg.to_radians());
    view.lights.directional.to_light = Vec3::new(yaw.sin() * pitch.cos(), pitch.sin(), yaw.cos() * pitch.cos());
    let pixels = cheeks(&draw(gpu, scene, &Pose::rest(scene), &view));
    pixels.iter().map(|p| f32::from(p[1])).sum::<f32>() / pixels.len() as f32
}

/// The height of the light chooses between the maps of a stack, and mixes their thresholds between them; 8 and 16 bits.
#[test]
fn a_stack_of_maps_follows_the_height_of_the_light() {
    let gpu = gpu();
    for is_8_bit in [false, true] {
        let map = FaceMap {
            width: 1,
            height: 1,
            pitches_rad: vec![0.0, 40f32.to_radians()],
            front: vec![texel(0.8), texel(0.2)],
            is_8_bit,
            ..FaceMap::default()
        };
        let scene = with_map(map);
        // At 90 degrees the measure is 1/2: the lower map is lit there, the upper one dark, their mean at its border.
        let [low, middle, high] = [0.0, 20.0, 40.0].map(|pitch| cheek(&gpu, &scene, 90.0, pitch));
        assert!(low > middle + 10.0 && middle > high + 10.0, "{low}, {middle}, {high}; 8 bits: {is_8_bit}");
        let even = (cheek(&gpu, &scene, 90.0, -60.0) - low).abs();
        assert!(even < 8.0, "below the lowest map: {even} apart");
    }
}

/// Behind 100 degrees the second map rules, before 80 the first; masks darken their own sector and side alone.
#[test]
fn second_maps_and_masks_rule_their_sectors() {
    let gpu = gpu();
    let map = FaceMap {
        width: 1,
        height: 1,
        pitches_rad: vec![0.0],
        front: vec![texel(0.95)],
        back: vec![texel(0.3)],
        ..FaceMap::default()
    };
    let scene = with_map(map.clone());
    let at = |scene: &Scene, yaw: f32| cheek(&gpu, scene, yaw, 0.0);
    let (lit, dark) = (at(&scene, 30.0), at(&scene, 140.0));
    assert!(lit > dark + 20.0, "{lit} and {dark}");
    assert!((at(&scene, 75.0) - lit).abs() < 1.0 && (at(&scene, 105.0) - dark).abs() < 1.0);
    assert!((at(&scene, -75.0) - at(&scene, 75.0)).abs() < 1.0, "sides differ");

    // Light from the left is masked at the side, light from the right behind.
    let masked = with_map(FaceMap { back: Vec::new(), masks: vec![[u16::MAX, 0, 0, u16::MAX]], ..map });
    assert!((at(&masked, 30.0) - lit).abs() < 1.0 && (at(&masked, -30.0) - lit).abs() < 1.0, "a mask acts in front");
    assert!((at(&masked, 90.0) - dark).abs() < 1.0 && (at(&masked, -90.0) - lit).abs() < 1.0, "at the side");
    assert!(at(&masked, 150.0) > dark + 5.0 && (at(&masked, -150.0) - dark).abs() < 1.0, "behind");
}

/// Thresholds may be measured by the cosine of the angle: the same map turns dark elsewhere.
#[test]
fn the_cosine_mapping_moves_the_border() {
    let gpu = gpu();
    let map = FaceMap { width: 1, height: 1, pitches_rad: vec![0.0], front: vec![texel(0.25)], ..FaceMap::default() };
    let mut scene = with_map(map);
    for material in &mut scene.materials {
        material.face_shadow = material.face_shadow.map(|f| FaceShadow { softness: 0.01, ..f });
    }
    let linear = [40.0, 50.0].map(|yaw| cheek(&gpu, &scene, yaw, 0.0));
    for material in &mut scene.materials {
        material.face_shadow = material.face_shadow.map(|f| FaceShadow { angle: AngleMapping::Cosine, ..f });
    }
    // (1 - cos 60) / 2 = 1/4.
    let cosine = [55.0, 65.0].map(|yaw| cheek(&gpu, &scene, yaw, 0.0));
    assert!(linear[0] > linear[1] + 20.0 && cosine[0] > cosine[1] + 20.0, "{linear:?}, {cosine:?}");
}
