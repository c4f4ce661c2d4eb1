//! Scene to vertex streams: every primitive under every node in one list, sorted so that draws merge by material.

use std::{cell::LazyCell, collections::HashMap};

use glam::{Mat4, Vec3};

use super::{
    draw_list::mark,
    pass::{Mark, deform::DeformInput},
    vertex::{DeformGroup, DeformVertex, MorphEntry, StaticVertex, pack_unit},
};
use crate::{
    eye::{EyeVertex, Eyes},
    hair::{self, HairStrips, NoStrips},
    material::{AlphaMode, Blending, Material},
    scene::{HumanBone, Influences, MorphTarget, Primitive, Role, Scene, Sight},
    skin,
};

/// What turns a [`Pose`] into matrices and weights, in the order of the GPU buffers.
#[derive(Debug, Default)]
pub(crate) struct Rig {
    pub palettes: Vec<Palette>,
    /// Nodes whose morph weights follow each other in the weight buffer, with their number of targets.
    pub weights: Vec<(usize, usize)>,
    /// Node of the head bone, and the inverse of its place at rest; the face looks to +Z then.
    pub head: Option<(usize, Mat4)>,
    /// Middle of the head at rest, character space.
    pub head_middle: Vec3,
    /// Node of the hips, and the inverse of its place at rest.
    pub hips: Option<(usize, Mat4)>,
    /// Middles and radii of spheres round its eyes and brows and round its hair at rest, character space; `None` where the ones
    /// are not seen through the other.
    pub eyes_and_hair: Option<[(Vec3, f32); 2]>,
    /// Middle and radius of the sphere that weighted layers are weighed over, at rest, character space.
    pub weighed: Option<(Vec3, f32)>,
    /// Least and greatest corner of all vertices at rest, character space; empty without a vertex.
    pub bounds: Option<(Vec3, Vec3)>,
    /// Middle and radius of a sphere round what each joint moves, mesh space; in the order of the joints.
    pub moved: Vec<Option<(Vec3, f32)>>,
}

#[derive(Debug)]
pub(crate) enum Palette {
    /// The node's own matrix.
    Rigid(usize),
    /// Joint nodes and `joint_from_mesh`.
    Skin(Vec<(usize, Mat4)>),
}

impl Palette {
    /// Nodes of its joints, with `joint_from_mesh` where it is not the identity.
    pub fn joints(&self) -> impl Iterator<Item = (usize, Option<Mat4>)> {
        let (rigid, skin) = match self {
            Self::Rigid(node) => (Some((*node, None)), &[][..]),
            Self::Skin(joints) => (None, &joints[..]),
        };
        rigid.into_iter().chain(skin.iter().map(|(node, bind)| (*node, Some(*bind))))
    }
}

/// A primitive under a node.
pub(crate) struct Part {
    pub material: usize,
    /// In the lists of what others see of the character, and of what it sees of itself.
    pub indices: std::ops::Range<u32>,
    pub first_person: std::ops::Range<u32>,
    pub center: Vec3,
    /// Least and greatest corner at rest, character space.
    pub bounds: (Vec3, Vec3),
    pub has_vertex_colors: bool,
    pub role: Role,
}

/// Vertices of all parts in one stream.
#[derive(Default)]
pub(crate) struct Geometry {
    pub parts: Vec<Part>,
    pub indices: Vec<u32>,
    /// What a character sees of itself; empty where it is none.
    pub first_person: Vec<u32>,
    pub static_vertices: Vec<StaticVertex>,
    pub source: Vec<DeformVertex>,
    pub vertex_refs: Vec<[u32; 2]>,
    pub groups: Vec<DeformGroup>,
    pub influences: Vec<u32>,
    pub morphs: Vec<MorphEntry>,
    pub rig: Rig,
    pub joint_count: usize,
    pub weight_count: usize,
    /// Material by part id, which counts primitives in the order of nodes.
    pub part_materials: Vec<usize>,
    /// Materials whose strands cannot be found.
    pub faults: Vec<(usize, NoStrips)>,
    /// Box round what each joint moves, mesh space.
    moved_by_joint: Vec<Option<(Vec3, Vec3)>>,
}

