//! Painted steps from shade to light, warm and cool.

use super::{Options, Section, Surroundings, TextureRef};
use crate::color::hue_saturation_columns;
use crate::render::layout::Block;

/// Parts that a part id map tells apart.
pub const MAX_PARTS: usize = 8;

crate::section! {
    /// Colour of a surface from full shade over the terminator to full light, instead of a single border. Everything is said
    /// twice, for warm and for cool light ([`Lights::coolness`](crate::scene::Lights::coolness)).
    ///
    /// The place on the ramp is 1/2 where light is about to turn into shade, 0 at `width` of N·L on its dark side and 1 at
    /// `width` on the lit side; on a face with a threshold map it is measured by the angle. Received shadow is place 0, so
    /// that it has exactly the colour of full shade.
    #[derive(Copy)]
    ShadeRamp = "shade_ramp" {
        on_line: true,
        channel: Some(("shade-ramp", "Place on the ramp from shade to light; black where there is none.")),
    }
    {
        /// Ramps in pictures; `None`: the numbers below.
        maps: Option<RampMaps> = None, part RampMaps;
        /// Reach to both sides of the border, in N·L (in angle over π on a face with a map).
        width: f32 = 0.5, in 0.01..=1.0;
        /// Without maps: by how much the hue of the shade's colour turns in warm and in cool light, radians, towards yellow from
        /// red, towards cyan from green.
        shade_hue_rad: [f32; 2] = [0.0; 2], in -3.15..=3.15;
        /// Without maps: its saturation in warm and in cool light; 1 leaves it.
        shade_saturation: [f32; 2] = [1.0; 2], in 0.0..=4.0;
        /// Without maps: what the lit colour is multiplied by at the terminator, linear.
        terminator_color: [f32; 3] = [0.86, 0.56, 0.5], in 0.0..=1.0;
        /// Without maps: places where the shade begins to turn into the terminator and has done so, and the same for the
        /// terminator and the light; growing.
        edges: [f32; 4] = [0.4, 0.46, 0.5, 0.56], in 0.0..=1.0;
    }
}

crate::part! {
    /// Ramps in pictures, sRGB: factors of the lit colour, from full shade (left) to full light (right), in rows of equal
    /// height from the top.
    #[derive(Copy)]
    RampMaps {
        /// For warm light.
        warm: TextureRef = TextureRef::default(), read RAMP;
        /// For cool light.
        cool: TextureRef = TextureRef::default(), read RAMP;
        /// Rows of each picture.
        rows: u32 = 1, in 1..=256;
        /// Row of the material.
        row: u32 = 0, in 0..=255;
        /// Part ids, linear: the number of a part in the red channel, from 1 on.
        part_ids: Option<TextureRef> = None, read LINEAR;
        /// Row of each part, where there are ids; 0 in the map is the material's own.
        part_rows: [u32; MAX_PARTS] = [0; MAX_PARTS], in 0..=255;
    }
}

impl ShadeRamp {
    /// Whether the numbers change the shade's colour at all.
    fn shifts_shade(&self) -> bool {
        self.maps.is_none() && (self.shade_hue_rad != [0.0; 2] || self.shade_saturation != [1.0; 2])
    }
}

impl Section for ShadeRamp {
    fn put(&self, gpu: &mut Block<'_>, _: &Surroundings<'_>) {
        let maps = self.maps.unwrap_or_default();
        // Middle of a row.
        let row_v = |row: u32| {
            let rows = maps.rows.max(1);
            (row.min(rows - 1) as f32 + 0.5) / rows as f32
        };
        let shift = |set: usize| hue_saturation_columns(self.shade_hue_rad[set], self.shade_saturation[set]);
        gpu.put("v", row_v(maps.row));
        gpu.put("part_v", maps.part_rows.map(row_v));
        gpu.put("shift_warm", shift(0));
        gpu.put("shift_cool", shift(1));
    }

    fn options(&self, on: &mut Options, _: &Surroundings<'_>) {
        on.set("soft", true);
        on.set("shade_ramp_maps", self.maps.is_some());
        on.set("shade_ramp_shift", self.shifts_shade());
    }
}
