//! Opacity and draw order.

use serde::{Deserialize, Serialize};

use super::{Material, plain_parts};

crate::part! {
    /// Opacity and draw order of a material.
    #[derive(Copy)]
    Alpha {
        /// How alpha is used.
        mode: AlphaMode = AlphaMode::Opaque;
        /// Alpha below which [`AlphaMode::Mask`] cuts; above 1 nothing is left.
        cutoff: f32 = 0.5, in 0.0..=1000.0;
        /// Cuts [`AlphaMode::Mask`] and [`AlphaMode::Blend`] by noise on the surface instead: as many pixels are left as alpha says,
        /// in any order of surfaces, and depth is right. For means of many pictures
        /// ([`render_accumulated`](crate::Renderer::render_accumulated)), in which it becomes smooth; one alone is grainy. The cutoff
        /// counts in shadows alone.
        hashed: bool = false;
        /// Whether [`AlphaMode::Blend`] writes depth (MToon `transparentWithZWrite`).
        write_depth: bool = false;
        /// Order among transparent materials, low first (MToon `renderQueueOffsetNumber`).
        queue_offset: i32 = 0, in -9..=9;
        /// How what is blended lies over itself, as layers of hair do.
        blending: Blending = Blending::Sorted;
        /// Whether a pass of its own draws what is nearly opaque first, with depth; it casts shadows, too. Not where
        /// [`Blending::Sorted`]. (Hair Renderer "Use Opaque Pass".)
        opaque_pass: bool = true;
        /// Alpha from which on that pass draws a surface, wholly opaque ("Opaque Pass Ref").
        opaque_cutoff: f32 = 0.9, in 0.5..=1.0;
        /// Alpha below which nothing is blended: such pixels cost without being seen ("Front Back Alpha Ref"). Not where
        /// [`Blending::Sorted`].
        least_alpha: f32 = 0.02, in 0.0..=0.5;
        /// Whether front faces of [`Blending::ThreePass`] write depth: less soft, but nothing behind shines through ("Front
        /// Write Depth").
        front_writes_depth: bool = false;
    }
}

/// How a blended surface lies over itself. Of materials with the same queue offset, those that are sorted come before those in
/// layers: the middle of a head of hair says nothing of which eye stands before which strand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Blending {
    /// Each part far before near, its triangles as the file has them.
    #[default]
    Sorted,
    /// The opaque part with depth, then back faces, then front faces, whether or not the material is double-sided: each blended
    /// where nothing is nearer. What cards of hair want whose triangles lie in a good order.
    ThreePass,
    /// The opaque part with depth, then the rest blended in one pass.
    DoubleLayer,
    /// The opaque part with depth, then all layers in any order, weighted by their depth over the head, or over the part where
    /// there is no head (McGuire and Bavoil 2013, with w = alpha exp(6 (1 - t)), t from 0 at the near side of that sphere to 1 at
    /// its far side). Nearly opaque layers shine through those before them a little, and no order of triangles shows. Of several
    /// actors, those that are farther away weigh less by the eighth power of their distance. What is weighted lies over
    /// everything else.
    Weighted,
}

impl Material {
    /// How it lies over itself: fire burns through.
    pub(crate) fn blending(&self) -> Blending {
        if self.drawn_mode() == AlphaMode::Blend && !self.burns() {
            self.alpha.blending
        } else {
            Blending::Sorted
        }
    }

    /// Whether a pass of its own draws its opaque part.
    pub(crate) fn has_core(&self) -> bool {
        self.blending() != Blending::Sorted && self.alpha.opaque_pass
    }
}

/// How alpha is used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AlphaMode {
    /// Ignored.
    #[default]
    Opaque,
    /// Cut at [`Alpha::cutoff`].
    Mask,
    /// Blended.
    Blend,
}
plain_parts!(AlphaMode, Blending);
