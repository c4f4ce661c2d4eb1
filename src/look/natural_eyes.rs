//! Eyes in natural light: where they are balls, behind a cornea.

use glam::{Mat4, Vec3};

use super::anime::materials_of_any;
use crate::eye::{EyeBone, EyeDimensions, EyeFrame, Eyes, Painted, parts_at_rest};
use crate::material::{Alpha, AlphaMode, CastShadow, Eye};
use crate::scene::{Primitive, Role, Scene};

/// Expression that brings eyeballs forth in the place of drawn eyes.
const EYEBALLS: &str = "eyeballs";
/// Radii within which parts of an eye lie, share of the ball's; and how far ahead all of such a part is.
const OF_EYE: [f32; 2] = [0.6, 1.35];
const AHEAD: f32 = 0.5;
/// Radius from which on a part is the cornea.
const CORNEA: f32 = 0.96;
/// Radius from which on a ball is that of a drawn character, metres, and the iris that it has, share of the radius.
const LARGE_M: f32 = 0.018;
const DRAWN_IRIS: f32 = 0.6;

/// What a material is of an eye.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Layer {
    /// The ball.
    Ball,
    Iris {
        /// Its radius over the ball's.
        radius: f32,
    },
    Cornea,
}

/// Gives materials of eyeballs an [`Eye`]; drawn eyes stay as they are. A character that has both shows its eyeballs.
pub(super) fn apply(scene: &mut Scene) {
    bring_forth(scene);
    let Layers { list: layers, ball_m } = layers(scene);
    let find = |wanted: fn(&Layer) -> bool| layers.iter().find(|(_, layer)| wanted(layer)).map(|(index, _)| *index);
    let (ball, iris) = (find(|l| *l == Layer::Ball), find(|l| matches!(l, Layer::Iris { .. })));
    let white = ball.map(|ball| scene.materials[ball].base);
    let share = layers.iter().find_map(|(_, layer)| match layer {
        Layer::Iris { radius } => Some(*radius),
        _ => None,
    });
    // Irises of drawn characters are as wide as their balls are large.
    let drawn = (ball_m > LARGE_M).then_some(DRAWN_IRIS);
    let dimensions = share.into_iter().chain(drawn).reduce(f32::max).map_or(EyeDimensions::default(), with_iris);
    let picture = iris.and_then(|iris| scene.materials[iris].base.texture);
    let color = iris.map_or([1.0; 3], |iris| {
        let [r, g, b, _] = scene.materials[iris].base.color;
        [r, g, b]
    });
    // Portraits of drawn characters have painted lights; on a real head they would be stickers.
    let preset = if scene.character.is_some() {
        Eye { limbus_strength: 0.35, limbus_width: 0.08, ..Eye::portrait() }
    } else {
        Eye { veins: 0.0, ..Eye::human() }
    };
    for (index, layer) in &layers {
        let material = &mut scene.materials[*index];
        // What is seen through lies over another layer that is painted, or is the cornea, which shows the iris itself.
        if material.alpha.mode == AlphaMode::Blend {
            let mode = if *layer == Layer::Cornea {
                AlphaMode::Opaque
            } else {
                AlphaMode::Mask
            };
            material.alpha = Alpha { mode, ..Alpha::default() };
        }
        if let (Layer::Cornea, Some(white)) = (layer, white) {
            material.base = white;
        }
        let iris_map = picture.filter(|_| !matches!(layer, Layer::Iris { .. }));
        let iris_color = if iris_map.is_some() { color } else { [1.0; 3] };
        material.eye = Some(Eye { dimensions, iris_map, iris_color, ..preset });
        material.cast_shadow = Some(CastShadow { casts: false, ..CastShadow::default() });
        material.double_sided = false;
    }
    as_painted(scene, &layers);
}

/// Measures of an eye with a human iris that is this share of its ball.
fn with_iris(share: f32) -> EyeDimensions {
    let human = EyeDimensions::default();
    let eyeball_radius_mm = (human.iris_radius_mm / share.max(0.1)).clamp(human.cornea_radius_mm, 40.0);
    EyeDimensions { eyeball_radius_mm, ..human }
}

