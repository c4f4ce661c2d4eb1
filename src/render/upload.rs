//! Scene to GPU: one vertex buffer, one index buffer, one bind group a material, draws merged by material.

use std::{
    borrow::Cow,
    collections::{BTreeMap, HashMap},
};

use glam::{Mat4, Vec3};
use wgpu::util::DeviceExt;

use super::{
    Renderer,
    draw_list::Draw,
    pass::{Driven, SurfaceFlags, deform::DeformBuffers},
    textures::{Encoding, TextureSet},
    uniforms::{AffineRows, DeformGroup, DeformVertex, MaterialUniform, MorphEntry, StaticVertex, pack_unit},
};
use crate::{
    Gpu, Result,
    material::{AlphaMode, Material, Shading, TextureRef},
    motion::Pose,
    scene::{Image, Influences, MorphTarget, Primitive, Scene, Skin},
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
    pub(crate) materials: wgpu::Buffer,
    pub(crate) material_groups: Vec<wgpu::BindGroup>,
    pub(crate) draws: Vec<Draw>,
    pub(crate) transparent_order: Vec<usize>,
    /// Whether the deformed vertices lag behind the pose.
    pub(crate) deform_pending: bool,
    source_materials: Vec<Material>,
    posed_materials: BTreeMap<usize, Material>,
    rig: Rig,
    part_materials: Vec<usize>,
    triangles: usize,
    texture_bytes: u64,
}

/// Bytes that a [`GpuScene`] takes on the GPU.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct GpuMemory {
    /// Textures with their mips.
    pub textures: u64,
    /// Vertices, indices, morphs, influences, uniforms.
    pub geometry: u64,
}

/// What turns a [`Pose`] into matrices and weights, in the order of the GPU buffers.
#[derive(Debug, Default)]
struct Rig {
    palettes: Vec<Palette>,
    /// Nodes whose morph weights follow each other in the weight buffer, with their number of targets.
    weights: Vec<(usize, usize)>,
}

#[derive(Debug)]
enum Palette {
    /// The node's own matrix.
    Rigid(usize),
    /// Joint nodes and `joint_from_mesh`.
    Skin(Vec<(usize, Mat4)>),
}

/// Size of one material in the uniform buffer: the strictest offset alignment of WebGPU.
const MATERIAL_STRIDE: u64 = (size_of::<MaterialUniform>() as u64).next_multiple_of(256);

