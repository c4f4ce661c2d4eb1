//! The materials of a scene on the GPU: bytes, textures, and the groups that shaders bind of them.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::{Arc, Mutex, PoisonError};

use super::bind;
use super::material::{self, Composition, Source};
use super::shaders::{BindingKind, Places, Shaders};
use super::textures::TextureSet;
use super::uploads::Uploads;
use super::variants::{Bound, BoundLayout};
use crate::eye::EyeRow;
use crate::material::{Material, Surroundings, skin_layer};
use crate::motion::{Driven, Shifts};
use crate::scene::Scene;
use crate::sdf::FaceMap;
use crate::{Actor, Error, Gpu, Result};

/// The strictest alignment of offsets in WebGPU.
const OFFSET_ALIGNMENT: u64 = 256;

/// Distance between the bytes of two materials.
pub(super) fn stride(places: &Places) -> u64 {
    (places.size as u64).next_multiple_of(OFFSET_ALIGNMENT)
}

/// Materials of a scene as shaders see them.
#[derive(Debug)]
pub(crate) struct Looks {
    pub(super) places: Arc<Places>,
    pub(super) sources: Vec<Material>,
    pub(super) compositions: Vec<Composition>,
    pub(super) numbers: wgpu::Buffer,
    pub(super) stride: u64,
    pub(super) textures: Vec<Vec<BoundTexture>>,
    /// Flat, with layers.
    pub(super) white: [wgpu::TextureView; 2],
    pub(super) default_sampler: wgpu::Sampler,
    pub(super) face_maps: Vec<FaceMap>,
    pub(super) metres_per_uv: Vec<[f32; 2]>,
    pub(super) uv_boxes: Vec<[[f32; 2]; 2]>,
    pub(super) eyes: Vec<Vec<EyeRow>>,
    pub(super) driven: Vec<Driven>,
    pub(super) self_shadow: bool,
}

#[derive(Debug)]
pub(super) struct BoundTexture {
    pub(super) name: String,
    pub(super) view: wgpu::TextureView,
    pub(super) sampler: wgpu::Sampler,
}

impl Looks {
    /// Bytes of a material.
    pub fn bytes(&self, index: usize, material: &Material) -> Result<Vec<u8>> {
        material::bytes(&self.places, &self.surroundings(index, material))
    }

    /// Refuses a changed material that cannot be drawn with what the upload has made.
    fn check(&self, shaders: &Shaders, index: usize, material: &Material) -> Result<()> {
        let fault =
            |what: &str, message: String| Err(Error::Argument { what: format!("materials[{index}]{what}"), message });
        let Some(source) = self.sources.get(index) else {
            return fault("", format!("is not there; there are {}", self.sources.len()));
        };
        if let Some((key, message)) = material.clone().out_of_range() {
            return fault(&format!(" {:?}, {key}", material.name), message);
        }
        let layers = |m: &Material| (m.blending(), m.has_core(), m.alpha.front_writes_depth, m.strips.map(|s| s.sort));
        let alpha = |m: &Material| (m.alpha.mode, m.alpha.hashed, m.alpha.write_depth, m.alpha.queue_offset);
        let fixed = |m: &Material| (alpha(m), m.double_sided, layers(m));
        let runs = |m: &Material| m.hair.map(|hair| hair.direction);
        let mut other = material.clone();
        let sections: Vec<&str> = other.sections_mut().map(|section| section.about().key).collect();
        let composed = Composition::new(shaders, &self.surroundings(index, material));
        let other = |differs: bool, what: &str| differs.then(|| format!("{what} others"));
        let difference = self.compositions[index]
            .difference(&composed, &sections)
            .or_else(|| other(fixed(material) != fixed(source), "its alpha mode, draw order or sides are"))
            .or_else(|| other(runs(material) != runs(source), "the directions of its hair are"));
        difference.map_or(Ok(()), |difference| {
            let message = format!(
                "{difference} at the upload, and only numbers may change after that; please upload it with it, weakened to \
                 nothing where it must not be seen"
            );
            fault(&format!(" {:?}", material.name), message)
        })
    }

    pub fn surroundings<'a>(&'a self, index: usize, material: &'a Material) -> Surroundings<'a> {
        Surroundings {
            material,
            face_maps: &self.face_maps,
            metres_per_uv: self.metres_per_uv.get(index).copied().unwrap_or([1.0; 2]),
            uv_box: self.uv_boxes.get(index).copied().unwrap_or([[0.0; 2], [1.0; 2]]),
            eyes: self.eyes.get(index).map_or(&[], Vec::as_slice),
            skin_layer: skin_layer(&self.sources, index),
            driven: self.driven.get(index).unwrap_or(Driven::NONE),
            self_shadow: self.self_shadow,
        }
    }

