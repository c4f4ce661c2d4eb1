//! The finished picture: bloom, tone curve, background, smooth edges.

use super::encodes_srgb;
use crate::render::layout::Filled;
use crate::render::numbers::{post_numbers, put_post};
use crate::render::shaders::Recipe;
use crate::render::targets::PictureTarget;
use crate::render::uploads::Uploads;
use crate::render::variants::Variants;
use crate::render::{Background, Output, Target, bind, targets};
use crate::scene::{Antialias, Post};
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
    pipeline: (Kind, wgpu::RenderPipeline),
}

/// What pipelines differ by: whether edges are smoothed, whether it is laid over what is there, and samples of the target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Kind {
    smooths: bool,
    is_over: bool,
    samples: u32,
}

/// What the pass reads and writes.
pub(crate) struct PostInputs<'a> {
    pub post: Post,
    pub background: Background,
    /// Of [`PostPass::group`].
    pub group: &'a wgpu::BindGroup,
    pub target: &'a wgpu::TextureView,
}

const PLAIN: Kind = Kind { smooths: false, is_over: false, samples: 1 };

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
            pipeline: (PLAIN, pipeline(variants, output, &pipeline_layout, PLAIN)?),
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

    /// Makes the pipeline anew where edges are smoothed otherwise, or for another kind of target.
    pub fn fit(&mut self, variants: &Variants, post: Post, target: &Target<'_>) -> Result<()> {
        let kind = Kind {
            smooths: post.antialias == Antialias::Fxaa && self.output.samples == 1,
            is_over: target.keeps_color,
            samples: target.samples(self.output),
        };
        if self.pipeline.0 != kind {
            self.pipeline = (kind, pipeline(variants, self.output, &self.pipeline_layout, kind)?);
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
        let (kind, pipeline) = &self.pipeline;
        targets::draw_picture(encoder, "post", inputs.target, !kind.is_over, pipeline, inputs.group, timestamps);
    }
}

fn pipeline(
    variants: &Variants,
    output: Output,
    layout: &wgpu::PipelineLayout,
    kind: Kind,
) -> Result<wgpu::RenderPipeline> {
    let recipe = Recipe::plain("post").with("encode_srgb", encodes_srgb(output.format)).with("antialias", kind.smooths);
    let module = variants.plain_module(&recipe)?;
    let blend = kind.is_over.then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
    let into = PictureTarget::of(output.format, kind.samples, blend);
    Ok(targets::picture_pipeline(&variants.gpu, "post", Some(layout), &module, "fs_main", into))
}