impl Renderer {
    /// Uploads a scene at rest and makes every pipeline that it needs.
    ///
    /// # Errors
    /// [`Error::Gpu`](crate::Error::Gpu) where the adapter refuses a resource, [`Error::Argument`](crate::Error::Argument)
    /// where the scene contradicts itself.
    pub fn upload(&mut self, scene: &Scene) -> Result<GpuScene> {
        let gpu = self.gpu.clone();
        gpu.scoped(|| {
            let borrow = |index| scene.images.get(index).map(Cow::Borrowed);
            let textures = TextureSet::new(&self.gpu, &scene.textures, &texture_uses(&scene.materials), borrow)?;
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
            let Scene { textures, images, materials, .. } = scene;
            let take = |index: usize| {
                let image = images.get_mut(index)?;
                let pixels = std::mem::take(&mut image.pixels);
                Some(Cow::Owned(Image { pixels, ..image.clone() }))
            };
            let textures = TextureSet::new(&self.gpu, textures, &texture_uses(materials), take)?;
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
        for (chunk, material) in uniforms.chunks_exact_mut(MATERIAL_STRIDE as usize).zip(&scene.materials) {
            chunk[..size_of::<MaterialUniform>()].copy_from_slice(bytemuck::bytes_of(&MaterialUniform::new(material)));
        }
        let materials = buffer("materials", &uniforms, U::UNIFORM | U::COPY_DST);
        let material_groups = scene
            .materials
            .iter()
            .enumerate()
            .map(|(index, material)| self.material_group(scene, material, index, &materials, textures))
            .collect();

        let indices = buffer("indices", bytemuck::cast_slice(&geometry.indices), U::INDEX);
        let static_vertices = buffer("static vertices", bytemuck::cast_slice(&geometry.static_vertices), U::VERTEX);
        let deform = self.deform.buffers(&self.gpu, &geometry.deform_input());
        let draws = self.make_draws(scene, &geometry.parts);
        let mut uploaded = GpuScene {
            deform,
            static_vertices,
            indices,
            instances: instance_buffer(&self.gpu, 1),
            instance_capacity: 1,
            instance_rows: Vec::new(),
            materials,
            material_groups,
            transparent_order: Vec::with_capacity(draws.len()),
            draws,
            deform_pending: true,
            source_materials: scene.materials.clone(),
            posed_materials: BTreeMap::new(),
            rig: geometry.rig,
            part_materials: geometry.part_materials,
            triangles: geometry.indices.len() / 3,
            texture_bytes: textures.bytes,
        };
        uploaded.set_pose(&self.gpu, scene, &Pose::rest(scene));
        Ok(uploaded)
    }

    fn material_group(
        &self,
        scene: &Scene,
        material: &Material,
        index: usize,
        uniforms: &wgpu::Buffer,
        textures: &TextureSet,
    ) -> wgpu::BindGroup {
        let mut entries = vec![wgpu::BindGroupEntry {
            binding: 0,
            resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer: uniforms,
                offset: index as u64 * MATERIAL_STRIDE,
                size: wgpu::BufferSize::new(size_of::<MaterialUniform>() as u64),
            }),
        }];
        for (slot, (texture, encoding)) in texture_slots(material).into_iter().enumerate() {
            let (view, sampler) = textures.get(&scene.textures, texture, encoding);
            let binding = 1 + 2 * slot as u32;
            entries.push(wgpu::BindGroupEntry { binding, resource: wgpu::BindingResource::TextureView(view) });
            entries
                .push(wgpu::BindGroupEntry { binding: binding + 1, resource: wgpu::BindingResource::Sampler(sampler) });
        }
        self.gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&material.name),
            layout: &self.layouts.material,
            entries: &entries,
        })
    }

    /// One draw for each opaque material, one for each transparent part; outlines likewise.
    fn make_draws(&mut self, scene: &Scene, parts: &[Part]) -> Vec<Draw> {
        let driven = Driven::of(scene);
        let mut draws: Vec<Draw> = Vec::new();
        for part in parts {
            let Some(material) = scene.materials.get(part.material) else { continue };
            let blend = material.alpha.mode == AlphaMode::Blend;
            // Parts are sorted by material, so that those of one material follow each other in the index buffer.
            if let Some(last) = draws.last_mut()
                && !blend
                && last.material == part.material
                && last.indices.end == part.indices.start
            {
                last.indices.end = part.indices.end;
                continue;
            }
            let flags = SurfaceFlags::of(material, &driven[part.material], part.has_vertex_colors);
            draws.push(Draw {
                material: part.material,
                indices: part.indices.clone(),
                center: part.center,
                blend,
                write_depth: material.alpha.write_depth,
                queue_offset: material.alpha.queue_offset,
                surface: if blend {
                    self.transparent.pipeline(&self.gpu, &self.layouts, flags, material)
                } else {
                    self.opaque.pipeline(&self.gpu, &self.layouts, flags, material)
                },
                outline: self.outline.pipeline(&self.gpu, &self.layouts, flags, material, &driven[part.material]),
                prepass: self.prepass.pipeline(&self.gpu, &self.layouts, flags, material),
            });
        }
        draws
    }
}

impl GpuScene {
    /// Moves the scene to a pose: joint matrices, morph weights and material changes are written to the GPU; the
    /// vertices follow in the next frame.
    pub fn set_pose(&mut self, gpu: &Gpu, scene: &Scene, pose: &Pose) {
        let world = scene.world_from_nodes(&pose.locals);
        let matrix = |node: usize| world.get(node).copied().unwrap_or(Mat4::IDENTITY);
        let mut joints: Vec<AffineRows> = Vec::with_capacity(self.deform.joint_count);
        for palette in &self.rig.palettes {
            match palette {
                Palette::Rigid(node) => joints.push(matrix(*node).into()),
                Palette::Skin(skin) => {
                    joints.extend(skin.iter().map(|(node, bind)| AffineRows::from(matrix(*node) * *bind)))
                }
            }
        }
        let mut weights: Vec<f32> = Vec::with_capacity(self.deform.weight_count);
        for &(node, targets) in &self.rig.weights {
            let of_node = pose.morph_weights.get(node).map_or(&[] as &[f32], Vec::as_slice);
            weights.extend((0..targets).map(|t| of_node.get(t).copied().unwrap_or(0.0)));
        }
        gpu.queue.write_buffer(&self.deform.joints, 0, bytemuck::cast_slice(&joints));
        if !weights.is_empty() {
            gpu.queue.write_buffer(&self.deform.weights, 0, bytemuck::cast_slice(&weights));
        }
        for index in self.posed_materials.keys().chain(pose.materials.keys()) {
            if let Some(material) = pose.materials.get(index).or_else(|| self.source_materials.get(*index)) {
                let uniform = MaterialUniform::new(material);
                gpu.queue.write_buffer(&self.materials, *index as u64 * MATERIAL_STRIDE, bytemuck::bytes_of(&uniform));
            }
        }
        self.posed_materials.clone_from(&pose.materials);
        self.deform_pending = true;
    }

