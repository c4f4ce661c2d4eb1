//! Morphs and skin in compute: once for every new pose, read by every later pass.

use crate::render::bind;
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

/// What deforms a character, whatever its pose.
#[derive(Debug)]
pub(crate) struct DeformSource {
    fixed: [wgpu::Buffer; 5],
    joints: u64,
    weights: u64,
    /// How many, and their bytes.
    vertices: u32,
    size: u64,
}

/// Buffers of one body.
#[derive(Debug)]
pub(crate) struct DeformBuffers {
    pub joints: wgpu::Buffer,
    pub weights: wgpu::Buffer,
    /// What every draw reads its vertices from.
    pub deformed: wgpu::Buffer,
    group: wgpu::BindGroup,
    vertices: u32,
}

impl DeformSource {
    /// Uploads what deforms a character.
    pub fn new(gpu: &Gpu, input: &DeformInput<'_>) -> Self {
        let fixed = |label, contents| bind::filled(gpu, label, contents, wgpu::BufferUsages::STORAGE);
        Self {
            fixed: [
                fixed("deform groups", bytemuck::cast_slice(input.groups)),
                fixed("source vertices", bytemuck::cast_slice(input.source)),
                fixed("vertex refs", bytemuck::cast_slice(input.vertex_refs)),
                fixed("influences", bytemuck::cast_slice(input.influences)),
                fixed("morphs", bytemuck::cast_slice(input.morphs)),
            ],
            joints: (input.joint_count * size_of::<AffineRows>()) as u64,
            weights: (input.weight_count * size_of::<f32>()) as u64,
            vertices: input.source.len() as u32,
            size: size_of_val(input.source) as u64,
        }
    }

    /// Bytes on the GPU.
    pub fn bytes(&self) -> u64 {
        self.fixed.iter().map(wgpu::Buffer::size).sum()
    }
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

    /// Buffers of a body of a character.
    pub fn buffers(&self, gpu: &Gpu, source: &DeformSource) -> DeformBuffers {
        use wgpu::BufferUsages as U;
        let sized = |label, bytes: u64, usage| bind::buffer(gpu, label, bytes.max(64), usage);
        let joints = sized("joints", source.joints, U::STORAGE | U::COPY_DST);
        let weights = sized("morph weights", source.weights, U::STORAGE | U::COPY_DST);
        let deformed = sized("deformed vertices", source.size, U::STORAGE);
        let bound = source.fixed.iter().chain([&joints, &weights, &deformed]);
        let layout = self.pipeline.get_bind_group_layout(0);
        let group = bind::group(gpu, "deform", &layout, bound.map(|b| b.as_entire_binding()));
        DeformBuffers { joints, weights, deformed, group, vertices: source.vertices }
    }

    /// Deforms all vertices of each of these bodies.
    pub fn encode<'a>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        bodies: impl Iterator<Item = &'a DeformBuffers>,
        timestamps: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("deform"), timestamp_writes: timestamps });
        pass.set_pipeline(&self.pipeline);
        for body in bodies {
            pass.set_bind_group(0, &body.group, &[]);
            let workgroups = body.vertices.div_ceil(WORKGROUP);
            pass.dispatch_workgroups(workgroups.min(MAX_WORKGROUPS), workgroups.div_ceil(MAX_WORKGROUPS).max(1), 1);
        }
    }
}
