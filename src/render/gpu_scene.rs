//! A scene on the GPU: its pose, its places, what shows it in the picture and in debug channels.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{Mat4, Vec3};

use super::draw_list::{self, Draw, Pipelines};
use super::frame::{ActorState, actor_numbers, put_actor};
use super::geometry::{Palette, Rig};
use super::layout::Filled;
use super::looks::{Looks, MaterialGroup};
use super::made::Made;
use super::pass::bangs_shadow::BangsMap;
use super::pass::deform::DeformBuffers;
use super::pass::shadow::{ShadowMap, ShadowRows};
use super::pass::{Picture, Sight, prepass};
use super::uploads::Uploads;
use super::variants::{Drawn, Request, Variant, Variants};
use super::vertex::{AffineRows, Instance};
use super::{Output, Renderer, View, bind};
use crate::material::Material;
use crate::motion::Pose;
use crate::scene::{EyesThrough, Post, Scene};
use crate::{Error, Gpu, Result};

/// A scene on the GPU, ready to be drawn. Made by [`Renderer::upload`].
///
/// It keeps what a [`Pose`] needs; the images of the [`Scene`] may be dropped after the upload.
#[derive(Debug)]
pub struct GpuScene {
    pub(crate) deform: DeformBuffers,
    pub(crate) static_vertices: wgpu::Buffer,
    pub(crate) indices: wgpu::Buffer,
    pub(crate) crowd: Crowd,
    pub(crate) instance_rows: Vec<AffineRows>,
    /// Most shells of a coat.
    pub(crate) shells: u32,
    pub(crate) character_group: wgpu::BindGroup,
    /// The same while the map of the bangs is drawn.
    pub(crate) character_group_without_map: wgpu::BindGroup,
    pub(crate) bangs: Option<BangsMap>,
    pub(crate) shadow: Option<ShadowMap>,
    pub(super) map_samplers: MapSamplers,
    /// Moves the head from its rest to the pose, and the hips.
    pub(super) head: Mat4,
    pub(super) hips: Mat4,
    pub(super) looks: Looks,
    pub(crate) draws: Vec<Draw>,
    /// What shows each draw in the picture.
    pub(crate) picture: Vec<Pipelines<Drawn>>,
    /// What shows it in debug channels that somebody has looked at, and under point and spot lights: by channel, and
    /// whether there are such lights.
    pub(super) sights: BTreeMap<(Option<String>, bool), Vec<Pipelines<Drawn>>>,
    /// Depth, normal and part of every draw, for the channels that show these.
    pub(crate) geometry: Vec<Drawn>,
    /// Groups of materials, by what shaders bind of them.
    pub(crate) groups: Vec<MaterialGroup>,
    pub(crate) transparent_order: Vec<usize>,
    /// Eyes and brows that are seen through hair, the foremost first.
    pub(crate) through_order: Vec<usize>,
    pub(super) eyes_through: Option<EyesThrough>,
    pub(crate) post: Option<Post>,
    /// How often the pose, the places of characters and what is cut out of materials have become others.
    pub(super) revisions: Revisions,
    /// The pose whose joints and weights are on the GPU.
    pub(crate) sent: Made<u64, ()>,
    /// The pose that the deformed vertices are in.
    pub(crate) deformed: Made<u64, ()>,
    /// What the maps of shadows were drawn for.
    pub(crate) maps: Made<MapsKey, ()>,
    /// Whether a material has inner lines, which read normals and parts.
    pub(crate) has_inner_lines: bool,
    /// Whether something reads the depth of the picture.
    pub(crate) has_prepass: bool,
    /// Whether time moves what is cut out of a material.
    pub(super) cuts_move: bool,
    pub(super) rig: Rig,
    pub(super) scratch: Scratch,
    pub(super) part_materials: Vec<usize>,
    /// How many nodes its poses have.
    pub(super) nodes: usize,
    /// The device and the output of the renderer that has uploaded it.
    pub(super) made_by: (Gpu, Output),
    pub(super) triangles: usize,
    pub(super) texture_bytes: u64,
}

/// Counts of changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Revisions {
    pub pose: u64,
    pub places: u64,
    pub(super) cuts: u64,
}

/// What shadow maps depend on.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MapsKey {
    pub(super) revisions: Revisions,
    pub(super) to_light: Vec3,
    /// Where it moves what is cut out.
    pub(super) time_s: f32,
    /// The frames in which the maps stand: bones may move that no vertex follows.
    pub(super) head: Mat4,
    pub(super) hips: Mat4,
}

/// How shaders read the maps of shadows.
#[derive(Debug)]
pub(super) struct MapSamplers {
    pub(super) gather: wgpu::Sampler,
    pub(super) compare: wgpu::Sampler,
}

