//! Thin knit over skin.

use super::Section;

crate::section! {
    /// A stocking: its yarn covers a share of the skin where it is seen face on, and more the more aslant it is seen. With T the
    /// share it lets through face on, it lets through T^(1 / N·V).
    #[derive(Copy)]
    Stocking = "stocking" { channel: Some(("overlay", "Share that decals and stockings cover.")) }
    {
        /// Colour of the yarn, linear; near black.
        color: [f32; 3] = [0.02, 0.02, 0.03], in 0.0..=1.0;
        /// Share of the skin that it covers face on.
        cover: f32 = 0.55, in 0.0..=1.0;
    }
    presets {
        /// Skin shows through, except where it is seen aslant.
        sheer { cover: 0.35 }
        /// Hardly any skin shows through.
        opaque { cover: 0.92 }
    }
}

impl Section for Stocking {}
