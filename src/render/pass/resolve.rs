//! Sums of weighted layers, laid over the picture sample by sample: resolved ones would mix what lies behind hair at its edge
//! with what does not.

use super::encodes_srgb;
use super::weighted::WeightedTargets;
use crate::render::shaders::Recipe;
use crate::render::targets::{self, PictureTarget};
use crate::render::variants::Variants;
use crate::render::{Output, bind};
use crate::{Gpu, Result};

/// Its pipelines, one for each sample.
#[derive(Debug)]
pub(crate) struct ResolvePass {
    format: wgpu::TextureFormat,
    layout: wgpu::BindGroupLayout,
    pipelines: Vec<wgpu::RenderPipeline>,
}

impl ResolvePass {
    /// For pictures like this one.
    pub fn new(variants: &Variants, output: Output) -> Result<Self> {
        let gpu = &variants.gpu;
        let multisampled = output.samples > 1;
        let sums = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled,
        };
        let layout = bind::layout(gpu, "resolve", [sums; 2].map(|ty| (wgpu::ShaderStages::FRAGMENT, ty)));
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("resolve"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let recipe = Recipe::plain("resolve")
            .with("multisampled", multisampled)
            .with("encode_srgb", encodes_srgb(output.format));
        let module = variants.plain_module(&recipe)?;
        let blend = Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        let pipeline = |sample: u32| {
            let mut into = PictureTarget::of(output.format, output.samples, blend);
            // Each draws its sample alone: no device need run fragments for every sample.
            into.multisample.mask = 1 << sample;
            let entry = format!("fs_sample_{sample}");
            targets::picture_pipeline(gpu, "resolve", Some(&pipeline_layout), &module, &entry, into)
        };
        Ok(Self { format: output.format, pipelines: (0..output.samples).map(pipeline).collect(), layout })
    }

    /// Whether it draws into this format.
    pub fn is_for(&self, format: wgpu::TextureFormat) -> bool {
        self.format == format
    }

    /// How sums are read.
    pub fn group(&self, gpu: &Gpu, targets: &WeightedTargets) -> wgpu::BindGroup {
        let sums = [&targets.sums, &targets.left].map(wgpu::BindingResource::TextureView);
        bind::group(gpu, "resolve", &self.layout, sums)
    }

    /// Draws the layers over what is there.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, group: &wgpu::BindGroup) {
        pass.set_bind_group(0, group, &[]);
        for pipeline in &self.pipelines {
            pass.set_pipeline(pipeline);
            pass.draw(0..3, 0..1);
        }
    }
}
