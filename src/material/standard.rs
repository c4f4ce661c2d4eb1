//! Physical surfaces: the metallic-roughness model of glTF.

use super::{Options, Section, Surroundings, TextureRef};

crate::section! {
    /// The metallic-roughness model of glTF 2.0: GGX with Smith's shadowing and Schlick's Fresnel term, light from all around
    /// by the split sum, and what rough mirrors lose in one bounce given back. Colour, normal map and light of its own are
    /// those of the material.
    ///
    /// Sources: glTF 2.0, appendix B; Karis 2013; Fdez-Agüera 2019.
    #[derive(Copy)]
    Standard = "standard" {
        is_model: true, on_line: true, of_file: true,
        channel: Some(("standard", "Physical surfaces: metalness in red, roughness in green, occlusion in blue.")),
    }
    {
        /// 1 is metal, 0 is none; multiplies the texture's.
        metallic: f32 = 0.0, in 0.0..=1.0;
        /// 0 mirrors, 1 is dull; multiplies the texture's.
        roughness: f32 = 0.8, in 0.0..=1.0;
        /// Roughness in green, metalness in blue, linear.
        map: Option<TextureRef> = None, read LINEAR;
        /// Share of the light from all around that arrives, in red, linear.
        occlusion: Option<TextureRef> = None, read LINEAR;
        /// How far that is followed.
        occlusion_strength: f32 = 1.0, in 0.0..=1.0;
        /// Index of refraction of what is no metal; glTF's is 1.5.
        ior: f32 = 1.5, in 1.0..=3.0;
    }
}

impl Section for Standard {
    fn options(&self, on: &mut Options, _: &Surroundings<'_>) {
        // One picture may hold all three.
        on.set("standard_occlusion_in_map", self.occlusion.is_some() && self.occlusion == self.map);
    }
}
