//! The materials of a scene on the GPU: bytes, textures, and the groups that shaders bind of them.

use std::sync::Arc;

use super::material::{self, Composition, Source};
use super::shaders::{BindingKind, Places};
use super::textures::TextureSet;
use super::uploads::Uploads;
use super::variants::BoundLayout;
use crate::material::{Material, Surroundings};
use crate::motion::{Driven, Pose};
use crate::scene::Scene;
use crate::sdf::FaceMap;
use crate::{Gpu, Result};

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
    pub(super) white: [wgpu::TextureView; 2],
    pub(super) default_sampler: wgpu::Sampler,
    pub(super) face_maps: Vec<FaceMap>,
    pub(super) metres_per_uv: Vec<[f32; 2]>,
    pub(super) driven: Vec<Driven>,
    pub(super) self_shadow: bool,
    /// Materials that an expression has changed.
    pub(super) posed: Vec<usize>,
    /// Bytes of materials that a pose has changed since the last frame.
    pub(super) waiting: Vec<(usize, Vec<u8>)>,
}

#[derive(Debug)]
pub(super) struct BoundTexture {
    pub(super) name: String,
    pub(super) view: wgpu::TextureView,
    pub(super) sampler: wgpu::Sampler,
}

/// Group 2 of a material for shaders that bind the same of it.
#[derive(Debug)]
pub(crate) struct MaterialGroup {
    pub(super) material: usize,
    pub(super) layout: Arc<BoundLayout>,
    pub group: wgpu::BindGroup,
}

impl Looks {
    /// Bytes of a material.
    pub fn bytes(&self, index: usize, material: &Material) -> Result<Vec<u8>> {
        material::bytes(&self.places, &self.surroundings(index, material))
    }

    /// Takes the materials that a pose changes, and those that it changes no more; whether there are any.
    pub fn pose(&mut self, pose: &Pose) -> bool {
        let changed: Vec<usize> = self.posed.iter().chain(pose.materials.keys()).copied().collect();
        for &index in &changed {
            let Some(source) = self.sources.get(index) else { continue };
            let material = pose.materials.get(&index).unwrap_or(source).clone().clamped();
            // The upload has shown that its bytes can be written.
            self.waiting.extend(self.bytes(index, &material).ok().map(|bytes| (index, bytes)));
        }
        self.posed.clear();
        self.posed.extend(pose.materials.keys());
        !changed.is_empty()
    }

    /// Sends the bytes of materials that a pose has changed.
    pub fn send(&mut self, uploads: &mut Uploads, encoder: &mut wgpu::CommandEncoder) {
        for (index, bytes) in self.waiting.drain(..) {
            uploads.write(encoder, &self.numbers, index as u64 * self.stride, &bytes);
        }
    }

    pub fn surroundings<'a>(&'a self, index: usize, material: &'a Material) -> Surroundings<'a> {
        Surroundings {
            material,
            face_maps: &self.face_maps,
            metres_per_uv: self.metres_per_uv.get(index).copied().unwrap_or([1.0; 2]),
            driven: self.driven.get(index).unwrap_or(Driven::NONE),
            self_shadow: self.self_shadow,
        }
    }

    /// Group 2 of a material, by what a shader binds.
    pub fn group(&self, gpu: &Gpu, material: usize, layout: &BoundLayout) -> wgpu::BindGroup {
        let texture = |name: &str| self.textures[material].iter().find(|t| t.name == name);
        let resource = |name: &str, kind| match kind {
            BindingKind::Numbers => wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: &self.numbers,
                offset: material as u64 * self.stride,
                size: wgpu::BufferSize::new(self.places.size as u64),
            }),
            BindingKind::Texture => {
                wgpu::BindingResource::TextureView(texture(name).map_or(&self.white[0], |t| &t.view))
            }
            BindingKind::TextureArray => {
                wgpu::BindingResource::TextureView(texture(name).map_or(&self.white[1], |t| &t.view))
            }
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

/// Textures of a material with their samplers.
pub(super) fn bound_textures(scene: &Scene, composition: &Composition, textures: &TextureSet) -> Vec<BoundTexture> {
    let bound = composition.slots().map(|slot| {
        let (view, sampler) = match slot.source {
            Source::Texture(t) => textures.get(&scene.textures, t.texture, slot.read),
            Source::FaceMap(map) => textures.face(map),
        };
        BoundTexture { name: slot.name.clone(), view: view.clone(), sampler: sampler.clone() }
    });
    bound.collect()
}
