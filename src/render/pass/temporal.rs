//! The picture of a window with those that it follows.

use wgpu::{BindingResource, BindingType, SamplerBindingType, ShaderStages, TextureSampleType, TextureViewDimension};

use super::HDR_FORMAT;
use super::velocity::VelocityTargets;
use crate::render::bind;
use crate::render::layout::Filled;
use crate::render::numbers::temporal_numbers;
use crate::render::shaders::Recipe;
use crate::render::targets::{self, PictureTarget};
use crate::render::uploads::Uploads;
use crate::render::variants::Variants;
use crate::{Gpu, Result};

/// 1 / distance, of how many pictures a pixel is the mean, and how far these differ.
const PAST_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Its pipeline.
#[derive(Debug)]
pub(crate) struct TemporalPass {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    sampler: wgpu::Sampler,
    numbers: Filled,
    uniform: wgpu::Buffer,
}

/// A mean of pictures: it reads one and writes the next in turn.
#[derive(Debug)]
pub(crate) struct Means {
    color: wgpu::TextureView,
    past: wgpu::TextureView,
}

impl Means {
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let [color, past] = [("history", HDR_FORMAT), ("history past", PAST_FORMAT)]
            .map(|(label, format)| targets::sampled(gpu, label, size, format));
        Self { color, past }
    }

    /// The mean picture, premultiplied.
    pub fn color(&self) -> &wgpu::TextureView {
        &self.color
    }
}

/// What is known of the cameras of two pictures that follow each other.
pub(crate) struct Step {
    /// Without jitter.
    pub world_from_clip: glam::Mat4,
    pub clip_before: glam::Mat4,
    pub eye: glam::Vec3,
    pub near: f32,
    pub size: [u32; 2],
    /// Height of the ground.
    pub ground_y: Option<f32>,
    /// How far the camera has moved, metres: distances may be others by as much.
    pub eye_moved: f32,
    /// Whether actors have come or gone.
    pub has_others: bool,
    pub is_continued: bool,
}

impl TemporalPass {
    pub fn new(variants: &Variants) -> Result<Self> {
        let gpu = &variants.gpu;
        let numbers = temporal_numbers();
        let read = |sample_type| bind::texture(sample_type, TextureViewDimension::D2);
        let (float, depth) = (TextureSampleType::Float { filterable: true }, TextureSampleType::Depth);
        let types = [
            bind::uniform(Some(numbers.size())),
            read(float),
            read(float),
            read(depth),
            read(float),
            read(float),
            BindingType::Sampler(SamplerBindingType::Filtering),
        ];
        let layout = bind::layout(gpu, "temporal", types.map(|ty| (ShaderStages::FRAGMENT, ty)));
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("temporal"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = variants.plain_module(&Recipe::plain("temporal"))?;
        let into = PictureTarget {
            colors: vec![Some(HDR_FORMAT.into()), Some(PAST_FORMAT.into())],
            ..PictureTarget::of(HDR_FORMAT, 1, None)
        };
        let pipeline = targets::picture_pipeline(gpu, "temporal", Some(&pipeline_layout), &module, "fs_main", into);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let uniform = bind::buffer(gpu, "temporal", numbers.size(), usage);
        Ok(Self { layout, pipeline, sampler: targets::linear_sampler(gpu), numbers, uniform })
    }

    /// How the drawn picture, its movement and the mean before it are read.
    pub fn group(
        &self,
        gpu: &Gpu,
        picture: &wgpu::TextureView,
        moved: &VelocityTargets,
        before: &Means,
    ) -> wgpu::BindGroup {
        let views = [picture, &moved.velocity, &moved.depth, &before.color, &before.past];
        let views = views.into_iter().map(BindingResource::TextureView);
        let sampler = BindingResource::Sampler(&self.sampler);
        let all = std::iter::once(self.uniform.as_entire_binding()).chain(views).chain([sampler]);
        bind::group(gpu, "temporal", &self.layout, all)
    }

    /// Draws the next mean; `group` reads the one before.
    pub fn encode(
        &mut self,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        step: &Step,
        group: &wgpu::BindGroup,
        into: &Means,
    ) {
        let bytes = self.numbers.fill(|gpu| {
            gpu.put("world_from_clip", step.world_from_clip.to_cols_array_2d());
            gpu.put("clip_before", step.clip_before.to_cols_array_2d());
            gpu.put("eye", step.eye.to_array());
            gpu.put("near", step.near);
            gpu.put("size_px", step.size.map(|s| s as f32));
            gpu.put("ground_y", step.ground_y.unwrap_or(0.0));
            gpu.put("has_ground", f32::from(u8::from(step.ground_y.is_some())));
            gpu.put("eye_moved", step.eye_moved);
            gpu.put("has_others", f32::from(u8::from(step.has_others)));
            gpu.put("is_continued", f32::from(u8::from(step.is_continued)));
        });
        uploads.write(encoder, &self.uniform, 0, bytes);
        let load = wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT);
        let [color, past] = [&into.color, &into.past].map(|view| Some(targets::color(view, load)));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("temporal"),
            color_attachments: &[color, past],
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..3, 0..1);
    }
}
