//! The finished picture: bloom, tone curve, background, smooth edges.

use super::encodes_srgb;
use crate::render::layout::Filled;
use crate::render::numbers::{post_numbers, put_post};
use crate::render::shaders::Recipe;
use crate::render::uploads::Uploads;
use crate::render::variants::Variants;
use crate::render::{Background, Output, bind, targets};
use crate::scene::Post;
use crate::{Gpu, Result};

/// Its pipeline, by whether edges are smoothed.
#[derive(Debug)]
pub(crate) struct PostPass {
    output: Output,
    layout: wgpu::BindGroupLayout,
    pipeline_layout: wgpu::PipelineLayout,
    sampler: wgpu::Sampler,
    numbers: Filled,
    uniform: wgpu::Buffer,
    pipeline: (bool, wgpu::RenderPipeline),
}

/// What the pass reads and writes.
pub(crate) struct PostInputs<'a> {
    pub post: Post,
    pub background: Background,
    /// Of [`PostPass::group`].
    pub group: &'a wgpu::BindGroup,
    pub target: &'a wgpu::TextureView,
}

impl PostPass {
    pub fn new(variants: &Variants, output: Output) -> Result<Self> {
        let gpu = &variants.gpu;
        let numbers = post_numbers();
        let layout = targets::picture_layout(gpu, "post", 2, Some(numbers.size()));
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("post"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        Ok(Self {
            pipeline: (false, pipeline(variants, output, &pipeline_layout, false)?),
            output,
            pipeline_layout,
            layout,
            sampler: targets::linear_sampler(gpu),
            uniform: bind::buffer(
                gpu,
                "post",
                numbers.size(),
                wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            ),
            numbers,
        })
    }

    /// How the drawn picture and its spread light are read.
    pub fn group(&self, gpu: &Gpu, picture: &wgpu::TextureView, spread: &wgpu::TextureView) -> wgpu::BindGroup {
        targets::picture_group(gpu, &self.layout, Some(&self.uniform), &[picture, spread], &self.sampler)
    }

    /// Makes the pipeline anew where edges are smoothed otherwise.
    pub fn fit(&mut self, variants: &Variants, post: Post) -> Result<()> {
        let smooths = post.antialias && self.output.samples == 1;
        if self.pipeline.0 != smooths {
            self.pipeline = (smooths, pipeline(variants, self.output, &self.pipeline_layout, smooths)?);
        }
        Ok(())
    }

    /// Draws the finished picture.
    pub fn encode(
        &mut self,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        inputs: &PostInputs<'_>,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let bytes = self.numbers.fill(|numbers| put_post(numbers, inputs.post, inputs.background));
        uploads.write(encoder, &self.uniform, 0, bytes);
        targets::draw_picture(encoder, "post", inputs.target, true, &self.pipeline.1, inputs.group, timestamps);
    }
}

fn pipeline(
    variants: &Variants,
    output: Output,
    layout: &wgpu::PipelineLayout,
    smooths: bool,
) -> Result<wgpu::RenderPipeline> {
    let recipe = Recipe::plain("post").with("encode_srgb", encodes_srgb(output.format)).with("antialias", smooths);
    let module = variants.plain_module(&recipe)?;
    Ok(targets::picture_pipeline(&variants.gpu, "post", Some(layout), &module, "fs_main", output.format, None))
}
