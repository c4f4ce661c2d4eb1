//! What a part of a character is: passes go by role, never by material name.

/// The role of a mesh part. Guessed at import from VRM data, bones and names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Role {
    /// Skin of the face, including ears where they share its material.
    Face,
    /// Hair that hangs over the face: bangs and side locks.
    HairFront,
    /// All other hair.
    Hair,
    /// Iris and pupil.
    Eye,
    /// Lights drawn on the eye.
    EyeHighlight,
    /// White of the eye.
    EyeWhite,
    /// Lashes and lid lines.
    Lash,
    /// Eyebrows.
    Brow,
    /// Inside of the mouth, teeth, tongue.
    Mouth,
    /// Skin of the body.
    Skin,
    /// Clothes, shoes.
    Cloth,
    /// Hard things that are worn: glasses, ribbons of metal, jewellery, gear.
    Accessory,
    /// Nothing is known.
    #[default]
    Other,
}
