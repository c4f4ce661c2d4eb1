//! What shaders bind: layouts and groups whose bindings are numbered in their order, and buffers.

use wgpu::{BindingResource, BindingType, TextureSampleType, TextureViewDimension};

use crate::Gpu;

/// A layout.
pub(crate) fn layout(
    gpu: &Gpu,
    label: &str,
    bindings: impl IntoIterator<Item = (wgpu::ShaderStages, BindingType)>,
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (0..)
        .zip(bindings)
        .map(|(binding, (visibility, ty))| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None })
        .collect();
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

/// Numbers of so many bytes.
pub(crate) fn uniform(bytes: Option<u64>) -> BindingType {
    BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: bytes.and_then(wgpu::BufferSize::new),
    }
}

/// A list that shaders read.
pub(crate) fn storage() -> BindingType {
    let ty = wgpu::BufferBindingType::Storage { read_only: true };
    BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None }
}

/// A texture with one sample a texel.
pub(crate) fn texture(sample_type: TextureSampleType, view_dimension: TextureViewDimension) -> BindingType {
    BindingType::Texture { sample_type, view_dimension, multisampled: false }
}

/// A texture that is read between its texels.
pub(crate) fn filtered(view_dimension: TextureViewDimension) -> BindingType {
    texture(TextureSampleType::Float { filterable: true }, view_dimension)
}

/// A group.
pub(crate) fn group<'a>(
    gpu: &Gpu,
    label: &str,
    layout: &wgpu::BindGroupLayout,
    resources: impl IntoIterator<Item = BindingResource<'a>>,
) -> wgpu::BindGroup {
    let entries: Vec<_> =
        (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
}

/// A buffer that holds something from the start.
pub(crate) fn filled(gpu: &Gpu, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    // Empty bindings are invalid; unread bytes stand for nothing.
    let contents = if contents.is_empty() { &[0u8; 64] } else { contents };
    let size = (contents.len() as u64).next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT);
    let descriptor = wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: true };
    let buffer = gpu.device.create_buffer(&descriptor);
    // A device that is lost maps nothing, and says so to whoever asks for its errors.
    if let Ok(mut mapped) = buffer.get_mapped_range_mut(..) {
        mapped.slice(..contents.len()).copy_from_slice(contents);
    }
    buffer.unmap();
    buffer
}

/// A buffer that is written later.
pub(crate) fn buffer(gpu: &Gpu, label: &str, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false })
}
