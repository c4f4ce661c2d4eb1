//! The sheets of eyes.

use hikage::Look;
use hikage::material::{CatchLight, Eye, EyeCard, EyeDepth, PupilShape};
use hikage::scene::Scene;

use super::sheets::{Camera, Panel, Row, Sheet, each_material};
use super::skin::{lit_by_key, without_hair};

/// The sheet that may show another model.
pub(super) const NAME: &str = "eyes";

/// Yaws of the camera, and of the key light.
const VIEWS: [f32; 5] = [-60.0, -30.0, 0.0, 30.0, 60.0];
const LIGHTS: [f32; 5] = [-75.0, -40.0, 0.0, 40.0, 75.0];

/// Radius of the pupil that is painted on the built-in character, with its soft edge, share of the iris'.
const PAINTED: f32 = 0.44;

/// Eyes behind a cornea: view, pupil, light on the iris, limbus, painted lights.
pub(super) fn natural() -> Sheet {
    let studio = |panels| Row { is_plain: true, change: in_studio, panels };
    let dark = |panels| Row { is_plain: true, change: in_key_light, panels };
    let view = |yaw: f32| seen_from(yaw, false, "");
    let pupil = |mm: f32| of(format!("pupil {mm} mm"), move |e| e.pupil_mm = mm);
    let light = |yaw: f32| lit_from(yaw, left(format!("light {yaw:.0}\u{b0}")));
    let limbus = |strength: f32| of(format!("limbus {strength}"), move |e| e.limbus_strength = strength);
    let wide = |width: f32| of(format!("limbus width {width}"), move |e| e.limbus_width = width);
    let caustic = |share: f32| lit_from(60.0, of(format!("caustic {share}"), move |e| e.caustic = share));
    let hollow = |slope: f32| lit_from(60.0, of(format!("hollow {slope}"), move |e| e.hollow = slope));
    let catch = |caption: &str, [key_catch, fill_catch]: [CatchLight; 2]| {
        of(caption.to_owned(), move |e| *e = Eye { key_catch, fill_catch, ..*e })
    };
    let portrait = [Eye::portrait().key_catch, Eye::portrait().fill_catch];
    let following = |yaw: f32| {
        let lights = portrait.map(|light| CatchLight { follow: 1.0, ..light });
        lit_from(yaw, catch(&format!("follow 1, light {yaw:.0}\u{b0}"), lights))
    };
    let both = |yaw: f32| seen_from(yaw, true, "");
    let face = |yaw: f32| Panel { camera: Camera::Head { yaw, height: 1.0 }, ..seen_from(yaw, false, "") };
    Sheet {
        name: NAME,
        title: "Eyes behind a cornea",
        caption: "An iris behind a cornea that refracts (eye), from the right to the left; pupils of 1 to 8 mm; a strong key light \
                  from either side, which gathers on the far half of the iris (caustic); the dark ring (limbus_strength, \
                  limbus_width); the iris without and with gathered light, flat and hollow; painted lights (key_catch, \
                  fill_catch); both eyes, and the face.",
        rows: vec![
            studio(VIEWS.map(view).into()),
            studio([1.0, 2.0, 4.0, 6.0, 8.0].map(pupil).into()),
            dark(LIGHTS.map(light).into()),
            studio([0.0, 0.3, 0.65, 1.0].map(limbus).into_iter().chain([0.05, 0.3].map(wide)).collect()),
            dark([0.0, 1.0].map(caustic).into_iter().chain([0.0, 1.0].map(hollow)).collect()),
            studio(
                [
                    catch("catch lights: none", [CatchLight::default(); 2]),
                    catch("catch lights: portrait", portrait),
                    following(-50.0),
                    following(50.0),
                ]
                .into(),
            ),
            studio([-30.0, 0.0, 30.0].map(both).into()),
            Row {
                is_plain: true,
                change: |scene| Look::Natural.apply(scene),
                panels: [-40.0, 0.0, 40.0].map(face).into(),
            },
        ],
    }
}

