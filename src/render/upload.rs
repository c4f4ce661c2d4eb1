//! Scene to GPU: one vertex buffer, one index buffer, one bind group a material, draws merged by material.

use std::{borrow::Cow, collections::BTreeMap};

use glam::{Mat4, Vec3};
use wgpu::util::DeviceExt;

use super::{
    Renderer, View,
    draw_list::{Draw, casts_on_face, through_order},
    geometry::{Geometry, Palette, Rig},
    pass::{
        SurfaceFlags,
        bangs_shadow::{BangsMap, map_texture},
        deform::DeformBuffers,
        shadow::{self, ShadowMap, ShadowRows},
    },
    textures::{self, Encoding, TextureSet},
    uniforms::{AffineRows, CharacterUniform, MaterialUniform},
    uv_metric,
};
use crate::{
    Error, Gpu, Result,
    material::{MAX_SHELLS, Material, Shading, TextureRef},
    motion::Pose,
    scene::{EyesThrough, Image, Post, Scene},
    sdf::FaceMap,
};

/// A scene on the GPU, ready to be drawn. Made by [`Renderer::upload`].
///
/// It keeps what a [`Pose`] needs; the images of the [`Scene`] may be dropped after the upload.
#[derive(Debug)]
pub struct GpuScene {
    pub(crate) deform: DeformBuffers,
    pub(crate) static_vertices: wgpu::Buffer,
    pub(crate) indices: wgpu::Buffer,
    pub(crate) instances: wgpu::Buffer,
    pub(crate) instance_capacity: usize,
    pub(crate) instance_rows: Vec<AffineRows>,
    /// How often the instances stand in their buffer.
    pub(crate) instance_copies: usize,
    pub(crate) character_group: wgpu::BindGroup,
    /// The same while the map of the bangs is drawn.
    pub(crate) character_group_without_map: wgpu::BindGroup,
    pub(crate) bangs: Option<BangsMap>,
    pub(crate) shadow: Option<ShadowMap>,
    map_samplers: MapSamplers,
    /// Moves the head from its rest to the pose, and the hips.
    head: Mat4,
    hips: Mat4,
    character: wgpu::Buffer,
    pub(crate) materials: wgpu::Buffer,
    pub(crate) material_groups: Vec<wgpu::BindGroup>,
    /// Textures of each material, in the order of their slots.
    material_textures: Vec<Vec<(wgpu::TextureView, wgpu::Sampler)>>,
    /// Pipelines of the prepass, one for each draw; empty where nothing reads it.
    pub(crate) prepass: Vec<Option<wgpu::RenderPipeline>>,
    /// Whether a material has inner lines, which read normals and parts.
    pub(crate) has_inner_lines: bool,
    face_maps: Vec<FaceMap>,
    metres_per_uv: Vec<[f32; 2]>,
    pub(crate) draws: Vec<Draw>,
    pub(crate) transparent_order: Vec<usize>,
    /// Eyes and brows that are seen through hair, the foremost first.
    pub(crate) through_order: Vec<usize>,
    eyes_through: Option<EyesThrough>,
    pub(crate) post: Option<Post>,
    /// Whether the deformed vertices lag behind the pose.
    pub(crate) deform_pending: bool,
    /// Whether the maps of shadows lag behind pose, light, places or what is cut out.
    pub(crate) maps_pending: bool,
    /// The light that they were drawn for, and the time where it moves what is cut out.
    maps_for: (Vec3, f32),
    source_materials: Vec<Material>,
    posed_materials: BTreeMap<usize, Material>,
    rig: Rig,
    scratch: Scratch,
    part_materials: Vec<usize>,
    triangles: usize,
    texture_bytes: u64,
}

/// How shaders read the maps of shadows.
#[derive(Debug)]
struct MapSamplers {
    gather: wgpu::Sampler,
    compare: wgpu::Sampler,
}

/// Pipelines of a draw that a debug channel replaces.
pub(crate) struct Shaded {
    surface: wgpu::RenderPipeline,
    through: Option<wgpu::RenderPipeline>,
    fluff: Option<wgpu::RenderPipeline>,
    outline: Option<wgpu::RenderPipeline>,
}

/// Lists that every pose fills anew, kept so that an animated character allocates nothing.
#[derive(Debug, Default)]
struct Scratch {
    world: Vec<Mat4>,
    joints: Vec<AffineRows>,
    weights: Vec<f32>,
}

