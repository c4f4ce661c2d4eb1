//! Scene to GPU: one vertex buffer, one index buffer, one bind group a material, draws merged by material.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{Mat4, Vec3};
use wgpu::util::DeviceExt;

use super::draw_list::{self, Draw, Pipelines, casts_on_face, through_order};
use super::frame::{CharacterState, character_numbers, put_character};
use super::geometry::{Geometry, Palette, Rig};
use super::layout::Filled;
use super::made::Made;
use super::material::{self, Composition, Source};
use super::pass::bangs_shadow::{BangsMap, map_texture};
use super::pass::deform::DeformBuffers;
use super::pass::shadow::{self, ShadowMap, ShadowRows};
use super::pass::{Picture, color_depth_format, prepass};
use super::shaders::{BindingKind, Places};
use super::textures::{self, TextureSet};
use super::variants::{BoundLayout, Drawn, Request, Variant, Variants};
use super::vertex::AffineRows;
use super::{Renderer, View, uv_metric};
use crate::material::{Encoding, MAX_SHELLS, Material, Surroundings, out_of_range};
use crate::motion::{Driven, Pose};
use crate::scene::{EyesThrough, Image, Post, Scene};
use crate::sdf::FaceMap;
use crate::{Error, Gpu, Result};

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
    character_numbers: Filled,
    looks: Looks,
    pub(crate) draws: Vec<Draw>,
    /// What shows each draw in the picture.
    pub(crate) picture: Vec<Pipelines<Drawn>>,
    /// The same in debug channels that somebody has looked at.
    channels: BTreeMap<String, Vec<Pipelines<Drawn>>>,
    /// Depth, normal and part of every draw, for the channels that show these.
    pub(crate) geometry: Vec<Drawn>,
    /// Groups of materials, by what shaders bind of them.
    pub(crate) groups: Vec<MaterialGroup>,
    pub(crate) transparent_order: Vec<usize>,
    /// Eyes and brows that are seen through hair, the foremost first.
    pub(crate) through_order: Vec<usize>,
    eyes_through: Option<EyesThrough>,
    pub(crate) post: Option<Post>,
    /// How often the pose, the places of characters and what is cut out of materials have become others.
    revisions: Revisions,
    /// The pose that the deformed vertices are in.
    pub(crate) deformed: Made<u64, ()>,
    /// What the maps of shadows were drawn for.
    pub(crate) maps: Made<MapsKey, ()>,
    rig: Rig,
    scratch: Scratch,
    part_materials: Vec<usize>,
    triangles: usize,
    texture_bytes: u64,
}

/// Counts of changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Revisions {
    pub pose: u64,
    pub places: u64,
    cuts: u64,
}

/// What shadow maps depend on.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MapsKey {
    revisions: Revisions,
    to_light: Vec3,
    /// Where it moves what is cut out.
    time_s: f32,
}

/// Materials of a scene as shaders see them.
#[derive(Debug)]
struct Looks {
    places: Arc<Places>,
    sources: Vec<Material>,
    compositions: Vec<Composition>,
    numbers: wgpu::Buffer,
    stride: u64,
    textures: Vec<Vec<BoundTexture>>,
    white: [wgpu::TextureView; 2],
    default_sampler: wgpu::Sampler,
    face_maps: Vec<FaceMap>,
    metres_per_uv: Vec<[f32; 2]>,
    driven: Vec<Driven>,
    self_shadow: bool,
    /// Materials that an expression has changed.
    posed: Vec<usize>,
}

#[derive(Debug)]
struct BoundTexture {
    name: String,
    view: wgpu::TextureView,
    sampler: wgpu::Sampler,
}

/// Group 2 of a material for shaders that bind the same of it.
#[derive(Debug)]
pub(crate) struct MaterialGroup {
    material: usize,
    layout: Arc<BoundLayout>,
    pub group: wgpu::BindGroup,
}

/// How shaders read the maps of shadows.
#[derive(Debug)]
struct MapSamplers {
    gather: wgpu::Sampler,
    compare: wgpu::Sampler,
}