    /// Draw calls of one frame with everything in view, outlines included.
    #[must_use]
    pub fn draw_count(&self) -> usize {
        self.draws.iter().map(|d| 1 + usize::from(d.outline.is_some())).sum()
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

/// Textures of a material in the order of `wgsl/bind/material.wgsl`.
fn texture_slots(material: &Material) -> [(Option<usize>, Encoding); 9] {
    let of = |r: Option<TextureRef>| r.map(|r| r.texture);
    let (shade, shift) = match &material.shading {
        Shading::Toon(toon) => (of(toon.shade_texture), of(toon.shift_texture)),
        Shading::Unlit => (None, None),
    };
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
    ]
}

fn texture_uses(materials: &[Material]) -> Vec<(usize, Encoding)> {
    materials.iter().flat_map(texture_slots).filter_map(|(texture, encoding)| Some((texture?, encoding))).collect()
}

/// A primitive under a node.
struct Part {
    material: usize,
    indices: std::ops::Range<u32>,
    center: Vec3,
    has_vertex_colors: bool,
}

/// Vertices of all parts in one stream.
#[derive(Default)]
struct Geometry {
    parts: Vec<Part>,
    indices: Vec<u32>,
    static_vertices: Vec<StaticVertex>,
    source: Vec<DeformVertex>,
    vertex_refs: Vec<[u32; 2]>,
    groups: Vec<DeformGroup>,
    influences: Vec<u32>,
    morphs: Vec<MorphEntry>,
    rig: Rig,
    joint_count: usize,
    weight_count: usize,
    /// Material by part id, which counts primitives in the order of nodes.
    part_materials: Vec<usize>,
}

impl Geometry {
    fn gather(scene: &Scene) -> Self {
        let mut geometry = Self::default();
        let rest = scene.rest_world_from_nodes();
        let mut skin_palettes: HashMap<usize, u32> = HashMap::new();
        let mut parts: Vec<(u32, usize, &Primitive, DeformGroup, Mat4)> = Vec::new();
        for (node_index, mesh) in scene.mesh_nodes() {
            let node = &scene.nodes[node_index];
            let skin = node.skin.and_then(|s| scene.skins.get(s));
            let rest_matrix = match skin {
                Some(skin) => skin_matrix(skin, &rest, 0),
                None => rest[node_index],
            };
            let first_weight = geometry.weight_count as u32;
            geometry.rig.weights.push((node_index, mesh.morph_names.len()));
            geometry.weight_count += mesh.morph_names.len();
            let mut rigid_joint = None;
            for primitive in &mesh.primitives {
                let skinned = skin.is_some() && primitive.influences.per_vertex > 0;
                let first_joint = if let (true, Some(skin), Some(skin_index)) = (skinned, skin, node.skin) {
                    *skin_palettes.entry(skin_index).or_insert_with(|| {
                        let first = geometry.joint_count as u32;
                        let joints = skin.joints.iter().copied().zip(skin.joint_from_mesh.iter().copied()).collect();
                        geometry.rig.palettes.push(Palette::Skin(joints));
                        geometry.joint_count += skin.joints.len();
                        first
                    })
                } else {
                    *rigid_joint.get_or_insert_with(|| {
                        geometry.rig.palettes.push(Palette::Rigid(node_index));
                        geometry.joint_count += 1;
                        geometry.joint_count as u32 - 1
                    })
                };
                let group = DeformGroup {
                    first_joint,
                    first_weight,
                    influences_per_vertex: if skinned {
                        primitive.influences.per_vertex as u32
                    } else {
                        0
                    },
                    ..DeformGroup::default()
                };
                parts.push((parts.len() as u32, node_index, primitive, group, rest_matrix));
            }
        }
        // Opaque first and by material, so that draws merge; blended parts keep their order in the file.
        let blend = |p: &Primitive| scene.materials.get(p.material).is_some_and(|m| m.alpha.mode == AlphaMode::Blend);
        let mask = |p: &Primitive| scene.materials.get(p.material).is_some_and(|m| m.alpha.mode == AlphaMode::Mask);
        parts.sort_by_key(|(id, _, p, ..)| (blend(p), mask(p), if blend(p) { 0 } else { p.material }, *id));
        let mut materials_by_id = vec![0; parts.len()];
        for (id, _, primitive, group, rest_matrix) in &parts {
            geometry.push(*id, primitive, *group, *rest_matrix);
            materials_by_id[*id as usize] = primitive.material;
        }
        geometry.part_materials = materials_by_id;
        geometry.vertex_refs.push([0, geometry.morphs.len() as u32]);
        geometry
    }