/// Bytes that a [`GpuScene`] takes on the GPU.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct GpuMemory {
    /// Textures with their mips.
    pub textures: u64,
    /// Vertices, indices, morphs, influences, uniforms.
    pub geometry: u64,
}

/// Size of one material in the uniform buffer: the strictest offset alignment of WebGPU.
const MATERIAL_STRIDE: u64 = (size_of::<MaterialUniform>() as u64).next_multiple_of(256);

impl Renderer {
    /// Uploads a scene at rest and makes every pipeline that it needs.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the adapter refuses a resource, [`Error::Argument`]
    /// where the scene contradicts itself.
    pub fn upload(&mut self, scene: &Scene) -> Result<GpuScene> {
        let gpu = self.gpu.clone();
        gpu.scoped(|| {
            let borrow = |index| scene.images.get(index).map(Cow::Borrowed);
            let uses = texture_uses(&scene.materials);
            let textures = TextureSet::new(&self.gpu, &scene.textures, &uses, &scene.face_maps, borrow)?;
            self.upload_with(scene, &textures)
        })?
    }

    /// [`Renderer::upload`] for a scene whose pictures nobody needs afterwards: each image is emptied once it is on the
    /// GPU, so that a character's textures do not stand in memory twice.
    ///
    /// # Errors
    /// Those of [`Renderer::upload`].
    pub fn upload_and_empty_images(&mut self, scene: &mut Scene) -> Result<GpuScene> {
        let gpu = self.gpu.clone();
        gpu.scoped(|| {
            let Scene { textures, images, materials, face_maps, .. } = scene;
            let take = |index: usize| {
                let image = images.get_mut(index)?;
                let pixels = std::mem::take(&mut image.pixels);
                Some(Cow::Owned(Image { pixels, ..image.clone() }))
            };
            let textures = TextureSet::new(&self.gpu, textures, &texture_uses(materials), face_maps, take)?;
            self.upload_with(scene, &textures)
        })?
    }

