//! What a file carries for looks that use it (`extras.hikage` of a glTF material).

use serde::{Deserialize, Serialize};

use super::TextureRef;

/// Textures that glTF and MToon have no place for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Authored {
    /// A painted highlight (`highlightBand` or `noseLipHighlight`). Default: none.
    pub highlight: Option<TextureRef>,
    /// Blush and lines (`facePaint`). Default: none.
    pub face_paint: Option<TextureRef>,
    /// Normals of painted fur (`detailNormal`). Default: none.
    pub detail_normal: Option<TextureRef>,
    /// Ramps from shade to light for warm and cool light (`rampWarm`, `rampCool`). Default: none.
    pub ramps: Option<[TextureRef; 2]>,
    /// Rows of the ramps (`rampRows`) and the material's own (`rampRow`). Default: 1 and 0.
    pub ramp_rows: [u32; 2],
    /// Numbers of parts (`partId`). Default: none.
    pub part_ids: Option<TextureRef>,
}
