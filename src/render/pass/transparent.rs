//! Blended surfaces with their outlines, far before near.

use std::collections::HashMap;

use super::{ColorPipeline, Mark, SurfaceFlags, color_pipeline, encode_constant, surface_cull};
use crate::{
    Gpu,
    material::Material,
    render::{Layouts, Output, draw_list, shaders, upload::GpuScene},
};

/// Pipelines by what a material uses.
#[derive(Debug)]
pub(crate) struct TransparentPass {
    output: Output,
    module: wgpu::ShaderModule,
    pipelines: HashMap<(SurfaceFlags, bool, bool), wgpu::RenderPipeline>,
}

/// What the pass reads; `scene.transparent_order` is sorted for the view.
pub(crate) struct TransparentInputs<'a> {
    pub scene: &'a GpuScene,
}

impl TransparentPass {
    pub fn new(gpu: &Gpu, output: Output) -> Self {
        Self { output, module: shaders::module(&gpu.device, "transparent"), pipelines: HashMap::new() }
    }

    /// The pipeline for a material, made on first use.
    pub fn pipeline(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        flags: SurfaceFlags,
        material: &Material,
    ) -> wgpu::RenderPipeline {
        // What is blended fades by its alpha.
        let flags = SurfaceFlags { dither_samples: flags.dither_fade, ..flags };
        let make = || {
            let mut constants = flags.constants();
            constants.push(encode_constant(flags.output(self.output)));
            color_pipeline(
                gpu,
                layouts,
                flags.output(self.output),
                &ColorPipeline {
                    label: "transparent",
                    module: &self.module,
                    fragment: "fs_main",
                    constants: &constants,
                    cull: surface_cull(material),
                    blend: true,
                    write_depth: material.alpha.write_depth,
                    mark: Mark::None,
                },
            )
        };
        self.pipelines.entry((flags, material.double_sided, material.alpha.write_depth)).or_insert_with(make).clone()
    }

    /// Draws each surface, then its outline.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, inputs: &TransparentInputs<'_>) {
        let scene = inputs.scene;
        for draw in scene.transparent_order.iter().map(|&i| &scene.draws[i]) {
            draw_list::record(pass, scene, draw, &draw.surface);
            if let Some(outline) = &draw.outline {
                draw_list::record(pass, scene, draw, outline);
            }
        }
    }
}
