//! Spreads light over a chain of pictures, each half as large.

use super::{ADD, HDR_FORMAT};
use crate::render::shaders::Recipe;
use crate::render::targets::{self, PictureTarget};
use crate::render::variants::Variants;
use crate::{Gpu, Result};

/// Its pipelines.
#[derive(Debug)]
pub(crate) struct BloomPass {
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    down: wgpu::RenderPipeline,
    up: wgpu::RenderPipeline,
}

/// Pictures of one size, the largest first, and how each is read.
#[derive(Debug)]
pub(crate) struct BloomChain {
    views: Vec<wgpu::TextureView>,
    groups: Vec<wgpu::BindGroup>,
}

/// What the pass reads and writes: the light is the first picture of the chain, and so is the result.
pub(crate) struct BloomInputs<'a> {
    pub chain: &'a BloomChain,
}

impl BloomPass {
    pub fn new(variants: &Variants) -> Result<Self> {
        let gpu = &variants.gpu;
        let module = variants.plain_module(&Recipe::plain("bloom"))?;
        let layout = targets::picture_layout(gpu, "bloom", 1, None);
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("bloom"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let make = |entry, blend| {
            let into = PictureTarget::of(HDR_FORMAT, 1, blend);
            targets::picture_pipeline(gpu, "bloom", Some(&pipeline_layout), &module, entry, into)
        };
        let (down, up) = (make("fs_down", None), make("fs_up", Some(ADD)));
        let sampler = targets::linear_sampler(gpu);
        Ok(Self { layout, sampler, down, up })
    }

    /// A chain of so many pictures below one of light.
    pub fn chain(&self, gpu: &Gpu, light: &wgpu::TextureView, levels: usize) -> BloomChain {
        let mut size = [light.texture().width(), light.texture().height()];
        let mut views = vec![light.clone()];
        for _ in 0..levels {
            size = size.map(|s| (s / 2).max(1));
            views.push(targets::sampled(gpu, "bloom", size, HDR_FORMAT));
        }
        let groups =
            views.iter().map(|v| targets::picture_group(gpu, &self.layout, None, &[v], &self.sampler)).collect();
        BloomChain { views, groups }
    }

    /// Halves the light down the chain, then adds it up again.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, inputs: &BloomInputs<'_>) {
        let BloomChain { views, groups } = inputs.chain;
        let last = views.len() - 1;
        for i in 1..=last {
            targets::draw_picture(encoder, "bloom down", &views[i], true, &self.down, &groups[i - 1], None);
        }
        for i in (0..last).rev() {
            targets::draw_picture(encoder, "bloom up", &views[i], false, &self.up, &groups[i + 1], None);
        }
    }
}
