//! Shadow of the bangs, as a face receives it.

use super::{Options, Section, Surroundings};

crate::section! {
    /// How a surface shows the shadow that bangs, hands, clothes and other characters cast on it. Casters, direction and
    /// softness are those of [`Bangs`](crate::scene::Bangs). Where a [`FaceShadow`](super::FaceShadow) leaves a material to
    /// normal shading, as on the neck, there is none.
    #[derive(Copy)]
    BangsShadow = "bangs_shadow" {
        needs: &["bangs", "actor"],
        channel: Some((
            "bangs-shadow",
            "Share of light that bangs, lids and lashes let through; black where nothing receives their shadow.",
        )),
    }
    {
        /// What lit colour is multiplied by in full shadow, linear; a warm dark.
        color: [f32; 3] = [0.86, 0.58, 0.52], in 0.0..=1.0;
        /// Strength.
        strength: f32 = 1.0, in 0.0..=1.0;
        /// Shares of light between which the shadow fades, growing: equal ones give a hard edge.
        edges: [f32; 2] = [0.35, 0.65], in 0.0..=1.0;
        /// Receives the shadow of lids and lashes instead, as drawn eyes do.
        lids: bool = false;
    }
}

impl Section for BangsShadow {
    fn options(&self, on: &mut Options, _: &Surroundings<'_>) {
        on.set("bangs_lids", self.lids);
    }
}
