//! Morphs and skin in compute: once for every new pose, read by every later pass.

use crate::render::bind;
use crate::render::gpu_scene::GpuScene;
use crate::render::shaders::Recipe;
use crate::render::variants::Variants;
use crate::render::vertex::{AffineRows, DeformGroup, DeformVertex, MorphEntry};
use crate::{Gpu, Result};

const WORKGROUP: u32 = 64;
/// Most workgroups along one axis in WebGPU; `wgsl/pass/deform.wgsl` counts rows of as many.
const MAX_WORKGROUPS: u32 = 65535;

/// The compute pipeline.
#[derive(Debug)]
pub(crate) struct DeformPass {
    pipeline: wgpu::ComputePipeline,
}

/// CPU side of the buffers.
pub(crate) struct DeformInput<'a> {
    pub groups: &'a [DeformGroup],
    pub source: &'a [DeformVertex],
    pub vertex_refs: &'a [[u32; 2]],
    pub influences: &'a [u32],
    pub morphs: &'a [MorphEntry],
    pub joint_count: usize,
    pub weight_count: usize,
}

/// Buffers of one scene.
#[derive(Debug)]
pub(crate) struct DeformBuffers {
    pub joints: wgpu::Buffer,
    pub weights: wgpu::Buffer,
    /// What every draw reads its vertices from.
    pub deformed: wgpu::Buffer,
    group: wgpu::BindGroup,
    vertices: u32,
    fixed_bytes: u64,
}

/// What the pass reads and writes.
pub(crate) struct DeformInputs<'a> {
    pub scene: &'a GpuScene,
}

impl DeformPass {
    pub fn new(variants: &Variants) -> Result<Self> {
        let pipeline = variants.gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("deform"),
            layout: None,
            module: &variants.plain_module(&Recipe::plain("deform"))?,
            entry_point: Some("main"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Ok(Self { pipeline })
    }

    /// Uploads what deforms a scene.
    pub fn buffers(&self, gpu: &Gpu, input: &DeformInput<'_>) -> DeformBuffers {
        use wgpu::BufferUsages as U;
        let fixed = |label, contents| bind::filled(gpu, label, contents, U::STORAGE);
        let sized = |label, bytes: usize, usage| bind::buffer(gpu, label, bytes.max(64) as u64, usage);
        let groups = fixed("deform groups", bytemuck::cast_slice(input.groups));
        let source = fixed("source vertices", bytemuck::cast_slice(input.source));
        let vertex_refs = fixed("vertex refs", bytemuck::cast_slice(input.vertex_refs));
        let influences = fixed("influences", bytemuck::cast_slice(input.influences));
        let morphs = fixed("morphs", bytemuck::cast_slice(input.morphs));
        let joints = sized("joints", input.joint_count * size_of::<AffineRows>(), U::STORAGE | U::COPY_DST);
        let weights = sized("morph weights", input.weight_count * size_of::<f32>(), U::STORAGE | U::COPY_DST);
        let deformed = sized("deformed vertices", size_of_val(input.source), U::STORAGE);
        let bound = [&groups, &source, &vertex_refs, &influences, &morphs, &joints, &weights, &deformed];
        let layout = self.pipeline.get_bind_group_layout(0);
        let group = bind::group(gpu, "deform", &layout, bound.iter().map(|b| b.as_entire_binding()));
        let fixed_bytes = bound[..5].iter().map(|b| b.size()).sum();
        DeformBuffers { joints, weights, deformed, group, vertices: input.source.len() as u32, fixed_bytes }
    }

    /// Deforms all vertices of the scene.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        inputs: &DeformInputs<'_>,
        timestamps: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        let buffers = &inputs.scene.deform;
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("deform"), timestamp_writes: timestamps });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &buffers.group, &[]);
        let workgroups = buffers.vertices.div_ceil(WORKGROUP);
        pass.dispatch_workgroups(workgroups.min(MAX_WORKGROUPS), workgroups.div_ceil(MAX_WORKGROUPS).max(1), 1);
    }
}

impl DeformBuffers {
    /// Bytes on the GPU.
    pub fn bytes(&self) -> u64 {
        self.fixed_bytes + self.joints.size() + self.weights.size() + self.deformed.size()
    }
}
