//! A highlight with a drawn shape, as polished metal and stones have it in a painted world.

use super::{Options, Section, Surroundings, TextureRef};
use crate::render::layout::Block;

crate::section! {
    /// A highlight whose shape is said by numbers or painted. With H halfway between light and viewer, X to the right of the
    /// picture and Y upwards, both along the surface, H is moved, squashed, split and squared before it is compared with the
    /// normal; a painted shape is looked up by (H·X, H·Y) instead. Edges are one pixel soft.
    ///
    /// Source: Anjyo and Hiramitsu 2003, "Stylized Highlights for Cartoon Rendering and Animation".
    #[derive(Copy)]
    ShapedHighlight = "shaped_highlight" { channel: Some(("highlight", "Share of highlights.")) }
    {
        /// Painted shape, red channel, linear; its middle stands where H is the normal.
        map: Option<TextureRef> = None, read LINEAR;
        /// Width of the painted shape, in H·X.
        map_width: f32 = 1.2, in 0.05..=4.0;
        /// Colour that the surface takes there, times the light's, linear.
        color: [f32; 3] = [1.0; 3], in 0.0..=1.0;
        /// Share of that colour in full.
        strength: f32 = 0.9, in 0.0..=1.0;
        /// Half angle of the unpainted shape, radians: between H and the normal.
        size_rad: f32 = 0.22, in 0.01..=1.5;
        /// Movement of H along X and Y.
        translate: [f32; 2] = [0.0; 2], in -1.0..=1.0;
        /// Turn of X and Y about the normal, radians, from X to Y.
        rotate_rad: f32 = 0.0, in -3.15..=3.15;
        /// How far H is squashed along X, which stretches the highlight along it; 0 not at all.
        squash: f32 = 0.0, in 0.0..=0.99;
        /// Distance by which the halves are split along X and Y; a gap is left where it is more than their size.
        split: [f32; 2] = [0.0; 2], in 0.0..=1.0;
        /// How far it is squared: 0 round, 1 a square.
        square: f32 = 0.0, in 0.0..=1.0;
        /// Share of what is left where the surface is in shade.
        in_shade: f32 = 0.35, in 0.0..=1.0;
        /// Stretch along the direction of brushed metal (the tangent): 0 none, 1 a band across it.
        anisotropy: f32 = 0.0, in 0.0..=1.0;
        /// How far the matcap takes the place of the lit colour, instead of being added: what polished metal mirrors.
        matcap_mix: f32 = 0.0, in 0.0..=1.0;
    }
    presets {
        /// A disc.
        round {}
        /// A square on its edge.
        square { square: 1.0, rotate_rad: 0.4 }
        /// The four panes of a window: halves are split farther than they are wide.
        window { square: 1.0, size_rad: 0.1, split: [0.125, 0.125], rotate_rad: 0.25 }
        /// Two slanted strokes.
        strokes { squash: 0.86, size_rad: 0.05, split: [0.0, 0.09], rotate_rad: 0.9 }
        /// Metal that was brushed along the tangent.
        brushed { anisotropy: 0.9, size_rad: 0.06 }
    }
}

impl Section for ShapedHighlight {
    fn put(&self, gpu: &mut Block<'_>, _: &Surroundings<'_>) {
        gpu.put("turn", [self.rotate_rad.cos(), self.rotate_rad.sin()]);
        gpu.put("size_sin", self.size_rad.sin());
        gpu.put("map_scale", 1.0 / self.map_width);
    }

    fn options(&self, on: &mut Options, _: &Surroundings<'_>) {
        on.set("shaped_brushed", self.anisotropy > 0.0);
        // The brush runs along the tangent.
        on.set("tangent", self.anisotropy > 0.0);
    }
}
