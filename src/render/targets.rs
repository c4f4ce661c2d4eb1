//! Size-dependent textures, made once for each size.

use super::{
    Output,
    pass::{DEPTH_FORMAT, color_depth_format, prepass::SURFACES_FORMAT},
};
use crate::Gpu;

/// Colour (where multisampled) and depth of the shaded frame.
#[derive(Debug)]
pub(crate) struct ColorTargets {
    pub size: [u32; 2],
    /// Multisampled colour that is resolved into the frame's target; `None` at one sample.
    pub multisampled: Option<wgpu::TextureView>,
    pub depth: wgpu::TextureView,
}

/// What the prepass writes.
#[derive(Debug)]
pub(crate) struct PrepassTargets {
    pub size: [u32; 2],
    pub has_surfaces: bool,
    pub surfaces: wgpu::Texture,
    pub depth: wgpu::Texture,
    pub surfaces_view: wgpu::TextureView,
    pub depth_view: wgpu::TextureView,
}

/// A texture to draw into.
pub(crate) fn target(
    gpu: &Gpu,
    label: &str,
    size: [u32; 2],
    samples: u32,
    format: wgpu::TextureFormat,
    copied: bool,
) -> wgpu::Texture {
    let copy = if copied {
        wgpu::TextureUsages::COPY_SRC
    } else {
        wgpu::TextureUsages::empty()
    };
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | copy,
        view_formats: &[],
    })
}

pub(crate) fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

impl ColorTargets {
    pub fn new(gpu: &Gpu, size: [u32; 2], output: Output) -> Self {
        let make = |label, format| view(&target(gpu, label, size, output.samples, format, false));
        Self {
            size,
            multisampled: (output.samples > 1).then(|| make("multisampled colour", output.format)),
            depth: make("depth", color_depth_format(gpu)),
        }
    }
}

impl PrepassTargets {
    /// Without normals and parts, these have one texel that nobody reads.
    pub fn new(gpu: &Gpu, size: [u32; 2], has_surfaces: bool) -> Self {
        let make = |label, size, format| {
            let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC;
            texture(gpu, label, size, format, usage)
        };
        let surfaces = make("surfaces", if has_surfaces { size } else { [1, 1] }, SURFACES_FORMAT);
        let depth = make("depth map", size, DEPTH_FORMAT);
        let (surfaces_view, depth_view) = (view(&surfaces), view(&depth));
        Self { size, has_surfaces, surfaces, depth, surfaces_view, depth_view }
    }
}

fn texture(
    gpu: &Gpu,
    label: &str,
    size: [u32; 2],
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

/// A picture that passes draw into and read.
pub(crate) fn sampled(gpu: &Gpu, label: &str, size: [u32; 2], format: wgpu::TextureFormat) -> wgpu::TextureView {
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
    view(&texture(gpu, label, size, format, usage))
}

/// Reads pictures between their texels, up to their border.
pub(crate) fn linear_sampler(gpu: &Gpu) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    })
}

/// Layout of a pass over whole pictures: numbers of `uniform` bytes where it has some, the pictures, their sampler.
pub(crate) fn picture_layout(gpu: &Gpu, label: &str, pictures: u32, uniform: Option<u64>) -> wgpu::BindGroupLayout {
    let stages = wgpu::ShaderStages::FRAGMENT;
    let mut types = Vec::new();
    types.extend(uniform.map(|size| wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: wgpu::BufferSize::new(size),
    }));
    types.extend((0..pictures).map(|_| wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }));
    types.push(wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering));
    let entries: Vec<_> = (0..)
        .zip(types)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry { binding, visibility: stages, ty, count: None })
        .collect();
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

/// Group of [`picture_layout`].
pub(crate) fn picture_group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    uniform: Option<&wgpu::Buffer>,
    pictures: &[&wgpu::TextureView],
    sampler: &wgpu::Sampler,
) -> wgpu::BindGroup {
    let mut resources: Vec<wgpu::BindingResource<'_>> =
        uniform.map(wgpu::Buffer::as_entire_binding).into_iter().collect();
    resources.extend(pictures.iter().copied().map(wgpu::BindingResource::TextureView));
    resources.push(wgpu::BindingResource::Sampler(sampler));
    let entries: Vec<_> =
        (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}

/// Pipeline of a pass over whole pictures.
pub(crate) fn picture_pipeline(
    gpu: &Gpu,
    label: &str,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    fragment: &str,
    format: wgpu::TextureFormat,
    blend: Option<wgpu::BlendState>,
) -> wgpu::RenderPipeline {
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vs_main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// Draws one picture over the whole of another.
pub(crate) fn draw_picture(
    encoder: &mut wgpu::CommandEncoder,
    label: &str,
    into: &wgpu::TextureView,
    clear: bool,
    pipeline: &wgpu::RenderPipeline,
    group: &wgpu::BindGroup,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) {
    let load = if clear {
        wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)
    } else {
        wgpu::LoadOp::Load
    };
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: into,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
        })],
        timestamp_writes: timestamps,
        ..Default::default()
    });
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, group, &[]);
    pass.draw(0..3, 0..1);
}