/// Lists that every pose fills anew, kept so that an animated character allocates nothing.
#[derive(Debug, Default)]
struct Scratch {
    world: Vec<Mat4>,
    joints: Vec<AffineRows>,
    weights: Vec<f32>,
    /// What is on the GPU.
    last_joints: Vec<AffineRows>,
    last_weights: Vec<f32>,
}

/// Bytes that a [`GpuScene`] takes on the GPU.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct GpuMemory {
    /// Textures with their mips.
    pub textures: u64,
    /// Vertices, indices, morphs, influences, uniforms.
    pub geometry: u64,
}

/// The strictest alignment of offsets in WebGPU.
const OFFSET_ALIGNMENT: u64 = 256;

impl Renderer {
    /// Uploads a scene at rest and makes every pipeline that it needs.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the adapter refuses a resource, [`Error::Argument`] where the scene contradicts itself or a number
    /// of a material is out of its range.
    pub fn upload(&mut self, scene: &Scene) -> Result<GpuScene> {
        let gpu = self.gpu().clone();
        let looks = self.looks_of(scene)?;
        gpu.scoped(|| {
            let borrow = |index| scene.images.get(index).map(Cow::Borrowed);
            let textures = TextureSet::new(&gpu, &scene.textures, &looks.uses(), &scene.face_maps, borrow)?;
            self.upload_with(scene, looks, &textures)
        })?
    }

    /// [`Renderer::upload`] for a scene whose pictures nobody needs afterwards: each image is emptied once it is on the
    /// GPU, so that a character's textures do not stand in memory twice.
    ///
    /// # Errors
    /// Those of [`Renderer::upload`].
    pub fn upload_and_empty_images(&mut self, scene: &mut Scene) -> Result<GpuScene> {
        let gpu = self.gpu().clone();
        let looks = self.looks_of(scene)?;
        gpu.scoped(|| {
            let Scene { textures, images, face_maps, .. } = scene;
            let take = |index: usize| {
                let image = images.get_mut(index)?;
                let pixels = std::mem::take(&mut image.pixels);
                Some(Cow::Owned(Image { pixels, ..image.clone() }))
            };
            let textures = TextureSet::new(&gpu, textures, &looks.uses(), face_maps, take)?;
            self.upload_with(scene, looks, &textures)
        })?
    }

    /// What the materials of a scene are made of.
    fn looks_of(&self, scene: &Scene) -> Result<Described> {
        let faults = [
            ("bangs", scene.bangs.and_then(|mut s| out_of_range(&mut s))),
            ("self_shadow", scene.self_shadow.and_then(|mut s| out_of_range(&mut s))),
            ("eyes_through", scene.eyes_through.and_then(|mut s| out_of_range(&mut s))),
            ("post", scene.post.and_then(|mut s| out_of_range(&mut s))),
        ];
        for (section, fault) in faults {
            if let Some((key, message)) = fault {
                return Err(Error::Argument { what: format!("{section}.{key}"), message });
            }
        }
        let sources = scene.materials.clone();
        for (index, material) in sources.iter().enumerate() {
            if let Some((key, message)) = material.clone().out_of_range() {
                let what = format!("material {index} {:?}, {key}", material.name);
                return Err(Error::Argument { what, message });
            }
        }
        let metres_per_uv = uv_metric::metres_per_uv(scene);
        let driven = Driven::of(scene);
        let mut compositions = Vec::with_capacity(sources.len());
        for of in Surroundings::of_scene(scene, &driven, &metres_per_uv) {
            self.variants.shaders.check(of.material)?;
            let composition = Composition::new(&self.variants.shaders, &of);
            composition.check(&of.material.name)?;
            compositions.push(composition);
        }
        Ok(Described { sources, compositions, metres_per_uv, driven })
    }

