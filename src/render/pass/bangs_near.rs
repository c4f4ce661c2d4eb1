//! Nearest depths of the map of the bangs, by blocks: they spare most receivers its taps.

use super::bangs_shadow;
use crate::render::bind;
use crate::render::shaders::Recipe;
use crate::render::targets::{self, PictureTarget};
use crate::render::variants::Variants;
use crate::{Gpu, Result};

/// Texels of the map along a block; `BANGS_BLOCK` in `wgsl/lib/bangs.wgsl` (a test compares them).
pub(crate) const BLOCK: u32 = 8;

/// The pipeline.
#[derive(Debug)]
pub(crate) struct BangsNearPass {
    pipeline: wgpu::RenderPipeline,
}

/// What the pass reads and writes: one layer of the map, through a group of [`BangsNearPass::group`], and its nearest depths.
pub(crate) struct BangsNearInputs<'a> {
    pub map: &'a wgpu::BindGroup,
    pub near: &'a wgpu::TextureView,
}

impl BangsNearPass {
    pub fn new(variants: &Variants) -> Result<Self> {
        let module = variants.plain_module(&Recipe::plain("bangs_near"))?;
        let into = PictureTarget::of(bangs_shadow::FORMAT, 1, None);
        let pipeline = targets::picture_pipeline(&variants.gpu, "bangs near", None, &module, "fs_main", into);
        Ok(Self { pipeline })
    }

    /// Binds a layer of the map.
    pub fn group(&self, gpu: &Gpu, layer: &wgpu::TextureView) -> wgpu::BindGroup {
        let layer = wgpu::BindingResource::TextureView(layer);
        bind::group(gpu, "bangs near", &self.pipeline.get_bind_group_layout(0), [layer])
    }

    /// Finds the nearest depths of one layer.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        inputs: &BangsNearInputs<'_>,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        targets::draw_picture(encoder, "bangs near", inputs.near, true, &self.pipeline, inputs.map, timestamps);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_as_large_in_the_shader() {
        let text = crate::render::shaders::file("lib/bangs");
        let module = naga::front::wgsl::parse_str(text).expect("valid WGSL");
        let named = module.constants.iter().find(|(_, c)| c.name.as_deref() == Some("BANGS_BLOCK"));
        let value = &module.global_expressions[named.expect("a constant").1.init];
        assert!(matches!(value, naga::Expression::Literal(naga::Literal::I32(v)) if *v == BLOCK as i32), "{value:?}");
    }
}