/// Lists that every pose fills anew, kept so that an animated character allocates nothing.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    pub(super) world: Vec<Mat4>,
    pub(super) joints: Vec<AffineRows>,
    pub(super) weights: Vec<f32>,
    /// Those of the pose.
    pub(super) last_joints: Vec<AffineRows>,
    pub(super) last_weights: Vec<f32>,
}

/// Bytes that a [`GpuScene`] takes on the GPU.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct GpuMemory {
    /// Textures with their mips.
    pub textures: u64,
    /// Vertices, indices, morphs, influences, uniforms.
    pub geometry: u64,
}

impl GpuScene {
    /// Moves the scene to a pose: joints, morph weights and material changes are those of frames that are encoded from now on.
    ///
    /// # Errors
    /// [`Error::Argument`] for a scene that is not the uploaded one, a pose of another scene, a transform or weight that is
    /// not finite, and a material that is not there.
    pub fn set_pose(&mut self, scene: &Scene, pose: &Pose) -> Result<()> {
        if scene.nodes.len() != self.nodes || scene.materials.len() != self.looks.sources.len() {
            let (nodes, materials) = (scene.nodes.len(), scene.materials.len());
            let message = format!(
                "has {nodes} nodes and {materials} materials; the uploaded one has {} and {}",
                self.nodes,
                self.looks.sources.len()
            );
            return Err(Error::Argument { what: "scene".to_owned(), message });
        }
        pose.check(scene)?;
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
        let Scratch { joints, weights, last_joints, last_weights, .. } = &mut self.scratch;
        if joints != last_joints || weights != last_weights {
            last_joints.clone_from(joints);
            last_weights.clone_from(weights);
            self.revisions.pose += 1;
        }
        if self.looks.pose(pose) {
            self.revisions.cuts += 1;
        }
        Ok(())
    }

    /// Makes room for a larger crowd, and gives each character of it its shadow map.
    pub(crate) fn fit(&mut self, renderer: &Renderer) {
        let (gpu, count) = (renderer.gpu(), self.instance_rows.len());
        let has_grown = self.crowd.fit(gpu, &self.instance_rows, self.shells);
        let has_maps = self.shadow.as_mut().is_some_and(|s| s.fit(gpu, count));
        if has_grown || has_maps {
            self.revisions.places += 1;
            let Self { crowd, deform, map_samplers, bangs, shadow, .. } = self;
            self.character_group =
                renderer.character_group(crowd, &deform.deformed, map_samplers, bangs.as_ref(), shadow.as_ref());
            self.character_group_without_map =
                renderer.character_group(crowd, &deform.deformed, map_samplers, None, None);
        }
    }

    /// Writes the places of the characters of a view.
    pub(crate) fn place(&mut self, view: &View) {
        let rows = view.instances.iter().map(|m| AffineRows::from(*m));
        if rows.clone().ne(self.instance_rows.iter().copied()) {
            self.revisions.places += 1;
            self.instance_rows.clear();
            self.instance_rows.extend(rows);
        }
    }

    /// Sends what has changed: the pose, and what depends on places and light. A crowd shares the shadow of its first one's
    /// bangs.
    pub(crate) fn send(&mut self, uploads: &mut Uploads, encoder: &mut wgpu::CommandEncoder, view: &View) {
        if self.sent.stale(self.revisions.pose).is_some() {
            let Scratch { last_joints, last_weights, .. } = &self.scratch;
            uploads.write(encoder, &self.deform.joints, 0, bytemuck::cast_slice(last_joints));
            uploads.write(encoder, &self.deform.weights, 0, bytemuck::cast_slice(last_weights));
        }
        self.looks.send(uploads, encoder);
        let from_world = view.instances.first().copied().unwrap_or_default().inverse();
        let to_light = from_world.transform_vector3(view.lights.directional.to_light).normalize_or(Vec3::Z);
        let Self { crowd, instance_rows, bangs, shadow, .. } = self;
        let rows = shadow.as_ref().map_or_else(ShadowRows::default, |s| {
            s.rows(self.hips.transform_point3(s.middle), view.lights.directional.to_light)
        });
        let states = (0..instance_rows.len()).map(|i| ActorState {
            shadow_layer: shadow.as_ref().and_then(|s| s.layer(i)),
            head: self.head,
            head_middle: self.rig.head_middle,
            bangs: bangs.as_ref(),
            through: self.eyes_through,
            to_light,
            from_world,
            shadow: rows,
        });
        crowd.send(uploads, encoder, states);
    }

    /// What its deformed vertices are made from.
    pub(crate) fn pose_revision(&self) -> u64 {
        self.revisions.pose
    }

    /// What its maps of shadows are made from.
    pub(crate) fn maps_key(&self, view: &View) -> MapsKey {
        MapsKey {
            revisions: self.revisions,
            to_light: view.lights.directional.to_light,
            time_s: if self.cuts_move { view.time_s } else { 0.0 },
            head: self.head,
            hips: self.hips,
        }
    }

