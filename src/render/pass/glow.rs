//! Light of surfaces that bloom, hidden by whatever the prepass shows before them.

use std::collections::HashMap;

use super::{ADD, HDR_FORMAT, SurfaceFlags, SurfacePipeline, surface_cull, surface_pipeline};
use crate::{
    Gpu,
    material::{AlphaMode, Material},
    render::{Layouts, draw_list, shaders, targets, upload::GpuScene},
};

/// Pipelines by what a material uses.
#[derive(Debug)]
pub(crate) struct GlowPass {
    module: wgpu::ShaderModule,
    pipelines: HashMap<(SurfaceFlags, bool, bool), wgpu::RenderPipeline>,
}

/// What the pass reads and writes.
pub(crate) struct GlowInputs<'a> {
    pub scene: &'a GpuScene,
    /// With the depth of the prepass.
    pub frame: &'a wgpu::BindGroup,
    /// Of [`target`].
    pub light: &'a wgpu::TextureView,
}

/// Where it draws: half the size of the picture.
pub(crate) fn target(gpu: &Gpu, size: [u32; 2]) -> wgpu::TextureView {
    targets::sampled(gpu, "glow", size.map(|s| s.div_ceil(2)), HDR_FORMAT)
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
        // Neither rims nor the shadow of bangs change what glows.
        let flags =
            SurfaceFlags { depth_rim: false, inner_lines: false, bangs_shadow: false, lid_shadow: false, ..flags };
        let blend = material.alpha.mode == AlphaMode::Blend;
        let make = || {
            let mut constants = flags.constants();
            constants.push(("GLOW_BLEND", f64::from(u8::from(blend))));
            let desc = SurfacePipeline {
                label: "glow",
                module: &self.module,
                vertex: "vs_main",
                fragment: Some("fs_main"),
                constants: &constants,
                cull: surface_cull(material),
                depth: None,
                samples: 1,
                targets: &[Some(wgpu::ColorTargetState {
                    format: HDR_FORMAT,
                    blend: Some(ADD),
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            };
            surface_pipeline(gpu, layouts, &desc)
        };
        self.pipelines.entry((flags, blend, material.double_sided)).or_insert_with(make).clone()
    }

    /// Draws the light.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        inputs: &GlowInputs<'_>,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let GlowInputs { scene, frame, light } = inputs;
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("glow"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: light,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            timestamp_writes: timestamps,
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
