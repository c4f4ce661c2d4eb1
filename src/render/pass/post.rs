//! The finished picture: bloom, tone curve, background, smooth edges.

use std::collections::HashMap;

use super::encode_constant;
use crate::{
    Gpu,
    render::{Background, Output, shaders, targets, uniforms::PostUniform},
    scene::Post,
};

/// Its pipelines, by whether edges are smoothed.
#[derive(Debug)]
pub(crate) struct PostPass {
    output: Output,
    module: wgpu::ShaderModule,
    layout: wgpu::BindGroupLayout,
    pipeline_layout: wgpu::PipelineLayout,
    sampler: wgpu::Sampler,
    uniform: wgpu::Buffer,
    pipelines: HashMap<bool, wgpu::RenderPipeline>,
}

/// What the pass reads and writes.
pub(crate) struct PostInputs<'a> {
    pub post: Post,
    pub background: Background,
    /// Of [`PostPass::group`].
    pub group: &'a wgpu::BindGroup,
    /// Of [`PostPass::pipeline`].
    pub pipeline: &'a wgpu::RenderPipeline,
    pub target: &'a wgpu::TextureView,
}

impl PostPass {
    pub fn new(gpu: &Gpu, output: Output) -> Self {
        let layout = targets::picture_layout(gpu, "post", 2, Some(size_of::<PostUniform>() as u64));
        Self {
            output,
            module: shaders::module(&gpu.device, "post"),
            pipeline_layout: gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("post"),
                bind_group_layouts: &[Some(&layout)],
                immediate_size: 0,
            }),
            layout,
            sampler: targets::linear_sampler(gpu),
            uniform: gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("post"),
                size: size_of::<PostUniform>() as u64,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            pipelines: HashMap::new(),
        }
    }

    /// How the drawn picture and its spread light are read.
    pub fn group(&self, gpu: &Gpu, picture: &wgpu::TextureView, spread: &wgpu::TextureView) -> wgpu::BindGroup {
        targets::picture_group(gpu, &self.layout, Some(&self.uniform), &[picture, spread], &self.sampler)
    }

    /// The pipeline for settings, made on first use.
    pub fn pipeline(&mut self, gpu: &Gpu, post: Post) -> wgpu::RenderPipeline {
        let smooths = post.antialias && self.output.samples == 1;
        let Self { output, module, pipeline_layout, pipelines, .. } = self;
        let make = || {
            let constants = [encode_constant(*output), ("ANTIALIAS", f64::from(u8::from(smooths)))];
            targets::picture_pipeline(gpu, "post", pipeline_layout, module, "fs_main", &constants, output.format, None)
        };
        pipelines.entry(smooths).or_insert_with(make).clone()
    }

    /// Draws the finished picture.
    pub fn encode(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        inputs: &PostInputs<'_>,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let uniform = PostUniform::new(inputs.post, inputs.background);
        gpu.queue.write_buffer(&self.uniform, 0, bytemuck::bytes_of(&uniform));
        targets::draw_picture(encoder, "post", inputs.target, true, inputs.pipeline, inputs.group, timestamps);
    }
}
