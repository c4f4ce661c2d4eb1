//! Facial expressions of VRM 1.0 (`VRMC_vrm.expressions`): weights to morphs and material changes.

use super::Pose;
use crate::{
    Error, Result,
    scene::{Expression, ExpressionOverride, Scene},
};

const BLINK: &[&str] = &["blink", "blinkLeft", "blinkRight"];
const LOOK_AT: &[&str] = &["lookUp", "lookDown", "lookLeft", "lookRight"];
const MOUTH: &[&str] = &["aa", "ih", "ou", "ee", "oh"];

impl Pose {
    /// Sets facial expressions; those not named are off. Weights are clamped to 0..1.
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
                let known: Vec<_> = expressions.iter().map(|e| e.name.as_str()).collect();
                let known = if known.is_empty() {
                    "none".to_owned()
                } else {
                    known.join(", ")
                };
                return Err(Error::Argument {
                    what: format!("expression {name:?}"),
                    message: format!("the model has no such expression; it has: {known}"),
                });
            };
            input[index] = if weight.is_finite() {
                weight.clamp(0.0, 1.0)
            } else {
                0.0
            };
        }
        for (weight, expression) in input.iter_mut().zip(expressions) {
            if expression.is_binary {
                *weight = if *weight > 0.5 { 1.0 } else { 0.0 };
            }
        }

        let keep = |of: fn(&Expression) -> ExpressionOverride| {
            let suppressed: f32 = expressions
                .iter()
                .zip(&input)
                .map(|(e, &w)| match of(e) {
                    ExpressionOverride::None => 0.0,
                    ExpressionOverride::Block => f32::from(u8::from(w > 0.0)),
                    ExpressionOverride::Blend => w,
                })
                .sum();
            1.0 - suppressed.min(1.0)
        };
        let (blink, look_at, mouth) =
            (keep(|e| e.override_blink), keep(|e| e.override_look_at), keep(|e| e.override_mouth));
        self.morph_weights = scene.nodes.iter().map(|n| n.morph_weights.clone()).collect();
        self.shifts.clear();
        self.pupil_scale = 1.0;
        for (expression, &weight) in expressions.iter().zip(&input) {
            let name = expression.name.as_str();
            let mut factor = 1.0;
            for (group, kept) in [(BLINK, blink), (LOOK_AT, look_at), (MOUTH, mouth)] {
                if group.contains(&name) {
                    factor *= kept;
                }
            }
            // A binary expression is whole or off, even where another one fades it.
            let weight = if expression.is_binary && factor < 1.0 {
                0.0
            } else {
                weight * factor
            };
            if weight > 0.0 {
                self.add_expression(expression, weight);
                let factor = scene.pupils.as_ref().and_then(|p| p.expressions.get(name)).unwrap_or(&1.0);
                self.pupil_scale *= 1.0 + (factor - 1.0) * weight;
            }
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

    fn add_expression(&mut self, expression: &Expression, weight: f32) {
        for bind in &expression.morphs {
            if let Some(w) = self.morph_weights.get_mut(bind.node).and_then(|n| n.get_mut(bind.target)) {
                *w += bind.weight * weight;
            }
        }
        self.shifts.colors.extend(expression.colors.iter().map(|bind| (*bind, weight)));
        self.shifts.uvs.extend(expression.uv_transforms.iter().map(|bind| (*bind, weight)));
    }
}
