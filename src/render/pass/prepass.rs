//! Depth, normal and part, one sample a pixel, for effects and channels that read them.

use std::collections::HashMap;

use super::{SurfaceFlags, SurfacePipeline, depth_state, surface_cull, surface_pipeline};
use crate::{
    Gpu,
    material::Material,
    render::{Layouts, draw_list, shaders, targets::PrepassTargets, upload::GpuScene},
};

/// Format of the world normal (octahedral, two halves of a word) and the part index + 1.
pub(crate) const SURFACES_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;

const SURFACES: wgpu::ColorTargetState =
    wgpu::ColorTargetState { format: SURFACES_FORMAT, blend: None, write_mask: wgpu::ColorWrites::ALL };

/// Pipelines by cut-out, culling and targets.
#[derive(Debug)]
pub(crate) struct PrepassPass {
    module: wgpu::ShaderModule,
    pipelines: HashMap<(Option<SurfaceFlags>, bool, bool), wgpu::RenderPipeline>,
}

/// What the pass reads and writes.
pub(crate) struct PrepassInputs<'a> {
    pub scene: &'a GpuScene,
    pub frame: &'a wgpu::BindGroup,
    pub targets: &'a PrepassTargets,
    /// Whether normals and parts are drawn, too.
    pub surfaces: bool,
    /// One for each draw of the scene; `None` leaves it out.
    pub pipelines: &'a [Option<wgpu::RenderPipeline>],
}

impl PrepassPass {
    pub fn new(gpu: &Gpu) -> Self {
        Self { module: shaders::module(&gpu.device, "prepass"), pipelines: HashMap::new() }
    }

    /// The pipeline for a material, made on first use; `depth_only` leaves normal and part out.
    pub fn pipeline(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        flags: SurfaceFlags,
        material: &Material,
        depth_only: bool,
    ) -> wgpu::RenderPipeline {
        let cut = flags.cut(material);
        let make = || {
            let (vertex, fragment) = match (depth_only, cut.is_some()) {
                (true, false) => ("vs_depth", None),
                (true, true) => ("vs_main", Some("fs_depth")),
                (false, _) => ("vs_main", Some("fs_main")),
            };
            let desc = SurfacePipeline {
                label: "prepass",
                module: &self.module,
                vertex,
                fragment,
                constants: &SurfaceFlags::cut_constants(cut),
                cull: surface_cull(material),
                depth: Some(depth_state(true)),
                samples: 1,
                targets: if depth_only { &[] } else { &[Some(SURFACES)] },
            };
            surface_pipeline(gpu, layouts, &desc)
        };
        self.pipelines.entry((cut, material.double_sided, depth_only)).or_insert_with(make).clone()
    }

    /// Draws surfaces.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        inputs: &PrepassInputs<'_>,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let surfaces = Some(wgpu::RenderPassColorAttachment {
            view: &inputs.targets.surfaces_view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("prepass"),
            color_attachments: if inputs.surfaces {
                std::slice::from_ref(&surfaces)
            } else {
                &[]
            },
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &inputs.targets.depth_view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            timestamp_writes: timestamps,
            ..Default::default()
        });
        draw_list::bind_scene(&mut pass, inputs.scene, inputs.frame, &inputs.scene.character_group);
        for (draw, pipeline) in inputs.scene.draws.iter().zip(inputs.pipelines) {
            if let Some(pipeline) = pipeline {
                draw_list::record(&mut pass, inputs.scene, draw, pipeline);
            }
        }
    }
}
