//! Where actors were when their stage was prepared last, for the movement between two pictures of a window. It is there while
//! a stage asks for it and no longer.

use std::sync::atomic::{AtomicU64, Ordering};

use super::bodies::Bodies;
use crate::render::uploads::Uploads;
use crate::render::vertex::{AffineRows, DeformVertex};
use crate::render::{Renderer, bind};

static NEXT: AtomicU64 = AtomicU64::new(1);

/// That of a stage.
#[derive(Debug, Default)]
pub(crate) struct StagePast {
    /// Numbers of the last time that it was prepared and of the one before; no other stage has the same. 0: there is none.
    pub before: u64,
    pub now: u64,
    /// Whether actors have come or gone between the two.
    pub has_others: bool,
    ids: Vec<u64>,
    /// Places of the actors, in their order.
    worlds: Option<wgpu::Buffer>,
    rows: Vec<AffineRows>,
}

/// That of a troupe.
#[derive(Debug)]
pub(crate) struct TroupePast {
    /// Vertices of all slots as they were.
    deformed: wgpu::Buffer,
    /// Group 3.
    pub group: wgpu::BindGroup,
    /// Whether vertices have moved since they were copied.
    is_stale: bool,
    /// Whether nothing is known of its vertices, and slots of which nothing is: they have not moved.
    is_new: bool,
    new_slots: Vec<u32>,
}

impl Bodies {
    /// Keeps where everybody was, before vertices are deformed anew; forgets it where nobody asks.
    pub fn remember(
        &mut self,
        renderer: &Renderer,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        is_asked: bool,
    ) {
        let Self { list, troupes, past, .. } = self;
        if !is_asked {
            if past.now != 0 {
                *past = StagePast::default();
                troupes.iter_mut().for_each(|troupe| troupe.past = None);
                list.iter_mut().for_each(|body| body.last_world = None);
            }
            return;
        }
        let gpu = renderer.gpu();
        (past.before, past.now) = (past.now, NEXT.fetch_add(1, Ordering::Relaxed));
        past.has_others = !list.iter().map(|body| &body.id).eq(&past.ids);
        if past.has_others {
            past.ids.clear();
            past.ids.extend(list.iter().map(|body| body.id));
        }
        let bytes = (list.len().max(1) * size_of::<AffineRows>()) as u64;
        let has_grown = past.worlds.as_ref().is_none_or(|worlds| worlds.size() < bytes);
        if has_grown {
            let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
            past.worlds = Some(bind::buffer(gpu, "places before", bytes.next_power_of_two(), usage));
        }
        let Some(worlds) = &past.worlds else { return };
        for troupe in troupes.iter_mut() {
            let current = &troupe.deform.deformed;
            let known = troupe.past.take().filter(|p| p.deformed.size() == current.size());
            let is_new = known.is_none();
            let deformed = known.as_ref().map(|p| p.deformed.clone()).unwrap_or_else(|| {
                let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST;
                bind::buffer(gpu, "vertices before", current.size(), usage)
            });
            if known.as_ref().is_some_and(|p| p.is_stale) {
                encoder.copy_buffer_to_buffer(current, 0, &deformed, 0, current.size());
            }
            let (group, mut new_slots) = match known {
                Some(known) if !has_grown => (known.group, known.new_slots),
                _ => {
                    let bound = [worlds.as_entire_binding(), deformed.as_entire_binding()];
                    (bind::group(gpu, "past", renderer.variants.past(), bound), Vec::new())
                }
            };
            new_slots.clear();
            troupe.past = Some(TroupePast { deformed, group, is_stale: !troupe.moved.is_empty(), is_new, new_slots });
        }
        past.rows.clear();
        for body in list.iter_mut() {
            if body.last_world.is_none()
                && let Some(of_troupe) = &mut troupes[body.troupe].past
            {
                of_troupe.new_slots.push(body.slot());
            }
            past.rows.push(body.last_world.unwrap_or(body.world).into());
            body.last_world = Some(body.world);
        }
        uploads.write(encoder, worlds, 0, bytemuck::cast_slice(&past.rows));
    }

    /// Whoever is new was where it is now; after vertices have been deformed.
    pub fn settle(&mut self, encoder: &mut wgpu::CommandEncoder) {
        for troupe in &self.troupes {
            let Some(past) = &troupe.past else { continue };
            let current = &troupe.deform.deformed;
            if past.is_new {
                encoder.copy_buffer_to_buffer(current, 0, &past.deformed, 0, current.size());
                continue;
            }
            let bytes = u64::from(troupe.data().source.vertices()) * size_of::<DeformVertex>() as u64;
            for slot in past.new_slots.iter().filter(|_| bytes > 0) {
                let at = u64::from(*slot) * bytes;
                encoder.copy_buffer_to_buffer(current, at, &past.deformed, at, bytes);
            }
        }
    }
}
