//! Depth, normal and part, one sample a pixel, for effects and channels that read them.

use std::collections::HashMap;

use super::{SurfaceFlags, depth_state, surface_cull, vertex_buffers};
use crate::{
    Gpu,
    material::{AlphaMode, Material},
    render::{Layouts, draw_list, shaders, targets::PrepassTargets, upload::GpuScene},
};

/// Format of the world normal (octahedral, two halves of a word) and the part index + 1.
pub(crate) const SURFACES_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;

/// Pipelines by cut-out, culling and targets.
#[derive(Debug)]
pub(crate) struct PrepassPass {
    module: wgpu::ShaderModule,
    pipelines: HashMap<(SurfaceFlags, bool, bool, bool), wgpu::RenderPipeline>,
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
        let alpha_test = material.alpha.mode != AlphaMode::Opaque || flags.dissolve || flags.dither_fade;
        // Without a cut-out nothing is sampled: one pipeline serves all.
        let flags = if alpha_test {
            SurfaceFlags { hdr: false, ..flags }
        } else {
            SurfaceFlags::default()
        };
        let make = || {
            let mut constants = flags.constants();
            constants.push(("ALPHA_TEST", f64::from(u8::from(alpha_test))));
            let options = || wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
            let (entry_point, targets) = if depth_only {
                ("fs_depth", &[] as &[Option<wgpu::ColorTargetState>])
            } else {
                ("fs_main", &[Some(SURFACES_FORMAT.into())] as _)
            };
            gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("prepass"),
                layout: Some(&layouts.surface),
                vertex: wgpu::VertexState {
                    module: &self.module,
                    entry_point: Some(if depth_only && !alpha_test {
                        "vs_depth"
                    } else {
                        "vs_main"
                    }),
                    compilation_options: options(),
                    buffers: &vertex_buffers(),
                },
                primitive: wgpu::PrimitiveState { cull_mode: surface_cull(material), ..Default::default() },
                depth_stencil: Some(depth_state(true)),
                multisample: wgpu::MultisampleState::default(),
                fragment: (alpha_test || !depth_only).then(|| wgpu::FragmentState {
                    module: &self.module,
                    entry_point: Some(entry_point),
                    compilation_options: options(),
                    targets,
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        self.pipelines.entry((flags, alpha_test, material.double_sided, depth_only)).or_insert_with(make).clone()
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
