//! Thin knit over skin.

use serde::{Deserialize, Serialize};

/// A stocking: its yarn covers a share of the skin where it is seen face on, and more the more aslant it is seen. With T the
/// share it lets through face on, it lets through T^(1 / N·V).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Stocking {
    /// Colour of the yarn, linear. Range 0..1. Default: near black, (0.02, 0.02, 0.03).
    pub color: [f32; 3],
    /// Share of the skin that it covers face on. Range 0..1. Default: 0.55.
    pub cover: f32,
}

impl Default for Stocking {
    fn default() -> Self {
        Self { color: [0.02, 0.02, 0.03], cover: 0.55 }
    }
}

impl Stocking {
    /// Skin shows through, except where it is seen aslant.
    #[must_use]
    pub fn sheer() -> Self {
        Self { cover: 0.35, ..Self::default() }
    }

    /// Hardly any skin shows through.
    #[must_use]
    pub fn opaque() -> Self {
        Self { cover: 0.92, ..Self::default() }
    }
}
