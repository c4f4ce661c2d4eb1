//! Eyes and brows over the hair that hangs before them, where the opaque pass marked both.

use std::collections::HashMap;

use super::{ColorPipeline, Mark, SurfaceFlags, color_pipeline, encode_constant, surface_cull};
use crate::{
    Gpu,
    material::Material,
    render::{Layouts, Output, draw_list, shaders, upload::GpuScene},
};

/// Pipelines by what a material uses.
#[derive(Debug)]
pub(crate) struct EyesThroughPass {
    output: Output,
    module: wgpu::ShaderModule,
    pipelines: HashMap<(SurfaceFlags, bool), wgpu::RenderPipeline>,
}

/// What the pass reads; `scene.through_order` holds the draws, the foremost first.
pub(crate) struct EyesThroughInputs<'a> {
    pub scene: &'a GpuScene,
}

impl EyesThroughPass {
    pub fn new(gpu: &Gpu, output: Output) -> Self {
        Self { output, module: shaders::module(&gpu.device, "eyes_through"), pipelines: HashMap::new() }
    }

    /// The pipeline for a material, made on first use.
    pub fn pipeline(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        flags: SurfaceFlags,
        material: &Material,
    ) -> wgpu::RenderPipeline {
        let make = || {
            let mut constants = flags.constants();
            constants.push(encode_constant(flags.output(self.output)));
            color_pipeline(
                gpu,
                layouts,
                flags.output(self.output),
                &ColorPipeline {
                    label: "eyes through",
                    module: &self.module,
                    fragment: "fs_main",
                    constants: &constants,
                    cull: surface_cull(material),
                    blend: true,
                    write_depth: false,
                    mark: Mark::Through,
                },
            )
        };
        self.pipelines.entry((flags, material.double_sided)).or_insert_with(make).clone()
    }

    /// Draws every eye and brow once more; each sample takes the foremost of them.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, inputs: &EyesThroughInputs<'_>) {
        let scene = inputs.scene;
        for draw in scene.through_order.iter().map(|&i| &scene.draws[i]) {
            if let Some(pipeline) = &draw.through {
                draw_list::record_marked(pass, scene, draw, pipeline, Mark::Through);
            }
        }
    }
}
