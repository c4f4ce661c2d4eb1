//! Actors as shaders read them, and the instances that stand for them in draws.

use crate::Gpu;
use crate::render::bind;
use crate::render::layout::Filled;
use crate::render::numbers::{ActorState, actor_numbers, put_actor};
use crate::render::uploads::Uploads;
use crate::render::vertex::Instance;

/// Lists of a stage on the GPU.
#[derive(Debug)]
pub(crate) struct Crowd {
    numbers: Filled,
    bytes: Vec<u8>,
    /// Bytes that are in the buffer.
    sent: Vec<u8>,
    pub actors: wgpu::Buffer,
    pub instances: wgpu::Buffer,
    /// What stands for what in draws.
    pub list: Vec<Instance>,
    /// What is in the buffer.
    listed: Vec<Instance>,
}

impl Crowd {
    pub fn new(gpu: &Gpu) -> Self {
        let numbers = actor_numbers();
        Self {
            actors: actors(gpu, &numbers, 1),
            instances: instances(gpu, 1),
            numbers,
            bytes: Vec::new(),
            sent: Vec::new(),
            list: Vec::new(),
            listed: Vec::new(),
        }
    }

    /// Makes room for so many actors; whether there is another buffer now.
    pub fn fit(&mut self, gpu: &Gpu, count: usize) -> bool {
        let has_grown = count as u64 * self.numbers.size() > self.actors.size();
        if has_grown {
            self.actors = actors(gpu, &self.numbers, count.next_power_of_two());
            self.sent.clear();
        }
        has_grown
    }

    /// Sends the list, and what the shaders read of each actor.
    pub fn send<'a>(
        &mut self,
        gpu: &Gpu,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        states: impl Iterator<Item = ActorState<'a>>,
    ) {
        if (self.list.len() * size_of::<Instance>()) as u64 > self.instances.size() {
            self.instances = instances(gpu, self.list.len().next_power_of_two());
            self.listed.clear();
        }
        if self.list != self.listed {
            uploads.write(encoder, &self.instances, 0, bytemuck::cast_slice(&self.list));
            self.listed.clone_from(&self.list);
        }
        self.bytes.clear();
        for state in states {
            self.bytes.extend_from_slice(self.numbers.fill(|numbers| put_actor(numbers, &state)));
        }
        if self.bytes != self.sent {
            uploads.write(encoder, &self.actors, 0, &self.bytes);
            self.sent.clone_from(&self.bytes);
        }
    }
}

fn actors(gpu: &Gpu, numbers: &Filled, count: usize) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
    bind::buffer(gpu, "actors", count as u64 * numbers.size(), usage)
}

fn instances(gpu: &Gpu, count: usize) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST;
    bind::buffer(gpu, "instances", (count * size_of::<Instance>()) as u64, usage)
}
