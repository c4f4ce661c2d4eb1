//! Looks: what is added to a character as its file describes it.

mod anime;
mod band_marks;
mod hair_band;
mod look_file;
mod natural;
mod natural_eyes;
mod presets;
mod profile_file;
mod shade;
mod shade_texture;
mod values;

pub use look_file::LookFile;
pub use profile_file::ProfileFile;

use serde::{Deserialize, Serialize};

use crate::material::plain_parts;
use crate::scene::Scene;
use crate::sdf::{FaceStyle, Sides};

/// What a character is made to look like.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Look {
    /// As the file says.
    #[default]
    Plain,
    /// The head of a shipped anime game: the shadow of the face is a drawn shape, not a matter of normals; bangs cast
    /// theirs on it; eyes and brows are seen through them; a band of light lies round the hair and follows view and light;
    /// light turns warm before it turns to shade; contours towards the light have a rim.
    Anime(Anime),
    /// Lit and not drawn: physical surfaces as the file says them, hair as strands, shadows that are soft, a studio all round,
    /// no lines.
    Natural,
}

/// The numbers of [`Look::Anime`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Anime {
    /// Painted threshold maps over the face's texture. `None`: they are made from the mesh of each face.
    pub face: Option<Sides>,
    /// How the shadow is drawn that is made from a mesh.
    pub face_style: FaceStyle,
    /// How the band of light is drawn that lies round hair whose file carries none.
    pub band: BandStyle,
}

/// How a band of light on hair is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BandStyle {
    /// One calm line round the head.
    Ring,
    /// A mark on each lock, with points where its strands end.
    #[default]
    Broken,
    /// A zigzag on each lock.
    W,
}
plain_parts!(BandStyle, FaceStyle);

impl Look {
    /// Changes the materials of a scene, before its upload. Roles decide what is what; a scene without a face keeps its
    /// materials, and a face whose two sides share their texture coordinates the shadow of its normals.
    pub fn apply(&self, scene: &mut Scene) {
        match self {
            Self::Plain => {}
            Self::Anime(anime) => anime::apply(scene, anime),
            Self::Natural => natural::apply(scene),
        }
    }
}
