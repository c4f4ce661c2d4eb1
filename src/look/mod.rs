//! Looks: what is added to a character as its file describes it.

mod anime;
mod hair_band;
mod look_file;
mod natural;
mod natural_eyes;
mod presets;
mod profile_file;
mod values;

pub use look_file::LookFile;
pub use profile_file::ProfileFile;

use crate::scene::Scene;
use crate::sdf::Sides;

/// What a character is made to look like.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Look {
    /// As the file says.
    #[default]
    Plain,
    /// The head of a shipped anime game: the shadow of the face is a drawn shape, not a matter of normals; bangs cast
    /// theirs on it; eyes and brows are seen through them; a band of light lies round the hair and follows view and light;
    /// light turns warm before it turns to shade; contours towards the light have a rim.
    Anime {
        /// Painted threshold maps over the face's texture. `None`: they are made from the mesh of each face.
        face: Option<Sides>,
    },
    /// Lit and not drawn: physical surfaces as the file says them, hair as strands, shadows that are soft, a studio all round,
    /// no lines.
    Natural,
}

impl Look {
    /// Changes the materials of a scene, before its upload. Roles decide what is what; a scene without a face keeps its
    /// materials, and a face whose two sides share their texture coordinates the shadow of its normals.
    pub fn apply(&self, scene: &mut Scene) {
        match self {
            Self::Plain => {}
            Self::Anime { face } => anime::apply(scene, face.as_ref()),
            Self::Natural => natural::apply(scene),
        }
    }
}