/// Drawn eyes: depth, light from below, pupils, and lights that move.
pub(super) fn drawn() -> Sheet {
    let with = |change: fn(&mut Scene), panels| Row { is_plain: false, change, panels };
    let row = |panels| with(without_hair, panels);
    let deep = EyeDepth::deep();
    let view = |name: &str| VIEWS.map(|yaw| seen_from(yaw, false, name)).into();
    let both = |name: &str| [-40.0, 0.0, 40.0].map(|yaw| seen_from(yaw, true, name)).into();
    let below = |share: f32| iris(format!("from_below {share}"), EyeDepth { from_below: share, ..deep });
    let following = |yaw: f32| {
        let depth = EyeDepth { from_below: 1.0, follow_light: 1.0, ..deep };
        lit_from(yaw, iris(format!("follow_light 1, light {yaw:.0}\u{b0}"), depth))
    };
    let round = EyeDepth { pupil_shape: PupilShape::Round, ..deep };
    let shapes = [
        ("painted", deep),
        ("round", round),
        ("slit", EyeDepth::slit()),
        ("heart", EyeDepth::heart()),
        ("star", EyeDepth::star()),
    ];
    let shape = |(name, depth): (&str, EyeDepth)| iris(name.to_owned(), EyeDepth { pupil_drawn: PAINTED, ..depth });
    let scaled = |pupil_scale: f32| {
        iris(format!("pupil_scale {pupil_scale}"), EyeDepth { pupil_drawn: PAINTED, pupil_scale, ..deep })
    };
    Sheet {
        name: "drawn-eyes",
        title: "Drawn eyes with depth",
        caption: "The drawn iris flat, and hollow behind a cornea (eye_depth), from the right to the left; light that gathers below \
                  (from_below) or away from the light (follow_light); shapes of the pupil (pupil_shape) and its size \
                  (pupil_drawn, pupil_scale); both eyes with lights that stay where they are drawn, and that move with the viewer \
                  (eye_card), flat and deep.",
        rows: vec![
            row(view("flat, ")),
            with(deepened, view("deep, ")),
            row([0.0, 0.6, 1.0].map(below).into_iter().chain([-60.0, 60.0].map(following)).collect()),
            row(shapes.map(shape).into()),
            row([0.6, 1.0, 1.5].map(scaled).into()),
            row(both("flat, ")),
            with(with_cards, both("eye_card, ")),
            with(
                |scene| {
                    deepened(scene);
                    with_cards(scene);
                },
                both("deep, eye_card, "),
            ),
        ],
    }
}

fn left(caption: String) -> Panel {
    Panel { caption, camera: Camera::Eyes { both: false, yaw: 0.0 }, ..Panel::default() }
}

fn seen_from(yaw: f32, both: bool, what: &str) -> Panel {
    Panel {
        camera: Camera::Eyes { both, yaw },
        aspect: if both { 2.0 } else { 1.0 },
        ..left(format!("{what}camera {yaw:.0}\u{b0}"))
    }
}

/// The left eye of a scene that was changed.
fn changed(caption: String, change: impl Fn(&mut Scene) + 'static) -> Panel {
    Panel { variants: vec![Box::new(change)], ..left(caption) }
}

/// The left eye with its section changed.
fn of(caption: String, change: impl Fn(&mut Eye) + 'static) -> Panel {
    changed(caption, move |scene| scene.materials.iter_mut().filter_map(|m| m.eye.as_mut()).for_each(&change))
}

/// The left eye with such a drawn iris.
fn iris(caption: String, depth: EyeDepth) -> Panel {
    changed(caption, move |scene| each_material(scene, "EyeIris", |m| m.eye_depth = Some(depth)))
}

fn deepened(scene: &mut Scene) {
    without_hair(scene);
    each_material(scene, "EyeIris", |m| m.eye_depth = Some(EyeDepth::deep()));
}

fn with_cards(scene: &mut Scene) {
    without_hair(scene);
    each_material(scene, "EyeHighlight", |m| m.eye_card = Some(EyeCard::default()));
}

fn lit_from(yaw: f32, panel: Panel) -> Panel {
    Panel { light_deg: [yaw, 25.0], ..panel }
}

fn in_studio(scene: &mut Scene) {
    Look::Natural.apply(scene);
    without_hair(scene);
    // Each is as wide as its panel says.
    scene.pupils = None;
}

fn in_key_light(scene: &mut Scene) {
    in_studio(scene);
    lit_by_key(scene);
}
