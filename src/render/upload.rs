//! Scene to GPU: one vertex buffer, one index buffer, one place in a uniform buffer a material, draws merged by material.

use std::borrow::Cow;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use super::character::{self, Character, CharacterData};
use super::draw_list::{self, Draw, Pipelines, casts_on_face, through_order};
use super::geometry::Geometry;
use super::looks::{Looks, bound_textures, stride};
use super::material::{self, Composition, Source};
use super::pass::bangs_shadow::{self, BangsAtlas, BangsFit};
use super::pass::deform::{DeformBuffers, DeformSource};
use super::pass::scatter::ScatterTaps;
use super::pass::shadow::{self, ShadowFit, ShadowMap};
use super::pass::{Picture, Sight};
use super::skin_layers::SkinPart;
use super::textures::{self, TextureSet};
use super::variants::Request;
use super::{Renderer, bind, uv_metric};
use crate::eye::{EyeRow, Eyes};
use crate::hair::holds_flow;
use crate::material::{Encoding, Generated, MAX_SHELLS, Material, Surroundings, out_of_range};
use crate::motion::{Driven, Skeleton};
use crate::scene::{Image, Mesh, Primitive, Scene};
use crate::sdf::FaceMap;
use crate::stage::crowd::Crowd;
use crate::stage::troupe::Troupe;
use crate::{Error, Gpu, Result, Stage};

impl Renderer {
    /// Uploads a scene at rest and makes every pipeline that it needs.
    ///
    /// # Errors
    /// [`Error::Gpu`] where the adapter refuses a resource, [`Error::Argument`] where the scene contradicts itself or a number
    /// of a material is out of its range.
    pub fn upload(&self, scene: &Scene) -> Result<Character> {
        let gpu = self.gpu().clone();
        let described = self.describe(scene)?;
        let borrow = |index| scene.images.get(index).map(Cow::Borrowed);
        let textures =
            self.textures(&described, |uses| TextureSet::new(&gpu, &scene.textures, uses, &scene.face_maps, borrow))?;
        gpu.scoped(|| self.upload_with(scene, described, textures))?
    }

    /// [`Renderer::upload`] for a scene whose pictures nobody needs afterwards: each image is emptied once it is on the
    /// GPU, so that a character's textures do not stand in memory twice.
    ///
    /// # Errors
    /// Those of [`Renderer::upload`].
    pub fn upload_and_empty_images(&self, scene: &mut Scene) -> Result<Character> {
        let gpu = self.gpu().clone();
        let described = self.describe(scene)?;
        let Scene { textures, images, face_maps, .. } = scene;
        let take = |index: usize| {
            let image = images.get_mut(index)?;
            let pixels = std::mem::take(&mut image.pixels);
            Some(Cow::Owned(Image { pixels, ..image.clone() }))
        };
        let textures = self.textures(&described, |uses| TextureSet::new(&gpu, textures, uses, face_maps, take))?;
        gpu.scoped(|| self.upload_with(scene, described, textures))?
    }

    /// Makes the textures of a scene, and meanwhile its pipelines.
    fn textures(
        &self,
        of: &Described,
        make: impl FnOnce(&[(usize, Encoding)]) -> Result<TextureSet> + Send,
    ) -> Result<TextureSet> {
        let requests = || of.requests.iter().flat_map(Pipelines::iter);
        // Error scopes belong to threads.
        let textures = || self.gpu().scoped(|| make(&of.uses()));
        let pipelines = || {
            if of.bangs.is_some() {
                self.gpu().scoped(|| self.make_bangs_near())??;
            }
            self.variants.get_all(requests())
        };
        let (textures, pipelines) = rayon::join(textures, pipelines);
        pipelines?;
        textures?
    }

