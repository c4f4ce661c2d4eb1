//! Head, face and eyes.

mod ears;
mod expressions;
mod eyeballs;
mod eyes;
mod face;
mod materials;
mod mouth;
mod paint;
pub mod shape;
mod state;

use crate::model::Model;

/// Height at the upper edge of the face's texture, and metres that it spans: seen from the front, u = 0.5 + x / span
/// and v = (top - y) / span.
pub const UV_TOP: f32 = 1.56;
/// Metres that the face's texture spans in both directions.
pub const UV_METRES: f32 = 0.35;

/// Adds head, eyes, mouth, brows and the expressions.
pub fn add(model: &mut Model) {
    let [mut skin, mut pocket] = face::build(&model.skeleton);
    skin.append(&ears::build(&model.skeleton));
    pocket.append(&mouth::build(&model.skeleton));
    model.parts.push(skin);
    model.parts.push(pocket);
    model.parts.extend(eyes::build(&model.skeleton));
    model.parts.extend(eyeballs::build(&model.skeleton));
    materials::add(model);
    model.expressions.extend(expressions::all());
}
