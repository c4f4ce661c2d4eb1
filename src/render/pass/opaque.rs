//! Opaque and alpha-masked surfaces.

use std::collections::HashMap;

use super::{ColorPipeline, Mark, SurfaceFlags, color_pipeline, encode_constant, surface_cull};
use crate::{
    Gpu,
    material::Material,
    render::{Layouts, Output, draw_list, shaders, upload::GpuScene},
};

/// Pipelines by what a material uses.
#[derive(Debug)]
pub(crate) struct OpaquePass {
    output: Output,
    module: wgpu::ShaderModule,
    pipelines: HashMap<(SurfaceFlags, bool, Mark), wgpu::RenderPipeline>,
}

/// What the pass reads.
pub(crate) struct OpaqueInputs<'a> {
    pub scene: &'a GpuScene,
}

impl OpaquePass {
    pub fn new(gpu: &Gpu, output: Output) -> Self {
        Self { output, module: shaders::module(&gpu.device, "opaque"), pipelines: HashMap::new() }
    }

    /// The pipeline for a material, made on first use.
    pub fn pipeline(
        &mut self,
        gpu: &Gpu,
        layouts: &Layouts,
        flags: SurfaceFlags,
        material: &Material,
        mark: Mark,
    ) -> wgpu::RenderPipeline {
        // With several samples a cut can cover part of a pixel.
        let has_samples = self.output.samples == 4;
        let flags = SurfaceFlags {
            alpha_coverage: flags.alpha_mask && has_samples,
            dither_samples: flags.dither_fade && has_samples,
            ..flags
        };
        let covered = flags.alpha_coverage || flags.dither_samples;
        let make = || {
            let mut constants = flags.constants();
            constants.push(encode_constant(flags.output(self.output)));
            color_pipeline(
                gpu,
                layouts,
                flags.output(self.output),
                &ColorPipeline {
                    label: "opaque",
                    module: &self.module,
                    fragment: if covered { "fs_covered" } else { "fs_main" },
                    constants: &constants,
                    cull: surface_cull(material),
                    blend: false,
                    write_depth: true,
                    mark,
                },
            )
        };
        self.pipelines.entry((flags, material.double_sided, mark)).or_insert_with(make).clone()
    }

    /// Draws all opaque surfaces, then all masked ones (the order of upload). Where eyes are to be seen through hair, they
    /// follow what is neither, and hair comes last.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, inputs: &OpaqueInputs<'_>) {
        for draw in inputs.scene.draws.iter().filter(|d| !d.blend) {
            if draw.mark == Mark::None {
                draw_list::record(pass, inputs.scene, draw, &draw.surface);
            } else {
                draw_list::record_marked(pass, inputs.scene, draw, &draw.surface, draw.mark);
            }
        }
    }
}
