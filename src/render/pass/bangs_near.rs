//! Nearest depths of the map of the bangs, by blocks: they spare most receivers its taps.

use super::bangs_shadow;
use crate::render::shaders::Recipe;
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
        let pipeline = variants.gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("bangs near"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs_main"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fs_main"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(bangs_shadow::FORMAT.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Ok(Self { pipeline })
    }

    /// Binds a layer of the map.
    pub fn group(&self, gpu: &Gpu, layer: &wgpu::TextureView) -> wgpu::BindGroup {
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("bangs near"),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(layer) }],
        })
    }

    /// Finds the nearest depths of one layer.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        inputs: &BangsNearInputs<'_>,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("bangs near"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: inputs.near,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::WHITE), store: wgpu::StoreOp::Store },
            })],
            timestamp_writes: timestamps,
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, inputs.map, &[]);
        pass.draw(0..3, 0..1);
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
