//! Pipelines: one maker for every pass, keyed by what the shader is linked from and by fixed state, on all cores.

use std::borrow::Cow;
use std::collections::{BTreeMap, HashMap};
use std::mem::offset_of;
use std::sync::{Arc, Mutex, OnceLock};

use rayon::prelude::*;

use super::bind;
use super::made::lock;
use super::shaders::{Binding, BindingKind, Linked, Recipe, Shaders};
use super::vertex::{Instance, StaticVertex};
use crate::{Gpu, Result};

/// Fixed state of a pipeline.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct State {
    pub cull: Option<wgpu::Face>,
    pub depth: Option<wgpu::DepthStencilState>,
    pub samples: u32,
    pub targets: Vec<wgpu::ColorTargetState>,
}

/// What a draw asks for.
#[derive(Clone, Debug)]
pub(crate) struct Request {
    pub recipe: Recipe,
    pub state: State,
}

/// A pipeline, and what it binds of its material.
#[derive(Clone, Debug)]
pub(crate) struct Variant {
    pub pipeline: wgpu::RenderPipeline,
    /// `None` where it binds nothing.
    pub bound: Option<Arc<BoundLayout>>,
}

/// What a pass draws with: a pipeline, and what it binds of its material.
#[derive(Clone, Debug)]
pub(crate) struct Drawn {
    pub pipeline: wgpu::RenderPipeline,
    pub bound: Option<Bound>,
}

/// Group 2 of a material for shaders that bind the same of it.
#[derive(Clone, Debug)]
pub(crate) struct Bound {
    pub material: usize,
    pub layout: Arc<BoundLayout>,
    pub group: wgpu::BindGroup,
}

/// Layout of group 2 for shaders that bind the same.
#[derive(Debug)]
pub(crate) struct BoundLayout {
    pub bindings: Vec<Binding>,
    pub group: wgpu::BindGroupLayout,
    pipeline: wgpu::PipelineLayout,
}

/// Makes pipelines and keeps them.
#[derive(Debug)]
pub(crate) struct Variants {
    pub gpu: Gpu,
    pub shaders: Shaders,
    frame: wgpu::BindGroupLayout,
    character: wgpu::BindGroupLayout,
    /// Group 3: where actors were in the last picture; made when somebody asks.
    past: OnceLock<wgpu::BindGroupLayout>,
    /// Of shaders that bind nothing of a material.
    bare: wgpu::PipelineLayout,
    layouts: Mutex<HashMap<Vec<Binding>, Arc<BoundLayout>>>,
    /// By the linked text: recipes that give the same share all.
    made: Mutex<HashMap<(Arc<str>, State), Variant>>,
}

impl Variants {
    pub fn new(gpu: &Gpu, shaders: Shaders, frame: wgpu::BindGroupLayout, character: wgpu::BindGroupLayout) -> Self {
        let bare = pipeline_layout(gpu, &[Some(&frame), Some(&character)]);
        let (layouts, made) = Default::default();
        Self { gpu: gpu.clone(), shaders, frame, character, past: OnceLock::new(), bare, layouts, made }
    }

    /// Layout of group 3.
    pub fn past(&self) -> &wgpu::BindGroupLayout {
        let list = || (wgpu::ShaderStages::VERTEX, bind::storage());
        self.past.get_or_init(|| bind::layout(&self.gpu, "past", [list(), list()]))
    }

    /// The pipeline of a request, made on first use.
    ///
    /// # Errors
    /// A section's WGSL does not link; the driver refuses it.
    pub fn get(&self, request: &Request) -> Result<Variant> {
        let linked = self.shaders.linked(&request.recipe)?;
        let key = (Arc::clone(&linked.text), request.state.clone());
        if let Some(found) = lock(&self.made).get(&key) {
            return Ok(found.clone());
        }
        let made = self.make(request, &linked)?;
        lock(&self.made).insert(key, made.clone());
        Ok(made)
    }

