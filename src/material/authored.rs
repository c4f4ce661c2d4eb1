//! What a file carries for looks that use it (`extras.hikage` of a glTF material).

use serde::{Deserialize, Serialize};

use super::{MAX_PARTS, Read, Standard, TextureRef};

/// Textures that glTF and MToon have no place for, and what a toon material does not show.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
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
    /// Row of the ramps of each part, from part 1 on (`partRows`); -1: the material's own. Default: -1.
    pub part_rows: [i32; MAX_PARTS],
    /// Shape of a highlight (`highlightShape`). Default: none.
    pub highlight_shape: Option<TextureRef>,
    /// What a stone encloses (`inclusions`). Default: none.
    pub inclusions: Option<TextureRef>,
    /// Shape of fire (`heat`). Default: none.
    pub heat: Option<TextureRef>,
    /// The physical surface of a metallic-roughness material. Default: none.
    pub surface: Option<Standard>,
    /// What the material is (`substance`). Default: none.
    pub substance: Option<Substance>,
}

impl Default for Authored {
    fn default() -> Self {
        Self {
            highlight: None,
            face_paint: None,
            detail_normal: None,
            ramps: None,
            ramp_rows: [1, 0],
            part_ids: None,
            part_rows: [-1; MAX_PARTS],
            highlight_shape: None,
            inclusions: None,
            heat: None,
            surface: None,
            substance: None,
        }
    }
}

impl Authored {
    /// Visits every texture: its name in the file, how it is read, value.
    pub(crate) fn each_texture(&mut self, visit: &mut dyn FnMut(&'static str, Read, &mut TextureRef)) {
        let Self {
            highlight,
            face_paint,
            detail_normal,
            ramps,
            part_ids,
            highlight_shape,
            inclusions,
            heat,
            surface,
            ..
        } = self;
        for (name, read, texture) in [
            ("highlight", Read::LINEAR, highlight),
            ("facePaint", Read::LINEAR, face_paint),
            ("detailNormal", Read::LINEAR, detail_normal),
            ("partId", Read::LINEAR, part_ids),
            ("highlightShape", Read::LINEAR, highlight_shape),
            ("inclusions", Read::SRGB, inclusions),
            ("heat", Read::LINEAR, heat),
        ] {
            if let Some(texture) = texture {
                visit(name, read, texture);
            }
        }
        if let Some(surface) = surface {
            for (name, texture) in [("metallicRoughness", &mut surface.map), ("occlusion", &mut surface.occlusion)] {
                if let Some(texture) = texture {
                    visit(name, Read::LINEAR, texture);
                }
            }
        }
        if let Some([warm, cool]) = ramps {
            visit("rampWarm", Read::RAMP, warm);
            visit("rampCool", Read::RAMP, cool);
        }
    }
}

/// What a material is, where a look treats it in its own way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Substance {
    /// Polished metal.
    Metal,
    /// A stone as [`Gem::amber`](super::Gem::amber).
    Amber,
    /// A stone as [`Gem::ruby`](super::Gem::ruby).
    Ruby,
    /// A stone as [`Gem::jade`](super::Gem::jade).
    Jade,
    /// A cut stone.
    Diamond,
    /// Fire.
    Fire,
    /// A coat of short hair.
    Fluff,
    /// Thin knit.
    Stocking,
}

impl Substance {
    /// The substance of this name: `metal`, `amber` and so on.
    pub(crate) fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "metal" => Self::Metal,
            "amber" => Self::Amber,
            "ruby" => Self::Ruby,
            "jade" => Self::Jade,
            "diamond" => Self::Diamond,
            "fire" => Self::Fire,
            "fluff" => Self::Fluff,
            "stocking" => Self::Stocking,
            _ => return None,
        })
    }
}
