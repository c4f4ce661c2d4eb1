//! Pupils that follow light and expressions.

use std::collections::BTreeMap;

use super::Character;
use crate::material::{Field, Part, Walk};

crate::part! {
    /// How pupils follow the light on the face and the expressions: those of materials with an iris, in the place of the
    /// diameter that these say. The reflex is [`PupilReflex`](crate::eye::PupilReflex)'s, by the time of the stage; expressions
    /// set [`Pose::pupil_scale`](crate::motion::Pose::pupil_scale).
    Pupils {
        /// Share of the light reflex: 0 leaves pupils as materials say, 1 follows the light wholly.
        reflex: f32 = 1.0, in 0.0..=1.0;
        /// Luminance that white in a light of strength 1 stands for, cd/m²: 100 is that of a lit room.
        luminance: f32 = 100.0, in 0.001..=100000.0;
        /// Time constant with which they narrow, seconds.
        constriction_s: f32 = 0.3, in 0.0..=10.0;
        /// Time constant with which they widen, seconds.
        dilation_s: f32 = 1.2, in 0.0..=10.0;
        /// What their diameter is multiplied by at weight 1 of an expression, by its name.
        expressions: BTreeMap<String, f32> = BTreeMap::new(), in 0.2..=3.0;
    }
}

impl Pupils {
    /// The name of an expression that the character lacks.
    pub(crate) fn unknown(&self, character: Option<&Character>) -> Option<&str> {
        let has = |name: &str| character.is_some_and(|c| c.expressions.iter().any(|e| e.name == name));
        self.expressions.keys().map(String::as_str).find(|name| !has(name))
    }
}

impl Part for BTreeMap<String, f32> {
    fn walk(&mut self, field: &'static Field, walk: &mut Walk<'_>) {
        self.values_mut().for_each(|value| value.walk(field, walk));
    }
}
