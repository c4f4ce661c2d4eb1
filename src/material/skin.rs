//! Skin: light that scatters below its surface, and what is mirrored on it.

use serde::{Deserialize, Serialize};

use super::{AlphaMode, Generated, Options, Section, Shading, Surroundings, TextureRef, walk::plain_parts};
use crate::render::layout::Block;
use crate::render::pass::irradiance_uv::layer_uv;
use crate::skin::{DiffusionProfile, Speculars, Texturing, Transmission};

/// How light that scatters is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SkinDiffuse {
    /// Not at all: light leaves where it arrives.
    Lambert,
    /// Light that is wrapped round, without colour.
    Wrapped,
    /// By a table of curvature and angle (Penner 2011).
    #[default]
    PreIntegrated,
    /// By spreading the light of the picture along its rows and columns (after Jimenez et al. 2015).
    ScreenSpace,
    /// By discs over the picture (Golubev 2018): a little cheaper, coarser where a body is as small as the reach of its light.
    ScreenSpaceDisc,
    /// By spreading light over the texture coordinates (d'Eon and Luebke 2007), of which each place must be one of the surface.
    TextureSpace,
}

/// What is mirrored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SkinSpecular {
    /// Blinn and Phong, normalised.
    BlinnPhong,
    /// Kelemen and Szirmay-Kalos 2001, with Beckmann's distribution.
    Kelemen,
    /// GGX with Smith's visibility.
    Ggx,
    /// Two lobes of GGX, a sharp and a wide one.
    #[default]
    DualGgx,
}

plain_parts!(SkinDiffuse, SkinSpecular);

