//! What a material has to do with the shadow of a character on itself.

use super::{Section, Surroundings};

crate::section! {
    /// Part of a material in [`SelfShadow`](crate::scene::SelfShadow). Received shadow is shade: it has exactly the shade's
    /// colour, or that of the dark end of a [`ShadeRamp`](super::ShadeRamp). A face with a
    /// [`FaceShadow`](super::FaceShadow) receives it only where its map leaves it to normal shading: on the neck.
    #[derive(Copy)]
    CastShadow = "cast_shadow" {
        needs: &["shadow", "actor"],
        channel: Some((
            "self-shadow",
            "Share of the key light that a character lets through to itself; black where nothing receives its shadow.",
        )),
    }
    {
        /// Whether it casts.
        casts: bool = true;
        /// How far it receives: 0 not at all, 1 whole.
        received: f32 = 1.0, in 0.0..=1.0;
    }
}

impl Section for CastShadow {
    fn is_on(&self, of: &Surroundings<'_>) -> bool {
        of.self_shadow && self.received > 0.0
    }
}
