//! Light of surfaces that bloom, hidden by whatever stands before them.

use std::collections::HashMap;

use super::{DEPTH_FORMAT, HDR_FORMAT, SurfaceFlags, depth_state, surface_cull, vertex_buffers};
use crate::{
    Gpu,
    material::Material,
    render::{Layouts, draw_list, shaders, targets, upload::GpuScene},
};

/// Pipelines by what a material uses.
#[derive(Debug)]
pub(crate) struct GlowPass {
    module: wgpu::ShaderModule,
    pipelines: HashMap<(SurfaceFlags, bool), wgpu::RenderPipeline>,
}

/// Where it draws: half the size of the picture.
#[derive(Debug)]
pub(crate) struct GlowTargets {
    pub light: wgpu::TextureView,
    depth: wgpu::TextureView,
}

impl GlowTargets {
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let size = size.map(|s| s.div_ceil(2));
        let depth = targets::target(gpu, "glow depth", size, 1, DEPTH_FORMAT, false);
        Self { light: targets::sampled(gpu, "glow", size, HDR_FORMAT), depth: targets::view(&depth) }
    }
}

/// What the pass reads and writes.
pub(crate) struct GlowInputs<'a> {
    pub scene: &'a GpuScene,
    pub frame: &'a wgpu::BindGroup,
    pub targets: &'a GlowTargets,
}

impl GlowPass {
    pub fn new(gpu: &Gpu) -> Self {
        Self { module: shaders::module(&gpu.device, "glow"), pipelines: HashMap::new() }
    }

    /// The pipeline for a material that glows, made on first use.
    pub fn pipeline(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        flags: SurfaceFlags,
        material: &Material,
    ) -> wgpu::RenderPipeline {
        // Neither rims nor shadows change what glows.
        let flags = SurfaceFlags { depth_rim: false, inner_lines: false, alpha_coverage: false, ..flags };
        let make = || {
            let constants = flags.constants();
            let options = || wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
            let add = wgpu::BlendComponent {
                src_factor: wgpu::BlendFactor::One,
                dst_factor: wgpu::BlendFactor::One,
                operation: wgpu::BlendOperation::Add,
            };
            gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("glow"),
                layout: Some(&layouts.surface),
                vertex: wgpu::VertexState {
                    module: &self.module,
                    entry_point: Some("vs_main"),
                    compilation_options: options(),
                    buffers: &vertex_buffers(),
                },
                primitive: wgpu::PrimitiveState { cull_mode: surface_cull(material), ..Default::default() },
                depth_stencil: Some(wgpu::DepthStencilState {
                    // The surface itself stands in the depth already, rounded otherwise where it is drawn otherwise.
                    bias: wgpu::DepthBiasState { constant: 4, slope_scale: 1.0, clamp: 0.0 },
                    ..depth_state(false)
                }),
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &self.module,
                    entry_point: Some("fs_main"),
                    compilation_options: options(),
                    targets: &[Some(wgpu::ColorTargetState {
                        format: HDR_FORMAT,
                        blend: Some(wgpu::BlendState { color: add, alpha: add }),
                        write_mask: wgpu::ColorWrites::ALL,
                    })],
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        self.pipelines.entry((flags, material.double_sided)).or_insert_with(make).clone()
    }

    /// Draws the depth of what hides light, then the light.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        inputs: &GlowInputs<'_>,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let GlowInputs { scene, frame, targets } = inputs;
        let depth = |load, store| wgpu::RenderPassDepthStencilAttachment {
            view: &targets.depth,
            depth_ops: Some(wgpu::Operations { load, store }),
            stencil_ops: None,
        };
        // From the beginning of the first pass to the end of the last.
        let begin = timestamps.clone().map(|t| wgpu::RenderPassTimestampWrites { end_of_pass_write_index: None, ..t });
        let end = timestamps.map(|t| wgpu::RenderPassTimestampWrites { beginning_of_pass_write_index: None, ..t });
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("glow depth"),
                depth_stencil_attachment: Some(depth(wgpu::LoadOp::Clear(0.0), wgpu::StoreOp::Store)),
                timestamp_writes: begin,
                ..Default::default()
            });
            draw_list::bind_scene(&mut pass, scene, frame, &scene.character_group);
            for draw in &scene.draws {
                if let Some(pipeline) = &draw.hides_glow {
                    draw_list::record(&mut pass, scene, draw, pipeline);
                }
            }
        }
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("glow"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &targets.light,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(depth(wgpu::LoadOp::Load, wgpu::StoreOp::Discard)),
            timestamp_writes: end,
            ..Default::default()
        });
        draw_list::bind_scene(&mut pass, scene, frame, &scene.character_group);
        for draw in &scene.draws {
            if let Some(pipeline) = &draw.glow {
                draw_list::record(&mut pass, scene, draw, pipeline);
            }
        }
    }
}
