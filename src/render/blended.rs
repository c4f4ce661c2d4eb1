//! Blended draws of a view in their order.

use std::ops::Range;

use glam::Vec3;

use super::bind;
use super::uploads::Uploads;
use super::vertex::Instance;
use crate::Gpu;
use crate::stage::bodies::Bodies;
use crate::stage::crowd::Crowd;

/// Actors of a troupe whose blended surfaces take their turns by distance, each for itself. Of more, each surface is drawn for
/// all of them together, far before near: what shows through another one's blended surface may then be missing there.
pub(super) const MOST_APART: usize = 8;

/// A draw of some actors of a troupe.
#[derive(Debug)]
pub(crate) struct Blended {
    pub troupe: usize,
    pub draw: usize,
    /// In the list of the view.
    pub instances: Range<u32>,
    /// Those that write depth first, then by queue offset, then those that do not lie over themselves in layers; then far before
    /// near, squared; then by actor and file.
    queue: (bool, i32, bool),
    depth: f32,
    place: (u32, usize),
}

/// What a view draws blended, and what stands for whom in it.
#[derive(Debug)]
pub(crate) struct BlendedList {
    pub draws: Vec<Blended>,
    pub list: Vec<Instance>,
    pub instances: wgpu::Buffer,
}

impl BlendedList {
    pub fn new(gpu: &Gpu) -> Self {
        Self { draws: Vec::new(), list: Vec::new(), instances: instances(gpu, 16) }
    }

    /// Those that write depth first, then by queue offset, then far before near (MToon, "Render Queue"); equal ones keep the
    /// order of actors and files.
    pub fn arrange(&mut self, bodies: &Bodies, crowd: &Crowd, eye: Vec3) {
        let Self { draws, list, .. } = self;
        draws.clear();
        list.clear();
        for (t, troupe) in bodies.troupes.iter().enumerate().filter(|(_, t)| t.data().has_blended) {
            let first = list.len();
            list.extend_from_slice(&crowd.list[troupe.instances.start as usize..troupe.instances.end as usize]);
            let blended = || troupe.data().draws.iter().enumerate().filter(|(_, draw)| draw.blend);
            let mut push = |depth: f32, draw: usize, instances: Range<usize>, actor: u32| {
                let of = &troupe.data().draws[draw];
                let instances = instances.start as u32..instances.end as u32;
                let (queue, place) = ((!of.write_depth, of.queue_offset, of.layered), (actor, draw));
                draws.push(Blended { troupe: t, draw, instances, queue, depth, place });
            };
            if list.len() - first <= MOST_APART {
                for (at, instance) in list.iter().enumerate().skip(first) {
                    let body = &bodies.list[instance.actor as usize];
                    // In character space, where distances of one body compare alike.
                    let eye = body.world.inverse().transform_point3(eye);
                    let scale = body.world.x_axis.truncate().length_squared();
                    for (index, draw) in blended() {
                        push(draw.center.distance_squared(eye) * scale, index, at..at + 1, instance.actor);
                    }
                }
            } else {
                let away = |i: &Instance| bodies.list[i.actor as usize].middle().distance_squared(eye);
                list[first..].sort_by(|a, b| away(b).total_cmp(&away(a)));
                for (index, _) in blended() {
                    push(away(&list[first]), index, first..list.len(), list[first].actor);
                }
            }
        }
        draws.sort_by(|a, b| a.queue.cmp(&b.queue).then(b.depth.total_cmp(&a.depth)).then(a.place.cmp(&b.place)));
    }

    /// Sends the list.
    pub fn send(&mut self, gpu: &Gpu, uploads: &mut Uploads, encoder: &mut wgpu::CommandEncoder) {
        if size_of_val(&self.list[..]) as u64 > self.instances.size() {
            self.instances = instances(gpu, self.list.len().next_power_of_two());
        }
        uploads.write(encoder, &self.instances, 0, bytemuck::cast_slice(&self.list));
    }
}

fn instances(gpu: &Gpu, count: usize) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST;
    bind::buffer(gpu, "blended instances", (count * size_of::<Instance>()) as u64, usage)
}
