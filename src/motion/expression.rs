//! Facial expressions of VRM 1.0 (`VRMC_vrm.expressions`): weights to morphs and material changes.

use super::{Pose, Skeleton};
use crate::{
    Error, Result,
    scene::{Expression, ExpressionOverride, Scene},
};

/// Names of a kind of expressions, and how others override it.
type Kind = (&'static [&'static str], fn(&Expression) -> ExpressionOverride);

/// Kinds of expressions that others may override.
const KINDS: [Kind; 3] = [
    (&["blink", "blinkLeft", "blinkRight"], |e| e.override_blink),
    (&["lookUp", "lookDown", "lookLeft", "lookRight"], |e| e.override_look_at),
    (&["aa", "ih", "ou", "ee", "oh"], |e| e.override_mouth),
];

/// The same from 0 to 1; NaN is nothing.
pub(crate) fn share(weight: f32) -> f32 {
    if weight > 0.0 { weight.min(1.0) } else { 0.0 }
}

/// The kind of each expression, in [`KINDS`]; `None` for those that nothing overrides.
pub(crate) fn kinds_of(expressions: &[Expression]) -> Vec<Option<usize>> {
    let kind = |e: &Expression| KINDS.iter().position(|(names, _)| names.contains(&e.name.as_str()));
    expressions.iter().map(kind).collect()
}

/// Turns what is asked of each expression into what shows of it: clamped to 0..1, binary ones rounded at 0.5, then faded or
/// blocked by others. What overrides its own kind does not.
pub(crate) fn resolve(expressions: &[Expression], kinds: &[Option<usize>], weights: &mut [f32]) {
    let mut amounts = [0f32; KINDS.len()];
    for ((weight, expression), own) in weights.iter_mut().zip(expressions).zip(kinds) {
        *weight = share(*weight);
        if expression.is_binary {
            *weight = f32::from(u8::from(*weight > 0.5));
        }
        for (kind, (_, of)) in KINDS.iter().enumerate().filter(|(kind, _)| *own != Some(*kind)) {
            amounts[kind] += match of(expression) {
                ExpressionOverride::None => 0.0,
                ExpressionOverride::Block => f32::from(u8::from(*weight > 0.0)),
                ExpressionOverride::Blend => *weight,
            };
        }
    }
    for ((weight, expression), kind) in weights.iter_mut().zip(expressions).zip(kinds) {
        let amount = kind.map_or(0.0, |kind| amounts[kind].min(1.0));
        if amount > 0.0 {
            // A binary expression is whole or off, even where another one fades it.
            *weight *= if expression.is_binary { 0.0 } else { 1.0 - amount };
        }
    }
}

impl Pose {
    /// Sets facial expressions; those not named are off. Weights are clamped to 0..1. Morphs that expressions drive start at 0;
    /// where nothing is expressed, all are as the file has them.
    ///
    /// Binary expressions round at 0.5, and expressions that block or blend blinking, gaze or the mouth do so, as VRM
    /// 1.0 rules. What they do to pupils ([`Pupils::expressions`](crate::scene::Pupils::expressions)) is multiplied.
    ///
    /// # Errors
    /// [`Error::Argument`] for a name that the character lacks; the message lists the known names.
    pub fn set_expressions(&mut self, scene: &Scene, weights: &[(String, f32)]) -> Result<()> {
        let expressions = scene.character.as_ref().map_or(&[] as &[Expression], |c| &c.expressions);
        let mut input = vec![0f32; expressions.len()];
        for (name, weight) in weights {
            let Some(index) = expressions.iter().position(|e| e.name == *name) else {
                return Err(unknown(name, expressions));
            };
            input[index] = *weight;
        }
        resolve(expressions, &kinds_of(expressions), &mut input);
        self.morph_weights = scene.nodes.iter().map(|n| n.morph_weights.clone()).collect();
        self.shifts.clear();
        self.pupil_scale = 1.0;
        if input.iter().any(|weight| *weight > 0.0) {
            let bound = expressions.iter().flat_map(|e| &e.morphs);
            bound.for_each(|bind| self.set_morph(bind.node, bind.target, 0.0));
        }
        for (expression, &weight) in expressions.iter().zip(&input) {
            let pupil = scene.pupils.as_ref().and_then(|p| p.expressions.get(&expression.name)).unwrap_or(&1.0);
            self.add_expression(expression, weight, *pupil);
        }
        Ok(())
    }

    /// [`Pose::set_expressions`] for characters of all kinds: names that this one lacks are skipped.
    pub fn express(&mut self, scene: &Scene, weights: &[(&str, f32)]) {
        let expressions = scene.character.as_ref().map_or(&[] as &[Expression], |c| &c.expressions);
        let has = |name: &str| expressions.iter().any(|e| e.name == name);
        let known: Vec<(String, f32)> =
            weights.iter().filter(|(name, _)| has(name)).map(|(name, weight)| ((*name).to_owned(), *weight)).collect();
        // Nothing is left that it could refuse.
        let _ = self.set_expressions(scene, &known);
    }

    /// Shows weights that are [`resolve`]d; morphs that no expression drives stay as they are.
    pub(crate) fn show_expressions(&mut self, skeleton: &Skeleton, weights: &[f32]) {
        for &(node, target) in &skeleton.bound {
            self.set_morph(node as usize, target as usize, 0.0);
        }
        self.shifts.clear();
        self.pupil_scale = 1.0;
        for ((expression, weight), pupil) in skeleton.expressions.iter().zip(weights).zip(&skeleton.pupils) {
            self.add_expression(expression, *weight, *pupil);
        }
    }

    fn set_morph(&mut self, node: usize, target: usize, weight: f32) {
        if let Some(slot) = self.morph_weights.get_mut(node).and_then(|n| n.get_mut(target)) {
            *slot = weight;
        }
    }

    fn add_expression(&mut self, expression: &Expression, weight: f32, pupil: f32) {
        if weight == 0.0 {
            return;
        }
        for bind in &expression.morphs {
            if let Some(w) = self.morph_weights.get_mut(bind.node).and_then(|n| n.get_mut(bind.target)) {
                *w += bind.weight * weight;
            }
        }
        self.shifts.colors.extend(expression.colors.iter().map(|bind| (*bind, weight)));
        self.shifts.uvs.extend(expression.uv_transforms.iter().map(|bind| (*bind, weight)));
        self.pupil_scale *= 1.0 + (pupil - 1.0) * weight;
    }
}

/// The error that names those that there are.
pub(crate) fn unknown(name: &str, expressions: &[Expression]) -> Error {
    let known: Vec<_> = expressions.iter().map(|e| e.name.as_str()).collect();
    let known = if known.is_empty() {
        "none".to_owned()
    } else {
        known.join(", ")
    };
    Error::Argument {
        what: format!("expression {name:?}"),
        message: format!("the model has no such expression; it has: {known}"),
    }
}
