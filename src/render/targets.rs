//! Size-dependent textures, made once for each size.

use super::{
    Output, bind,
    pass::{DEPTH_FORMAT, prepass::SURFACES_FORMAT},
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

/// A texture to draw into; `more` is what else is done with it.
pub(crate) fn texture(
    gpu: &Gpu,
    label: &str,
    size: [u32; 2],
    samples: u32,
    format: wgpu::TextureFormat,
    more: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | more,
        view_formats: &[],
    })
}

/// Layers of a map that passes draw one by one and shaders read together.
pub(crate) fn layers(
    gpu: &Gpu,
    label: &str,
    size: [u32; 2],
    layers: u32,
    format: wgpu::TextureFormat,
) -> wgpu::TextureView {
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: layers },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    array_view(&texture)
}

/// All layers of a texture.
pub(crate) fn array_view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        ..Default::default()
    })
}

/// One layer of a texture.
pub(crate) fn layer(of: &wgpu::TextureView, base_array_layer: u32) -> wgpu::TextureView {
    of.texture().create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        base_array_layer,
        array_layer_count: Some(1),
        ..Default::default()
    })
}

pub(crate) fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

impl ColorTargets {
    pub fn new(gpu: &Gpu, size: [u32; 2], output: Output) -> Self {
        let make =
            |label, format| view(&texture(gpu, label, size, output.samples, format, wgpu::TextureUsages::empty()));
        Self {
            size,
            multisampled: (output.samples > 1).then(|| make("multisampled colour", output.format)),
            depth: make("depth", output.depth_format(gpu)),
        }
    }
}

impl PrepassTargets {
    /// Without normals and parts, these have one texel that nobody reads.
    pub fn new(gpu: &Gpu, size: [u32; 2], has_surfaces: bool) -> Self {
        let read = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let make = |label, size, format| texture(gpu, label, size, 1, format, read);
        let surfaces = make("surfaces", if has_surfaces { size } else { [1, 1] }, SURFACES_FORMAT);
        let depth = make("depth map", size, DEPTH_FORMAT);
        let (surfaces_view, depth_view) = (view(&surfaces), view(&depth));
        Self { size, has_surfaces, surfaces, depth, surfaces_view, depth_view }
    }
}

/// A picture that passes draw into and read.
pub(crate) fn sampled(gpu: &Gpu, label: &str, size: [u32; 2], format: wgpu::TextureFormat) -> wgpu::TextureView {
    view(&texture(gpu, label, size, 1, format, wgpu::TextureUsages::TEXTURE_BINDING))
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
    let pictures = (0..pictures).map(|_| bind::filtered(wgpu::TextureViewDimension::D2));
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    let types = uniform.map(|size| bind::uniform(Some(size))).into_iter().chain(pictures).chain([sampler]);
    bind::layout(gpu, label, types.map(|ty| (wgpu::ShaderStages::FRAGMENT, ty)))
}

/// Group of [`picture_layout`].
pub(crate) fn picture_group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    uniform: Option<&wgpu::Buffer>,
    pictures: &[&wgpu::TextureView],
    sampler: &wgpu::Sampler,
) -> wgpu::BindGroup {
    let pictures = pictures.iter().copied().map(wgpu::BindingResource::TextureView);
    let numbers = uniform.map(wgpu::Buffer::as_entire_binding).into_iter();
    bind::group(gpu, "pictures", layout, numbers.chain(pictures).chain([wgpu::BindingResource::Sampler(sampler)]))
}

/// What a pass over whole pictures draws into.
#[derive(Clone, Debug)]
pub(crate) struct PictureTarget {
    pub colors: Vec<Option<wgpu::ColorTargetState>>,
    pub multisample: wgpu::MultisampleState,
    pub depth: Option<wgpu::DepthStencilState>,
}

impl PictureTarget {
    /// One colour without a depth.
    pub fn of(format: wgpu::TextureFormat, samples: u32, blend: Option<wgpu::BlendState>) -> Self {
        let color = wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::ALL };
        let multisample = wgpu::MultisampleState { count: samples, ..Default::default() };
        Self { colors: vec![Some(color)], multisample, depth: None }
    }
}

/// Pipeline of a pass over whole pictures; without a layout, the shader's own.
pub(crate) fn picture_pipeline(
    gpu: &Gpu,
    label: &str,
    layout: Option<&wgpu::PipelineLayout>,
    module: &wgpu::ShaderModule,
    fragment: &str,
    into: PictureTarget,
) -> wgpu::RenderPipeline {
    let PictureTarget { colors, multisample, depth } = into;
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
        layout,
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vs_main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: depth,
        multisample,
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &colors,
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
    let mut pass = begin(encoder, label, Some(color(into, load)), None, timestamps);
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, group, &[]);
    pass.draw(0..3, 0..1);
}

/// A pass into a colour, a depth, or both.
pub(crate) fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    label: &str,
    color: Option<wgpu::RenderPassColorAttachment<'_>>,
    depth_stencil_attachment: Option<wgpu::RenderPassDepthStencilAttachment<'_>>,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
) -> wgpu::RenderPass<'e> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: if color.is_some() {
            std::slice::from_ref(&color)
        } else {
            &[]
        },
        depth_stencil_attachment,
        timestamp_writes,
        ..Default::default()
    })
}

/// A colour that is kept.
pub(crate) fn color(view: &wgpu::TextureView, load: wgpu::LoadOp<wgpu::Color>) -> wgpu::RenderPassColorAttachment<'_> {
    let ops = wgpu::Operations { load, store: wgpu::StoreOp::Store };
    wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops }
}

/// A depth that starts at `clear`.
pub(crate) fn depth(
    view: &wgpu::TextureView,
    clear: f32,
    store: wgpu::StoreOp,
) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    let depth_ops = Some(wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store });
    wgpu::RenderPassDepthStencilAttachment { view, depth_ops, stencil_ops: None }
}
