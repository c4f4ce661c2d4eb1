//! The environment behind everything, before any surface is drawn.

use std::collections::HashMap;
use std::sync::Mutex;

use super::{Drawing, Mark, Picture};
use crate::render::bind;
use crate::render::environment::EnvironmentMap;
use crate::render::made::lock;
use crate::render::shaders::Recipe;
use crate::render::targets::{self, PictureTarget};
use crate::render::variants::{Request, Variants};
use crate::{Gpu, Result};

/// Its pipelines, by whether they draw half floats.
#[derive(Debug)]
pub(crate) struct BackgroundPass {
    group: wgpu::BindGroupLayout,
    pipeline: wgpu::PipelineLayout,
    made: Mutex<HashMap<bool, wgpu::RenderPipeline>>,
    /// How the last picture is read.
    read: Mutex<Option<(wgpu::TextureView, wgpu::BindGroup)>>,
}

/// What the pass reads.
pub(crate) struct BackgroundInputs<'a> {
    pub variants: &'a Variants,
    pub picture: &'a Picture<'a>,
    pub map: &'a EnvironmentMap,
    /// Group 0.
    pub frame: &'a wgpu::BindGroup,
}

impl BackgroundPass {
    pub fn new(gpu: &Gpu, frame: &wgpu::BindGroupLayout) -> Self {
        let radiance = bind::filtered(wgpu::TextureViewDimension::D2);
        let group = bind::layout(gpu, "background", [(wgpu::ShaderStages::FRAGMENT, radiance)]);
        let pipeline = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("background"),
            bind_group_layouts: &[Some(frame), Some(&group)],
            immediate_size: 0,
        });
        Self { group, pipeline, made: Mutex::default(), read: Mutex::default() }
    }

    /// Draws it.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, inputs: &BackgroundInputs<'_>) -> Result<()> {
        pass.set_pipeline(&self.pipeline(inputs.variants, inputs.picture)?);
        pass.set_bind_group(0, inputs.frame, &[]);
        pass.set_bind_group(1, &self.read(&inputs.variants.gpu, &inputs.map.picture), &[]);
        pass.draw(0..3, 0..1);
        Ok(())
    }

    fn read(&self, gpu: &Gpu, picture: &wgpu::TextureView) -> wgpu::BindGroup {
        let mut read = lock(&self.read);
        if let Some((_, known)) = read.as_ref().filter(|(of, _)| of == picture) {
            return known.clone();
        }
        let resources = [wgpu::BindingResource::TextureView(picture)];
        let group = bind::group(gpu, "background", &self.group, resources);
        *read = Some((picture.clone(), group.clone()));
        group
    }

    fn pipeline(&self, variants: &Variants, picture: &Picture<'_>) -> Result<wgpu::RenderPipeline> {
        if let Some(known) = lock(&self.made).get(&picture.sight.hdr) {
            return Ok(known.clone());
        }
        let drawing = Drawing { cull: None, blend: false, write_depth: false, mark: Mark::None };
        let Request { recipe, state } = picture.request(Recipe::plain("background"), drawing);
        let module = variants.plain_module(&recipe)?;
        let into = PictureTarget {
            colors: state.targets.into_iter().map(Some).collect(),
            multisample: wgpu::MultisampleState { count: state.samples, ..Default::default() },
            // Nothing is behind it and nothing has been drawn.
            depth: state
                .depth
                .map(|d| wgpu::DepthStencilState { depth_compare: Some(wgpu::CompareFunction::Always), ..d }),
        };
        let gpu = &variants.gpu;
        let made = targets::picture_pipeline(gpu, "background", Some(&self.pipeline), &module, "fs_main", into);
        lock(&self.made).insert(picture.sight.hdr, made.clone());
        Ok(made)
    }
}
