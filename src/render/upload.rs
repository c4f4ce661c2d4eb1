//! Scene to GPU: one vertex buffer, one index buffer, one place in a uniform buffer a material, draws merged by material.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use glam::Mat4;

use super::draw_list::{self, Pipelines, casts_on_face, through_order};
use super::geometry::Geometry;
use super::gpu_scene::{Crowd, GpuScene, MapSamplers, Revisions, Scratch};
use super::looks::{Looks, bound_textures, stride};
use super::made::Made;
use super::material::{self, Composition, Source};
use super::pass::bangs_shadow::{BangsMap, map_texture};
use super::pass::shadow::{self, ShadowMap};
use super::pass::{Picture, Sight, color_depth_format};
use super::textures::{self, TextureSet};
use super::{Renderer, bind, uv_metric};
use crate::material::{Encoding, MAX_SHELLS, Material, Surroundings, out_of_range};
use crate::motion::{Driven, Pose};
use crate::scene::{Image, Scene};
use crate::sdf::FaceMap;
use crate::{Error, Result};

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
        scene.check()?;
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
        let buffer = |label, contents: &[u8], usage| bind::filled(&gpu, label, contents, usage);
        use wgpu::BufferUsages as U;
        let Described { sources, compositions, metres_per_uv, driven } = described;
        let places = Arc::clone(&self.variants.shaders.places);
        let stride = stride(&places);
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
            waiting: Vec::new(),
        };
        for (index, material) in looks.sources.iter().enumerate() {
            gpu.queue.write_buffer(&looks.numbers, index as u64 * stride, &looks.bytes(index, material)?);
        }

        let indices = buffer("indices", bytemuck::cast_slice(&geometry.indices), U::INDEX);
        let static_vertices = buffer("static vertices", bytemuck::cast_slice(&geometry.static_vertices), U::VERTEX);
        let crowd = Crowd::new(&gpu);
        let bangs = self.bangs_map(scene, &geometry)?;
        let shadow = self.shadow_map(scene, &geometry);
        let map_samplers = MapSamplers {
            gather: device.create_sampler(&wgpu::SamplerDescriptor { label: Some("bangs"), ..Default::default() }),
            compare: shadow::sampler(&gpu),
        };
        let deform = self.deform.buffers(&gpu, &geometry.deform_input());
        let character_group_without_map = self.character_group(&crowd, &deform.deformed, &map_samplers, None, None);
        let character_group = character_group_without_map.clone();
        let draws = draw_list::draws(scene, &geometry.parts, color_depth_format(&gpu).has_stencil_aspect());
        let picture = Picture::new(&gpu, self.output, scene.post.is_some(), Sight::default());
        let requests = draw_list::requests(scene, &draws, &looks.compositions, &picture);
        self.variants.get_all(requests.iter().flat_map(Pipelines::iter))?;
        let shells = scene.materials.iter().filter_map(|m| m.fluff).map(|f| f.shells.min(MAX_SHELLS)).max();
        let mut uploaded = GpuScene {
            deform,
            static_vertices,
            indices,
            crowd,
            instance_rows: Vec::new(),
            shells: shells.unwrap_or(0),
            character_group,
            character_group_without_map,
            bangs,
            shadow,
            map_samplers,
            head: Mat4::IDENTITY,
            hips: Mat4::IDENTITY,
            looks,
            transparent_order: Vec::with_capacity(draws.len()),
            through_order: through_order(&draws),
            draws,
            picture: Vec::new(),
            sights: BTreeMap::new(),
            geometry: Vec::new(),
            groups: Vec::new(),
            eyes_through: scene.eyes_through,
            post: scene.post,
            revisions: Revisions::default(),
            sent: Made::not_yet(()),
            deformed: Made::not_yet(()),
            maps: Made::not_yet(()),
            has_inner_lines: false,
            has_prepass: false,
            cuts_move: false,
            rig: geometry.rig,
            scratch: Scratch::default(),
            part_materials: geometry.part_materials,
            nodes: scene.nodes.len(),
            made_by: (gpu.clone(), self.output),
            triangles: geometry.indices.len() / 3,
            texture_bytes: textures.bytes,
        };
        uploaded.picture = uploaded.made(&self.variants, requests)?;
        uploaded.has_prepass = uploaded.picture.iter().any(|p| p.prepass.is_some());
        let drawn = || uploaded.draws.iter().map(|d| &uploaded.looks.compositions[d.material]);
        let has_inner_lines = drawn().any(|c| c.needs("prepass_surfaces"));
        let cuts_move = drawn().any(|c| c.takes_part("uv"));
        (uploaded.has_inner_lines, uploaded.cuts_move) = (has_inner_lines, cuts_move);
        uploaded.set_pose(scene, &Pose::rest(scene))?;
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
    pub(super) fn character_group(
        &self,
        crowd: &Crowd,
        deformed: &wgpu::Buffer,
        samplers: &MapSamplers,
        bangs: Option<&BangsMap>,
        shadow: Option<&ShadowMap>,
    ) -> wgpu::BindGroup {
        let no_bangs = map_texture(self.gpu(), 1, 1);
        let (map, near) = bangs.map_or((&no_bangs, &no_bangs), |b| (&b.view, &b.near));
        let no_shadow = shadow::map_texture(self.gpu(), 1, 1);
        let view = |view| wgpu::BindingResource::TextureView(view);
        let resources = [
            crowd.actors.as_entire_binding(),
            deformed.as_entire_binding(),
            view(map),
            view(near),
            wgpu::BindingResource::Sampler(&samplers.gather),
            view(shadow.map_or(&no_shadow, |s| &s.view)),
            wgpu::BindingResource::Sampler(&samplers.compare),
        ];
        bind::group(self.gpu(), "character", &self.layouts.character, resources)
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
