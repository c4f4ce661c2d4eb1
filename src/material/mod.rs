//! What a surface looks like: plain sections with public fields. MToon 1.0 maps onto it without loss.
//!
//! A look is one section: a Rust file here, a WGSL file of the same stem in `wgsl/look`, and one line in the list below.

mod about;
mod alpha;
mod authored;
mod own;
pub(crate) mod section;
mod standard;
mod texture_ref;
mod walk;

pub use about::{About, Encoding, Field, Inner, Kind, Preset, Read};
pub use alpha::{Alpha, AlphaMode, Blending};
pub use authored::{Authored, Substance};
pub use own::{OwnSection, register};
pub(crate) use section::skin_layer;
pub use section::{Declared, Fields, Generated, Options, Section, Surroundings};
pub use standard::Standard;
pub use texture_ref::{TextureRef, UvTransform};
pub use walk::{Leaf, Part, UNBOUNDED, Walk, shown_range};

pub use crate::render::layout::Block;

pub(crate) use own::registered;
pub(crate) use walk::{clamp, out_of_range, plain_parts};

use section::{Held, sections};
use serde::{Deserialize, Serialize};

// The one list. Its order is the order inside of a stage of shading, and that of the places in the uniform.
sections! {
    /// A drawn iris that has depth. Default: none.
    eye_depth: Option<EyeDepth>,
    /// Lights of a drawn eye that move. Default: none.
    eye_card: Option<EyeCard>,
    /// Lit colour.
    base: Base,
    /// Tangent-space normal map. Default: none.
    normal_map: Option<NormalMap>,
    /// Light of its own.
    emission: Emission,
    /// Moves UVs over time.
    uv_animation: UvAnimation,
    /// Burns away. Default: none.
    dissolve: Option<Dissolve>,
    /// Fades pixel by pixel. Default: none.
    dither_fade: Option<DitherFade>,
    /// How light becomes colour.
    shading: Shading => toon,
    /// Bounds of the light that is taken. Default: none.
    light_response: Option<LightResponse>,
    /// Painted fur. Default: none.
    fur_detail: Option<FurDetail>,
    /// Thin knit over it. Default: none.
    stocking: Option<Stocking>,
    /// Pictures laid over it. Default: none.
    decals: Option<Decals>,
    /// Painted steps from shade to light; takes the place of the border and of `transition`. Default: none.
    shade_ramp: Option<ShadeRamp>,
    /// Shadow of a face by a threshold map. Default: none.
    face_shadow: Option<FaceShadow>,
    /// Part in the shadow of the character on itself. Default: none.
    cast_shadow: Option<CastShadow>,
    /// Place in a stack of cards. Default: none.
    layer: Option<Layer>,
    /// Blush and lines. Default: none.
    face_paint: Option<FacePaint>,
    /// Tint of light that is about to turn into shade. Default: none.
    transition: Option<Transition>,
    /// Shadow of bangs and of what else stands before the face. Default: none.
    bangs_shadow: Option<BangsShadow>,
    /// A stone that is seen into. Default: none.
    gem: Option<Gem>,
    /// A cut stone that throws light back. Default: none.
    diamond: Option<Diamond>,
    /// Fire. Default: none.
    fire: Option<Fire>,
    /// Strands that are lit. Default: none.
    hair: Option<Hair>,
    /// Skin that scatters light. Default: none.
    skin: Option<Skin>,
    /// An eye behind its cornea. Default: none.
    eye: Option<Eye>,
    /// Painted highlight that moves. Default: none.
    highlight: Option<Highlight>,
    /// A picture of light looked up by the view-space normal. Default: none.
    matcap: Option<Matcap>,
    /// Highlight with a drawn shape. Default: none.
    shaped_highlight: Option<ShapedHighlight>,
    /// Sparks that flash one by one. Default: none.
    sparkle: Option<Sparkle>,
    /// Light along the contour.
    rim: Rim,
    /// Light along the contour, by depth. Default: none.
    depth_rim: Option<DepthRim>,
    /// Lines inside of it. Default: none.
    inner_lines: Option<InnerLines>,
    /// Line around the shape. Default: none.
    outline: Option<Outline>,
    /// A coat of short hair. Default: none.
    fluff: Option<Fluff>,
    /// Strips of hair. Default: none.
    strips: Option<Strips>,
    /// What of it blooms. Default: none.
    glow: Option<Glow>,
}

impl Material {
    /// Its sections, in the order of the list; those of an application follow.
    pub fn sections(&self) -> impl Iterator<Item = &dyn Section> {
        self.listed().into_iter().flatten().chain(self.own.iter().map(OwnSection::section))
    }

    /// The same to change.
    pub(crate) fn sections_mut(&mut self) -> impl Iterator<Item = &mut dyn Section> {
        let (listed, own) = self.listed_mut();
        listed.into_iter().flatten().chain(own.iter_mut().map(OwnSection::section_mut))
    }

    /// Whether it is fire, which has neither a colour of its own nor light on it.
    pub(crate) fn burns(&self) -> bool {
        self.fire.is_some() && self.alpha.mode == AlphaMode::Blend
    }

    /// Whether light spreads in it over texture coordinates.
    pub(crate) fn scatters_over_uv(&self) -> bool {
        self.skin.is_some_and(|skin| skin.diffuse == SkinDiffuse::TextureSpace)
    }

    /// Whether noise cuts it.
    pub(crate) fn is_hashed(&self) -> bool {
        self.alpha.hashed && self.alpha.mode != AlphaMode::Opaque && !self.burns()
    }

    /// How it is drawn: what noise cuts is masked.
    pub(crate) fn drawn_mode(&self) -> AlphaMode {
        if self.is_hashed() {
            AlphaMode::Mask
        } else {
            self.alpha.mode
        }
    }

    /// Visits every texture: its key, how it is read, value.
    pub(crate) fn each_texture(&mut self, visit: &mut dyn FnMut(String, Read, &mut TextureRef)) {
        for section in self.sections_mut() {
            let about = section.about();
            section.walk_fields(&mut Walk::new(&mut |path, field, leaf| {
                if let (Kind::Texture(read), Leaf::Texture(texture)) = (field.kind, leaf) {
                    visit(format!("{}.{}", about.key, path.join(".")), read, texture);
                }
            }));
        }
    }

    /// Its textures and those that looks may use of its file: what each is for, its index, what its numbers mean.
    #[must_use]
    pub fn textures(&self) -> Vec<(String, usize, Encoding)> {
        let (mut copy, mut list) = (self.clone(), Vec::new());
        copy.each_texture(&mut |key, read, texture| list.push((key, texture.texture, read.encoding)));
        copy.authored.each_texture(&mut |name, read, texture| {
            list.push((format!("authored.{name}"), texture.texture, read.encoding));
        });
        list
    }

    /// A number that is out of its range: its key and what is wrong with it.
    pub(crate) fn out_of_range(&mut self) -> Option<(String, String)> {
        if let Some((key, message)) = out_of_range(&mut self.alpha) {
            return Some((format!("alpha.{key}"), message));
        }
        self.sections_mut().find_map(|section| {
            let (key, message) = out_of_range(section)?;
            Some((format!("{}.{key}", section.about().key), message))
        })
    }

    /// The same with every number within its range.
    pub(crate) fn clamped(mut self) -> Self {
        clamp(&mut self.alpha);
        self.sections_mut().for_each(|section| clamp(section));
        self
    }
}

/// Every section that there is, in the order of the list; those of an application follow.
pub fn all() -> impl Iterator<Item = &'static About> {
    LISTED.iter().copied().chain(registered().into_iter().map(|r| r.about))
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
