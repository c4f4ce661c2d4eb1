//! A highlight with a drawn shape, as polished metal and stones have it in a painted world.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// A highlight whose shape is said by numbers or painted. With H halfway between light and viewer, X to the right of the
/// picture and Y upwards, both along the surface, H is moved, squashed, split and squared before it is compared with the
/// normal; a painted shape is looked up by (H·X, H·Y) instead. Edges are one pixel soft.
///
/// Source: Anjyo and Hiramitsu 2003, "Stylized Highlights for Cartoon Rendering and Animation".
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ShapedHighlight {
    /// Painted shape, red channel, linear; its middle stands where H is the normal. A material has one painted highlight:
    /// a [`Highlight`](super::Highlight) comes before it. Default: none.
    pub map: Option<TextureRef>,
    /// Width of the painted shape, in H·X. Range 0.05..4. Default: 1.2.
    pub map_width: f32,
    /// Colour that the surface takes there, times the light's, linear. Range 0..1. Default: white.
    pub color: [f32; 3],
    /// Share of that colour in full. Range 0..1. Default: 0.9.
    pub strength: f32,
    /// Half angle of the unpainted shape, radians: between H and the normal. Range 0.01..1.5. Default: 0.22.
    pub size_rad: f32,
    /// Movement of H along X and Y. Range -1..1. Default: (0, 0).
    pub translate: [f32; 2],
    /// Turn of X and Y about the normal, radians, from X to Y. Range -π..π. Default: 0.
    pub rotate_rad: f32,
    /// How far H is squashed along X, which stretches the highlight along it; 0 not at all. Range 0..0.99. Default: 0.
    pub squash: f32,
    /// Distance by which the halves are split along X and Y; a gap is left where it is more than their size. Range 0..1.
    /// Default: (0, 0).
    pub split: [f32; 2],
    /// How far it is squared: 0 round, 1 a square. Range 0..1. Default: 0.
    pub square: f32,
    /// Share of what is left where the surface is in shade. Range 0..1. Default: 0.35.
    pub in_shade: f32,
    /// Stretch along the direction of brushed metal (the tangent): 0 none, 1 a band across it. Range 0..1. Default: 0.
    pub anisotropy: f32,
    /// How far the matcap takes the place of the lit colour, instead of being added: what polished metal mirrors.
    /// Range 0..1. Default: 0.
    pub matcap_mix: f32,
}

impl Default for ShapedHighlight {
    fn default() -> Self {
        Self {
            map: None,
            map_width: 1.2,
            color: [1.0; 3],
            strength: 0.9,
            size_rad: 0.22,
            translate: [0.0; 2],
            rotate_rad: 0.0,
            squash: 0.0,
            split: [0.0; 2],
            square: 0.0,
            in_shade: 0.35,
            anisotropy: 0.0,
            matcap_mix: 0.0,
        }
    }
}

impl ShapedHighlight {
    /// A square on its edge.
    #[must_use]
    pub fn square() -> Self {
        Self { square: 1.0, rotate_rad: 0.4, ..Self::default() }
    }

    /// The four panes of a window: halves are split farther than they are wide.
    #[must_use]
    pub fn window() -> Self {
        Self { square: 1.0, size_rad: 0.1, split: [0.125, 0.125], rotate_rad: 0.25, ..Self::default() }
    }

    /// Two slanted strokes.
    #[must_use]
    pub fn strokes() -> Self {
        Self { squash: 0.86, size_rad: 0.05, split: [0.0, 0.09], rotate_rad: 0.9, ..Self::default() }
    }

    /// Metal that was brushed along the tangent.
    #[must_use]
    pub fn brushed() -> Self {
        Self { anisotropy: 0.9, size_rad: 0.06, ..Self::default() }
    }
}