    fn upload_with(&mut self, scene: &Scene, textures: &TextureSet) -> Result<GpuScene> {
        let geometry = Geometry::gather(scene);
        let device = &self.gpu.device;
        let buffer = |label, contents: &[u8], usage| {
            // Empty bindings are invalid; four unread bytes stand for nothing.
            let contents = if contents.is_empty() { &[0u8; 64] } else { contents };
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        use wgpu::BufferUsages as U;
        let mut uniforms = vec![0u8; scene.materials.len().max(1) * MATERIAL_STRIDE as usize];
        let metres_per_uv = uv_metric::metres_per_uv(scene);
        let described = scene.materials.iter().zip(metres_per_uv.iter().copied());
        for (chunk, (material, metres)) in uniforms.chunks_exact_mut(MATERIAL_STRIDE as usize).zip(described) {
            let uniform = MaterialUniform::new(material, &scene.face_maps, metres);
            chunk[..size_of::<MaterialUniform>()].copy_from_slice(bytemuck::bytes_of(&uniform));
        }
        let materials = buffer("materials", &uniforms, U::UNIFORM | U::COPY_DST);
        let material_textures: Vec<Vec<_>> =
            scene.materials.iter().map(|material| material_textures(scene, material, textures)).collect();
        let material_groups =
            (0..).zip(&material_textures).map(|(index, bound)| self.material_group(index, &materials, bound)).collect();

        let indices = buffer("indices", bytemuck::cast_slice(&geometry.indices), U::INDEX);
        let static_vertices = buffer("static vertices", bytemuck::cast_slice(&geometry.static_vertices), U::VERTEX);
        let character = buffer("character", &[0; size_of::<CharacterUniform>()], U::UNIFORM | U::COPY_DST);
        let bangs = self.bangs_map(scene, &geometry);
        let shadow = self.shadow_map(scene, &geometry);
        let map_samplers = MapSamplers {
            gather: device.create_sampler(&wgpu::SamplerDescriptor { label: Some("bangs"), ..Default::default() }),
            compare: shadow::sampler(&self.gpu),
        };
        let character_group_without_map = self.character_group(&character, &map_samplers, None, None);
        let character_group = self.character_group(&character, &map_samplers, bangs.as_ref(), shadow.as_ref());
        let deform = self.deform.buffers(&self.gpu, &geometry.deform_input());
        let draws = self.make_draws(scene, &geometry.parts);
        let has_inner_lines = draws.iter().any(|d| d.flags.inner_lines);
        let prepass = if has_inner_lines || draws.iter().any(|d| d.flags.depth_rim || d.glow.is_some()) {
            let Self { prepass, gpu, layouts, .. } = self;
            let mut make =
                |d: &Draw| prepass.pipeline(gpu, layouts, d.flags, &scene.materials[d.material], !has_inner_lines);
            draws.iter().map(|d| (!d.blend).then(|| make(d))).collect()
        } else {
            Vec::new()
        };
        let mut uploaded = GpuScene {
            deform,
            static_vertices,
            indices,
            instances: instance_buffer(&self.gpu, 1),
            instance_capacity: 1,
            instance_rows: Vec::new(),
            instance_copies: 1 + scene
                .materials
                .iter()
                .filter_map(|m| m.fluff)
                .map(|f| f.shells.clamp(1, MAX_SHELLS) as usize)
                .max()
                .unwrap_or(0),
            character_group,
            character_group_without_map,
            bangs,
            shadow,
            map_samplers,
            head: Mat4::IDENTITY,
            hips: Mat4::IDENTITY,
            character,
            materials,
            material_groups,
            material_textures,
            prepass,
            has_inner_lines,
            // The numbers alone: what they point to is on the GPU.
            face_maps: scene.face_maps.iter().map(FaceMap::without_texels).collect(),
            metres_per_uv,
            transparent_order: Vec::with_capacity(draws.len()),
            through_order: through_order(&draws),
            eyes_through: scene.eyes_through,
            post: scene.post,
            draws,
            deform_pending: true,
            maps_pending: true,
            maps_for: (Vec3::ZERO, 0.0),
            source_materials: scene.materials.clone(),
            posed_materials: BTreeMap::new(),
            rig: geometry.rig,
            scratch: Scratch::default(),
            part_materials: geometry.part_materials,
            triangles: geometry.indices.len() / 3,
            texture_bytes: textures.bytes,
        };
        uploaded.set_pose(&self.gpu, scene, &Pose::rest(scene));
        Ok(uploaded)
    }

    fn material_group(
        &self,
        index: usize,
        uniforms: &wgpu::Buffer,
        bound: &[(wgpu::TextureView, wgpu::Sampler)],
    ) -> wgpu::BindGroup {
        let mut entries = vec![wgpu::BindGroupEntry {
            binding: 0,
            resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: uniforms,
                offset: index as u64 * MATERIAL_STRIDE,
                size: wgpu::BufferSize::new(size_of::<MaterialUniform>() as u64),
            }),
        }];
        for (slot, (view, sampler)) in (0..).zip(bound) {
            let binding = 1 + 2 * slot;
            entries.push(wgpu::BindGroupEntry { binding, resource: wgpu::BindingResource::TextureView(view) });
            if (slot as usize) < SAMPLER_SLOTS {
                let resource = wgpu::BindingResource::Sampler(sampler);
                entries.push(wgpu::BindGroupEntry { binding: binding + 1, resource });
            }
        }
        self.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("material"),
            layout: &self.layouts.material,
            entries: &entries,
        })
    }

    /// Shows another picture in place of a material's base texture from the next frame on: the iris of an eye, its lights,
    /// a pattern of cloth. The picture is sRGB.
    ///
    /// # Errors
    /// [`Error::Argument`] for a material that is not there or has had no base texture at its upload, and for a picture
    /// whose size does not fit its bytes.
    pub fn replace_base_texture(&self, scene: &mut GpuScene, material: usize, image: &Image) -> Result<()> {
        let has_one = scene.source_materials.get(material).is_some_and(|m| m.base.texture.is_some());
        if !has_one {
            let message = "is not there or has no base texture; materials get theirs before the upload".to_owned();
            return Err(Error::Argument { what: format!("material {material}"), message });
        }
        self.gpu.scoped(|| {
            let view = textures::single(&self.gpu, image, Encoding::Srgb)?;
            // Where lit and shade share their texture, the first slot serves both.
            scene.material_textures[material][0].0 = view;
            scene.maps_pending = true;
            scene.material_groups[material] =
                self.material_group(material, &scene.materials, &scene.material_textures[material]);
            Ok(())
        })?
    }

    /// Group 1; where a map is missing, an empty one stands.
    fn character_group(
        &self,
        character: &wgpu::Buffer,
        samplers: &MapSamplers,
        bangs: Option<&BangsMap>,
        shadow: Option<&ShadowMap>,
    ) -> wgpu::BindGroup {
        let no_bangs = map_texture(&self.gpu, 1, 1);
        let (map, near) = bangs.map_or((&no_bangs, &no_bangs), |b| (&b.view, &b.near));
        let no_shadow = shadow::map_texture(&self.gpu, 1, 1);
        let view = |view| wgpu::BindingResource::TextureView(view);
        let resources = [
            character.as_entire_binding(),
            view(map),
            view(near),
            wgpu::BindingResource::Sampler(&samplers.gather),
            view(shadow.map_or(&no_shadow, |s| &s.view)),
            wgpu::BindingResource::Sampler(&samplers.compare),
        ];
        let entries: Vec<_> =
            (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
        self.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("character"),
            layout: &self.layouts.character,
            entries: &entries,
        })
    }

    /// The shadow maps of the scene's characters, where something casts and something receives.
    fn shadow_map(&self, scene: &Scene, geometry: &Geometry) -> Option<ShadowMap> {
        let settings = scene.self_shadow?;
        let (low, high) = geometry.rig.bounds?;
        let casts = scene.materials.iter().any(|m| m.cast_shadow.is_some_and(|s| s.casts));
        let receives = scene.materials.iter().any(|m| m.cast_shadow.is_some_and(|s| s.received > 0.0));
        let radius = (high - low).length() * 0.5;
        let fits = casts && receives && radius.is_finite() && radius > 0.0;
        fits.then(|| ShadowMap::new(&self.gpu, settings, (low + high) * 0.5, radius))
    }

    /// The map of the bangs' shadow, where the scene has bangs, hair that casts and a face that receives.
    fn bangs_map(&self, scene: &Scene, geometry: &Geometry) -> Option<BangsMap> {
        let bangs = scene.bangs?;
        let (low, high) = scene.face_box(None)?;
        let casts = geometry.parts.iter().any(|p| casts_on_face(p.role));
        let receives = scene.materials.iter().any(|m| m.bangs_shadow.is_some());
        let lids = scene.materials.iter().any(|m| m.bangs_shadow.is_some_and(|b| b.lids));
        // Half as wide again as the head: bangs hang before it.
        let half = ((high - low).max_element() * 0.75).min(10.0);
        let middle = (low + high) * 0.5;
        ((casts || lids) && receives).then(|| BangsMap::new(&self.gpu, &self.bangs_near, bangs, middle, half, lids))
    }
}

