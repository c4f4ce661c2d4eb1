//! Morphs and skin in compute: once for every new pose, read by every later pass.

use crate::render::bind;
use crate::render::shaders::Recipe;
use crate::render::uploads::Uploads;
use crate::render::variants::Variants;
use crate::render::vertex::{AffineRows, DeformGroup, DeformVertex, MorphEntry};
use crate::stage::troupe::Troupe;
use crate::{Gpu, Result};

const WORKGROUP: u32 = 64;
/// Most workgroups along one axis in WebGPU; `wgsl/pass/deform.wgsl` counts rows of as many.
const MAX_WORKGROUPS: u32 = 65535;
/// Slots that have a place in `Moved` of the shader.
const MOST_SLOTS: usize = 1024;

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
    joints: usize,
    weights: usize,
    vertices: u32,
}

/// Buffers of several bodies of a character: each has a slot in them.
#[derive(Debug)]
pub(crate) struct DeformBuffers {
    pub joints: wgpu::Buffer,
    pub weights: wgpu::Buffer,
    /// What every draw reads its vertices from.
    pub deformed: wgpu::Buffer,
    /// `Moved` of the shader.
    moved: wgpu::Buffer,
    group: wgpu::BindGroup,
    slots: usize,
}

impl DeformBuffers {
    /// How many there are.
    pub fn slots(&self) -> usize {
        self.slots
    }

    /// Sends which slots are deformed next.
    pub fn send_slots(
        &self,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        source: &DeformSource,
        slots: &[u32],
    ) {
        let strides = [source.joints as u32, source.weights as u32, 0, 0];
        uploads.write(encoder, &self.moved, 0, bytemuck::cast_slice(&strides));
        uploads.write(encoder, &self.moved, size_of_val(&strides) as u64, bytemuck::cast_slice(slots));
    }
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
            joints: input.joint_count,
            weights: input.weight_count,
            vertices: input.source.len() as u32,
        }
    }

    /// Matrices of a body.
    pub fn joint_count(&self) -> usize {
        self.joints
    }

    /// Weights of morphs of a body.
    pub fn weight_count(&self) -> usize {
        self.weights
    }

    /// Vertices of a body.
    pub fn vertices(&self) -> u32 {
        self.vertices
    }

    /// Bytes of joints, weights and vertices of a body.
    fn sizes(&self) -> [u64; 3] {
        let of = |count: usize, size: usize| (count * size) as u64;
        [
            of(self.joints, size_of::<AffineRows>()),
            of(self.weights, size_of::<f32>()),
            of(self.vertices as usize, size_of::<DeformVertex>()),
        ]
    }

    /// Slots that buffers may have on a device.
    pub fn most_slots(&self, gpu: &Gpu) -> usize {
        let binding = gpu.device.limits().max_storage_buffer_binding_size;
        let largest = self.sizes().into_iter().max().unwrap_or(0).max(1);
        ((binding / largest) as usize).min(MOST_SLOTS)
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

    /// Buffers of so many bodies of a character.
    pub fn buffers(&self, gpu: &Gpu, source: &DeformSource, slots: usize) -> DeformBuffers {
        use wgpu::BufferUsages as U;
        let sized = |label, bytes: u64, usage| bind::buffer(gpu, label, (bytes * slots as u64).max(64), usage);
        let [joints, weights, deformed] = source.sizes();
        let joints = sized("joints", joints, U::STORAGE | U::COPY_DST);
        let weights = sized("morph weights", weights, U::STORAGE | U::COPY_DST);
        let deformed = sized("deformed vertices", deformed, U::STORAGE | U::COPY_SRC);
        let moved = bind::buffer(gpu, "moved", 16 + 4 * MOST_SLOTS as u64, U::UNIFORM | U::COPY_DST);
        let bound = source.fixed.iter().chain([&joints, &weights, &deformed, &moved]);
        let layout = self.pipeline.get_bind_group_layout(0);
        let group = bind::group(gpu, "deform", &layout, bound.map(|b| b.as_entire_binding()));
        DeformBuffers { joints, weights, deformed, moved, group, slots }
    }

    /// Deforms all vertices of these troupes' bodies that have moved, those of a troupe in one dispatch.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        troupes: &mut [Troupe],
        timestamps: Option<wgpu::ComputePassTimestampWrites<'_>>,
    ) {
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("deform"), timestamp_writes: timestamps });
        pass.set_pipeline(&self.pipeline);
        for troupe in troupes.iter_mut().filter(|t| !t.moved.is_empty()) {
            pass.set_bind_group(0, &troupe.deform.group, &[]);
            let workgroups = troupe.data().source.vertices.div_ceil(WORKGROUP);
            let rows = workgroups.div_ceil(MAX_WORKGROUPS).max(1);
            pass.dispatch_workgroups(workgroups.min(MAX_WORKGROUPS), rows, troupe.moved.len() as u32);
            troupe.moved.clear();
        }
    }
}