/// Gives eyes the measures that are painted: of the pupil, and where nothing but the picture has one, of the iris.
fn as_painted(scene: &mut Scene, layers: &[(usize, Layer)]) {
    // What is wrong with them the upload says.
    let Ok(eyes) = Eyes::of(scene) else { return };
    for (index, _) in layers {
        let material = &scene.materials[*index];
        let Some(eye) = material.eye else { continue };
        let picture = eye.iris_map.or(material.base.texture);
        let image = picture.and_then(|p| scene.images.get(scene.textures.get(p.texture)?.image));
        let (Some(image), Some(row)) = (image, eyes.rows[*index].first()) else { continue };
        let Some(painted) = Painted::of(image, row) else { continue };
        let mut changed = Eye { pupil_drawn: painted.pupil, ..eye };
        // The parts of an eye say themselves how large its iris is.
        if let (None, Some(iris), [_]) = (eye.iris_map, painted.iris, layers) {
            let share = eye.dimensions.iris_radius_mm / eye.dimensions.eyeball_radius_mm;
            changed.dimensions = with_iris(share * iris);
        }
        scene.materials[*index].eye = Some(changed);
    }
}

/// Makes the pose at rest one with eyeballs, where an expression of the file has them.
fn bring_forth(scene: &mut Scene) {
    let Some(character) = &mut scene.character else { return };
    let Some(expression) = character.expressions.iter_mut().find(|e| e.name == EYEBALLS) else { return };
    for bind in std::mem::take(&mut expression.morphs) {
        let weight = scene.nodes.get_mut(bind.node).and_then(|node| node.morph_weights.get_mut(bind.target));
        if let Some(weight) = weight {
            *weight = bind.weight;
        }
    }
}

/// The eyeballs of a scene.
struct Layers {
    /// Their materials, and what each is.
    list: Vec<(usize, Layer)>,
    /// Radius of the largest ball, metres; 0 where there is none.
    ball_m: f32,
}

fn layers(scene: &Scene) -> Layers {
    let named = materials_of_any(scene, &[Role::Eye, Role::EyeWhite]);
    let bones = EyeBone::of(scene);
    let parts = parts_at_rest(scene);
    let named_parts = parts.iter().filter(|part| named.contains(&part.primitive.material));
    let bodies: Vec<(usize, Primitive)> = named_parts.map(|part| (part.primitive.material, part.body())).collect();
    let of =
        |material: usize| bodies.iter().filter(move |(m, _)| *m == material).map(|(_, body)| (body, Mat4::IDENTITY));
    let frames_of = |material: usize| EyeFrame::of(&of(material).collect::<Vec<_>>(), &bones).ok();
    let balls: Vec<(usize, Vec<EyeFrame>)> = named.iter().filter_map(|m| Some((*m, frames_of(*m)?))).collect();
    let frames: Vec<EyeFrame> = balls.iter().flat_map(|(_, frames)| frames.iter().copied()).collect();
    let mut layers: Vec<(usize, Layer)> = balls.iter().map(|(material, _)| (*material, Layer::Ball)).collect();
    for material in named.iter().filter(|m| balls.iter().all(|(ball, _)| ball != *m)) {
        layers.extend(layer(of(*material).map(|(body, _)| body), &frames).map(|layer| (*material, layer)));
    }
    Layers { list: layers, ball_m: frames.iter().map(|f| f.radius).fold(0.0, f32::max) }
}

/// What parts are that lie about eyeballs, where all of them do.
fn layer<'a>(bodies: impl Iterator<Item = &'a Primitive>, frames: &[EyeFrame]) -> Option<Layer> {
    let (mut sum, mut count, mut widest) = (0.0, 0, 0.0f32);
    for position in bodies.flat_map(|body| &body.positions) {
        let off = |f: &EyeFrame| (Vec3::from(*position) - f.centre) / f.radius;
        let (frame, off) =
            frames.iter().map(|f| (f, off(f))).min_by(|a, b| a.1.length_squared().total_cmp(&b.1.length_squared()))?;
        let (ahead, far) = (off.dot(frame.axis), off.length());
        if ahead < AHEAD || !(OF_EYE[0]..=OF_EYE[1]).contains(&far) {
            return None;
        }
        widest = widest.max(off.reject_from_normalized(frame.axis).length());
        (sum, count) = (sum + far, count + 1);
    }
    let mean = sum / count.max(1) as f32;
    (count > 0).then_some(if mean > CORNEA {
        Layer::Cornea
    } else {
        Layer::Iris { radius: widest }
    })
}