impl GpuScene {
    /// Moves the scene to a pose: joint matrices, morph weights and material changes are written to the GPU; the
    /// vertices follow in the next frame.
    pub fn set_pose(&mut self, gpu: &Gpu, scene: &Scene, pose: &Pose) {
        let Scratch { world, joints, weights } = &mut self.scratch;
        scene.world_from_nodes_into(&pose.locals, world);
        let matrix = |node: usize| world.get(node).copied().unwrap_or(Mat4::IDENTITY);
        joints.clear();
        for palette in &self.rig.palettes {
            match palette {
                Palette::Rigid(node) => joints.push(matrix(*node).into()),
                Palette::Skin(skin) => {
                    joints.extend(skin.iter().map(|(node, bind)| AffineRows::from(matrix(*node) * *bind)))
                }
            }
        }
        weights.clear();
        for &(node, targets) in &self.rig.weights {
            let of_node = pose.morph_weights.get(node).map_or(&[] as &[f32], Vec::as_slice);
            weights.extend((0..targets).map(|t| of_node.get(t).copied().unwrap_or(0.0)));
        }
        let moved = |bone: Option<(usize, Mat4)>| bone.map_or(Mat4::IDENTITY, |(node, inverse)| matrix(node) * inverse);
        (self.head, self.hips) = (moved(self.rig.head), moved(self.rig.hips));
        gpu.queue.write_buffer(&self.deform.joints, 0, bytemuck::cast_slice(joints));
        if !weights.is_empty() {
            gpu.queue.write_buffer(&self.deform.weights, 0, bytemuck::cast_slice(weights));
        }
        for index in self.posed_materials.keys().chain(pose.materials.keys()) {
            if let Some(material) = pose.materials.get(index).or_else(|| self.source_materials.get(*index)) {
                let metres = self.metres_per_uv.get(*index).copied().unwrap_or([1.0; 2]);
                let uniform = MaterialUniform::new(material, &self.face_maps, metres);
                gpu.queue.write_buffer(&self.materials, *index as u64 * MATERIAL_STRIDE, bytemuck::bytes_of(&uniform));
            }
        }
        self.posed_materials.clone_from(&pose.materials);
        self.deform_pending = true;
        self.maps_pending = true;
    }

