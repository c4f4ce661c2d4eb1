//! Fluff: shells of a coat of short hair, drawn as instances of the surface.

use std::collections::HashMap;

use super::{ColorPipeline, Mark, SurfaceFlags, color_pipeline, encode_constant};
use crate::{
    Gpu,
    material::{Fluff, MAX_SHELLS},
    render::{Layouts, Output, shaders, upload::GpuScene},
};

/// Pipelines by what a material uses.
#[derive(Debug)]
pub(crate) struct FluffPass {
    output: Output,
    module: wgpu::ShaderModule,
    pipelines: HashMap<SurfaceFlags, wgpu::RenderPipeline>,
}

/// What the pass reads.
pub(crate) struct FluffInputs<'a> {
    pub scene: &'a GpuScene,
    /// Size of a metre on the nearest character, pixels.
    pub px_per_m: f32,
}

/// Shells of a coat: `fluff_shells` of `wgsl/lib/fluff.wgsl`.
fn shells(fluff: &Fluff, px_per_m: f32) -> u32 {
    let most = fluff.shells.clamp(1, MAX_SHELLS);
    ((fluff.length_m * px_per_m).ceil() as u32).clamp(most.min(4), most)
}

impl FluffPass {
    pub fn new(gpu: &Gpu, output: Output) -> Self {
        Self { output, module: shaders::module(&gpu.device, "fluff"), pipelines: HashMap::new() }
    }

    /// The pipeline for a material, made on first use.
    pub fn pipeline(&mut self, gpu: &Gpu, layouts: &Layouts, flags: SurfaceFlags) -> wgpu::RenderPipeline {
        let flags = SurfaceFlags { dither_samples: flags.dither_fade && self.output.samples == 4, ..flags };
        let make = || {
            let mut constants = flags.constants();
            constants.push(encode_constant(flags.output(self.output)));
            color_pipeline(
                gpu,
                layouts,
                flags.output(self.output),
                &ColorPipeline {
                    label: "fluff",
                    module: &self.module,
                    fragment: if flags.dither_samples { "fs_dithered" } else { "fs_main" },
                    constants: &constants,
                    cull: Some(wgpu::Face::Back),
                    blend: true,
                    // Shells lie over each other in their order.
                    write_depth: false,
                    mark: Mark::None,
                },
            )
        };
        self.pipelines.entry(flags).or_insert_with(make).clone()
    }

    /// Draws every coat, root to tips.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, inputs: &FluffInputs<'_>) {
        let FluffInputs { scene, px_per_m } = inputs;
        let instances = scene.instance_rows.len() as u32;
        for draw in &scene.draws {
            let (Some(pipeline), Some(fluff)) = (&draw.fluff, scene.material(draw).fluff) else { continue };
            pass.set_pipeline(pipeline);
            pass.set_bind_group(2, &scene.material_groups[draw.material], &[]);
            // The first copy of the instances is the surface itself.
            let last = instances * (1 + shells(&fluff, *px_per_m));
            pass.draw_indexed(draw.indices.clone(), 0, instances..last);
        }
    }
}