crate::section! {
    /// Skin and what scatters light as it does, in the place of the toon shading or as far as wanted.
    ///
    /// Curvature, thickness and occlusion are measured at upload, of the pose at rest with its weights of morph targets
    /// ([`Node::morph_weights`](crate::scene::Node::morph_weights)).
    ///
    /// Sources: Penner 2011; Jimenez et al. 2015; Golubev 2018; d'Eon and Luebke 2007; Ma et al. 2007; Christensen and Burley 2015.
    #[derive(Copy)]
    Skin = "skin" {
        is_model: true,
        channel: Some(("skin-irradiance", "Light that falls on skin, before it scatters.")),
        more_channels: &[
            ("skin-scattered", "The same after it has scattered."),
            ("skin-specular", "What skin mirrors."),
            ("skin-thickness", "Thickness of skin: white is 10 mm and more."),
            ("skin-occlusion", "Share of light from all around that nothing hides from skin: black is none."),
            ("skin-curvature", "Curvature of skin: white is 0.5/mm and more; blue where it is hollow."),
            ("skin-profile", "Diffusion profiles of skin, a colour each."),
        ],
    }
    {
        /// How light that scatters is found: `lambert`, `wrapped`, `pre-integrated`, `screen-space`,
        /// `screen-space-disc` or `texture-space`.
        diffuse: SkinDiffuse = SkinDiffuse::PreIntegrated;
        /// 1 is lit skin, 0 the toon shading with its warm edge.
        natural: f32 = 1.0, in 0.0..=1.0;
        /// How light scatters in it.
        profile: DiffusionProfile = DiffusionProfile::default(), part DiffusionProfile;
        /// How far `wrapped` light comes round: 0 Lambert, 1 to the back.
        wrap: f32 = 0.3, in 0.0..=1.0;
        /// Whether that is as it is commonly written, which adds light.
        wrap_as_written: bool = false;
        /// Places that light comes from in `screen-space`, of both lines together, `screen-space-disc` and `texture-space`: 11
        /// quick, 17 good, 40 best.
        taps: u32 = 17, in 4..=40;
        /// What is mirrored: `blinn-phong`, `kelemen`, `ggx` or `dual-ggx`.
        specular: SkinSpecular = SkinSpecular::DualGgx;
        /// Roughness; of two lobes their mean.
        roughness: f32 = 0.45, in 0.05..=1.0;
        /// Share of what is mirrored.
        specular_strength: f32 = 1.0, in 0.0..=1.0;
        /// What the roughness of the sharp and of the wide lobe is multiplied by.
        lobes: [f32; 2] = [0.75, 1.3], in 0.05..=4.0;
        /// Share of the sharp lobe.
        lobe_mix: f32 = 0.85, in 0.0..=1.0;
        /// Curvature in place of the mesh's, red, linear: 1 is 1/mm.
        curvature_map: Option<TextureRef> = None, read LINEAR;
        /// What curvature is multiplied by, and so the width of a warm edge.
        curvature_scale: f32 = 1.0, in 0.0..=10.0;
        /// Thickness in place of the mesh's, red, linear: 0 and 1 stand for the profile's remap.
        thickness_map: Option<TextureRef> = None, read LINEAR;
        /// How far bumps of the normal map are softer in colours that scatter farther.
        detail: f32 = 1.0, in 0.0..=1.0;
        /// How far the edges of shadows scatter.
        penumbra: f32 = 1.0, in 0.0..=1.0;
        /// How far skin takes less of the light from all around where hair, clothes or other skin within 100 mm hide it, and how far it
        /// mirrors less of it there: 0 not at all, 1 as the mesh at rest has it (Jimenez et al. 2016; Lagarde and de Rousiers 2014).
        occlusion: f32 = 1.0, in 0.0..=1.0;
        /// Share of light that comes through.
        transmission: f32 = 1.0, in 0.0..=1.0;
        /// Whether that follows a traced volume, in which more light comes through a slab than the profile says (red 1.3 times at
        /// 1 mm, 3 times at 6 mm); round bodies, whose light leaves at their sides, lie between the two.
        transmission_of_volume: bool = false;
        /// Share of warm light along the border of a toon shade, wherever that is drawn: by normals, by a face's threshold map or by
        /// a shadow that is cast; 0 none, 1 nothing else. It reaches half as far as light below the surface (3.9 mm in skin, times
        /// `curvature_scale`), round bodies over a wider angle, at most 34 degrees; beside a cast shadow as far as that is filtered.
        /// Its hue is that of light which has come so far (Christensen and Burley 2015).
        edge: f32 = 0.0, in 0.0..=1.0;
        /// Bands of equal steps in that, as painters cut it; 0 for a smooth one.
        edge_steps: u32 = 0, in 0..=8;
    }
    presets {
        /// Light skin.
        skin_light {}
        /// Dark skin.
        skin_dark { profile: profile("skin-dark") }
        /// Polished jade.
        jade { profile: profile("jade"), specular: SkinSpecular::Ggx, roughness: 0.25 }
        /// Paraffin wax.
        wax { profile: profile("wax"), specular: SkinSpecular::Ggx, roughness: 0.5 }
        /// Whole milk.
        milk { profile: profile("milk"), specular: SkinSpecular::Ggx, roughness: 0.15 }
        /// Polished marble.
        marble { profile: profile("marble"), specular: SkinSpecular::Ggx, roughness: 0.3 }
        /// Drawn skin: toon shade with a warm band along its border, over a wider angle where a surface is rounder.
        drawn { natural: 0.0, edge: 0.4, curvature_scale: 3.0 }
    }
}

impl Skin {
    /// Whether nothing of it is lit as skin.
    fn is_drawn(&self, of: &Surroundings<'_>) -> bool {
        matches!(of.material.shading, Shading::Toon(_)) && self.natural == 0.0
    }
}

/// A profile that is there.
fn profile(name: &str) -> DiffusionProfile {
    DiffusionProfile::named(name).unwrap_or_default()
}

impl Section for Skin {
    fn put(&self, gpu: &mut Block<'_>, of: &Surroundings<'_>) {
        gpu.put("profile_number", number(&self.profile));
        gpu.put("thickness_range_mm", self.profile.thickness_range_mm());
        gpu.put("reach_mm", self.profile.max_radius_mm());
        gpu.put("metres_per_uv", of.metres_per_uv);
        gpu.put("layer_uv", layer_uv(of.uv_box));
        gpu.put("layer", of.skin_layer as f32);
    }