    /// Group 2 of a material, by what a shader binds: with these numbers, and with another base texture where there is one.
    pub fn group(
        &self,
        gpu: &Gpu,
        material: usize,
        layout: &BoundLayout,
        numbers: &wgpu::Buffer,
        base: Option<&wgpu::TextureView>,
    ) -> wgpu::BindGroup {
        let texture = |name: &str| self.textures[material].iter().find(|t| t.name == name);
        // Where lit and shade share their texture, its place serves both.
        let view = |name: &str, white: usize| {
            let own = texture(name).map_or(&self.white[white], |t| &t.view);
            wgpu::BindingResource::TextureView(base.filter(|_| name == "base_texture").unwrap_or(own))
        };
        let resource = |name: &str, kind| match kind {
            BindingKind::Numbers => wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: numbers,
                offset: material as u64 * self.stride,
                size: wgpu::BufferSize::new(self.places.size as u64),
            }),
            BindingKind::Texture => view(name, 0),
            BindingKind::TextureArray => view(name, 1),
            BindingKind::Sampler => wgpu::BindingResource::Sampler(
                texture(name.trim_end_matches("_sampler")).map_or(&self.default_sampler, |t| &t.sampler),
            ),
        };
        let entries: Vec<_> = layout
            .bindings
            .iter()
            .map(|b| wgpu::BindGroupEntry { binding: b.index, resource: resource(&b.name, b.kind) })
            .collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("material"),
            layout: &layout.group,
            entries: &entries,
        })
    }
}

/// What of its materials one actor has otherwise.
#[derive(Debug, Default)]
pub(crate) struct Edits {
    /// Bytes of all materials, made at the first change.
    numbers: Option<wgpu::Buffer>,
    /// What the actor and its pose change.
    changes: (BTreeMap<usize, Material>, Shifts),
    /// Bytes of materials that have changed since the last frame.
    waiting: Vec<(usize, Vec<u8>)>,
    /// Other base textures, by material.
    bases: HashMap<usize, wgpu::TextureView>,
    /// Groups with these, by material and layout, made when they are first drawn with.
    groups: Mutex<Vec<Bound>>,
}

impl Edits {
    /// Takes the materials that an actor has otherwise, and what its pose shifts of all; whether any is another than before.
    ///
    /// # Errors
    /// A material that is not there, a number out of its range, or what was settled at the upload.
    pub fn take(&mut self, shaders: &Shaders, looks: &Looks, actor: &Actor) -> Result<bool> {
        let (materials, shifts) = (&actor.materials, &actor.pose.shifts);
        if self.changes.0 == *materials && self.changes.1 == *shifts {
            return Ok(false);
        }
        for (index, material) in materials.iter().filter(|(i, m)| self.changes.0.get(i) != Some(m)) {
            looks.check(shaders, *index, material)?;
        }
        let (before, moved) = &self.changes;
        let touched = before.keys().chain(materials.keys()).copied();
        for index in touched.chain(moved.materials()).chain(shifts.materials()).collect::<BTreeSet<_>>() {
            let Some(source) = looks.sources.get(index) else { continue };
            let material = shifts.applied(index, materials.get(&index).unwrap_or(source)).clamped();
            self.waiting.push((index, looks.bytes(index, &material)?));
        }
        self.changes = (materials.clone(), shifts.clone());
        Ok(true)
    }

    /// Shows another base texture of a material.
    pub fn set_base(&mut self, material: usize, view: wgpu::TextureView) {
        self.bases.insert(material, view);
        self.groups.get_mut().unwrap_or_else(PoisonError::into_inner).retain(|g| g.material != material);
    }

    /// Sends the bytes of materials that have changed.
    pub fn send(&mut self, gpu: &Gpu, looks: &Looks, uploads: &mut Uploads, encoder: &mut wgpu::CommandEncoder) {
        if self.waiting.is_empty() {
            return;
        }
        let numbers = self.numbers.get_or_insert_with(|| {
            let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
            let copy = bind::buffer(gpu, "materials of an actor", looks.numbers.size(), usage);
            encoder.copy_buffer_to_buffer(&looks.numbers, 0, &copy, 0, copy.size());
            self.groups.get_mut().unwrap_or_else(PoisonError::into_inner).clear();
            copy
        });
        for (index, bytes) in self.waiting.drain(..) {
            uploads.write(encoder, numbers, index as u64 * looks.stride, &bytes);
        }
    }

    /// The group of a material with its changes; `None` where it has none.
    pub fn group(&self, gpu: &Gpu, looks: &Looks, bound: &Bound) -> Option<wgpu::BindGroup> {
        let base = self.bases.get(&bound.material);
        if self.numbers.is_none() && base.is_none() {
            return None;
        }
        let mut groups = self.groups.lock().unwrap_or_else(PoisonError::into_inner);
        let is_it = |g: &&Bound| g.material == bound.material && Arc::ptr_eq(&g.layout, &bound.layout);
        if let Some(known) = groups.iter().find(is_it) {
            return Some(known.group.clone());
        }
        let numbers = self.numbers.as_ref().unwrap_or(&looks.numbers);
        let group = looks.group(gpu, bound.material, &bound.layout, numbers, base);
        groups.push(Bound { group: group.clone(), ..bound.clone() });
        Some(group)
    }
}

/// Textures of a material with their samplers.
pub(super) fn bound_textures(scene: &Scene, composition: &Composition, textures: &TextureSet) -> Vec<BoundTexture> {
    let bound = composition.slots().map(|slot| {
        let (view, sampler) = match slot.source {
            Source::Texture(t) => textures.get(&scene.textures, t.texture, slot.read),
            Source::FaceMap(map) => textures.face(map),
            Source::Generated(generated) => textures.generated(generated),
        };
        BoundTexture { name: slot.name.clone(), view: view.clone(), sampler: sampler.clone() }
    });
    bound.collect()
}
