//! The bodies of a stage's actors on the GPU: pose, place, maps of shadows, and what of their materials has changed.

use std::collections::HashMap;
use std::ops::Range;

use glam::{Mat4, Vec3};

use super::crowd::Crowd;
use super::{Actor, Stage};
use crate::motion::Pose;
use crate::render::draw_list::Draw;
use crate::render::frame::ActorState;
use crate::render::geometry::Palette;
use crate::render::looks::Edits;
use crate::render::made::Made;
use crate::render::pass::bangs_shadow::BangsMap;
use crate::render::pass::deform::DeformBuffers;
use crate::render::pass::shadow::{ShadowMap, ShadowRows};
use crate::render::uploads::Uploads;
use crate::render::vertex::{AffineRows, Instance};
use crate::render::{Character, CharacterData, Renderer};
use crate::{Error, Gpu, Result};

/// Bodies of all actors, in their order.
#[derive(Debug, Default)]
pub(crate) struct Bodies {
    pub list: Vec<Body>,
    pub shadow: Option<ShadowMap>,
    crowd: Option<Crowd>,
}

/// The body of one actor.
#[derive(Debug)]
pub(crate) struct Body {
    /// That of its actor.
    id: u64,
    pub character: Character,
    /// Its number on the stage, and its instance.
    pub index: u32,
    /// What stands for the shells of its coat.
    pub shells: Range<u32>,
    /// What stands for the others that cast on it: their numbers and instances.
    pub casters: Vec<(usize, u32)>,
    pub world: Mat4,
    pub deform: DeformBuffers,
    /// Group 1, and the same while maps of shadows are drawn.
    pub groups: Option<[wgpu::BindGroup; 2]>,
    pub bangs: Option<BangsMap>,
    shadow_layer: Option<u32>,
    /// Moves the head from its rest to the pose, and the hips.
    head: Mat4,
    hips: Mat4,
    edits: Edits,
    /// How often the pose, and what is cut out of materials, have become others.
    revisions: [u64; 2],
    /// The pose whose joints and weights are on the GPU, and the one that its vertices are in.
    sent: Made<u64, ()>,
    pub deformed: Made<u64, ()>,
    pub maps: Made<MapsKey, ()>,
    scratch: Scratch,
}

/// What maps of shadows depend on.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct MapsKey {
    to_light: Vec3,
    /// Where it moves what is cut out.
    time_s: f32,
    shadow_layer: Option<u32>,
    /// The frames in which the maps stand: bones may move that no vertex follows.
    head: Mat4,
    hips: Mat4,
    /// Of what casts into them, itself first: actor, revisions, place.
    cast: Vec<(u64, [u64; 2], Mat4)>,
}

/// Lists that every pose fills anew, kept so that an animated character allocates nothing.
#[derive(Debug, Default)]
struct Scratch {
    world: Vec<Mat4>,
    joints: Vec<AffineRows>,
    weights: Vec<f32>,
    /// Those of the pose.
    last_joints: Vec<AffineRows>,
    last_weights: Vec<f32>,
}

/// Other actors that cast on one, at most.
const MOST_CASTING: usize = 16;
/// How far beyond its own size something may stand from a head and cast on it, metres.
const REACH_M: f32 = 3.0;

impl Stage {
    /// Makes the bodies those of the actors: new ones, vanished ones, poses, places, lists.
    pub(crate) fn embody(&mut self, renderer: &Renderer) -> Result<()> {
        self.check()?;
        let Self { actors, bodies, .. } = self;
        for (i, actor) in actors.iter().enumerate() {
            renderer.owns(&actor.character, i)?;
        }
        if !bodies.are_of(actors) {
            let mut known: HashMap<u64, Body> = bodies.list.drain(..).map(|body| (body.id, body)).collect();
            for actor in actors.iter() {
                let body = known.remove(&actor.id).filter(|body| body.is_of(actor));
                bodies.list.push(body.unwrap_or_else(|| Body::new(renderer, actor)));
            }
        }
        for (index, (actor, body)) in actors.iter().zip(&mut bodies.list).enumerate() {
            body.index = index as u32;
            body.world = actor.world;
            let fault = |e| match e {
                Error::Argument { what, message } => {
                    Error::Argument { what: format!("actors[{index}].{what}"), message }
                }
                other => other,
            };
            body.pose(&actor.pose).map_err(fault)?;
        }
        bodies.fit(renderer);
        Ok(())
    }
}

