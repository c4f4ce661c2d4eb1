//! What a view is drawn into: a picture of its own, or the frame of a host.

use super::{Far, Output, View};
use crate::scene::DepthRange;
use crate::{Error, Result};

/// Where [`Renderer::draw`](crate::Renderer::draw) draws a view. From a view of a texture alone: a picture of its own.
#[derive(Clone, Copy, Debug)]
pub struct Target<'a> {
    /// Colour, in the format of the [`Output`]; the base level of its texture, as large as the [`View`]. One sample a pixel;
    /// with a host's depth as many as the output has, and the host resolves them.
    pub color: &'a wgpu::TextureView,
    /// Keeps what is there instead of clearing it to the view's background. A stage with a [`Post`](crate::scene::Post), and
    /// samples that are resolved without a host's `depth`, are drawn apart in half floats and laid over it. Default: false.
    pub keeps_color: bool,
    /// The depth of a host's frame, in the format of [`Output::depth`] and with the samples of the output: what the host has
    /// drawn hides the actors, and they hide what it draws afterwards. Its depth is that of the camera's matrices
    /// ([`View::of_matrices`]), or of [`Camera::clip_from_view`](crate::scene::Camera::clip_from_view): 1 at the near plane, 0
    /// at infinity. Its stencil does not outlive the draw. Default: none, a depth of its own.
    pub depth: Option<&'a wgpu::TextureView>,
}

impl<'a> From<&'a wgpu::TextureView> for Target<'a> {
    fn from(color: &'a wgpu::TextureView) -> Self {
        Self { color, keeps_color: false, depth: None }
    }
}

impl Target<'_> {
    /// Refuses what the pipelines of an output do not draw into, or what a view does not fit.
    pub(super) fn check(&self, output: Output, view: &View) -> Result<()> {
        let fault = |what: &str, found: String, expected: &str| {
            let message = format!("has {found}; expected {expected}");
            Err(Error::Argument { what: format!("target: {what}"), message })
        };
        let samples = self.samples(output);
        let color = (self.color, "", Some(output.format));
        for (part, name, format) in
            [Some(color), self.depth.map(|d| (d, "depth ", output.depth.map(|d| d.format)))].into_iter().flatten()
        {
            let texture = part.texture();
            let (found, wanted) = ([texture.width(), texture.height()], view.size);
            if found != wanted {
                let [found, wanted] = [found, wanted].map(|[w, h]| format!("{w} x {h}"));
                return fault(&format!("{name}size"), found, &wanted);
            }
            if Some(texture.format()) != format {
                let wanted = format.map_or("none: Output::depth names no format".to_owned(), |f| format!("{f:?}"));
                return fault(&format!("{name}format"), format!("{:?}", texture.format()), &wanted);
            }
            if texture.sample_count() != samples {
                return fault(&format!("{name}samples"), texture.sample_count().to_string(), &samples.to_string());
            }
            if !texture.usage().contains(wgpu::TextureUsages::RENDER_ATTACHMENT) {
                return fault(&format!("{name}usage"), format!("{:?}", texture.usage()), "RENDER_ATTACHMENT");
            }
        }
        if self.depth.is_none() && output.depth.is_some() {
            return fault("depth", "none".to_owned(), "the host's: Output::depth names its format");
        }
        if let Some(depth) = output.depth
            && DepthRange::of(&view.camera).is_reversed() != (depth.far == Far::Zero)
        {
            let message =
                format!("write depth the other way round; expected Far::{:?} as Output::depth says", depth.far);
            return Err(Error::Argument { what: "camera matrices".to_owned(), message });
        }
        Ok(())
    }

    /// Samples of the colour.
    pub(super) fn samples(&self, output: Output) -> u32 {
        if self.depth.is_some() { output.samples } else { 1 }
    }

    /// Whether it must be drawn apart and laid over what is kept.
    pub(super) fn is_laid_over(&self, output: Output) -> bool {
        self.keeps_color && self.samples(output) != output.samples
    }
}
