//! Outline: an inverted hull around the shape, in MToon's colours or in those of what it surrounds.

use serde::{Deserialize, Serialize};

use super::{MAX_PARTS, TextureRef};

/// Outline.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Outline {
    /// Width and its unit. Default: world, 0.
    pub width: OutlineWidth,
    /// Least and greatest width of a line in the world, pixels of a picture 1024 high. Range 0.., growing. Default: none.
    pub clamp_px: Option<[f32; 2]>,
    /// Mask of the width: green channel, linear. Default: none.
    pub width_mask: Option<TextureRef>,
    /// Multiplies the width by the red channel of the vertex colour. Default: false.
    pub vertex_width: bool,
    /// Moves the hull away from the viewer, metres: hides lines inside of the shape that are nearer to it. Range 0..0.1.
    /// Default: 0.
    pub push_m: f32,
    /// Colour, linear. Default: black.
    pub color: [f32; 3],
    /// 0 ignores the surface's shading, 1 multiplies by the shaded colour. Range 0..1. Default: 1.
    pub lighting_mix: f32,
    /// Colour that comes from the surface; `color` and `lighting_mix` do nothing then. Default: none.
    pub tint: Option<OutlineTint>,
}

impl Default for Outline {
    fn default() -> Self {
        Self {
            width: OutlineWidth::World { metres: 0.0 },
            clamp_px: None,
            width_mask: None,
            vertex_width: false,
            push_m: 0.0,
            color: [0.0; 3],
            lighting_mix: 1.0,
            tint: None,
        }
    }
}

/// Width of an outline.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OutlineWidth {
    /// Metres in the world: thinner with distance.
    World {
        /// Width, metres. Range 0...
        metres: f32,
    },
    /// Share of the picture's height: the same at any distance.
    Screen {
        /// Width over picture height. Range 0...
        height_ratio: f32,
    },
}

/// Colour of a line from the surface that it surrounds: darker, with another hue, and never brighter than the light that
/// falls on the character. It does not change along the line, as one that is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct OutlineTint {
    /// Which of its colours. Default: that in shade.
    pub from: TintSource,
    /// Exponent of that colour: more makes it darker and more saturated. Range 0.5..4. Default: 1.5.
    pub gamma: f32,
    /// Turn of its hue, radians, from red towards yellow. Range -π..π. Default: 0.
    pub hue_rad: f32,
    /// Its saturation; 1 leaves it. Range 0..4. Default: 1.2.
    pub saturation: f32,
    /// What it is multiplied by, linear. Default: (0.42, 0.36, 0.4).
    pub factor: [f32; 3],
    /// Colours of parts that an id map tells apart. Default: none.
    pub parts: Option<PartColors>,
}

impl Default for OutlineTint {
    fn default() -> Self {
        Self {
            from: TintSource::Shade,
            gamma: 1.5,
            hue_rad: 0.0,
            saturation: 1.2,
            factor: [0.42, 0.36, 0.4],
            parts: None,
        }
    }
}

/// A colour of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TintSource {
    /// In full light.
    Lit,
    /// In full shade: of the ramp where there is one.
    #[default]
    Shade,
}

/// Colours of lines by the part that they surround.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PartColors {
    /// Part ids, linear: the number of a part in the red channel, from 1 on; others keep the colour of the surface. A
    /// [`ShadeRamp`](super::ShadeRamp) that has part ids lends its map: a material has one.
    pub part_ids: TextureRef,
    /// Colour of each part, linear. Default: black.
    pub colors: [[f32; 3]; MAX_PARTS],
}

impl Default for PartColors {
    fn default() -> Self {
        Self { part_ids: TextureRef::default(), colors: [[0.0; 3]; MAX_PARTS] }
    }
}
