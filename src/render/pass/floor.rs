//! The floor of the benches: the same triangles, unlit with one texture, in the same targets.

use super::{ColorPipeline, Mark, color_pipeline};
use crate::{
    Gpu,
    render::{Layouts, Output, draw_list, shaders, upload::GpuScene},
};

/// One pipeline for everything.
#[derive(Debug)]
pub(crate) struct FloorPass {
    pipeline: wgpu::RenderPipeline,
}

/// What the pass reads.
pub(crate) struct FloorInputs<'a> {
    pub scene: &'a GpuScene,
}

impl FloorPass {
    pub fn new(gpu: &Gpu, layouts: &Layouts, output: Output) -> Self {
        let module = shaders::module(&gpu.device, "floor");
        let pipeline = color_pipeline(
            gpu,
            layouts,
            output,
            &ColorPipeline {
                label: "floor",
                module: &module,
                fragment: "fs_main",
                constants: &[],
                cull: Some(wgpu::Face::Back),
                blend: false,
                write_depth: true,
                mark: Mark::None,
            },
        );
        Self { pipeline }
    }

    /// Draws every surface.
    pub fn encode(&self, pass: &mut wgpu::RenderPass<'_>, inputs: &FloorInputs<'_>) {
        for draw in &inputs.scene.draws {
            draw_list::record(pass, inputs.scene, draw, &self.pipeline);
        }
    }
}
