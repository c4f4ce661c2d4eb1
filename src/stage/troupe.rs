//! The actors of one character: what they share on the GPU beyond the character itself, and the slot of each in it.

use std::ops::Range;

use crate::render::draw_list::Draw;
use crate::render::made::Made;
use crate::render::pass::bangs_shadow::BangsAtlas;
use crate::render::pass::deform::DeformBuffers;
use crate::render::uploads::Uploads;
use crate::render::vertex::AffineRows;
use crate::render::{Character, CharacterData, Renderer};

use super::maps::MapsKey;
use super::past::TroupePast;

/// Actors of one character, as many as their buffers may hold; the rest are another troupe.
#[derive(Debug)]
pub(crate) struct Troupe {
    pub character: Character,
    /// Which slots are taken.
    slots: Vec<bool>,
    /// Slots that there may be.
    most: usize,
    pub deform: DeformBuffers,
    pub bangs: Option<BangsAtlas>,
    /// Where its vertices were, while somebody asks.
    pub past: Option<TroupePast>,
    /// Group 1, and the same while maps of shadows are drawn.
    pub groups: Option<[wgpu::BindGroup; 2]>,
    /// Joints and weights of all slots.
    joints: Vec<AffineRows>,
    weights: Vec<f32>,
    /// Slots whose vertices are in another pose.
    pub moved: Vec<u32>,
    /// What stands for its actors in draws.
    pub instances: Range<u32>,
    /// Parts of these by the number that tells eyes apart.
    pub numbered: Vec<(u32, Range<u32>)>,
    /// What stands for the shells of their coats: the innermost of all of them, then the next.
    pub shells: Range<u32>,
    /// What stands for them in the shadow map of the whole stage.
    pub on_world: Range<u32>,
    pub maps: Made<MapsKey, ()>,
}

impl Troupe {
    pub fn new(renderer: &Renderer, character: &Character) -> Self {
        let data = &character.0;
        let most = renderer.deform_slots(&data.source).min(data.bangs.as_ref().map_or(usize::MAX, |b| b.most_tiles()));
        Self {
            character: character.clone(),
            slots: Vec::new(),
            most: most.max(1),
            deform: renderer.deform_buffers(&data.source, 1),
            bangs: None,
            past: None,
            groups: None,
            joints: Vec::new(),
            weights: Vec::new(),
            moved: Vec::new(),
            instances: 0..0,
            numbered: Vec::new(),
            shells: 0..0,
            on_world: 0..0,
            maps: Made::not_yet(()),
        }
    }

    /// What they are.
    pub fn data(&self) -> &CharacterData {
        &self.character.0
    }

    /// A slot for an actor, where there is room.
    pub fn take_slot(&mut self) -> Option<u32> {
        let free = self.slots.iter().position(|taken| !taken);
        let slot = free.or_else(|| (self.slots.len() < self.most).then_some(self.slots.len()))?;
        if slot == self.slots.len() {
            self.slots.push(true);
        }
        self.slots[slot] = true;
        Some(slot as u32)
    }

    /// Frees the slots of actors that have gone.
    pub fn keep_slots(&mut self, stays: impl Fn(u32) -> bool) {
        self.slots.iter_mut().zip(0..).filter(|(_, slot)| !stays(*slot)).for_each(|(taken, _)| *taken = false);
        self.moved.retain(|slot| stays(*slot));
    }

    pub fn is_empty(&self) -> bool {
        !self.slots.contains(&true)
    }

    /// Makes room for all slots; whether anything is bound otherwise now.
    pub fn fit(&mut self, renderer: &Renderer) -> bool {
        let data = &*self.character.0;
        let wanted = self.slots.len().max(1);
        let (joints, weights) = (data.source.joint_count(), data.source.weight_count());
        self.joints.resize(wanted * joints, AffineRows::default());
        self.weights.resize(wanted * weights, 0.0);
        let mut is_other = false;
        if wanted > self.deform.slots() {
            self.deform = renderer.deform_buffers(&data.source, wanted.next_power_of_two().min(self.most));
            self.moved = (0..self.slots.len() as u32).filter(|s| self.slots[*s as usize]).collect();
            is_other = true;
        }
        if let Some(fit) = &data.bangs
            && self.bangs.as_ref().is_none_or(|atlas| wanted > atlas.tiles())
        {
            self.bangs = renderer.bangs_atlas(fit, wanted.next_power_of_two().min(self.most));
            self.maps = Made::not_yet(());
            is_other = true;
        }
        is_other
    }

    /// Takes the pose of a slot.
    pub fn pose(&mut self, slot: u32, joints: &[AffineRows], weights: &[f32]) {
        let of = |count: usize| slot as usize * count..(slot as usize + 1) * count;
        self.joints[of(joints.len())].copy_from_slice(joints);
        self.weights[of(weights.len())].copy_from_slice(weights);
        if !self.moved.contains(&slot) {
            self.moved.push(slot);
        }
    }

    /// Sends the poses that have changed, slots that follow each other together.
    pub fn send(&mut self, uploads: &mut Uploads, encoder: &mut wgpu::CommandEncoder) {
        self.moved.sort_unstable();
        let source = &self.character.0.source;
        for run in self.moved.chunk_by(|a, b| a + 1 == *b) {
            let slots = run[0] as usize..run[run.len() - 1] as usize + 1;
            let of = |count: usize| slots.start * count..slots.end * count;
            let (joints, weights) = (of(source.joint_count()), of(source.weight_count()));
            let at = |first: usize, size: usize| (first * size) as u64;
            let joints_at = at(joints.start, size_of::<AffineRows>());
            let weights_at = at(weights.start, size_of::<f32>());
            uploads.write(encoder, &self.deform.joints, joints_at, bytemuck::cast_slice(&self.joints[joints]));
            uploads.write(encoder, &self.deform.weights, weights_at, bytemuck::cast_slice(&self.weights[weights]));
        }
        if !self.moved.is_empty() {
            self.deform.send_slots(uploads, encoder, source, &self.moved);
        }
    }

    /// Draws that are not blended, or not whole.
    pub fn solid_draws(&self) -> impl Iterator<Item = (usize, &Draw)> {
        self.data().draws.iter().enumerate().filter(|(_, draw)| draw.is_solid())
    }
}
