//! Bytes on their way to the GPU. They arrive in the order of the commands, so that frames that are encoded before one submit
//! each keep their own numbers.

use super::bind;
use crate::Gpu;

/// Size of a buffer that bytes wait in: hundreds of frames of a few characters.
const WAITING_BYTES: u64 = 1 << 20;
/// Parts of a buffer that bytes of a size make at least: several frames of a crowd.
const PARTS: u64 = 8;

/// A buffer that bytes wait in until the commands are run; another one follows when it is full, since nobody here knows when
/// an application submits.
#[derive(Debug)]
pub(crate) struct Uploads {
    gpu: Gpu,
    waiting: wgpu::Buffer,
    used: u64,
}

impl Uploads {
    pub fn new(gpu: &Gpu) -> Self {
        Self { gpu: gpu.clone(), waiting: waiting(gpu, WAITING_BYTES), used: 0 }
    }

    /// Copies bytes, a multiple of four, into the beginning of a buffer or what follows `offset`.
    pub fn write(&mut self, encoder: &mut wgpu::CommandEncoder, into: &wgpu::Buffer, offset: u64, bytes: &[u8]) {
        let size = bytes.len() as u64;
        if size == 0 {
            return;
        }
        if self.used + size > self.waiting.size() {
            self.waiting = waiting(&self.gpu, WAITING_BYTES.max(size * PARTS));
            self.used = 0;
        }
        self.gpu.queue.write_buffer(&self.waiting, self.used, bytes);
        encoder.copy_buffer_to_buffer(&self.waiting, self.used, into, offset, size);
        self.used += size;
    }
}

fn waiting(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    bind::buffer(gpu, "uploads", size, wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST)
}