    fn upload_with(&mut self, scene: &Scene, described: Described, textures: &TextureSet) -> Result<GpuScene> {
        let geometry = Geometry::gather(scene);
        let gpu = self.gpu().clone();
        let device = &gpu.device;
        let buffer = |label, contents: &[u8], usage| {
            // Empty bindings are invalid; four unread bytes stand for nothing.
            let contents = if contents.is_empty() { &[0u8; 64] } else { contents };
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        use wgpu::BufferUsages as U;
        let Described { sources, compositions, metres_per_uv, driven } = described;
        let places = Arc::clone(&self.variants.shaders.places);
        let stride = (places.size as u64).next_multiple_of(OFFSET_ALIGNMENT);
        let bound = compositions.iter().map(|c| bound_textures(scene, c, textures)).collect();
        let looks = Looks {
            numbers: buffer("materials", &vec![0; sources.len().max(1) * stride as usize], U::UNIFORM | U::COPY_DST),
            places,
            sources,
            compositions,
            stride,
            textures: bound,
            white: [textures.white.clone(), textures.white_array.clone()],
            default_sampler: textures.default_sampler.clone(),
            face_maps: scene.face_maps.iter().map(FaceMap::without_texels).collect(),
            metres_per_uv,
            driven,
            self_shadow: scene.self_shadow.is_some(),
            posed: Vec::new(),
        };
        for (index, material) in looks.sources.iter().enumerate() {
            let bytes = material::bytes(&looks.places, &looks.surroundings(index, material))?;
            gpu.queue.write_buffer(&looks.numbers, index as u64 * stride, &bytes);
        }

        let indices = buffer("indices", bytemuck::cast_slice(&geometry.indices), U::INDEX);
        let static_vertices = buffer("static vertices", bytemuck::cast_slice(&geometry.static_vertices), U::VERTEX);
        let character_numbers = character_numbers();
        let character =
            buffer("character", &vec![0; character_numbers.size() as usize], U::UNIFORM | U::COPY_DST);
        let bangs = self.bangs_map(scene, &geometry)?;
        let shadow = self.shadow_map(scene, &geometry);
        let map_samplers = MapSamplers {
            gather: device.create_sampler(&wgpu::SamplerDescriptor { label: Some("bangs"), ..Default::default() }),
            compare: shadow::sampler(&gpu),
        };
        let character_group_without_map = self.character_group(&character, &map_samplers, None, None);
        let character_group = self.character_group(&character, &map_samplers, bangs.as_ref(), shadow.as_ref());
        let deform = self.deform.buffers(&gpu, &geometry.deform_input());
        let draws = draw_list::draws(scene, &geometry.parts, color_depth_format(&gpu).has_stencil_aspect());
        let picture = Picture::new(&gpu, self.output, scene.post.is_some(), None);
        let requests = draw_list::requests(scene, &draws, &looks.compositions, &picture);
        self.variants.get_all(requests.iter().flat_map(Pipelines::iter))?;
        let shells = scene.materials.iter().filter_map(|m| m.fluff).map(|f| f.shells.min(MAX_SHELLS) as usize).max();
        let mut uploaded = GpuScene {
            deform,
            static_vertices,
            indices,
            instances: instance_buffer(&gpu, 1),
            instance_capacity: 1,
            instance_rows: Vec::new(),
            instance_copies: 1 + shells.unwrap_or(0),
            character_group,
            character_group_without_map,
            bangs,
            shadow,
            map_samplers,
            head: Mat4::IDENTITY,
            hips: Mat4::IDENTITY,
            character,
            character_numbers,
            looks,
            transparent_order: Vec::with_capacity(draws.len()),
            through_order: through_order(&draws),
            draws,
            picture: Vec::new(),
            channels: BTreeMap::new(),
            geometry: Vec::new(),
            groups: Vec::new(),
            eyes_through: scene.eyes_through,
            post: scene.post,
            revisions: Revisions::default(),
            deformed: Made::not_yet(()),
            maps: Made::not_yet(()),
            rig: geometry.rig,
            scratch: Scratch::default(),
            part_materials: geometry.part_materials,
            triangles: geometry.indices.len() / 3,
            texture_bytes: textures.bytes,
        };
        uploaded.picture = uploaded.made(&self.variants, requests)?;
        uploaded.set_pose(&gpu, scene, &Pose::rest(scene));
        Ok(uploaded)
    }

    /// Shows another picture in place of a material's base texture from the next frame on: the iris of an eye, its lights,
    /// a pattern of cloth. The picture is sRGB.
    ///
    /// # Errors
    /// [`Error::Argument`] for a material that is not there or has had no base texture at its upload, and for a picture
    /// whose size does not fit its bytes.
    pub fn replace_base_texture(&self, scene: &mut GpuScene, material: usize, image: &Image) -> Result<()> {
        let has_one = scene.looks.sources.get(material).is_some_and(|m| m.base.texture.is_some());
        if !has_one {
            let message = "is not there or has no base texture; materials get theirs before the upload".to_owned();
            return Err(Error::Argument { what: format!("material {material}"), message });
        }
        let gpu = self.gpu().clone();
        gpu.scoped(|| {
            let view = textures::single(&gpu, image, Encoding::Srgb)?;
            // Where lit and shade share their texture, its place serves both.
            for bound in scene.looks.textures[material].iter_mut().filter(|b| b.name == "base_texture") {
                bound.view = view.clone();
            }
            scene.revisions.cuts += 1;
            let GpuScene { groups, looks, .. } = scene;
            for group in groups.iter_mut().filter(|g| g.material == material) {
                group.group = looks.group(&gpu, material, &group.layout);
            }
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
        let no_bangs = map_texture(self.gpu(), 1, 1);
        let (map, near) = bangs.map_or((&no_bangs, &no_bangs), |b| (&b.view, &b.near));
        let no_shadow = shadow::map_texture(self.gpu(), 1, 1);
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
        self.gpu().device.create_bind_group(&wgpu::BindGroupDescriptor {
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
        fits.then(|| ShadowMap::new(self.gpu(), settings, (low + high) * 0.5, radius))
    }

    /// The map of the bangs' shadow, where the scene has bangs, hair that casts and a face that receives.
    fn bangs_map(&mut self, scene: &Scene, geometry: &Geometry) -> Result<Option<BangsMap>> {
        let (Some(bangs), Some((low, high))) = (scene.bangs, scene.face_box(None)) else { return Ok(None) };
        let casts = geometry.parts.iter().any(|p| casts_on_face(p.role));
        let receives = scene.materials.iter().any(|m| m.bangs_shadow.is_some());
        let lids = scene.materials.iter().any(|m| m.bangs_shadow.is_some_and(|b| b.lids));
        if !((casts || lids) && receives) {
            return Ok(None);
        }
        // Half as wide again as the head: bangs hang before it.
        let half = ((high - low).max_element() * 0.75).min(10.0);
        let gpu = self.gpu().clone();
        Ok(Some(BangsMap::new(&gpu, self.bangs_near()?, bangs, (low + high) * 0.5, half, lids)))
    }
}

/// Materials of a scene, before anything of them is on the GPU.
struct Described {
    sources: Vec<Material>,
    compositions: Vec<Composition>,
    metres_per_uv: Vec<[f32; 2]>,
    driven: Vec<Driven>,
}

impl Described {
    /// Textures that are read, and how.
    fn uses(&self) -> Vec<(usize, Encoding)> {
        let slots = self.compositions.iter().flat_map(Composition::slots);
        let of_file = |slot: &material::Slot| match slot.source {
            Source::Texture(t) => Some((t.texture, slot.read.encoding)),
            Source::FaceMap(_) => None,
        };
        slots.filter_map(of_file).collect()
    }
}

impl Looks {
    fn surroundings<'a>(&'a self, index: usize, material: &'a Material) -> Surroundings<'a> {
        Surroundings {
            material,
            face_maps: &self.face_maps,
            metres_per_uv: self.metres_per_uv.get(index).copied().unwrap_or([1.0; 2]),
            driven: self.driven.get(index).unwrap_or(Driven::NONE),
            self_shadow: self.self_shadow,
        }
    }

    /// Group 2 of a material, by what a shader binds.
    fn group(&self, gpu: &Gpu, material: usize, layout: &BoundLayout) -> wgpu::BindGroup {
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
fn bound_textures(scene: &Scene, composition: &Composition, textures: &TextureSet) -> Vec<BoundTexture> {
    let bound = composition.slots().map(|slot| {
        let (view, sampler) = match slot.source {
            Source::Texture(t) => textures.get(&scene.textures, t.texture, slot.read),
            Source::FaceMap(map) => textures.face(map),
        };
        BoundTexture { name: slot.name.clone(), view: view.clone(), sampler: sampler.clone() }
    });
    bound.collect()
}

impl GpuScene {
    /// Moves the scene to a pose: joint matrices, morph weights and material changes are written to the GPU; the
    /// vertices follow in the next frame.
    pub fn set_pose(&mut self, gpu: &Gpu, scene: &Scene, pose: &Pose) {
        let Scratch { world, joints, weights, .. } = &mut self.scratch;
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
        if scratch_differs(&self.scratch) {
            let Scratch { joints, weights, last_joints, last_weights, .. } = &mut self.scratch;
            gpu.queue.write_buffer(&self.deform.joints, 0, bytemuck::cast_slice(joints));
            if !weights.is_empty() {
                gpu.queue.write_buffer(&self.deform.weights, 0, bytemuck::cast_slice(weights));
            }
            last_joints.clone_from(joints);
            last_weights.clone_from(weights);
            self.revisions.pose += 1;
        }
        let Self { looks, revisions, .. } = self;
        let changed: Vec<usize> = looks.posed.iter().chain(pose.materials.keys()).copied().collect();
        for index in changed {
            let Some(source) = looks.sources.get(index) else { continue };
            let material = pose.materials.get(&index).unwrap_or(source).clone().clamped();
            // The upload has shown that its bytes can be written.
            if let Ok(bytes) = material::bytes(&looks.places, &looks.surroundings(index, &material)) {
                gpu.queue.write_buffer(&looks.numbers, index as u64 * looks.stride, &bytes);
            }
            revisions.cuts += 1;
        }
        looks.posed.clear();
        looks.posed.extend(pose.materials.keys());
    }

    /// Gives each character of a larger crowd its shadow map.
    pub(crate) fn fit_shadow(&mut self, renderer: &Renderer) {
        let Some(shadow) = &mut self.shadow else { return };
        if shadow.fit(renderer.gpu(), self.instance_rows.len()) {
            self.revisions.places += 1;
            self.character_group = renderer.character_group(
                &self.character,
                &self.map_samplers,
                self.bangs.as_ref(),
                self.shadow.as_ref(),
            );
        }
    }

    /// Writes the places of the characters of a view.
    pub(crate) fn place(&mut self, gpu: &Gpu, view: &View) {
        let rows = view.instances.iter().map(|m| AffineRows::from(*m));
        if rows.clone().eq(self.instance_rows.iter().copied()) {
            return;
        }
        self.revisions.places += 1;
        self.instance_rows.clear();
        self.instance_rows.extend(rows);
        // A copy for the surfaces, and one for each shell of a coat.
        let copied = self.instance_rows.repeat(self.instance_copies);
        if copied.len() > self.instance_capacity {
            self.instance_capacity = copied.len().next_power_of_two();
            self.instances = instance_buffer(gpu, self.instance_capacity);
        }
        gpu.queue.write_buffer(&self.instances, 0, bytemuck::cast_slice(&copied));
    }

    /// Writes what of the character depends on the light. A crowd shares the shadow of its first one's bangs.
    pub(crate) fn light(&mut self, gpu: &Gpu, view: &View) {
        let from_world = view.instances.first().copied().unwrap_or_default().inverse();
        let to_light = from_world.transform_vector3(view.lights.directional.to_light).normalize_or(Vec3::Z);
        let state = CharacterState {
            head: self.head,
            head_middle: self.rig.head_middle,
            bangs: self.bangs.as_ref(),
            through: self.eyes_through,
            to_light,
            from_world,
            shadow: self.shadow.as_ref().map_or_else(ShadowRows::default, |s| {
                let middle = self.hips.transform_point3(s.middle);
                s.rows(middle, view.lights.directional.to_light, self.instance_rows.len())
            }),
        };
        let bytes = self.character_numbers.fill(|numbers| put_character(numbers, &state));
        gpu.queue.write_buffer(&self.character, 0, bytes);
    }

    /// What its deformed vertices are made from.
    pub(crate) fn pose_revision(&self) -> u64 {
        self.revisions.pose
    }

    /// What its maps of shadows are made from.
    pub(crate) fn maps_key(&self, view: &View) -> MapsKey {
        let moves = self.draws.iter().any(|d| self.looks.compositions[d.material].has("uv_animation"));
        MapsKey {
            revisions: self.revisions,
            to_light: view.lights.directional.to_light,
            time_s: if moves { view.time_s } else { 0.0 },
        }
    }

    /// The material of a draw as it was uploaded.
    pub(crate) fn material(&self, draw: &Draw) -> &Material {
        &self.looks.sources[draw.material]
    }

    /// Whether a material has inner lines, which read normals and parts.
    pub(crate) fn has_inner_lines(&self) -> bool {
        self.draws.iter().any(|d| self.looks.compositions[d.material].needs("prepass_surfaces"))
    }

    /// Whether something reads the depth of the picture.
    pub(crate) fn has_prepass(&self) -> bool {
        self.picture.iter().any(|p| p.prepass.is_some())
    }

    /// What a variant draws a material with; groups of the same layout are shared.
    pub(crate) fn bind(&mut self, gpu: &Gpu, variant: Variant, material: usize) -> Drawn {
        let Self { groups, looks, .. } = self;
        let group = variant.bound.map(|layout| {
            let known = groups.iter().position(|g| g.material == material && Arc::ptr_eq(&g.layout, &layout));
            known.unwrap_or_else(|| {
                let group = looks.group(gpu, material, &layout);
                groups.push(MaterialGroup { material, layout, group });
                groups.len() - 1
            })
        });
        Drawn { pipeline: variant.pipeline, group }
    }

    /// What is drawn with, of what was asked for.
    fn made(&mut self, variants: &Variants, requests: Vec<Pipelines<Request>>) -> Result<Vec<Pipelines<Drawn>>> {
        let materials: Vec<usize> = self.draws.iter().map(|d| d.material).collect();
        let mut list = Vec::with_capacity(requests.len());
        for (request, material) in requests.into_iter().zip(materials) {
            list.push(request.map(|r| Ok::<_, Error>(self.bind(&variants.gpu, variants.get(&r)?, material)))?);
        }
        Ok(list)
    }

    /// What shows a debug channel, made when somebody first looks at it.
    pub(crate) fn show_channel(&mut self, variants: &Variants, picture: &Picture<'_>, channel: &str) -> Result<()> {
        if self.channels.contains_key(channel) {
            return Ok(());
        }
        let requests: Vec<_> = self.draws.iter().map(|d| self.channel_request(picture, d)).collect();
        variants.get_all(requests.iter().flat_map(Pipelines::iter))?;
        let made = self.made(variants, requests)?;
        self.channels.insert(channel.to_owned(), made);
        Ok(())
    }

    fn channel_request(&self, picture: &Picture<'_>, draw: &Draw) -> Pipelines<Request> {
        let (of, material) = (&self.looks.compositions[draw.material], self.material(draw));
        draw_list::surface_requests(draw, of, material, picture)
    }

    /// What shows each draw in a channel of [`GpuScene::show_channel`].
    pub(crate) fn channel(&self, channel: &str) -> &[Pipelines<Drawn>] {
        self.channels.get(channel).map_or(&[], Vec::as_slice)
    }

    /// Makes what draws depth, normal and part of every draw, when somebody first looks at them.
    pub(crate) fn make_geometry(&mut self, variants: &Variants) -> Result<()> {
        if !self.geometry.is_empty() {
            return Ok(());
        }
        let request = |draw: &Draw| {
            let (of, material) = (&self.looks.compositions[draw.material], self.material(draw));
            (draw.material, prepass::request(of, material, draw.has_vertex_colors, true))
        };
        let requests: Vec<_> = self.draws.iter().map(request).collect();
        for (material, request) in requests {
            let drawn = self.bind(&variants.gpu, variants.get(&request)?, material);
            self.geometry.push(drawn);
        }
        Ok(())
    }

    /// Draw calls of the colour pass with everything in view, outlines and coats of fluff included.
    #[must_use]
    pub fn draw_count(&self) -> usize {
        self.picture.iter().map(|p| 1 + usize::from(p.outline.is_some()) + usize::from(p.fluff.is_some())).sum()
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
                + self.looks.numbers.size(),
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

/// Whether a pose is another than that on the GPU.
fn scratch_differs(scratch: &Scratch) -> bool {
    scratch.joints != scratch.last_joints || scratch.weights != scratch.last_weights
}