impl Bodies {
    /// Whether they are those of these actors.
    pub fn are_of(&self, actors: &[Actor]) -> bool {
        actors.len() == self.list.len() && actors.iter().zip(&self.list).all(|(actor, body)| body.is_of(actor))
    }

    pub fn crowd(&self) -> Option<&Crowd> {
        self.crowd.as_ref()
    }

    /// Fits maps and lists to the bodies.
    fn fit(&mut self, renderer: &Renderer) {
        let Self { list, shadow, crowd } = self;
        let gpu = renderer.gpu();
        let crowd = crowd.get_or_insert_with(|| Crowd::new(gpu));
        let fits: Vec<_> = list.iter().filter_map(|b| b.character.0.shadow.as_ref()).collect();
        let has_other_maps = ShadowMap::fit(shadow, gpu, &fits);
        let has_others = crowd.fit(gpu, list.len()) | has_other_maps;
        let layers = shadow.as_ref().map_or(0, ShadowMap::layers);
        let shadowed = list.iter_mut().filter(|b| b.character.0.shadow.is_some());
        shadowed.enumerate().for_each(|(i, b)| b.shadow_layer = (i < layers).then_some(i as u32));
        for body in list.iter_mut().filter(|b| has_others || b.groups.is_none()) {
            body.groups = Some(renderer.body_groups(crowd, body, shadow.as_ref()));
            if has_other_maps {
                // What was in its layer is gone.
                body.maps = Made::not_yet(());
            }
        }
        // The bodies themselves come first.
        let places: Vec<AffineRows> = list.iter().map(|b| b.world.into()).collect();
        let instance = |actor: u32, extra| Instance { world: places[actor as usize], actor, first_vertex: 0, extra };
        crowd.list.clear();
        crowd.list.extend((0..list.len() as u32).map(|i| instance(i, i)));
        let spheres: Vec<(Vec3, f32)> = list.iter().map(Body::sphere).collect();
        for i in 0..list.len() {
            let body = &mut list[i];
            let first = crowd.list.len() as u32;
            crowd.list.extend((1..=body.character.0.shells).map(|shell| instance(body.index, shell)));
            body.shells = first..crowd.list.len() as u32;
            body.casters.clear();
            if body.bangs.is_none() && body.shadow_layer.is_none() {
                continue;
            }
            let away = |o: usize| spheres[i].0.distance(spheres[o].0) - spheres[o].1;
            let mut near: Vec<usize> =
                (0..spheres.len()).filter(|o| *o != i && away(*o) < spheres[i].1 + REACH_M).collect();
            near.sort_by(|a, b| away(*a).total_cmp(&away(*b)));
            for o in near.into_iter().take(MOST_CASTING) {
                body.casters.push((o, crowd.list.len() as u32));
                crowd.list.push(instance(o as u32, i as u32));
            }
        }
    }

    /// Sends what has changed: poses, materials, and what depends on places and light.
    pub fn send(&mut self, gpu: &Gpu, uploads: &mut Uploads, encoder: &mut wgpu::CommandEncoder, to_light: Vec3) {
        let Self { list, shadow, crowd } = self;
        for body in list.iter_mut() {
            if body.sent.stale(body.revisions[0]).is_some() {
                let Scratch { last_joints, last_weights, .. } = &body.scratch;
                uploads.write(encoder, &body.deform.joints, 0, bytemuck::cast_slice(last_joints));
                uploads.write(encoder, &body.deform.weights, 0, bytemuck::cast_slice(last_weights));
            }
            body.edits.send(gpu, &body.character.0.looks, uploads, encoder);
        }
        let side = shadow.as_ref().map_or(1, ShadowMap::side);
        if let Some(crowd) = crowd {
            crowd.send(gpu, uploads, encoder, list.iter().map(|body| body.state(side, to_light)));
        }
    }

    /// What the maps of a body are made from.
    pub fn maps_key(&self, body: usize, to_light: Vec3, time_s: f32) -> MapsKey {
        let own = &self.list[body];
        let casting = || std::iter::once(own).chain(own.casters.iter().map(|(o, _)| &self.list[*o]));
        MapsKey {
            to_light,
            time_s: if casting().any(|b| b.character.0.cuts_move) {
                time_s
            } else {
                0.0
            },
            shadow_layer: own.shadow_layer,
            head: own.head,
            hips: own.hips,
            cast: casting().map(|b| (b.id, b.revisions, b.world)).collect(),
        }
    }
}