    fn options(&self, on: &mut Options, of: &Surroundings<'_>) {
        let is_toon = matches!(of.material.shading, Shading::Toon(_));
        on.set("skin_vertex", true);
        on.set("skin_edge", is_toon && self.natural < 1.0 && self.edge > 0.0);
        if self.is_drawn(of) {
            return on.set("skin_drawn", true);
        }
        on.set("skin_toon", is_toon && self.natural < 1.0);
        // What is seen through is not in the picture of light on skin.
        let is_seen_through = of.material.drawn_mode() == AlphaMode::Blend;
        let name = match self.diffuse {
            SkinDiffuse::Lambert => "skin_lambert",
            SkinDiffuse::Wrapped => "skin_wrapped",
            SkinDiffuse::ScreenSpace | SkinDiffuse::ScreenSpaceDisc if !is_seen_through => "skin_screen_space",
            SkinDiffuse::TextureSpace => "skin_texture_space",
            _ => "skin_pre_integrated",
        };
        on.set(name, true);
        on.set("skin_disc", name == "skin_screen_space" && self.diffuse == SkinDiffuse::ScreenSpaceDisc);
        // Which actor's layers it reads.
        on.set("actor", name == "skin_texture_space");
        on.set("skin_penumbra", name == "skin_pre_integrated" && self.penumbra > 0.0);
        let name = match self.specular {
            SkinSpecular::BlinnPhong => "skin_blinn_phong",
            SkinSpecular::Kelemen => "skin_kelemen",
            SkinSpecular::Ggx => "skin_ggx",
            SkinSpecular::DualGgx => "skin_dual_ggx",
        };
        on.set(name, true);
        on.set("skin_wrap_as_written", self.wrap_as_written);
        on.set("skin_of_volume", self.transmission_of_volume);
        on.set("skin_pre_scatter", self.profile.texturing == Texturing::PreAndPost);
        on.set("skin_thick", self.profile.transmission == Transmission::Thick);
    }

    fn generated(&self, on: &Surroundings<'_>) -> Option<(&'static str, Generated)> {
        let of = SkinTable {
            distances: self.profile.scattering_distance_mm.map(f32::to_bits),
            ior: self.profile.ior.to_bits(),
            specular: self.specular,
            roughness: self.roughness.to_bits(),
            lobes: self.lobes.map(f32::to_bits),
            lobe_mix: self.lobe_mix.to_bits(),
        };
        // Toon shade has no room for another texture beside those of a face.
        (!self.is_drawn(on)).then_some(("table", Generated::Skin(of)))
    }
}

/// Below the flag beside it (`wgsl/lib/skin_light.wgsl`).
const MOST_NUMBERS: u32 = 0xffff;

/// A number for skin of this profile, which tells it from other skin in the picture: 1 to 65535.
fn number(profile: &DiffusionProfile) -> f32 {
    let texturing = f32::from(u8::from(profile.texturing == Texturing::PreAndPost));
    let numbers = profile.scattering_distance_mm.into_iter().chain([profile.world_scale, texturing]);
    // FNV-1a.
    let hash = numbers.flat_map(f32::to_le_bytes).fold(0x811c_9dc5u32, |h, b| (h ^ u32::from(b)).wrapping_mul(0x0100_0193));
    (1 + hash % MOST_NUMBERS) as f32
}

/// What the table of skin is made of; floats by their bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SkinTable {
    distances: [u32; 3],
    ior: u32,
    specular: SkinSpecular,
    roughness: u32,
    lobes: [u32; 2],
    lobe_mix: u32,
}

impl SkinTable {
    /// Of diffusion alone.
    pub(crate) fn of_diffusion(profile: &DiffusionProfile) -> Self {
        Self {
            distances: profile.scattering_distance_mm.map(f32::to_bits),
            ior: profile.ior.to_bits(),
            specular: SkinSpecular::Ggx,
            roughness: 0.5f32.to_bits(),
            lobes: [1.0f32.to_bits(); 2],
            lobe_mix: 0.5f32.to_bits(),
        }
    }

    /// Its numbers.
    pub(crate) fn numbers(self) -> (DiffusionProfile, Speculars) {
        let profile = DiffusionProfile {
            scattering_distance_mm: self.distances.map(f32::from_bits),
            ior: f32::from_bits(self.ior),
            ..DiffusionProfile::default()
        };
        let speculars = Speculars {
            model: self.specular,
            roughness: f32::from_bits(self.roughness),
            lobes: self.lobes.map(f32::from_bits),
            lobe_mix: f32::from_bits(self.lobe_mix),
            f0: profile.f0(),
        };
        (profile, speculars)
    }
}
