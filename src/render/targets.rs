//! Size-dependent textures, made once for each size.

use super::{
    Output,
    pass::{
        DEPTH_FORMAT, color_depth_format,
        prepass::{NORMAL_FORMAT, PART_FORMAT},
    },
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
    pub normal: wgpu::Texture,
    pub part: wgpu::Texture,
    pub depth: wgpu::Texture,
    pub normal_view: wgpu::TextureView,
    pub part_view: wgpu::TextureView,
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

/// Depth that a shader reads.
pub(crate) fn depth_map(gpu: &Gpu, size: [u32; 2]) -> wgpu::TextureView {
    view(&gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("depth map"),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: DEPTH_FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    }))
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
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let make = |label, format| target(gpu, label, size, 1, format, true);
        let normal = make("prepass normal", NORMAL_FORMAT);
        let part = make("prepass part", PART_FORMAT);
        let depth = make("prepass depth", DEPTH_FORMAT);
        let (normal_view, part_view, depth_view) = (view(&normal), view(&part), view(&depth));
        Self { size, normal, part, depth, normal_view, part_view, depth_view }
    }
}
