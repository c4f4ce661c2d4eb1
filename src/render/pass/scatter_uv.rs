//! Spreads the light on skin over its texture coordinates, as far as its profile says.

use super::HDR_FORMAT;
use super::irradiance_uv::UvTargets;
use crate::render::bind;
use crate::render::shaders::Recipe;
use crate::render::skin_layers::SkinPart;
use crate::render::targets::{self, PictureTarget};
use crate::render::uploads::Uploads;
use crate::render::variants::Variants;
use crate::skin::{MOST_TAPS, discs};
use crate::{Gpu, Result};

/// The pass and its numbers.
#[derive(Debug)]
pub(crate) struct ScatterUvPass {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    numbers: wgpu::Buffer,
}

/// `ScatterUvNumbers` of `wgsl/pass/scatter_uv.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
struct ScatterUvNumbers {
    count: u32,
    unused: [u32; 3],
    /// As [`discs`] gives them, of each texel of two by two.
    taps: [[[f32; 4]; MOST_TAPS]; 4],
}

impl ScatterUvPass {
    pub fn new(variants: &Variants) -> Result<Self> {
        use wgpu::{TextureSampleType as T, TextureViewDimension as D};
        let gpu: &Gpu = &variants.gpu;
        let fragment = |ty| (wgpu::ShaderStages::FRAGMENT, ty);
        let size = size_of::<ScatterUvNumbers>() as u64;
        let unfiltered = || fragment(bind::texture(T::Float { filterable: false }, D::D2));
        let list = [
            fragment(bind::uniform(Some(size))),
            unfiltered(),
            unfiltered(),
            unfiltered(),
            fragment(bind::storage()),
            fragment(bind::texture(T::Uint, D::D2)),
        ];
        let layout = bind::layout(gpu, "scatter over uv", list);
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("scatter over uv"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = variants.plain_module(&Recipe::plain("scatter_uv"))?;
        let into = PictureTarget::of(HDR_FORMAT, 1, None);
        let pipeline =
            targets::picture_pipeline(gpu, "scatter over uv", Some(&pipeline_layout), &module, "fs_main", into);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let numbers = bind::buffer(gpu, "scatter over uv", size, usage);
        Ok(Self { layout, pipeline, numbers })
    }

    pub fn group(&self, gpu: &Gpu, read: &UvTargets, part: &SkinPart) -> wgpu::BindGroup {
        let view = wgpu::BindingResource::TextureView;
        let resources = [
            self.numbers.as_entire_binding(),
            view(&read.light),
            view(&read.places),
            view(&read.spans),
            part.seams.as_entire_binding(),
            view(&part.nearest_seams),
        ];
        bind::group(gpu, "scatter over uv", &self.layout, resources)
    }

    /// Spreads it, by so many taps.
    pub fn encode(
        &self,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        (group, taps): (&wgpu::BindGroup, usize),
        into: &wgpu::TextureView,
    ) {
        let numbers = ScatterUvNumbers { count: taps.min(MOST_TAPS) as u32, unused: [0; 3], taps: discs(taps) };
        uploads.write(encoder, &self.numbers, 0, bytemuck::bytes_of(&numbers));
        targets::draw_picture(encoder, "scatter over uv", into, true, &self.pipeline, group, None);
    }
}