    /// What a scene is made of.
    fn describe(&self, scene: &Scene) -> Result<Described> {
        scene.check()?;
        let faults = [
            ("bangs", scene.bangs.and_then(|mut s| out_of_range(&mut s))),
            ("self_shadow", scene.self_shadow.and_then(|mut s| out_of_range(&mut s))),
            ("eyes_through", scene.eyes_through.and_then(|mut s| out_of_range(&mut s))),
            ("pupils", scene.pupils.clone().and_then(|mut s| out_of_range(&mut s))),
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
        for (index, material) in sources.iter().enumerate() {
            let image = |texture: usize| scene.images.get(scene.textures.get(texture)?.image);
            let flow = material.hair.and_then(|h| image(h.flow_map?.texture));
            // Of a picture that was emptied nothing is known.
            if flow.is_some_and(|flow| !flow.pixels.is_empty() && !holds_flow(flow)) {
                let what = format!("material {index} {:?}, hair.flow_map", material.name);
                let message = "holds next to no directions; expected right in red and up in green, 0.5 for none (a normal map is \
                               no flow map)";
                return Err(Error::Argument { what, message: message.to_owned() });
            }
        }
        let (metres_per_uv, uv_boxes) = (uv_metric::metres_per_uv(scene), uv_metric::uv_boxes(scene));
        for (index, material) in sources.iter().enumerate().filter(|(_, m)| m.scatters_over_uv()) {
            let parts = scene.meshes.iter().flat_map(|m| &m.primitives).filter(|p| p.material == index);
            // A point or a line holds no light of a surface.
            if parts.map(uv_metric::uv_box).any(|[_, extent]| extent.contains(&0.0)) {
                let what = format!("material {index} {:?}, skin.diffuse", material.name);
                let message = "is texture-space, but the part has no texture coordinates; please choose screen-space or pre-integrated";
                return Err(Error::Argument { what, message: message.to_owned() });
            }
        }
        let eyes = Eyes::of(scene).map_err(|(material, key, message)| Error::Argument {
            what: format!("material {material} {:?}, {key}", sources[material].name),
            message,
        })?;
        let driven = Driven::of(scene);
        let mut compositions = Vec::with_capacity(sources.len());
        for of in Surroundings::of_scene(scene, &driven, &metres_per_uv, &uv_boxes, &eyes.rows) {
            self.variants.shaders.check(of.material)?;
            let composition = Composition::new(&self.variants.shaders, &of);
            composition.check(&of.material.name)?;
            compositions.push(composition);
        }
        let geometry = Geometry::gather(scene, &eyes);
        if let Some((material, fault)) = geometry.faults.first() {
            let what = format!("material {material} {:?}, hair.direction", scene.materials[*material].name);
            let message = format!("is mesh, but a part of it {fault}; please choose uv-v, uv-u or a flow map");
            return Err(Error::Argument { what, message });
        }
        let has_stencil = self.output.depth_format(self.gpu()).has_stencil_aspect();
        let draws = draw_list::draws(scene, &geometry.parts, has_stencil);
        let environment = scene.lights.as_ref().is_some_and(|lights| lights.environment.is_some());
        let sight = Sight { hdr: scene.post.is_some(), environment, ..Sight::default() };
        let picture = Picture::new(self.gpu(), self.output, sight);
        let requests = draw_list::requests(scene, &draws, &compositions, &picture);
        Ok(Described {
            sources,
            compositions,
            metres_per_uv,
            uv_boxes,
            eyes: eyes.rows,
            driven,
            bangs: bangs_fit(scene, &geometry),
            geometry,
            draws,
            sight,
            requests,
        })
    }

    fn upload_with(&self, scene: &Scene, described: Described, mut textures: TextureSet) -> Result<Character> {
        textures.generate(&self.variants, described.generated())?;
        let gpu = self.gpu().clone();
        let buffer = |label, contents: &[u8], usage| bind::filled(&gpu, label, contents, usage);
        use wgpu::BufferUsages as U;
        let Described {
            sources,
            compositions,
            metres_per_uv,
            uv_boxes,
            eyes,
            driven,
            bangs,
            geometry,
            draws,
            sight,
            requests,
        } = described;
        let places = Arc::clone(&self.variants.shaders.places);
        let stride = stride(&places);
        let bound = compositions.iter().map(|c| bound_textures(scene, c, &textures)).collect();
        let looks = Looks {
            numbers: buffer(
                "materials",
                &vec![0; sources.len().max(1) * stride as usize],
                U::UNIFORM | U::COPY_DST | U::COPY_SRC,
            ),
            places,
            sources,
            compositions,
            stride,
            textures: bound,
            white: [textures.white.clone(), textures.white_array.clone()],
            default_sampler: textures.default_sampler.clone(),
            face_maps: scene.face_maps.iter().map(FaceMap::without_texels).collect(),
            metres_per_uv,
            uv_boxes,
            eyes,
            driven,
            self_shadow: scene.self_shadow.is_some(),
        };
        for (index, material) in looks.sources.iter().enumerate() {
            gpu.queue.write_buffer(&looks.numbers, index as u64 * stride, &looks.bytes(index, material)?);
        }

        let indices = buffer("indices", bytemuck::cast_slice(&geometry.indices), U::INDEX);
        let of_first = || buffer("first person", bytemuck::cast_slice(&geometry.first_person), U::INDEX);
        let first_person = scene.character.is_some().then(of_first);
        let static_vertices = buffer("static vertices", bytemuck::cast_slice(&geometry.static_vertices), U::VERTEX);
        let shadow = shadow_fit(scene, &geometry);
        let source = DeformSource::new(&gpu, &geometry.deform_input());
        let drawn = || draws.iter().map(|d| &looks.compositions[d.material]);
        let has_inner_lines = drawn().any(|c| c.needs("prepass_surfaces"));
        let cuts_move = drawn().any(|c| c.takes_part("uv"));
        let has_prepass = requests.iter().any(|p| p.prepass.is_some());
        let skin = draws.iter().filter(|d| looks.compositions[d.material].is_on("skin_screen_space"));
        let scatter =
            ScatterTaps::most(skin.filter_map(|d| looks.sources[d.material].skin.as_ref()).map(ScatterTaps::of));
        let of_skin = (0..scene.materials.len()).filter(|i| scene.materials[*i].scatters_over_uv());
        let skin_layers =
            of_skin.map(|i| SkinPart::new(&gpu, scene, i, looks.uv_boxes[i], looks.metres_per_uv[i])).collect();
        let shells = scene.materials.iter().filter_map(|m| m.fluff).map(|f| f.shells.min(MAX_SHELLS)).max();
        let data = CharacterData {
            made_by: (gpu.clone(), self.output),
            scene: measured(scene),
            skeleton: Skeleton::of(scene),
            static_vertices,
            indices,
            first_person,
            source,
            looks,
            picture: OnceLock::new(),
            shown: Mutex::default(),
            groups: Mutex::default(),
            depths: Mutex::default(),
            geometry: OnceLock::new(),
            through_order: through_order(&draws),
            has_blended: draws.iter().any(|draw| draw.blend),
            has_weighted: draws.iter().any(|draw| draw.weighted),
            world_shadows: OnceLock::new(),
            glows: OnceLock::new(),
            velocities: OnceLock::new(),
            irradiances: Mutex::default(),
            uv_irradiances: Mutex::default(),
            skin_layers,
            draws,
            bangs,
            shadow,
            has_prepass,
            has_inner_lines,
            cuts_move,
            scatter,
            shells: shells.unwrap_or(0),
            rig: geometry.rig,
            part_materials: geometry.part_materials,
            triangles: geometry.indices.len() / 3,
            texture_bytes: textures.bytes,
        };
        let picture = data.made(&self.variants, requests)?;
        if has_prepass {
            let depths = picture.iter().map(|p| p.prepass.clone()).collect();
            data.depths.lock().unwrap_or_else(PoisonError::into_inner)[usize::from(has_inner_lines)] = Some(depths);
        }
        data.shown.lock().unwrap_or_else(PoisonError::into_inner).insert(character::seen(sight), Arc::clone(&picture));
        // Nobody else has seen it yet.
        let _ = data.picture.set(picture);
        Ok(Character(Arc::new(data)))
    }

    /// Shows another picture in place of a material's base texture on one actor of a stage, from the next frame on: the iris
    /// of an eye, its lights, a pattern of cloth. The picture is sRGB.
    ///
    /// # Errors
    /// [`Error::Argument`] for an actor that is not there, a material that is not there or has had no base texture at its
    /// upload, and for a picture whose size does not fit its bytes.
    pub fn replace_base_texture(&self, stage: &mut Stage, actor: usize, material: usize, image: &Image) -> Result<()> {
        let fault = |what: String, message: &str| Err(Error::Argument { what, message: message.to_owned() });
        let Some(character) = stage.actors.get(actor).map(|a| a.character.clone()) else {
            return fault(format!("actor {actor}"), "is not there");
        };
        let has_one = character.0.looks.sources.get(material).is_some_and(|m| m.base.texture.is_some());
        if !has_one {
            let message = "is not there or has no base texture; materials get theirs before the upload";
            return fault(format!("material {material}"), message);
        }
        stage.embody(self)?;
        let gpu = self.gpu().clone();
        let view = gpu.scoped(|| textures::single(&gpu, image, Encoding::Srgb))??;
        stage.bodies.list[actor].edits_mut().set_base(material, view);
        Ok(())
    }

    /// Refuses a character of another device or output.
    pub(crate) fn owns(&self, character: &Character, actor: usize) -> Result<()> {
        let (gpu, output) = &character.0.made_by;
        let fault = |message: &str| {
            let message = format!("{message}; please upload it by this one");
            Err(Error::Argument { what: format!("actors[{actor}].character"), message })
        };
        if !gpu.is(self.gpu()) {
            return fault("was uploaded by a renderer of another device");
        }
        if *output != self.output {
            return fault("was uploaded by a renderer of another output");
        }
        Ok(())
    }

    /// Slots that the buffers of a character's bodies may have.
    pub(crate) fn deform_slots(&self, source: &DeformSource) -> usize {
        source.most_slots(self.gpu())
    }

    /// Buffers of so many bodies.
    pub(crate) fn deform_buffers(&self, source: &DeformSource, slots: usize) -> DeformBuffers {
        self.deform.buffers(self.gpu(), source, slots)
    }

    /// The maps of the bangs' shadow of so many bodies.
    pub(crate) fn bangs_atlas(&self, fit: &BangsFit, tiles: usize) -> Option<BangsAtlas> {
        Some(BangsAtlas::new(self.gpu(), self.bangs_near.get()?, fit, tiles))
    }

    /// The shadow maps of a stage, or what stands for them.
    pub(crate) fn shadow_view<'a>(&'a self, shadow: Option<&'a ShadowMap>) -> &'a wgpu::TextureView {
        shadow.map_or(&self.empty_maps.shadow, |map| &map.view)
    }

    /// Group 1 of a troupe, and the same while maps are drawn; where a map is missing, an empty one stands.
    pub(crate) fn troupe_groups(&self, crowd: &Crowd, of: &Troupe, shadow: Option<&ShadowMap>) -> [wgpu::BindGroup; 2] {
        let EmptyMaps { bangs: no_bangs, gather, compare, .. } = &self.empty_maps;
        let group = |bangs: Option<&BangsAtlas>, shadow: Option<&ShadowMap>| {
            let (map, near) = bangs.map_or((no_bangs, no_bangs), |b| (&b.view, &b.near));
            let resources = [
                crowd.actors.as_entire_binding(),
                of.deform.deformed.as_entire_binding(),
                wgpu::BindingResource::TextureView(map),
                wgpu::BindingResource::TextureView(near),
                wgpu::BindingResource::Sampler(gather),
                wgpu::BindingResource::TextureView(self.shadow_view(shadow)),
                wgpu::BindingResource::Sampler(compare),
            ];
            bind::group(self.gpu(), "actors", &self.layouts.character, resources)
        };
        [group(of.bangs.as_ref(), shadow), group(None, None)]
    }
}

/// What stands where an actor has no maps, and how maps are read.
#[derive(Debug)]
pub(super) struct EmptyMaps {
    bangs: wgpu::TextureView,
    shadow: wgpu::TextureView,
    gather: wgpu::Sampler,
    compare: wgpu::Sampler,
}

impl EmptyMaps {
    pub fn new(gpu: &Gpu) -> Self {
        let gather = wgpu::SamplerDescriptor { label: Some("bangs"), ..Default::default() };
        Self {
            bangs: bangs_shadow::map_texture(gpu, 1, 1),
            shadow: shadow::map_texture(gpu, 1, 1),
            gather: gpu.device.create_sampler(&gather),
            compare: shadow::sampler(gpu),
        }
    }
}

/// How the shadow map fits a character, where something of it casts and something receives.
fn shadow_fit(scene: &Scene, geometry: &Geometry) -> Option<ShadowFit> {
    let settings = scene.self_shadow?;
    let (low, high) = geometry.rig.bounds?;
    let casts = scene.materials.iter().any(|m| m.cast_shadow.is_some_and(|s| s.casts));
    let receives = scene.materials.iter().any(|m| m.cast_shadow.is_some_and(|s| s.received > 0.0));
    let radius = (high - low).length() * 0.5;
    let fits = casts && receives && radius.is_finite() && radius > 0.0;
    fits.then(|| ShadowFit { settings, middle: (low + high) * 0.5, radius })
}

/// How the map of the bangs' shadow fits a head, where the scene has bangs, hair that casts and a face that receives.
fn bangs_fit(scene: &Scene, geometry: &Geometry) -> Option<BangsFit> {
    let (bangs, (low, high)) = (scene.bangs?, scene.face_box(None)?);
    let casts = geometry.parts.iter().any(|p| casts_on_face(p.role));
    let receives = scene.materials.iter().any(|m| m.bangs_shadow.is_some());
    let lids = scene.materials.iter().any(|m| m.bangs_shadow.is_some_and(|b| b.lids));
    // Half as wide again as the head: bangs hang before it.
    let half = ((high - low).max_element() * 0.75).min(10.0);
    ((casts || lids) && receives).then_some(BangsFit { bangs, middle: (low + high) * 0.5, half, lids })
}

/// A scene without what only the GPU needs.
fn measured(scene: &Scene) -> Scene {
    let primitive = |p: &Primitive| Primitive {
        material: p.material,
        role: p.role,
        positions: p.positions.clone(),
        influences: p.influences.clone(),
        ..Primitive::default()
    };
    let mesh = |m: &Mesh| Mesh {
        name: m.name.clone(),
        primitives: m.primitives.iter().map(primitive).collect(),
        morph_names: m.morph_names.clone(),
    };
    let image = |i: &Image| Image { name: i.name.clone(), width: i.width, height: i.height, ..Image::default() };
    Scene {
        source: scene.source.clone(),
        nodes: scene.nodes.clone(),
        meshes: scene.meshes.iter().map(mesh).collect(),
        skins: scene.skins.clone(),
        materials: scene.materials.clone(),
        textures: scene.textures.clone(),
        images: scene.images.iter().map(image).collect(),
        face_maps: scene.face_maps.iter().map(FaceMap::without_texels).collect(),
        animations: scene.animations.clone(),
        animation_rig: scene.animation_rig.clone(),
        character: scene.character.clone(),
        lights: scene.lights.clone(),
        bangs: scene.bangs,
        self_shadow: scene.self_shadow,
        eyes_through: scene.eyes_through,
        pupils: scene.pupils.clone(),
        post: scene.post,
        warnings: scene.warnings.clone(),
    }
}

/// What a scene is made of, before anything of it is on the GPU.
struct Described {
    sources: Vec<Material>,
    compositions: Vec<Composition>,
    metres_per_uv: Vec<[f32; 2]>,
    uv_boxes: Vec<[[f32; 2]; 2]>,
    eyes: Vec<Vec<EyeRow>>,
    driven: Vec<Driven>,
    bangs: Option<BangsFit>,
    geometry: Geometry,
    draws: Vec<Draw>,
    /// What pictures of it are first made for, and what then shows each draw.
    sight: Sight<'static>,
    requests: Vec<Pipelines<Request>>,
}

impl Described {
    /// Textures that are made of numbers.
    fn generated(&self) -> Vec<Generated> {
        let slots = self.compositions.iter().flat_map(Composition::slots);
        let made = |slot: &material::Slot| match slot.source {
            Source::Generated(generated) => Some(generated),
            Source::Texture(_) | Source::FaceMap(_) => None,
        };
        slots.filter_map(made).collect()
    }

    /// Textures that are read, and how.
    fn uses(&self) -> Vec<(usize, Encoding)> {
        let slots = self.compositions.iter().flat_map(Composition::slots);
        let of_file = |slot: &material::Slot| match slot.source {
            Source::Texture(t) => Some((t.texture, slot.read.encoding)),
            Source::FaceMap(_) | Source::Generated(_) => None,
        };
        slots.filter_map(of_file).collect()
    }
}
