//! Pupils that follow light and expressions, in time: of eyes behind a cornea, and drawn ones.

use glam::Vec3;
use hikage::eye::{EyeDimensions, PupilReflex};
use hikage::material::{Eye, EyeDepth, Material, PupilShape};
use hikage::motion::Pose;
use hikage::scene::{Character, Expression, Primitive, Pupils, Role, Scene};
use hikage::{Renderer, Stage};

use crate::eyeballs::{eyes, linear, matt, open_ball, rays, seen};
use crate::support::{Shoot, Shot, gpu, scene, square, staged, with_renderer};

const SIDE: u32 = 160;

/// A white eye with a black pupil of 4 mm, and the scene's pupils.
fn eye(pupils: Option<Pupils>) -> Scene {
    let of = Eye { pupil_mm: 4.0, pupil_drawn: 0.0, pupil_color: [0.0, 0.0, 0.0, 1.0], caustic: 0.0, ..matt() };
    Scene { pupils, ..eyes(vec![open_ball()], of) }
}

/// By light alone, at the luminance of the light's strength in cd/m².
fn by_light() -> Pupils {
    Pupils { luminance: 1000.0, ..Pupils::default() }
}

fn shot(strength: f32, time_s: f32) -> Shot {
    let mut shot = seen(SIDE, 6.5, [0.0; 2], Vec3::Z);
    shot.lights.directional.intensity = strength;
    shot.time_s = time_s;
    shot
}

/// Diameter of the pupil in a picture, mm: as many pixels as are dark see so much of the iris.
fn diameter_mm(renderer: &Renderer, stage: &mut Stage, shot: &Shot) -> f32 {
    let light = linear(&renderer.shoot(stage, shot).expect("a picture"));
    let human = EyeDimensions::default();
    let mut of_iris: Vec<(f64, f32)> =
        rays(shot).iter().zip(light).filter_map(|(ray, l)| Some((ray.on_iris(&human)?.length(), l.y))).collect();
    of_iris.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Beside the limbus it is dark as well.
    let inner: Vec<(f64, f32)> = of_iris.into_iter().filter(|(q, _)| *q < 0.82).collect();
    let white = inner.iter().fold(0.0f32, |most, (_, l)| most.max(*l));
    assert!(white > 0.0, "no light");
    let dark = inner.iter().filter(|(_, l)| *l < 0.5 * white).count();
    inner.get(dark).map_or(0.82, |(q, _)| *q) as f32 * 2.0 * human.iris_radius_mm
}

/// What a pixel is of the pupil's diameter, mm.
const PIXEL: f32 = 2.0 * 13.0 / SIDE as f32;

#[track_caller]
fn assert_near(found: f32, expected: f32) {
    println!("{found:.3} mm, expected {expected:.3}");
    assert!((found - expected).abs() < PIXEL, "{found} mm, expected {expected}");
}

#[test]
fn pupils_are_as_wide_as_the_light_asks() {
    let gpu = gpu();
    with_renderer(&gpu, |renderer| {
        let found = [1.0, 0.1, 0.01].map(|strength| {
            let mut stage = staged(renderer.upload(&eye(Some(by_light()))));
            let found = diameter_mm(renderer, &mut stage, &shot(strength, 0.0));
            assert_near(found, PupilReflex::steady_mm(1000.0 * strength));
            found
        });
        assert!(found[0] < found[1] && found[1] < found[2], "{found:?}");
        // Half of the way from what the material says; none where the scene has no pupils.
        let mut stage = staged(renderer.upload(&eye(Some(Pupils { reflex: 0.5, ..by_light() }))));
        assert_near(diameter_mm(renderer, &mut stage, &shot(1.0, 0.0)), 0.5 * (4.0 + PupilReflex::steady_mm(1000.0)));
        let mut stage = staged(renderer.upload(&eye(None)));
        for strength in [1.0, 0.01] {
            assert_near(diameter_mm(renderer, &mut stage, &shot(strength, 0.0)), 4.0);
        }
    });
}