    /// Gives each character of a larger crowd its shadow map.
    pub(crate) fn fit_shadow(&mut self, renderer: &Renderer) {
        let Some(shadow) = &mut self.shadow else { return };
        if shadow.fit(&renderer.gpu, self.instance_rows.len()) {
            self.maps_pending = true;
            self.character_group = renderer.character_group(
                &self.character,
                &self.map_samplers,
                self.bangs.as_ref(),
                self.shadow.as_ref(),
            );
        }
    }

    /// Writes what of the character depends on the light. A crowd shares the shadow of its first one's bangs.
    pub(crate) fn light(&mut self, gpu: &Gpu, view: &View) {
        let moves = self.draws.iter().any(|d| d.flags.uv_animation);
        let wanted = (view.lights.directional.to_light, if moves { view.time_s } else { 0.0 });
        self.maps_pending |= self.maps_for != wanted;
        self.maps_for = wanted;
        let from_world = view.instances.first().copied().unwrap_or_default().inverse();
        let to_light = from_world.transform_vector3(view.lights.directional.to_light).normalize_or(Vec3::Z);
        let uniform = CharacterUniform::new(
            self.head,
            self.rig.head_middle,
            self.bangs.as_ref(),
            self.eyes_through,
            to_light,
            from_world,
            self.shadow.as_ref().map_or_else(ShadowRows::default, |s| {
                let middle = self.hips.transform_point3(s.middle);
                s.rows(middle, view.lights.directional.to_light, self.instance_rows.len())
            }),
        );
        gpu.queue.write_buffer(&self.character, 0, bytemuck::bytes_of(&uniform));
    }

    /// The material of a draw as it was uploaded.
    pub(crate) fn material(&self, draw: &Draw) -> &Material {
        &self.source_materials[draw.material]
    }

    /// Puts the pipelines of a debug channel in place of those of the picture, and gives these.
    pub(crate) fn show_channel(&mut self, renderer: &mut Renderer, channel: u32) -> Vec<Shaded> {
        let Renderer { gpu, layouts, opaque, transparent, eyes_through, fluff, .. } = renderer;
        let Self { draws, source_materials, .. } = self;
        let swap = |draw: &mut Draw| {
            let material = &source_materials[draw.material];
            let flags = SurfaceFlags { channel, hdr: false, ..draw.flags };
            let surface = if draw.blend {
                transparent.pipeline(gpu, layouts, flags, material)
            } else {
                opaque.pipeline(gpu, layouts, flags, material, draw.mark)
            };
            let through = draw.through.as_ref().map(|_| eyes_through.pipeline(gpu, layouts, flags, material));
            let coat = draw.fluff.as_ref().map(|_| fluff.pipeline(gpu, layouts, flags));
            Shaded {
                fluff: std::mem::replace(&mut draw.fluff, coat),
                surface: std::mem::replace(&mut draw.surface, surface),
                through: std::mem::replace(&mut draw.through, through),
                outline: draw.outline.take(),
            }
        };
        draws.iter_mut().map(swap).collect()
    }

    /// Puts the pipelines of the picture back.
    pub(crate) fn show_again(&mut self, shaded: Vec<Shaded>) {
        for (draw, Shaded { surface, through, fluff, outline }) in self.draws.iter_mut().zip(shaded) {
            (draw.surface, draw.through, draw.fluff, draw.outline) = (surface, through, fluff, outline);
        }
    }

    /// Draw calls of the colour pass with everything in view, outlines and coats of fluff included.
    #[must_use]
    pub fn draw_count(&self) -> usize {
        self.draws.iter().map(|d| 1 + usize::from(d.outline.is_some()) + usize::from(d.fluff.is_some())).sum()
    }

