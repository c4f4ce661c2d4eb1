//! Outline: an inverted hull around the shape, in MToon's colours or in those of what it surrounds.

use serde::{Deserialize, Serialize};

use super::{Field, MAX_PARTS, Options, Part, Section, Surroundings, TextureRef, Walk, plain_parts};
use crate::color::hue_saturation_columns;
use crate::render::layout::Block;
use crate::scene::ColorTarget;

crate::section! {
    /// Outline.
    #[derive(Copy)]
    Outline = "outline" { unlit: true, of_file: true }
    {
        /// Width and its unit: metres, or a share of the picture's height.
        width: OutlineWidth = OutlineWidth::World { metres: 0.0 }, in 0.0..=10.0;
        /// Least and greatest width of a line in the world, pixels of a picture 1024 high, growing; those that take the
        /// colour of their surface are at most 4 wide without it, as a pen's.
        clamp_px: Option<[f32; 2]> = None, in 0.0..=1000000.0;
        /// Mask of the width: green channel, linear.
        width_mask: Option<TextureRef> = None, read LINEAR;
        /// Multiplies the width by the red channel of the vertex colour.
        vertex_width: bool = false;
        /// Moves the hull away from the viewer, metres: hides lines inside of the shape that are nearer to it.
        push_m: f32 = 0.0, in 0.0..=0.1;
        /// Colour, linear; files hold 0 to 1.
        color: [f32; 3] = [0.0; 3], in 0.0..=100.0;
        /// 0 ignores the surface's shading, 1 multiplies by the shaded colour.
        lighting_mix: f32 = 1.0, in 0.0..=1.0;
        /// Colour that comes from the surface; `color` and `lighting_mix` do nothing then.
        tint: Option<OutlineTint> = None, part OutlineTint;
    }
}

/// Width of an outline.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OutlineWidth {
    /// Metres in the world: thinner with distance.
    World {
        /// Width, metres.
        metres: f32,
    },
    /// Share of the picture's height: the same at any distance.
    Screen {
        /// Width over picture height.
        height_ratio: f32,
    },
}

impl OutlineWidth {
    /// Its number, whatever the unit.
    #[must_use]
    pub fn value(self) -> f32 {
        match self {
            Self::World { metres: width } | Self::Screen { height_ratio: width } => width,
        }
    }
}

impl Part for OutlineWidth {
    fn walk(&mut self, field: &'static Field, walk: &mut Walk<'_>) {
        match self {
            Self::World { metres: width } | Self::Screen { height_ratio: width } => width.walk(field, walk),
        }
    }
}

crate::part! {
    /// Colour of a line from the surface that it surrounds: darker, with another hue, and never brighter than the light that
    /// falls on the character. It does not change along the line, as one that is drawn.
    #[derive(Copy)]
    OutlineTint {
        /// Which of its colours.
        from: TintSource = TintSource::Shade;
        /// Exponent of that colour: more makes it darker and more saturated.
        gamma: f32 = 1.5, in 0.5..=4.0;
        /// Turn of its hue, radians, from red towards yellow.
        hue_rad: f32 = 0.0, in -3.15..=3.15;
        /// Its saturation; 1 leaves it.
        saturation: f32 = 1.2, in 0.0..=4.0;
        /// What it is multiplied by, linear.
        factor: [f32; 3] = [0.42, 0.36, 0.4], in 0.0..=10.0;
        /// Colours of parts that an id map tells apart.
        parts: Option<PartColors> = None, part PartColors;
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
plain_parts!(TintSource);

crate::part! {
    /// Colours of lines by the part that they surround.
    #[derive(Copy)]
    PartColors {
        /// Part ids, linear: the number of a part in the red channel, from 1 on; others keep the colour of the surface.
        part_ids: TextureRef = TextureRef::default(), read LINEAR;
        /// Colour of each part, linear.
        colors: [[f32; 3]; MAX_PARTS] = [[0.0; 3]; MAX_PARTS], in 0.0..=1.0;
    }
}

/// Greatest width of a line in the colour of its surface, pixels of a picture 1024 high.
const PEN_PX: f32 = 4.0;

impl Outline {
    /// Bounds of its width, where there are any.
    fn bounds_px(&self) -> Option<[f32; 2]> {
        self.clamp_px.or(self.tint.map(|_| [0.0, PEN_PX]))
    }

    /// Whether the surface must be shaded for the colour of the line: black stays black whatever the light.
    fn is_mixed(&self, of: &Surroundings<'_>) -> bool {
        let has_color = self.color != [0.0; 3] || of.driven.shifts(ColorTarget::OutlineColor);
        self.tint.is_none() && self.lighting_mix > 0.0 && has_color
    }
}

impl Section for Outline {
    fn put(&self, gpu: &mut Block<'_>, _: &Surroundings<'_>) {
        gpu.put("clamp_px", self.bounds_px().unwrap_or_default());
        let tint = self.tint.unwrap_or_default();
        gpu.put("tint_from_shade", f32::from(u8::from(tint.from == TintSource::Shade)));
        gpu.put("shift", hue_saturation_columns(tint.hue_rad, tint.saturation));
        gpu.put("parts", tint.parts.unwrap_or_default().colors.map(|[r, g, b]| [r, g, b, 1.0]));
    }

    fn options(&self, on: &mut Options, of: &Surroundings<'_>) {
        let is_screen = matches!(self.width, OutlineWidth::Screen { .. });
        on.set("outline_screen", is_screen);
        on.set("outline_bounds", self.bounds_px().is_some() && !is_screen);
        on.set("outline_push", self.push_m > 0.0);
        on.set("outline_mixed", self.is_mixed(of));
        on.set("outline_tint", self.tint.is_some());
        // Colours of strips of hair mean something else.
        on.set("outline_vertex_width", self.vertex_width && of.material.strips.is_none());
    }

    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        // Fire has no contour.
        self.width.value() > 0.0 && !of.material.burns()
    }
}
