//! A painted highlight that moves with view and light, as a whole: on hair, nose and lips.

use super::{Options, Section, Surroundings, TextureRef};

crate::section! {
    /// A highlight painted over the surface and moved in its texture coordinates, by the same amount everywhere, so that it
    /// keeps its shape; it fades where the light stands behind the head as it is seen. V, L and F are the directions from the
    /// head to the viewer, to the directional light, and the front of the face; S points to the character's right.
    ///
    /// Source: coordinates move along v by V·L and V·F on hair, and along u by V·S on nose and lips, which grows as the head
    /// turns to the right of the picture.
    #[derive(Copy)]
    Highlight = "highlight" { needs: &["moved"], channel: Some(("highlight", "Share of highlights.")) }
    {
        /// Where it is, linear. Red: the first layer. Green: the second. Blue: strands that stay in place and break the edges
        /// of both. Clamped at its border: what moves out does not come in on the other side.
        map: TextureRef = TextureRef::default(), read LINEAR;
        /// Colour that the lit colour becomes, linear.
        color: [f32; 3] = [1.0; 3], in 0.0..=1.0;
        /// Share of that colour in full.
        strength: f32 = 0.85, in 0.0..=1.0;
        /// Movement along v for V·L.
        light_v: f32 = 0.05, in -1.0..=1.0;
        /// Movement along v for V·F.
        view_v: f32 = 0.05, in -1.0..=1.0;
        /// Movement along u for V·S.
        turn_u: f32 = 0.0, in -1.0..=1.0;
        /// Colour of the second layer, which lies below the first and moves by `second_motion` as much.
        second_color: [f32; 3] = [1.0; 3], in 0.0..=1.0;
        /// Share of it in full; 0 for none.
        second_strength: f32 = 0.0, in 0.0..=1.0;
        /// Its movement over that of the first layer.
        second_motion: f32 = 0.6, in -2.0..=2.0;
        /// How far strands cut into the layers: where the map is not above this share of the strand, nothing is left.
        breakup: f32 = 0.0, in 0.0..=1.0;
        /// Share that is left where the surface is in shade.
        in_shade: f32 = 0.25, in 0.0..=1.0;
        /// Cosine of the angle between V and F at which it has gone; it fades from 0.35 above. Below -1.35 it never does:
        /// hair shines all round.
        facing: f32 = -2.0, in -2.0..=1.0;
    }
}

impl Section for Highlight {
    fn options(&self, on: &mut Options, _: &Surroundings<'_>) {
        let second = self.second_strength > 0.0;
        on.set("highlight_second", second);
        on.set("highlight_apart", second && self.second_motion != 1.0);
        on.set("highlight_breakup", self.breakup > 0.0);
    }
}
