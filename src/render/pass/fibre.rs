//! Tables of azimuthal scattering of fibres, made when a material with lit hair is uploaded.

use crate::render::bind;
use crate::render::pass::HDR_FORMAT;
use crate::render::shaders::Recipe;
use crate::render::variants::Variants;
use crate::{Gpu, Result};

/// Angles about the fibre with two columns of energies, and inclinations twice.
pub(crate) const SIZE: [u32; 2] = [128, 96];

/// What a table is made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FibreInputs {
    /// Width of the detector, radians.
    pub width: f32,
    /// Index of refraction.
    pub ior: f32,
    pub is_gaussian: bool,
}

/// Makes a table.
pub(crate) fn table(variants: &Variants, inputs: FibreInputs) -> Result<wgpu::TextureView> {
    let gpu = &variants.gpu;
    let module = variants.plain_module(&Recipe::plain("fibre"))?;
    let pipeline = gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("fibre"),
        layout: None,
        module: &module,
        entry_point: Some("main"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let view = texture(gpu);
    // Nodes across the fibre lie closer than the detector is wide.
    let nodes = (16.0 / inputs.width).ceil().clamp(64.0, 512.0) as u32;
    let words = [inputs.width.to_bits(), inputs.ior.to_bits(), u32::from(inputs.is_gaussian), nodes];
    let numbers = bind::filled(gpu, "fibre", bytemuck::bytes_of(&words), wgpu::BufferUsages::UNIFORM);
    let layout = pipeline.get_bind_group_layout(0);
    let resources = [numbers.as_entire_binding(), wgpu::BindingResource::TextureView(&view)];
    let group = bind::group(gpu, "fibre", &layout, resources);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("fibre") });
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        let [width, height] = SIZE;
        pass.dispatch_workgroups(width.div_ceil(8), height.div_ceil(8), 1);
    }
    gpu.queue.submit([encoder.finish()]);
    Ok(view)
}

fn texture(gpu: &Gpu) -> wgpu::TextureView {
    let [width, height] = SIZE;
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("fibre"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: HDR_FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::STORAGE_BINDING,
        view_formats: &[],
    });
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
