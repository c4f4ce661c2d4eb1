//! A painted highlight that moves with view and light, as a whole: on hair, nose and lips.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// A highlight painted over the surface and moved in its texture coordinates, by the same amount everywhere, so that it
/// keeps its shape; it fades where the light stands behind the head as it is seen. V, L and F are the directions from the
/// head to the viewer, to the directional light, and the front of the face; S points to the character's right.
///
/// Source: coordinates move along v by V·L and V·F on hair, and along u by V·S on nose and lips, which grows as the head
/// turns to the right of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Highlight {
    /// Where it is, linear. Red: the first layer. Green: the second. Blue: strands that stay in place and break the edges
    /// of both. Clamped at its border: what moves out does not come in on the other side. Default: texture 0.
    pub map: TextureRef,
    /// Colour that the lit colour becomes, linear. Range 0..1. Default: white.
    pub color: [f32; 3],
    /// Share of that colour in full. Range 0..1. Default: 0.85.
    pub strength: f32,
    /// Movement along v for V·L. Range -1..1. Default: 0.05.
    pub light_v: f32,
    /// Movement along v for V·F. Range -1..1. Default: 0.05.
    pub view_v: f32,
    /// Movement along u for V·S. Range -1..1. Default: 0.
    pub turn_u: f32,
    /// Colour of the second layer, which lies below the first and moves by `second_motion` as much. Range 0..1.
    /// Default: white.
    pub second_color: [f32; 3],
    /// Share of it in full; 0 for none. Range 0..1. Default: 0.
    pub second_strength: f32,
    /// Its movement over that of the first layer. Range -2..2. Default: 0.6.
    pub second_motion: f32,
    /// How far strands cut into the layers: where the map is not above this share of the strand, nothing is left.
    /// Range 0..1. Default: 0.
    pub breakup: f32,
    /// Share that is left where the surface is in shade. Range 0..1. Default: 0.25.
    pub in_shade: f32,
    /// Cosine of the angle between V and F at which it has gone; it fades from 0.35 above. Below -1.35 it never does:
    /// hair shines all round. Default: -2.
    pub facing: f32,
}

impl Default for Highlight {
    fn default() -> Self {
        Self {
            map: TextureRef::default(),
            color: [1.0; 3],
            strength: 0.85,
            light_v: 0.05,
            view_v: 0.05,
            turn_u: 0.0,
            second_color: [1.0; 3],
            second_strength: 0.0,
            second_motion: 0.6,
            breakup: 0.0,
            in_shade: 0.25,
            facing: -2.0,
        }
    }
}
