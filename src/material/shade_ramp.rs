//! Painted steps from shade to light, warm and cool.

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// Parts that a part id map tells apart.
pub const MAX_PARTS: usize = 8;

/// Colour of a surface from full shade over the terminator to full light, instead of a single border. Everything is said
/// twice, for warm and for cool light ([`Lights::coolness`](crate::scene::Lights::coolness)).
///
/// The place on the ramp is 1/2 where light is about to turn into shade, 0 at `width` of N·L on its dark side and 1 at
/// `width` on the lit side; on a face with a threshold map it is measured by the angle. Received shadow is place 0, so
/// that it has exactly the colour of full shade.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ShadeRamp {
    /// Ramps in pictures; `None`: the numbers below. Default: none.
    pub maps: Option<RampMaps>,
    /// Reach to both sides of the border, in N·L (in angle over π on a face with a map). Range 0.01..1. Default: 0.5.
    pub width: f32,
    /// Without maps: by how much the hue of the shade's colour turns in warm and in cool light, radians, towards yellow from
    /// red, towards cyan from green. Range -π..π. Default: (0, 0).
    pub shade_hue_rad: [f32; 2],
    /// Without maps: its saturation in warm and in cool light; 1 leaves it. Range 0..4. Default: (1, 1).
    pub shade_saturation: [f32; 2],
    /// Without maps: what the lit colour is multiplied by at the terminator, linear. Range 0..1. Default: (0.86, 0.56, 0.5).
    pub terminator_color: [f32; 3],
    /// Without maps: places where the shade begins to turn into the terminator and has done so, and the same for the
    /// terminator and the light; growing. Range 0..1. Default: (0.4, 0.46, 0.5, 0.56).
    pub edges: [f32; 4],
}

impl Default for ShadeRamp {
    fn default() -> Self {
        Self {
            maps: None,
            width: 0.5,
            shade_hue_rad: [0.0; 2],
            shade_saturation: [1.0; 2],
            terminator_color: [0.86, 0.56, 0.5],
            edges: [0.4, 0.46, 0.5, 0.56],
        }
    }
}

impl ShadeRamp {
    /// Whether the numbers change the shade's colour at all.
    pub(crate) fn shifts_shade(&self) -> bool {
        self.shade_hue_rad != [0.0; 2] || self.shade_saturation != [1.0; 2]
    }
}

/// Ramps in pictures, sRGB: factors of the lit colour, from full shade (left) to full light (right), in rows of equal
/// height from the top.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RampMaps {
    /// For warm light.
    pub warm: TextureRef,
    /// For cool light.
    pub cool: TextureRef,
    /// Rows of each picture. Range 1..256. Default: 1.
    pub rows: u32,
    /// Row of the material. Default: 0.
    pub row: u32,
    /// Part ids, linear: the number of a part in the red channel, from 1 on. Default: none.
    pub part_ids: Option<TextureRef>,
    /// Row of each part, where there are ids; 0 in the map is the material's own. Default: 0 for all.
    pub part_rows: [u32; MAX_PARTS],
}

impl Default for RampMaps {
    fn default() -> Self {
        let none = TextureRef::default();
        Self { warm: none, cool: none, rows: 1, row: 0, part_ids: None, part_rows: [0; MAX_PARTS] }
    }
}
