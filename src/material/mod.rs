//! What a surface looks like: plain sections with public fields. MToon 1.0 maps onto it without loss.

mod alpha;
mod authored;
mod bangs_shadow;
mod base;
mod cast_shadow;
mod decal;
mod depth_rim;
mod diamond;
mod dissolve;
mod dither_fade;
mod face_paint;
mod face_shadow;
mod fire;
mod fluff;
mod fur_detail;
mod gem;
mod glow;
mod highlight;
mod inner_lines;
mod layer;
mod light_response;
mod matcap;
mod outline;
mod rim;
mod shade_ramp;
mod shaped_highlight;
mod sparkle;
mod stocking;
mod toon;
mod transition;
mod uv_animation;

pub use alpha::{Alpha, AlphaMode};
pub use authored::{Authored, Substance};
pub use bangs_shadow::BangsShadow;
pub use base::{Base, Blink, Emission, NormalMap, TextureRef, UvTransform};
pub use cast_shadow::CastShadow;
pub use decal::{Decal, Decals, MAX_DECALS};
pub use depth_rim::DepthRim;
pub use diamond::Diamond;
pub use dissolve::Dissolve;
pub use dither_fade::DitherFade;
pub use face_paint::FacePaint;
pub use face_shadow::{AngleMapping, FaceShadow};
pub use fire::Fire;
pub use fluff::{Fluff, MAX_SHELLS};
pub use fur_detail::FurDetail;
pub use gem::Gem;
pub use glow::Glow;
pub use highlight::Highlight;
pub use inner_lines::InnerLines;
pub use layer::Layer;
pub use light_response::LightResponse;
pub use matcap::Matcap;
pub use outline::{Outline, OutlineTint, OutlineWidth, PartColors, TintSource};
pub use rim::Rim;
pub use shade_ramp::{MAX_PARTS, RampMaps, ShadeRamp};
pub use shaped_highlight::ShapedHighlight;
pub use sparkle::Sparkle;
pub use stocking::Stocking;
pub use toon::{Shading, Toon};
pub use transition::Transition;
pub use uv_animation::UvAnimation;

use serde::{Deserialize, Serialize};

/// A material.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Material {
    /// Name in the file; may be empty.
    pub name: String,
    /// Which description in the file it was made from.
    pub origin: Origin,
    /// Lit colour.
    pub base: Base,
    /// Opacity and draw order.
    pub alpha: Alpha,
    /// Draws back faces too, with their normals turned. Default: false.
    pub double_sided: bool,
    /// Tangent-space normal map. Default: none.
    pub normal_map: Option<NormalMap>,
    /// Light of its own.
    pub emission: Emission,
    /// Moves UVs over time.
    pub uv_animation: UvAnimation,
    /// How light becomes colour.
    pub shading: Shading,
    /// Shadow of a face by a threshold map. Default: none.
    pub face_shadow: Option<FaceShadow>,
    /// Tint of light that is about to turn into shade. Default: none.
    pub transition: Option<Transition>,
    /// Painted steps from shade to light; takes the place of the border and of `transition`. Default: none.
    pub shade_ramp: Option<ShadeRamp>,
    /// Bounds of the light that is taken. Default: none.
    pub light_response: Option<LightResponse>,
    /// Painted fur. Default: none.
    pub fur_detail: Option<FurDetail>,
    /// Blush and lines. Default: none.
    pub face_paint: Option<FacePaint>,
    /// Shadow of bangs and of what else stands before the face. Default: none.
    pub bangs_shadow: Option<BangsShadow>,
    /// Part in the shadow of the character on itself. Default: none.
    pub cast_shadow: Option<CastShadow>,
    /// Painted highlight that moves. Default: none.
    pub highlight: Option<Highlight>,
    /// Highlight with a drawn shape. Default: none.
    pub shaped_highlight: Option<ShapedHighlight>,
    /// Sparks that flash one by one. Default: none.
    pub sparkle: Option<Sparkle>,
    /// A stone that is seen into. Default: none.
    pub gem: Option<Gem>,
    /// A cut stone that throws light back. Default: none.
    pub diamond: Option<Diamond>,
    /// Fire. Default: none.
    pub fire: Option<Fire>,
    /// A coat of short hair. Default: none.
    pub fluff: Option<Fluff>,
    /// What of it blooms. Default: none.
    pub glow: Option<Glow>,
    /// Thin knit over it. Default: none.
    pub stocking: Option<Stocking>,
    /// Pictures laid over it. Default: none.
    pub decals: Option<Decals>,
    /// Burns away. Default: none.
    pub dissolve: Option<Dissolve>,
    /// Fades pixel by pixel. Default: none.
    pub dither_fade: Option<DitherFade>,
    /// What the file carries for looks that use it.
    pub authored: Authored,
    /// Place in a stack of cards. Default: none.
    pub layer: Option<Layer>,
    /// A picture of light looked up by the view-space normal. Default: none.
    pub matcap: Option<Matcap>,
    /// Light along the contour.
    pub rim: Rim,
    /// Light along the contour, by depth. Default: none.
    pub depth_rim: Option<DepthRim>,
    /// Line around the shape. Default: none.
    pub outline: Option<Outline>,
    /// Lines inside of it. Default: none.
    pub inner_lines: Option<InnerLines>,
}

impl Material {
    /// The map that tells its parts apart; ramps and lines share one.
    pub(crate) fn part_ids(&self) -> Option<TextureRef> {
        let of_ramp = self.shade_ramp.and_then(|r| r.maps?.part_ids);
        of_ramp.or_else(|| Some(self.outline?.tint?.parts?.part_ids))
    }

    /// Whether it burns: fire is seen through.
    pub(crate) fn is_fire(&self) -> bool {
        self.fire.is_some() && self.alpha.mode == AlphaMode::Blend
    }

    /// The painted picture of a highlight, of a highlight's shape, or of fire: a material has one.
    pub(crate) fn painted_highlight(&self) -> Option<TextureRef> {
        let shape = || self.shaped_highlight.and_then(|s| s.map);
        self.fire.filter(|_| self.is_fire()).and_then(|f| f.heat).or(self.highlight.map(|h| h.map)).or_else(shape)
    }
}

/// The description that a [`Material`] was made from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// Made in code.
    #[default]
    Code,
    /// `VRMC_materials_mtoon` (VRM 1.0).
    Mtoon1,
    /// `materialProperties` with an MToon shader (VRM 0.x).
    Mtoon0,
    /// `KHR_materials_unlit`, or an unlit shader of VRM 0.x.
    Unlit,
    /// glTF metallic-roughness, turned into a toon material.
    Pbr,
}