    /// The material of a draw as it was uploaded.
    pub(crate) fn material(&self, draw: &Draw) -> &Material {
        &self.looks.sources[draw.material]
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
    pub(super) fn made(
        &mut self,
        variants: &Variants,
        requests: Vec<Pipelines<Request>>,
    ) -> Result<Vec<Pipelines<Drawn>>> {
        let materials: Vec<usize> = self.draws.iter().map(|d| d.material).collect();
        let mut list = Vec::with_capacity(requests.len());
        for (request, material) in requests.into_iter().zip(materials) {
            list.push(request.map(|r| Ok::<_, Error>(self.bind(&variants.gpu, variants.get(&r)?, material)))?);
        }
        Ok(list)
    }

    /// Makes what shows each draw of a picture, where nobody has looked at its like before.
    pub(crate) fn look(&mut self, variants: &Variants, picture: &Picture<'_>) -> Result<()> {
        let Sight { channel, punctual } = picture.sight;
        let key = (channel.map(str::to_owned), punctual);
        if picture.sight == Sight::default() || self.sights.contains_key(&key) {
            return Ok(());
        }
        let request = |draw: &Draw| {
            let (of, material) = (&self.looks.compositions[draw.material], self.material(draw));
            draw_list::surface_requests(draw, of, material, picture)
        };
        let requests: Vec<_> = self.draws.iter().map(request).collect();
        variants.get_all(requests.iter().flat_map(Pipelines::iter))?;
        let made = self.made(variants, requests)?;
        self.sights.insert(key, made);
        Ok(())
    }

    /// What shows each draw, once [`GpuScene::look`] has made it.
    pub(crate) fn shown(&self, sight: Sight<'_>) -> &[Pipelines<Drawn>] {
        let key = (sight.channel.map(str::to_owned), sight.punctual);
        self.sights.get(&key).unwrap_or(&self.picture)
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
                + self.crowd.bytes()
                + self.looks.numbers.size(),
        }
    }
}

/// Actors as shaders read them, and what stands for them in draws.
#[derive(Debug)]
pub(crate) struct Crowd {
    numbers: Filled,
    bytes: Vec<u8>,
    pub(super) actors: wgpu::Buffer,
    pub(super) instances: wgpu::Buffer,
    /// How many there is room for.
    capacity: usize,
    /// What is in the buffer of instances.
    listed: Vec<Instance>,
    list: Vec<Instance>,
}

impl Crowd {
    pub fn new(gpu: &Gpu) -> Self {
        let empty = || bind::buffer(gpu, "actors", 64, wgpu::BufferUsages::STORAGE);
        Self {
            numbers: actor_numbers(),
            bytes: Vec::new(),
            actors: empty(),
            instances: empty(),
            capacity: 0,
            listed: Vec::new(),
            list: Vec::new(),
        }
    }

    /// Lists actors at these places with coats of so many shells; whether there are other buffers now.
    pub fn fit(&mut self, gpu: &Gpu, places: &[AffineRows], shells: u32) -> bool {
        let has_grown = places.len() > self.capacity;
        if has_grown {
            self.capacity = places.len().next_power_of_two();
            let buffer = |label, size, usage| bind::buffer(gpu, label, size, usage | wgpu::BufferUsages::COPY_DST);
            let entries = self.capacity as u64 * u64::from(1 + shells);
            let size = size_of::<Instance>() as u64;
            self.actors = buffer("actors", self.capacity as u64 * self.numbers.size(), wgpu::BufferUsages::STORAGE);
            self.instances = buffer("instances", entries * size, wgpu::BufferUsages::VERTEX);
            self.listed.clear();
        }
        self.list.clear();
        // The surfaces, then each shell of their coats.
        for extra in 0..=shells {
            let of_shell = (0..).zip(places);
            self.list.extend(of_shell.map(|(actor, world)| Instance { world: *world, actor, first_vertex: 0, extra }));
        }
        has_grown
    }

    /// Sends the list, and what the shaders read of each.
    pub fn send<'a>(
        &mut self,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        states: impl Iterator<Item = ActorState<'a>>,
    ) {
        if self.list != self.listed {
            uploads.write(encoder, &self.instances, 0, bytemuck::cast_slice(&self.list));
            self.listed.clone_from(&self.list);
        }
        self.bytes.clear();
        for state in states {
            self.bytes.extend_from_slice(self.numbers.fill(|numbers| put_actor(numbers, &state)));
        }
        uploads.write(encoder, &self.actors, 0, &self.bytes);
    }

    /// Bytes on the GPU.
    pub fn bytes(&self) -> u64 {
        self.actors.size() + self.instances.size()
    }
}