    /// Triangles of one character, outlines not counted.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.triangles
    }

    /// Material of a part; parts are what [`Channel::PartId`](super::Channel::PartId) numbers.
    #[must_use]
    pub fn part_material(&self, part: usize) -> Option<usize> {
        self.part_materials.get(part).copied()
    }

    /// Bytes on the GPU.
    #[must_use]
    pub fn memory(&self) -> GpuMemory {
        GpuMemory {
            textures: self.texture_bytes,
            geometry: self.deform.bytes()
                + self.static_vertices.size()
                + self.indices.size()
                + self.instances.size()
                + self.materials.size(),
        }
    }
}

/// Buffer for the transforms of `count` instances.
pub(crate) fn instance_buffer(gpu: &Gpu, count: usize) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("instances"),
        size: (count * size_of::<AffineRows>()) as u64,
        usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Textures of a material, the one of them that is an array, and the one from which on they have no samplers of their own:
/// some devices have no more than 16.
pub(crate) const TEXTURE_SLOTS: usize = 19;
pub(crate) const FACE_SLOT: usize = 9;
pub(crate) const SAMPLER_SLOTS: usize = 13;
const DETAIL_SLOT: usize = 12;

/// Views and samplers of a material's textures.
fn material_textures(
    scene: &Scene,
    material: &Material,
    textures: &TextureSet,
) -> Vec<(wgpu::TextureView, wgpu::Sampler)> {
    let bound = texture_slots(material).into_iter().enumerate().map(|(slot, (texture, encoding))| {
        let (view, sampler) = match (slot, material.fur_detail) {
            (FACE_SLOT, _) => textures.face(material.face_shadow.map(|f| f.map)),
            // One sampler serves both kinds of detail.
            (DETAIL_SLOT, Some(fur)) => {
                let normals = textures.get(&scene.textures, Some(fur.detail_normal.texture), Encoding::Linear);
                (textures.get(&scene.textures, texture, encoding).0, normals.1)
            }
            _ => textures.get(&scene.textures, texture, encoding),
        };
        (view.clone(), sampler.clone())
    });
    bound.collect()
}

/// Textures of a material in the order of `wgsl/bind/material.wgsl`; that of the face's maps is not among them.
fn texture_slots(material: &Material) -> [(Option<usize>, Encoding); TEXTURE_SLOTS] {
    let of = |r: Option<TextureRef>| r.map(|r| r.texture);
    let (shade, shift) = match &material.shading {
        Shading::Toon(toon) => (of(toon.shade_texture), of(toon.shift_texture)),
        Shading::Unlit => (None, None),
    };
    let ramps = material.shade_ramp.and_then(|r| r.maps);
    [
        (of(material.base.texture), Encoding::Srgb),
        (shade, Encoding::Srgb),
        (shift, Encoding::Linear),
        (material.normal_map.map(|n| n.texture.texture), Encoding::Linear),
        (of(material.emission.texture), Encoding::Srgb),
        (material.matcap.map(|m| m.texture), Encoding::Srgb),
        (of(material.rim.mask), Encoding::Srgb),
        (material.outline.and_then(|o| of(o.width_mask)), Encoding::Linear),
        (of(material.uv_animation.mask), Encoding::Linear),
        (None, Encoding::Linear),
        (of(material.painted_highlight()), Encoding::Linear),
        (material.face_paint.map(|p| p.map.texture), Encoding::Linear),
        (
            material.fur_detail.map_or_else(|| material.gem.and_then(|g| of(g.inclusions)), |f| of(f.detail_color)),
            Encoding::Srgb,
        ),
        (material.fur_detail.map(|f| f.detail_normal.texture), Encoding::Linear),
        (ramps.map(|r| r.warm.texture), Encoding::Srgb),
        (ramps.map(|r| r.cool.texture), Encoding::Srgb),
        (of(material.part_ids()), Encoding::Linear),
        (material.decals.as_ref().and_then(|d| of(d.map)), Encoding::Srgb),
        (material.depth_rim.and_then(|r| of(r.width_mask)), Encoding::Linear),
    ]
}

fn texture_uses(materials: &[Material]) -> Vec<(usize, Encoding)> {
    materials.iter().flat_map(texture_slots).filter_map(|(texture, encoding)| Some((texture?, encoding))).collect()
}
