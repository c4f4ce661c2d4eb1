//! Spreads the light on skin over the picture, as far as its profile says.

use super::HDR_FORMAT;
use super::irradiance::IrradianceTargets;
use crate::render::View;
use crate::render::bind;
use crate::render::shaders::Recipe;
use crate::render::targets::{self, PictureTarget};
use crate::render::uploads::Uploads;
use crate::render::variants::Variants;
use crate::scene::Camera;
use crate::skin::{MOST_TAPS, discs};
use crate::{Gpu, Result};

/// The pass and its numbers.
#[derive(Debug)]
pub(crate) struct ScatterPass {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::RenderPipeline,
    numbers: wgpu::Buffer,
}

/// `ScatterNumbers` of `wgsl/pass/scatter.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
struct ScatterNumbers {
    /// At a distance of a metre.
    mm_per_px: f32,
    count: u32,
    unused: [u32; 2],
    /// Place in a profile of d = 1, its radius, and 1/8 pi over the density of places there; of each pixel of two by two.
    taps: [[[f32; 4]; MOST_TAPS]; 4],
}

impl ScatterPass {
    pub fn new(variants: &Variants) -> Result<Self> {
        let gpu = &variants.gpu;
        use wgpu::{TextureSampleType as T, TextureViewDimension as D};
        let read = |ty| (wgpu::ShaderStages::FRAGMENT, ty);
        let unfiltered = bind::texture(T::Float { filterable: false }, D::D2);
        let list = [
            read(bind::uniform(Some(size_of::<ScatterNumbers>() as u64))),
            read(unfiltered),
            read(unfiltered),
            read(unfiltered),
        ];
        let layout = bind::layout(gpu, "scatter", list);
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("scatter"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = variants.plain_module(&Recipe::plain("scatter"))?;
        let into = PictureTarget::of(HDR_FORMAT, 1, None);
        let pipeline = targets::picture_pipeline(gpu, "scatter", Some(&pipeline_layout), &module, "fs_main", into);
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        Ok(Self { layout, pipeline, numbers: bind::buffer(gpu, "scatter", size_of::<ScatterNumbers>() as u64, usage) })
    }

    pub fn group(&self, gpu: &Gpu, read: &IrradianceTargets) -> wgpu::BindGroup {
        let view = wgpu::BindingResource::TextureView;
        let resources = [self.numbers.as_entire_binding(), view(&read.light), view(&read.distance), view(&read.place)];
        bind::group(gpu, "scatter", &self.layout, resources)
    }

    /// Spreads it, by so many taps.
    pub fn encode(
        &self,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        group: &wgpu::BindGroup,
        (view, taps): (&View, usize),
        into: &wgpu::TextureView,
    ) {
        let Camera { fov_y_rad, .. } = view.camera;
        let numbers = ScatterNumbers {
            mm_per_px: 2000.0 * (fov_y_rad * 0.5).tan() / view.size[1] as f32,
            count: taps.min(MOST_TAPS) as u32,
            unused: [0; 2],
            taps: discs(taps),
        };
        uploads.write(encoder, &self.numbers, 0, bytemuck::bytes_of(&numbers));
        targets::draw_picture(encoder, "scatter", into, true, &self.pipeline, group, None);
    }
}
