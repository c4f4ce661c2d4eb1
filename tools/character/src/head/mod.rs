//! Head, face and eyes.

mod cavities;
mod ears;
mod expressions;
mod eyeballs;
mod eyes;
mod face;
mod features;
mod grid;
mod lashes;
mod materials;
mod mouth;
mod paint;
mod paint_eyes;
pub mod sdf;
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

/// Heights of the lids of her left eye (right for `blinkRight`), by morph: for points along the upper and the lower lid,
/// height at weight 0 and at weight 1, metres.
#[must_use]
pub fn lids() -> Vec<(&'static str, [Vec<[f32; 2]>; 2])> {
    let rest = state::Eye::default();
    expressions::STATES
        .iter()
        .map(|(name, state)| {
            let eye = state().eyes[usize::from(*name == "blinkRight")];
            let lid = |k: usize| grid::lid_columns().map(|s| [rest.lids(s)[k], eye.lids(s)[k]]).collect();
            (*name, [lid(0), lid(1)])
        })
        .collect()
}
