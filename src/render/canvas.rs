//! What a colour pass draws into.

use wgpu::{LoadOp, Operations, StoreOp};

/// Colour and depth of a view: a frame's own, or a host's.
#[derive(Clone, Copy, Debug)]
pub(super) struct Canvas<'a> {
    pub color: &'a wgpu::TextureView,
    /// Samples that are resolved into the colour.
    pub multisampled: Option<&'a wgpu::TextureView>,
    pub depth: Option<&'a wgpu::TextureView>,
    /// Whether the depth is a host's.
    pub keeps_depth: bool,
}

impl<'a> Canvas<'a> {
    /// The colour of a pass. Where another one `goes_on` with it, samples are kept and not resolved yet.
    pub fn color_attachment(&self, load: LoadOp<wgpu::Color>, goes_on: bool) -> wgpu::RenderPassColorAttachment<'a> {
        let store = kept(self.multisampled.is_none() || goes_on);
        wgpu::RenderPassColorAttachment {
            view: self.multisampled.unwrap_or(self.color),
            depth_slice: None,
            resolve_target: self.multisampled.filter(|_| !goes_on).map(|_| self.color),
            ops: Operations { load, store },
        }
    }

    /// Depth and stencil of a pass; the depth is kept for one that `goes_on` with it, and for a host. Whatever a host's stencil
    /// holds, marks begin with none.
    pub fn depth_attachment(
        &self,
        load: LoadOp<f32>,
        goes_on: bool,
    ) -> Option<wgpu::RenderPassDepthStencilAttachment<'a>> {
        let stencil = Operations { load: LoadOp::Clear(0), store: StoreOp::Discard };
        self.depth.map(|view| wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(Operations { load, store: kept(self.keeps_depth || goes_on) }),
            stencil_ops: view.texture().format().has_stencil_aspect().then_some(stencil),
        })
    }
}

fn kept(is_kept: bool) -> StoreOp {
    if is_kept { StoreOp::Store } else { StoreOp::Discard }
}