/// On the way to the steady diameter, by the time constant of the direction; however many frames there are.
#[test]
fn pupils_follow_a_step_of_light_in_time() {
    let gpu = gpu();
    let [dark, bright] = [10.0, 1000.0].map(PupilReflex::steady_mm);
    with_renderer(&gpu, |renderer| {
        for (from, to, tau, [start, end]) in [(0.01, 1.0, 0.3f32, [dark, bright]), (1.0, 0.01, 1.2, [bright, dark])] {
            let after = |times: &[f32]| {
                let mut stage = staged(renderer.upload(&eye(Some(by_light()))));
                assert_near(diameter_mm(renderer, &mut stage, &shot(from, 2.0)), start);
                let all = times.iter().map(|time| diameter_mm(renderer, &mut stage, &shot(to, 2.0 + time)));
                all.collect::<Vec<f32>>()
            };
            let (whole, halves) = (after(&[0.3]), after(&[0.15, 0.3, 4.0]));
            let expected = |time: f32| end + (start - end) * (-time / tau).exp();
            assert_near(whole[0], expected(0.3));
            assert_near(halves[0], expected(0.15));
            assert!((whole[0] - halves[1]).abs() < 0.3 * PIXEL, "{whole:?} {halves:?}");
            let way = |found: f32| (found - start) / (end - start);
            assert!(0.0 < way(halves[0]) && way(halves[0]) < way(halves[1]) && way(halves[1]) < 1.0, "{halves:?}");
            assert_near(halves[2], expected(4.0));
        }
    });
}

#[test]
fn expressions_widen_and_narrow_them() {
    let gpu = gpu();
    let expression = |name: &str| Expression { name: name.to_owned(), ..Expression::default() };
    let pupils = Pupils {
        reflex: 0.0,
        expressions: [("surprised".to_owned(), 1.8), ("angry".to_owned(), 0.5)].into(),
        ..Pupils::default()
    };
    let mut of = eye(Some(pupils));
    let expressions = vec![expression("surprised"), expression("angry"), expression("happy")];
    of.character = Some(Character { expressions, ..Character::default() });
    with_renderer(&gpu, |renderer| {
        let mut stage = staged(renderer.upload(&of));
        let mut with = |weights: &[(&str, f32)]| {
            let mut pose = Pose::rest(&of);
            pose.express(&of, weights);
            stage.actors[0].pose = pose;
            diameter_mm(renderer, &mut stage, &shot(1.0, 0.0))
        };
        assert_near(with(&[]), 4.0);
        assert_near(with(&[("surprised", 1.0)]), 4.0 * 1.8);
        assert_near(with(&[("surprised", 0.5), ("happy", 1.0)]), 4.0 * 1.4);
        assert_near(with(&[("angry", 1.0)]), 4.0 * 0.5);
        // An application may do it without an expression.
        stage.actors[0].pose = Pose { pupil_scale: 1.5, ..Pose::rest(&of) };
        assert_near(diameter_mm(renderer, &mut stage, &shot(1.0, 0.0)), 6.0);
    });
    let mut unknown = eye(None);
    unknown.pupils = Some(Pupils { expressions: [("absent".to_owned(), 2.0)].into(), ..Pupils::default() });
    let message = with_renderer(&gpu, |r| r.upload(&unknown).expect_err("no such expression")).to_string();
    assert!(message.contains("pupils.expressions") && message.contains("absent"), "{message}");
}

/// 4 mm are a drawn pupil as it is.
#[test]
fn drawn_pupils_follow_as_well() {
    let gpu = gpu();
    let drawn = |pupils: Option<Pupils>| {
        let depth = EyeDepth {
            pupil_shape: PupilShape::Round,
            pupil_color: [0.0, 0.0, 0.0, 1.0],
            pupil_radius: 0.4,
            depth: 0.0,
            ..EyeDepth::default()
        };
        let part = Primitive { role: Role::Eye, ..square([0.0; 2], 0.01, 0.0) };
        Scene { pupils, ..scene(vec![(part, Material { eye_depth: Some(depth), ..Material::default() })]) }
    };
    with_renderer(&gpu, |renderer| {
        let area = |pupils: Option<Pupils>, strength: f32| {
            let mut stage = staged(renderer.upload(&drawn(pupils)));
            let shot = Shot { size: [SIDE; 2], ..shot(strength, 0.0) };
            let light = linear(&renderer.shoot(&mut stage, &shot).expect("a picture"));
            let white = light.iter().fold(0.0f32, |most, l| most.max(l.y));
            light.iter().filter(|l| l.y < 0.5 * white).count() as f32
        };
        let still = area(None, 1.0);
        for strength in [1.0, 0.01] {
            assert_eq!(area(None, strength), still);
            let expected = (PupilReflex::steady_mm(1000.0 * strength) / 4.0).powi(2);
            let found = area(Some(by_light()), strength) / still;
            println!("{found} times as much, expected {expected}");
            assert!((found / expected - 1.0).abs() < 0.03, "{found} times as much, expected {expected}");
        }
    });
}
