//! Weighted layers of a frame, which need no order: their sums, and how these get into the picture.

use super::blended::Blended;
use super::canvas::Canvas;
use super::character::Shown as Drawables;
use super::draw_list::Actors;
use super::pass::resolve::ResolvePass;
use super::pass::weighted::{self, WeightedTargets};
use super::{Output, Renderer, targets};
use crate::Result;

/// What layers are drawn into, and what lays this over the picture.
#[derive(Debug)]
pub(super) struct Layers {
    targets: WeightedTargets,
    resolve: ResolvePass,
    group: wgpu::BindGroup,
}

impl Layers {
    /// Makes it where there is none of this size and format.
    pub fn fit(made: &mut Option<Self>, r: &Renderer, size: [u32; 2], output: Output) -> Result<()> {
        if made.as_ref().is_some_and(|w| w.targets.size == size && w.resolve.is_for(output.format)) {
            return Ok(());
        }
        let resolve = match made.take() {
            Some(known) if known.resolve.is_for(output.format) => known.resolve,
            _ => ResolvePass::new(&r.variants, output)?,
        };
        let targets = WeightedTargets::new(r.gpu(), size, output.samples);
        *made = Some(Self { group: resolve.group(r.gpu(), &targets), targets, resolve });
        Ok(())
    }

    /// Sums the layers among blended draws and lays them over the picture.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        canvas: Canvas<'_>,
        actors: &Actors<'_>,
        pipelines: &[Drawables],
        blended: &[Blended],
    ) {
        let depth = canvas.depth_attachment(wgpu::LoadOp::Load, true);
        weighted::encode(encoder, &self.targets, depth, actors, pipelines, blended);
        let over = canvas.color_attachment(wgpu::LoadOp::Load, false);
        let mut pass = targets::begin(encoder, "resolve", Some(over), None, None);
        self.resolve.encode(&mut pass, &self.group);
    }
}
