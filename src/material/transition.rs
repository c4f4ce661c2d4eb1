//! A gentle second band on the lit side of the border of light and shade.

use super::{Options, Section, Surroundings};

crate::section! {
    /// Light that passes into shade through a colour, as it does through skin: the lit colour is tinted where the surface is
    /// about to turn dark. Works on normals and on a [`FaceShadow`](super::FaceShadow) alike; a
    /// [`ShadeRamp`](super::ShadeRamp) takes its place.
    #[derive(Copy)]
    Transition = "transition" {
        on_line: true,
        channel: Some(("transition", "Tint of light that is about to turn into shade; white where it does nothing.")),
    }
    {
        /// What the lit colour is multiplied by at the border, linear; a warm blush.
        color: [f32; 3] = [1.0, 0.86, 0.81], in 0.0..=1.0;
        /// Strength.
        strength: f32 = 1.0, in 0.0..=1.0;
        /// How far it reaches from the border into the light: in angle over π on a face with a map, in N·L elsewhere.
        width: f32 = 0.2, in 0.01..=1.0;
    }
}

impl Section for Transition {
    fn options(&self, on: &mut Options, _: &Surroundings<'_>) {
        on.set("soft", true);
    }

    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        of.material.shade_ramp.is_none() && self.strength > 0.0
    }
}