impl Body {
    fn new(renderer: &Renderer, actor: &Actor) -> Self {
        let data = &actor.character.0;
        Self {
            id: actor.id,
            index: 0,
            shells: 0..0,
            casters: Vec::new(),
            world: actor.world,
            deform: renderer.deform_buffers(&data.source),
            groups: None,
            bangs: data.bangs.as_ref().and_then(|fit| renderer.bangs_map(fit)),
            shadow_layer: None,
            head: Mat4::IDENTITY,
            hips: Mat4::IDENTITY,
            edits: Edits::default(),
            revisions: [0; 2],
            sent: Made::not_yet(()),
            deformed: Made::not_yet(()),
            maps: Made::not_yet(()),
            scratch: Scratch::default(),
            character: actor.character.clone(),
        }
    }

    fn is_of(&self, actor: &Actor) -> bool {
        self.id == actor.id && std::ptr::eq(&*self.character.0, &*actor.character.0)
    }

    /// What it is.
    pub fn data(&self) -> &CharacterData {
        &self.character.0
    }

    /// What is read of it in draws.
    pub fn edits(&self) -> &Edits {
        &self.edits
    }

    /// The same to change.
    pub fn edits_mut(&mut self) -> &mut Edits {
        // Maps of shadows show what is cut out.
        self.revisions[1] += 1;
        &mut self.edits
    }

    /// Layer of its shadow map.
    pub fn shadow_layer(&self) -> Option<u32> {
        self.shadow_layer
    }

    /// What its deformed vertices are made from.
    pub fn pose_revision(&self) -> u64 {
        self.revisions[0]
    }

    /// Instance of itself.
    pub fn instance(&self) -> Range<u32> {
        self.index..self.index + 1
    }

    /// Takes a pose.
    fn pose(&mut self, pose: &Pose) -> Result<()> {
        let CharacterData { scene, rig, looks, .. } = &*self.character.0;
        pose.check(scene)?;
        let Scratch { world, joints, weights, .. } = &mut self.scratch;
        scene.world_from_nodes_into(&pose.locals, world);
        let matrix = |node: usize| world.get(node).copied().unwrap_or(Mat4::IDENTITY);
        joints.clear();
        for palette in &rig.palettes {
            match palette {
                Palette::Rigid(node) => joints.push(matrix(*node).into()),
                Palette::Skin(skin) => {
                    joints.extend(skin.iter().map(|(node, bind)| AffineRows::from(matrix(*node) * *bind)))
                }
            }
        }
        weights.clear();
        for &(node, targets) in &rig.weights {
            let of_node = pose.morph_weights.get(node).map_or(&[] as &[f32], Vec::as_slice);
            weights.extend((0..targets).map(|t| of_node.get(t).copied().unwrap_or(0.0)));
        }
        let moved = |bone: Option<(usize, Mat4)>| bone.map_or(Mat4::IDENTITY, |(node, inverse)| matrix(node) * inverse);
        (self.head, self.hips) = (moved(rig.head), moved(rig.hips));
        let Scratch { joints, weights, last_joints, last_weights, .. } = &mut self.scratch;
        if joints != last_joints || weights != last_weights {
            last_joints.clone_from(joints);
            last_weights.clone_from(weights);
            self.revisions[0] += 1;
        }
        if self.edits.pose(looks, pose) {
            self.revisions[1] += 1;
        }
        Ok(())
    }

    /// A sphere round it in the world.
    fn sphere(&self) -> (Vec3, f32) {
        let (low, high) = self.character.0.rig.bounds.unwrap_or_default();
        let middle = self.world.transform_point3(self.hips.transform_point3((low + high) * 0.5));
        (middle, (high - low).length() * 0.5 * self.world.x_axis.truncate().length())
    }

    fn state(&self, shadow_side: u32, to_light: Vec3) -> ActorState<'_> {
        let data = self.data();
        let from_world = self.world.inverse();
        let shadow = data.shadow.as_ref().map_or_else(ShadowRows::default, |fit| {
            let middle = self.world.transform_point3(self.hips.transform_point3(fit.middle));
            fit.rows(shadow_side, middle, self.world.x_axis.truncate().length(), to_light)
        });
        ActorState {
            shadow_layer: self.shadow_layer,
            head: self.head,
            head_middle: data.rig.head_middle,
            bangs: self.bangs.as_ref(),
            through: data.scene.eyes_through,
            to_light: from_world.transform_vector3(to_light).normalize_or(Vec3::Z),
            from_world,
            shadow,
        }
    }

    /// Draws that are not blended.
    pub fn solid_draws(&self) -> impl Iterator<Item = (usize, &Draw)> {
        self.character.0.draws.iter().enumerate().filter(|(_, draw)| !draw.blend)
    }
}