impl Geometry {
    pub fn gather(scene: &Scene, eyes: &Eyes) -> Self {
        let mut geometry = Self::default();
        let rest = scene.rest_world_from_nodes();
        let joint = |node: usize| Some((node, rest.get(node)?.inverse()));
        geometry.rig.head = scene.head_node().and_then(joint);
        geometry.rig.hips = scene.bone_node(HumanBone::Hips).and_then(joint);
        // A little over the bone, at the base of the skull, where there is no face.
        let over_bone = || Some(geometry.rig.head?.1.inverse().w_axis.truncate() + Vec3::Y * 0.1);
        let middle = scene.face_box(None).map(|(low, high)| (low + high) * 0.5).or_else(over_bone);
        geometry.rig.head_middle = middle.unwrap_or_default();
        let mut skin_palettes: HashMap<usize, u32> = HashMap::new();
        let mut parts: Vec<(u32, usize, &Primitive, DeformGroup, Mat4)> = Vec::new();
        let in_head = scene.below_head();
        for (node_index, mesh) in scene.mesh_nodes() {
            let node = &scene.nodes[node_index];
            let skin = node.skin.and_then(|s| scene.skins.get(s));
            let rest_matrix = match skin {
                Some(skin) => skin.matrix(&rest, 0),
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
        geometry.moved_by_joint = vec![None; geometry.joint_count];
        // Opaque first and by material, so that draws merge; blended parts keep their order in the file.
        let blend = |p: &Primitive| scene.materials.get(p.material).is_some_and(|m| m.drawn_mode() == AlphaMode::Blend);
        let mask = |p: &Primitive| scene.materials.get(p.material).is_some_and(|m| m.drawn_mode() == AlphaMode::Mask);
        parts.sort_by_key(|(id, _, p, ..)| (blend(p), mask(p), if blend(p) { 0 } else { p.material }, *id));
        let mut materials_by_id = vec![0; parts.len()];
        let is_skin = |p: &Primitive| scene.materials.get(p.material).is_some_and(|m| m.skin.is_some());
        let at_rest = |node: usize, primitive, character_from_mesh| skin::Part {
            primitive,
            character_from_mesh,
            morph_weights: &scene.nodes[node].morph_weights,
        };
        let skin: Vec<_> =
            parts.iter().filter(|part| is_skin(part.2)).map(|part| at_rest(part.1, part.2, part.4)).collect();
        // What is drawn on skin lies on it, and hides nothing from it.
        let is_on_skin = |p: &Primitive| matches!(p.role, Role::Lash | Role::Brow | Role::EyeHighlight);
        let hides = |node: usize, p: &Primitive| {
            !is_skin(p) && !blend(p) && !is_on_skin(p) && Sight::of(scene, &in_head, node).others
        };
        let hides = parts.iter().filter(|part| hides(part.1, part.2));
        let hiding: Vec<_> = hides.map(|part| at_rest(part.1, part.2, part.4)).collect();
        let scales = scene.materials.iter().filter_map(|m| Some(m.skin.as_ref()?.profile.world_scale));
        let mut skin = skin::measured(&skin, &hiding, scales.fold(f32::MAX, f32::min)).into_iter();
        geometry.push_eyes(eyes, &parts);
        for (id, node, primitive, group, rest_matrix) in &parts {
            let sight = Sight::of(scene, &in_head, *node);
            let material = scene.materials.get(primitive.material);
            // Found where something asks for them, once for all that do.
            let strips = LazyCell::new(|| HairStrips::of(primitive, *rest_matrix, middle));
            let strips = || strips.as_ref().map_err(|why| *why);
            let hair = material.and_then(|m| m.hair.as_ref());
            let strands = hair.map(|hair| hair::tangents(hair, primitive, strips)).transpose();
            let strands = strands.unwrap_or_else(|fault| {
                geometry.faults.push((primitive.material, fault));
                None
            });
            let mesh = scene.nodes[*node].mesh.map_or("", |mesh| &scene.meshes[mesh].name);
            let arranged = material.and_then(|m| arranged(m, primitive, mesh, strips));
            let prepared = Prepared {
                strands: strands.as_deref(),
                strips: arranged.as_ref(),
                skin: if is_skin(primitive) { skin.next() } else { None },
                eyes: eyes.vertices.get(id).map(Vec::as_slice),
            };
            geometry.push(*id, primitive, &prepared, *group, *rest_matrix, &sight);
            materials_by_id[*id as usize] = primitive.material;
        }
        let moved = geometry.moved_by_joint.iter();
        let sphere = |(low, high): (Vec3, Vec3)| ((low + high) * 0.5, (high - low).length() * 0.5);
        geometry.rig.moved = moved.map(|b| b.map(sphere)).collect();
        geometry.part_materials = materials_by_id;
        geometry.rig.eyes_and_hair = eyes_and_hair(scene, &geometry.parts);
        geometry.rig.weighed = weighed(scene, &geometry.parts);
        geometry.vertex_refs.push([0, geometry.morphs.len() as u32]);
        geometry
    }

    /// A vertex for each eye, before all others, which nobody draws: its normal is the gaze in every pose, its tangent points to
    /// the right as the eye is seen.
    fn push_eyes(&mut self, eyes: &Eyes, parts: &[(u32, usize, &Primitive, DeformGroup, Mat4)]) {
        for eye in &eyes.list {
            let Some((.., group, rest)) = parts.iter().find(|part| part.0 == eye.part) else { continue };
            let group_index = self.groups.len() as u32;
            self.groups.push(DeformGroup {
                first_vertex: self.source.len() as u32,
                first_influence: self.influences.len() as u32,
                influences_per_vertex: group.influences_per_vertex.min(1),
                ..*group
            });
            if group.influences_per_vertex > 0 {
                self.influences.push(u32::from(eye.joint) | 0xffff << 16);
            }
            // The other way round than the shader: normals by the transposed matrix, points by the inverse.
            let back = rest.inverse();
            let right = back.transform_vector3(eye.up.cross(eye.axis));
            self.source.push(DeformVertex {
                position: back.transform_point3(eye.centre).to_array(),
                normal: pack_unit(rest.transpose().transform_vector3(eye.axis).to_array()),
                tangent: pack_unit(right.to_array()) & !1,
                outline_normal: pack_unit([0.0, 0.0, 1.0]),
            });
            self.static_vertices.push(StaticVertex::default());
            self.vertex_refs.push([group_index, self.morphs.len() as u32]);
        }
    }

    fn push(
        &mut self,
        id: u32,
        primitive: &Primitive,
        prepared: &Prepared<'_>,
        mut group: DeformGroup,
        rest: Mat4,
        sight: &Sight,
    ) {
        let Prepared { strands, strips, skin, eyes } = prepared;
        let tangents = strands.unwrap_or(&primitive.tangents);
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
            let tangent = tangents.get(v).copied().unwrap_or([1.0, 0.0, 0.0, 1.0]);
            let [tx, ty, tz, sign] = tangent;
            self.source.push(DeformVertex {
                position,
                normal: pack_unit(normal),
                tangent: pack_unit([tx, ty, tz]) & !1 | u32::from(sign < 0.0),
                outline_normal: pack_unit(primitive.outline_normals.get(v).copied().unwrap_or(normal)),
            });
            let ([u0, v0], [u1, v1]) = (uv(0, v), uv(1, v));
            let bare = strips.map_or([255; 4], |s| s.colors[v]);
            let color = primitive.colors.get(v).map_or(bare, |c| c.map(|x| (x.clamp(0.0, 1.0) * 255.0).round() as u8));
            let part = id | strips.map_or(0, |s| s.numbers[v] << 16);
            let [k, t, o] = skin.as_ref().and_then(|s| s.get(v)).copied().unwrap_or_default();
            let of_skin = [k, t, o, 0.0].map(|x| half::f16::from_f32(x).to_bits());
            let shape = eyes.and_then(|e| e.get(v)).map_or(of_skin, |of_eye| of_eye.map(|x| x as u16));
            self.static_vertices.push(StaticVertex { uv: [u0, v0, u1, v1], color, part, shape });
            self.vertex_refs.push([group_index, self.morphs.len() as u32]);
            morphs.take(v as u32, &mut self.morphs);
            let world = rest.transform_point3(Vec3::from(position));
            (low, high) = (low.min(world), high.max(world));
            let per_vertex = group.influences_per_vertex as usize;
            let influences = v * per_vertex..(v + 1) * per_vertex;
            let joints = primitive.influences.joints.get(influences.clone()).unwrap_or_default().iter();
            let weights = primitive.influences.weights.get(influences).unwrap_or_default().iter();
            let moving = joints.zip(weights).filter(|(_, weight)| **weight > 0.0).map(|(joint, _)| u32::from(*joint));
            let rigid = (per_vertex == 0).then_some(0);
            for joint in moving.chain(rigid) {
                let at = Vec3::from(position);
                let moved = &mut self.moved_by_joint[(group.first_joint + joint) as usize];
                *moved = Some(moved.map_or((at, at), |(low, high)| (low.min(at), high.max(at))));
            }
        }
        if group.influences_per_vertex > 0 {
            pack_influences(&primitive.influences, &mut self.influences);
        }
        let start = self.indices.len() as u32;
        // A mirrored node turns its triangles inside out; the front faces are put back here.
        let mirrored = rest.determinant() < 0.0;
        let turned = |t: &[u32]| {
            let [a, b, c] = [t[0] + first, t[1] + first, t[2] + first];
            if mirrored { [a, c, b] } else { [a, b, c] }
        };
        let indices = strips.map_or(&primitive.indices, |s| &s.indices);
        if sight.others {
            self.indices.extend(indices.chunks_exact(3).flat_map(turned));
        }
        let own = self.first_person.len() as u32;
        if sight.own {
            let of_head = |v: &u32| sight.is_of_head(primitive, *v as usize);
            let kept = indices.chunks_exact(3).filter(|t| !t.iter().any(of_head));
            self.first_person.extend(kept.flat_map(turned));
        }
        if low.cmple(high).all() {
            let (a, b) = self.rig.bounds.unwrap_or((low, high));
            self.rig.bounds = Some((a.min(low), b.max(high)));
        }
        self.parts.push(Part {
            material: primitive.material,
            indices: start..self.indices.len() as u32,
            first_person: own..self.first_person.len() as u32,
            center: (low + high) * 0.5,
            bounds: (low, high),
            has_vertex_colors: !primitive.colors.is_empty(),
            role: primitive.role,
        });
    }

    pub fn deform_input(&self) -> DeformInput<'_> {
        DeformInput {
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

/// What the material of a part has made of it.
struct Prepared<'a> {
    /// In the place of tangents.
    strands: Option<&'a [[f32; 4]]>,
    /// Another order of triangles.
    strips: Option<&'a Arranged>,
    /// Curvature, thickness and occlusion.
    skin: Option<Vec<[f32; 3]>>,
    /// Places in eyes.
    eyes: Option<&'a [EyeVertex]>,
}

/// Spheres round eyes and hair, as far as those are seen through this.
fn eyes_and_hair(scene: &Scene, parts: &[Part]) -> Option<[(Vec3, f32); 2]> {
    scene.eyes_through?;
    let sphere = |wanted: Mark| {
        let marked = parts.iter().filter(|p| mark(p.role) == wanted);
        let (low, high) = marked.map(|p| p.bounds).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
        // Hair swings.
        let swing = if wanted == Mark::Hair { 0.1 } else { 0.0 };
        low.cmple(high).all().then(|| ((low + high) * 0.5, (high - low).length() * 0.5 + swing))
    };
    Some([sphere(Mark::Eyes)?, sphere(Mark::Hair)?])
}

/// A primitive as strips of hair.
struct Arranged {
    /// Triangles in the order of their strips.
    indices: Vec<u32>,
    /// How far along its strip each vertex lies, 16 bits in red and green.
    colors: Vec<[u8; 4]>,
    /// By vertex: the strip in 8 bits, and its turn in 8 above.
    numbers: Vec<u32>,
}

/// A primitive of a mesh as its strips, where its material asks for them.
fn arranged<'a>(
    material: &Material,
    primitive: &Primitive,
    mesh: &str,
    strips: impl FnOnce() -> Result<&'a HairStrips, NoStrips>,
) -> Option<Arranged> {
    let settings = material.strips?;
    let vertices = primitive.positions.len();
    let found = match strips() {
        Ok(found) => found,
        Err(why) => {
            let name = &material.name;
            tracing::warn!(
                "material {name:?}, strips: a part of mesh {mesh:?} {why}; it is drawn as it is and without occlusion, please \
                 give it a material of its own"
            );
            let (colors, numbers) = (vec![[255; 4]; vertices], vec![0; vertices]);
            return Some(Arranged { indices: primitive.indices.clone(), colors, numbers });
        }
    };
    let order = found.order(settings.sort);
    let mut turns = vec![0; found.count];
    let last = found.count.saturating_sub(1).max(1);
    order.iter().enumerate().for_each(|(turn, strip)| turns[*strip as usize] = (turn * 255 / last) as u32);
    let mut numbers = vec![0; vertices];
    for (triangle, strip) in primitive.indices.chunks_exact(3).zip(&found.of_triangles) {
        triangle.iter().for_each(|v| numbers[*v as usize] = strip & 0xff | turns[*strip as usize] << 8);
    }
    let place = |t: &f32| {
        let [low, high] = ((t * 65535.0).round() as u16).to_le_bytes();
        [high, low, 0, 0]
    };
    Some(Arranged {
        indices: found.arranged(&primitive.indices, &order),
        colors: found.along.iter().map(place).collect(),
        numbers,
    })
}

/// The sphere that weighted layers are weighed over: the head, or where there is none, what is weighted, half as large as the
/// middle one of its sides, for long hair hangs far below its head.
fn weighed(scene: &Scene, parts: &[Part]) -> Option<(Vec3, f32)> {
    let is_weighted = |p: &&Part| scene.materials.get(p.material).is_some_and(|m| m.blending() == Blending::Weighted);
    let bounds = parts.iter().filter(is_weighted).map(|p| p.bounds).filter(|(low, high)| low.cmple(*high).all());
    let (low, high) = bounds.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))?;
    // Hair stands a fifth wider than the face.
    let head = scene.face_box(None).map(|(low, high)| ((low + high) * 0.5, (high - low).max_element() * 0.6));
    let sides = high - low;
    let middle_side = sides.element_sum() - sides.max_element() - sides.min_element();
    Some(head.unwrap_or(((low + high) * 0.5, middle_side * 0.5)))
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
