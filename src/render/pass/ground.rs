//! What actors stand on.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};

use wgpu::{BindingResource, BindingType, SamplerBindingType, ShaderStages, TextureSampleType, TextureViewDimension};

use super::shadow::{self, ShadowRows};
use super::{Drawing, Mark, Picture};
use crate::material::Encoding;
use crate::render::layout::{Block, Filled};
use crate::render::made::lock;
use crate::render::shaders::Recipe;
use crate::render::uploads::Uploads;
use crate::render::variants::{Request, Variants};
use crate::render::{bind, targets, textures};
use crate::scene::Image;
use crate::stage::Ground;
use crate::{Gpu, Result};

/// Its pipelines.
#[derive(Debug)]
pub(crate) struct GroundPass {
    group: wgpu::BindGroupLayout,
    pipeline: wgpu::PipelineLayout,
    sampler: wgpu::Sampler,
    compare: wgpu::Sampler,
    made: Mutex<HashMap<Kind, wgpu::RenderPipeline>>,
}

/// What pipelines differ by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Kind {
    shadow_only: bool,
    textured: bool,
    grid: bool,
    punctual: bool,
    hdr: bool,
}

/// The ground of a stage on the GPU.
#[derive(Debug)]
pub(crate) struct GroundBody {
    numbers: Filled,
    uniform: wgpu::Buffer,
    texture: Option<(Arc<Image>, wgpu::TextureView)>,
    group: wgpu::BindGroup,
}

impl GroundPass {
    pub fn new(gpu: &Gpu, frame: &wgpu::BindGroupLayout) -> Self {
        let read = |ty| (ShaderStages::FRAGMENT, ty);
        let group = bind::layout(
            gpu,
            "ground",
            [
                (ShaderStages::VERTEX_FRAGMENT, bind::uniform(None)),
                read(bind::texture(TextureSampleType::Depth, TextureViewDimension::D2Array)),
                read(BindingType::Sampler(SamplerBindingType::Comparison)),
                read(bind::filtered(TextureViewDimension::D2)),
                read(BindingType::Sampler(SamplerBindingType::Filtering)),
            ],
        );
        let pipeline = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("ground"),
            bind_group_layouts: &[Some(frame), Some(&group)],
            immediate_size: 0,
        });
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("ground"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            mipmap_filter: wgpu::MipmapFilterMode::Linear,
            anisotropy_clamp: 8,
            ..Default::default()
        });
        Self { group, pipeline, sampler, compare: shadow::sampler(gpu), made: Mutex::default() }
    }

    /// What draws a ground into a picture.
    fn pipeline(&self, variants: &Variants, picture: &Picture<'_>, of: &Ground) -> Result<wgpu::RenderPipeline> {
        let kind = Kind {
            shadow_only: of.shadow_only,
            textured: of.texture.is_some(),
            grid: of.grid.is_some(),
            punctual: picture.sight.punctual,
            hdr: picture.sight.hdr,
        };
        if let Some(known) = lock(&self.made).get(&kind) {
            return Ok(known.clone());
        }
        let recipe = Recipe::plain("ground")
            .with("shadow_only", kind.shadow_only)
            .with("textured", kind.textured)
            .with("grid", kind.grid);
        // It hides what is below it, unless it is but a shadow.
        let drawing = Drawing { cull: None, blend: true, write_depth: !kind.shadow_only, mark: Mark::None };
        let Request { recipe, state } = picture.request(recipe, drawing);
        let targets: Vec<_> = state.targets.into_iter().map(Some).collect();
        let module = variants.plain_module(&recipe)?;
        let made = variants.gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("ground"),
            layout: Some(&self.pipeline),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs_main"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                cull_mode: state.cull,
                ..Default::default()
            },
            depth_stencil: state.depth,
            multisample: wgpu::MultisampleState { count: state.samples, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fs_main"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        });
        lock(&self.made).insert(kind, made.clone());
        Ok(made)
    }

    /// Makes a stage's ground what it says; `is_new`: there is another map.
    pub fn embody(
        &self,
        gpu: &Gpu,
        body: &mut Option<GroundBody>,
        of: &Ground,
        shadow: &wgpu::TextureView,
        is_new: bool,
    ) -> Result<()> {
        let is_same = |body: &GroundBody| match (&body.texture, &of.texture) {
            (None, None) => true,
            (Some((a, _)), Some(b)) => Arc::ptr_eq(a, b),
            _ => false,
        };
        if !is_new && body.as_ref().is_some_and(is_same) {
            return Ok(());
        }
        let texture = match &of.texture {
            Some(image) => Some((Arc::clone(image), textures::single(gpu, image, Encoding::Srgb)?)),
            None => None,
        };
        let numbers = Filled::of_file("pass/ground", &["lib/shadow"], "GroundNumbers");
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let uniform = bind::buffer(gpu, "ground", numbers.size(), usage);
        let white = || targets::sampled(gpu, "no texture", [1, 1], wgpu::TextureFormat::Rgba8UnormSrgb);
        let view = texture.as_ref().map_or_else(white, |(_, view)| view.clone());
        let resources = [
            uniform.as_entire_binding(),
            BindingResource::TextureView(shadow),
            BindingResource::Sampler(&self.compare),
            BindingResource::TextureView(&view),
            BindingResource::Sampler(&self.sampler),
        ];
        let group = bind::group(gpu, "ground", &self.group, resources);
        *body = Some(GroundBody { numbers, uniform, texture, group });
        Ok(())
    }

    /// Draws it.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, inputs: &GroundInputs<'_>) -> Result<()> {
        pass.set_pipeline(&self.pipeline(inputs.variants, inputs.picture, inputs.ground)?);
        pass.set_bind_group(0, inputs.frame, &[]);
        pass.set_bind_group(1, &inputs.body.group, &[]);
        pass.draw(0..4, 0..1);
        Ok(())
    }
}

/// What the pass reads.
pub(crate) struct GroundInputs<'a> {
    pub variants: &'a Variants,
    pub picture: &'a Picture<'a>,
    pub ground: &'a Ground,
    pub body: &'a GroundBody,
    /// Group 0.
    pub frame: &'a wgpu::BindGroup,
}

impl GroundBody {
    /// Sends its numbers.
    pub fn send(
        &mut self,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        of: &Ground,
        shadow: &ShadowRows,
    ) {
        let bytes = self.numbers.fill(|numbers| put(numbers, of, shadow));
        uploads.write(encoder, &self.uniform, 0, bytes);
    }
}

fn put(gpu: &mut Block<'_>, of: &Ground, shadow: &ShadowRows) {
    let grid = of.grid.unwrap_or_default();
    gpu.put("shadow", shadow.numbers());
    gpu.put("middle", of.middle.to_array());
    gpu.put("radius", of.radius_m);
    gpu.put("color", of.color.0);
    gpu.put("texture_size", of.texture_m);
    gpu.put("shade", of.shade.0);
    gpu.put("grid_spacing", grid.spacing_m);
    gpu.put("grid_color", grid.color.0);
    gpu.put("grid_width", grid.width_m);
}