    /// Pipelines of many requests, on all cores. Those that differ in nothing are one.
    ///
    /// # Errors
    /// Those of [`Variants::get`].
    pub fn get_all<'a>(&self, requests: impl IntoIterator<Item = &'a Request>) -> Result<()> {
        // Two cores must not link the same.
        let mut recipes: BTreeMap<String, Vec<&Request>> = BTreeMap::new();
        requests.into_iter().for_each(|r| recipes.entry(r.recipe.key()).or_default().push(r));
        let recipes: Vec<Vec<&Request>> = recipes.into_values().collect();
        let linked: Vec<Arc<Linked>> =
            recipes.par_iter().map(|of| self.shaders.linked(&of[0].recipe)).collect::<Result<_>>()?;
        let mut wanted = HashMap::new();
        for (request, linked) in recipes.iter().zip(&linked).flat_map(|(of, l)| of.iter().map(move |r| (*r, l))) {
            wanted.insert((Arc::clone(&linked.text), request.state.clone()), (request, linked));
        }
        wanted.retain(|key, _| !lock(&self.made).contains_key(key));
        wanted.into_par_iter().try_for_each(|(key, (request, linked))| {
            let made = self.make(request, linked)?;
            lock(&self.made).insert(key, made);
            Ok(())
        })
    }

    fn make(&self, request: &Request, linked: &Linked) -> Result<Variant> {
        let Request { recipe, state } = request;
        let targets: Vec<_> = state.targets.iter().cloned().map(Some).collect();
        // Error scopes belong to threads.
        self.gpu.scoped(|| {
            let module = self.module(recipe.pass, linked);
            let bound = (!linked.bindings.is_empty()).then(|| self.layout(&linked.bindings));
            let with_past = linked.reads_past.then(|| {
                let material = bound.as_ref().map(|b| &b.group);
                pipeline_layout(&self.gpu, &[Some(&self.frame), Some(&self.character), material, Some(self.past())])
            });
            let layout = with_past.as_ref().unwrap_or(bound.as_ref().map_or(&self.bare, |b| &b.pipeline));
            let pipeline = self.gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(recipe.pass),
                layout: Some(layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("vs_main"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &VERTEX_BUFFERS,
                },
                primitive: wgpu::PrimitiveState { cull_mode: state.cull, ..Default::default() },
                depth_stencil: state.depth.clone(),
                multisample: wgpu::MultisampleState { count: state.samples, ..Default::default() },
                fragment: linked.has_fragment.then_some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some("fs_main"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &targets,
                }),
                multiview_mask: None,
                cache: None,
            });
            Variant { pipeline, bound }
        })
    }

    /// Shader module of a pass that draws no material.
    ///
    /// # Errors
    /// Its WGSL does not link.
    pub fn plain_module(&self, recipe: &Recipe) -> Result<wgpu::ShaderModule> {
        Ok(self.module(recipe.pass, &*self.shaders.linked(recipe)?))
    }

    fn module(&self, label: &str, linked: &Linked) -> wgpu::ShaderModule {
        self.gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Naga(Cow::Owned(linked.module.clone())),
        })
    }

    fn layout(&self, bindings: &[Binding]) -> Arc<BoundLayout> {
        let mut layouts = lock(&self.layouts);
        if let Some(found) = layouts.get(bindings) {
            return Arc::clone(found);
        }
        let entries: Vec<_> = bindings.iter().map(layout_entry).collect();
        let group = self
            .gpu
            .device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("material"), entries: &entries });
        let pipeline = pipeline_layout(&self.gpu, &[Some(&self.frame), Some(&self.character), Some(&group)]);
        let layout = Arc::new(BoundLayout { bindings: bindings.to_vec(), group, pipeline });
        layouts.insert(bindings.to_vec(), Arc::clone(&layout));
        layout
    }
}

fn pipeline_layout(gpu: &Gpu, groups: &[Option<&wgpu::BindGroupLayout>]) -> wgpu::PipelineLayout {
    gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("surface"),
        bind_group_layouts: groups,
        immediate_size: 0,
    })
}

fn layout_entry(binding: &Binding) -> wgpu::BindGroupLayoutEntry {
    use wgpu::TextureViewDimension as D;
    wgpu::BindGroupLayoutEntry {
        binding: binding.index,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: match binding.kind {
            BindingKind::Numbers => bind::uniform(None),
            BindingKind::Texture => bind::filtered(D::D2),
            BindingKind::TextureArray => bind::filtered(D::D2Array),
            BindingKind::Sampler => wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        },
        count: None,
    }
}

const fn attribute(shader_location: u32, format: wgpu::VertexFormat, offset: usize) -> wgpu::VertexAttribute {
    wgpu::VertexAttribute { format, offset: offset as u64, shader_location }
}

/// Vertex streams, as `wgsl/bind/vertex.wgsl` reads them: what does not move, and what an instance stands for. Deformed
/// vertices are pulled from storage, so that one draw serves actors in poses of their own.
const VERTEX_BUFFERS: [Option<wgpu::VertexBufferLayout<'static>>; 2] = [
    Some(wgpu::VertexBufferLayout {
        array_stride: size_of::<StaticVertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &[
            attribute(0, wgpu::VertexFormat::Float32x4, offset_of!(StaticVertex, uv)),
            attribute(1, wgpu::VertexFormat::Unorm8x4, offset_of!(StaticVertex, color)),
            attribute(2, wgpu::VertexFormat::Uint32, offset_of!(StaticVertex, part)),
            // The same bytes as skin and as an eye has them.
            attribute(7, wgpu::VertexFormat::Float16x4, offset_of!(StaticVertex, shape)),
            attribute(8, wgpu::VertexFormat::Uint32x2, offset_of!(StaticVertex, shape)),
        ],
    }),
    Some(wgpu::VertexBufferLayout {
        array_stride: size_of::<Instance>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &wgpu::vertex_attr_array![3 => Float32x4, 4 => Float32x4, 5 => Float32x4, 6 => Uint32x3],
    }),
];