    fn push(&mut self, id: u32, primitive: &Primitive, mut group: DeformGroup, rest: Mat4) {
        let first = self.source.len() as u32;
        group.first_vertex = first;
        group.first_influence = self.influences.len() as u32;
        let group_index = self.groups.len() as u32;
        self.groups.push(group);

        let uv = |set: usize, v: usize| primitive.uvs.get(set).and_then(|s| s.get(v)).copied().unwrap_or([0.0; 2]);
        let mut morphs = MorphCursors::new(&primitive.morphs);
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for (v, &position) in primitive.positions.iter().enumerate() {
            let normal = primitive.normals.get(v).copied().unwrap_or([0.0, 0.0, 1.0]);
            let tangent = primitive.tangents.get(v).copied().unwrap_or([1.0, 0.0, 0.0, 1.0]);
            let [tx, ty, tz, sign] = tangent;
            self.source.push(DeformVertex {
                position,
                normal: pack_unit(normal),
                tangent: pack_unit([tx, ty, tz]) & !1 | u32::from(sign < 0.0),
                outline_normal: pack_unit(primitive.outline_normals.get(v).copied().unwrap_or(normal)),
            });
            let ([u0, v0], [u1, v1]) = (uv(0, v), uv(1, v));
            let color =
                primitive.colors.get(v).map_or([255; 4], |c| c.map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8));
            self.static_vertices.push(StaticVertex { uv: [u0, v0, u1, v1], color, part: id });
            self.vertex_refs.push([group_index, self.morphs.len() as u32]);
            morphs.take(v as u32, &mut self.morphs);
            let world = rest.transform_point3(Vec3::from(position));
            (low, high) = (low.min(world), high.max(world));
        }
        if group.influences_per_vertex > 0 {
            pack_influences(&primitive.influences, &mut self.influences);
        }
        let start = self.indices.len() as u32;
        // A mirrored node turns its triangles inside out; the front faces are put back here.
        let mirrored = rest.determinant() < 0.0;
        self.indices.extend(primitive.indices.chunks_exact(3).flat_map(|t| {
            let [a, b, c] = [t[0] + first, t[1] + first, t[2] + first];
            if mirrored { [a, c, b] } else { [a, b, c] }
        }));
        self.parts.push(Part {
            material: primitive.material,
            indices: start..self.indices.len() as u32,
            center: (low + high) * 0.5,
            has_vertex_colors: !primitive.colors.is_empty(),
        });
    }

    fn deform_input(&self) -> super::pass::deform::DeformInput<'_> {
        super::pass::deform::DeformInput {
            groups: &self.groups,
            source: &self.source,
            vertex_refs: &self.vertex_refs,
            influences: &self.influences,
            morphs: &self.morphs,
            joint_count: self.joint_count,
            weight_count: self.weight_count,
        }
    }
}

/// Reads sparse morph targets in vertex order.
struct MorphCursors<'a> {
    targets: Vec<(u32, &'a MorphTarget, usize)>,
}

impl<'a> MorphCursors<'a> {
    fn new(targets: &'a [MorphTarget]) -> Self {
        let moving = targets.iter().enumerate().filter(|(_, t)| !t.vertices.is_empty());
        Self { targets: moving.map(|(i, t)| (i as u32, t, 0)).collect() }
    }

    fn take(&mut self, vertex: u32, out: &mut Vec<MorphEntry>) {
        for (index, target, cursor) in &mut self.targets {
            if target.vertices.get(*cursor) == Some(&vertex) {
                let at = |list: &[[f32; 3]]| list.get(*cursor).copied().unwrap_or([0.0; 3]);
                let entry =
                    MorphEntry { target_index: *index, position: at(&target.positions), normal: at(&target.normals) };
                out.push(entry);
                *cursor += 1;
            }
        }
    }
}

/// Packs joints with unorm16 weights whose sum is exactly one: the heaviest takes what rounding leaves.
fn pack_influences(influences: &Influences, out: &mut Vec<u32>) {
    let per_vertex = influences.per_vertex;
    for (joints, weights) in influences.joints.chunks_exact(per_vertex).zip(influences.weights.chunks_exact(per_vertex))
    {
        let mut codes: Vec<i64> = weights.iter().map(|w| (f64::from(*w) * 65535.0).round() as i64).collect();
        let rest: i64 = 65535 - codes.iter().sum::<i64>();
        if let Some(first) = codes.first_mut() {
            *first = (*first + rest).clamp(0, 65535);
        }
        out.extend(joints.iter().zip(&codes).map(|(joint, code)| u32::from(*joint) | (*code as u32) << 16));
    }
}

fn skin_matrix(skin: &Skin, rest: &[Mat4], joint: usize) -> Mat4 {
    let node = skin.joints.get(joint).and_then(|n| rest.get(*n)).copied().unwrap_or(Mat4::IDENTITY);
    node * skin.joint_from_mesh.get(joint).copied().unwrap_or(Mat4::IDENTITY)
}
