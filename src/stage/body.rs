//! The bodies of a stage's actors: pose, place, and what of their materials has changed; and what their maps are made from.

use std::collections::HashMap;

use glam::{Mat4, Vec3};
use rayon::prelude::*;

use super::crowd::Crowd;
use super::troupe::Troupe;
use super::{Actor, Ground, Stage};
use crate::render::looks::Edits;
use crate::render::made::Made;
use crate::render::numbers::ActorState;
use crate::render::pass::Mark;
use crate::render::pass::ground::GroundBody;
use crate::render::pass::shadow::{ShadowFit, ShadowMap, ShadowRows};
use crate::render::shaders::Shaders;
use crate::render::uploads::Uploads;
use crate::render::vertex::{AffineRows, Instance};
use crate::render::{Character, CharacterData, Renderer};
use crate::scene::{MOST_SHADOWED, SelfShadow};
use crate::{Error, Gpu, Result};

/// Bodies of all actors, in their order.
#[derive(Debug, Default)]
pub(crate) struct Bodies {
    pub list: Vec<Body>,
    pub troupes: Vec<Troupe>,
    pub shadow: Option<ShadowMap>,
    /// What the map of the whole stage is made from, and where it stands.
    pub world_map: WorldMap,
    pub crowd: Option<Crowd>,
    pub ground: Option<GroundBody>,
    scratch: Scratch,
}

/// The body of one actor.
#[derive(Debug)]
pub(crate) struct Body {
    /// That of its actor.
    id: u64,
    pub character: Character,
    /// Its troupe, and its slot there.
    pub troupe: usize,
    slot: u32,
    /// What stands for itself.
    pub instance: u32,
    /// What stands for itself and for others that cast on it, in its own shadow map: their troupes and instances.
    pub casters: Vec<(usize, u32)>,
    /// The same of others that cast on its face.
    pub face_casters: Vec<(usize, u32)>,
    pub world: Mat4,
    /// Share of the key light that arrives.
    key_light: f32,
    /// Least and greatest corner in its pose, character space; and what that is in the world.
    bounds: (Vec3, Vec3),
    volume: Volume,
    shadow_layer: Option<u32>,
    /// Moves the head from its rest to the pose, and the hips.
    head: Mat4,
    hips: Mat4,
    edits: Edits,
    /// How often the pose, and what is cut out of materials, have become others; no pose has been taken at first.
    revisions: [u64; 2],
    pub maps: Made<MapsKey, ()>,
    /// Matrices of its nodes, character space; its joints and the weights of its morphs.
    nodes: Vec<Mat4>,
    joints: Vec<AffineRows>,
    weights: Vec<f32>,
    /// Whether its troupe has not seen these.
    has_moved: bool,
}

/// The shadow map of the whole stage.
#[derive(Debug)]
pub(crate) struct WorldMap {
    pub layer: Option<u32>,
    pub rows: ShadowRows,
    /// What stands for those who cast, by troupe.
    pub made: Made<MapsKey, ()>,
}

impl Default for WorldMap {
    fn default() -> Self {
        Self { layer: None, rows: ShadowRows::default(), made: Made::not_yet(()) }
    }
}

/// What maps of shadows depend on.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct MapsKey {
    to_light: Vec3,
    /// Where it moves what is cut out.
    time_s: f32,
    shadow_layer: Option<u32>,
    /// Of what receives, then of what casts.
    cast: Vec<Cast>,
}

/// How something casts, and the frames in which maps stand: bones may move that no vertex follows.
#[derive(Clone, Debug, PartialEq)]
struct Cast {
    id: u64,
    revisions: [u64; 2],
    world: Mat4,
    head: Mat4,
    hips: Mat4,
}

/// Lists that every frame fills anew, kept so that it allocates nothing.
#[derive(Debug, Default)]
struct Scratch {
    volumes: Vec<Volume>,
    /// By body, where it has them: what the shadow on its face may come through, its eyes, its hair, their number.
    faces: Vec<Option<FaceLight>>,
    eyes: Vec<Option<[Sphere; 2]>>,
    numbers: Vec<u32>,
    near: Vec<(f32, usize)>,
    order: Vec<usize>,
}

/// Something round, world space.
#[derive(Clone, Copy, Debug, Default)]
struct Sphere {
    middle: Vec3,
    radius: f32,
}

/// A box that stands in any way, world space: half of its edges.
#[derive(Clone, Copy, Debug, Default)]
struct Volume {
    middle: Vec3,
    edges: [Vec3; 3],
}

/// Where the light of the shadow on a face comes from: along a column.
#[derive(Clone, Copy, Debug)]
struct FaceLight {
    head: Volume,
    to_light: Vec3,
}

/// So many actors are posed on all cores; fewer are done before other cores have woken.
const MANY: usize = 8;
/// Other actors that cast on one, at most.
const MOST_CASTING: usize = 16;
/// How far towards the light something may stand and cast, beyond sizes, metres.
const REACH_M: f32 = 4.0;

impl Sphere {
    fn meets(self, other: Self, window: f32) -> bool {
        self.middle.distance(other.middle) < self.radius + other.radius + window
    }

    /// Moved with an actor.
    fn moved(self, by: &Mat4) -> Self {
        Self { middle: by.transform_point3(self.middle), radius: self.radius * by.x_axis.truncate().length() }
    }
}

impl Volume {
    /// A box of an actor's space in the world.
    fn of(low: Vec3, high: Vec3, world: &Mat4) -> Self {
        let half = (high - low) * 0.5;
        let edge = |axis: Vec3| world.transform_vector3(axis);
        let edges = [edge(Vec3::X * half.x), edge(Vec3::Y * half.y), edge(Vec3::Z * half.z)];
        Self { middle: world.transform_point3((low + high) * 0.5), edges }
    }

    /// How far it reaches from its middle along a unit axis.
    fn reach(&self, axis: Vec3) -> f32 {
        self.edges.iter().map(|edge| edge.dot(axis).abs()).sum()
    }

    fn radius(&self) -> f32 {
        self.edges.iter().map(|edge| edge.length_squared()).sum::<f32>().sqrt()
    }

    /// Whether something may cast on it along a light: what stands towards that, within reach.
    fn is_cast_on_by(&self, other: &Self, [right, up, to_light]: [Vec3; 3]) -> bool {
        let away = other.middle - self.middle;
        let meets = |axis: Vec3| away.dot(axis).abs() < self.reach(axis) + other.reach(axis);
        let (along, both) = (away.dot(to_light), self.reach(to_light) + other.reach(to_light));
        along > -both && along < both + REACH_M && meets(right) && meets(up)
    }
}

impl Stage {
    /// Makes the bodies those of the actors: new ones, vanished ones, poses, places, lists.
    pub(crate) fn embody(&mut self, renderer: &Renderer) -> Result<()> {
        self.check()?;
        let Self { actors, bodies, lights, .. } = self;
        for (i, actor) in actors.iter().enumerate() {
            renderer.owns(&actor.character, i)?;
        }
        if !bodies.are_of(actors) {
            bodies.arrange(renderer, actors);
        }
        let has_others = bodies.troupes.iter_mut().fold(false, |has, troupe| troupe.fit(renderer) | has);
        let Bodies { list, troupes, .. } = bodies;
        let shaders = &renderer.variants.shaders;
        let pose = |(index, (actor, body)): (usize, (&Actor, &mut Body))| match body.pose(shaders, actor).err()? {
            Error::Argument { what, message } => {
                Some(Error::Argument { what: format!("actors[{index}].{what}"), message })
            }
            other => Some(other),
        };
        let fault = if actors.len() < MANY {
            actors.iter().zip(&mut *list).enumerate().find_map(pose)
        } else {
            actors.par_iter().zip(&mut *list).enumerate().filter_map(pose).find_first(|_| true)
        };
        if let Some(fault) = fault {
            return Err(fault);
        }
        for body in list.iter_mut().filter(|body| body.has_moved) {
            troupes[body.troupe].pose(body.slot, &body.joints, &body.weights);
            body.has_moved = false;
        }
        let to_light = lights.directional.to_light.normalize_or(Vec3::Z);
        let on_world = self.casts_on_world || self.ground.is_some();
        let has_other_maps = bodies.fit(renderer, has_others, to_light, self.focus, on_world);
        match &self.ground {
            Some(ground) => {
                let map = renderer.shadow_view(bodies.shadow.as_ref());
                renderer.ground().embody(renderer.gpu(), &mut bodies.ground, ground, map, has_other_maps)
            }
            None => {
                bodies.ground = None;
                Ok(())
            }
        }
    }
}

impl Bodies {
    /// Whether they are those of these actors.
    pub fn are_of(&self, actors: &[Actor]) -> bool {
        actors.len() == self.list.len() && actors.iter().zip(&self.list).all(|(actor, body)| body.is_of(actor))
    }

    /// A body for each actor, with a slot in a troupe; those that are here keep theirs.
    fn arrange(&mut self, renderer: &Renderer, actors: &[Actor]) {
        let Self { list, troupes, .. } = self;
        let mut known: HashMap<u64, Body> = list.drain(..).map(|body| (body.id, body)).collect();
        let kept: Vec<Option<Body>> = actors.iter().map(|a| known.remove(&a.id).filter(|body| body.is_of(a))).collect();
        let stay: Vec<(usize, u32)> = kept.iter().flatten().map(|b| (b.troupe, b.slot)).collect();
        for (t, troupe) in troupes.iter_mut().enumerate() {
            troupe.keep_slots(|slot| stay.contains(&(t, slot)));
        }
        for (actor, kept) in actors.iter().zip(kept) {
            let body = kept.unwrap_or_else(|| {
                let found = troupes
                    .iter_mut()
                    .enumerate()
                    .filter(|(_, troupe)| troupe.character.is(&actor.character))
                    .find_map(|(t, troupe)| Some((t, troupe.take_slot()?)));
                let (troupe, slot) = found.unwrap_or_else(|| {
                    let mut troupe = Troupe::new(renderer, &actor.character);
                    let slot = troupe.take_slot().unwrap_or_default();
                    troupes.push(troupe);
                    (troupes.len() - 1, slot)
                });
                Body::new(actor, troupe, slot)
            });
            list.push(body);
        }
        // Troupes that everybody has left go.
        let mut count = 0;
        let places: Vec<usize> = troupes
            .iter()
            .map(|troupe| {
                let place = count;
                count += usize::from(!troupe.is_empty());
                place
            })
            .collect();
        troupes.retain(|troupe| !troupe.is_empty());
        list.iter_mut().for_each(|body| body.troupe = places[body.troupe]);
    }

    /// Fits maps and lists to the bodies; whether there are other maps now.
    fn fit(
        &mut self,
        renderer: &Renderer,
        has_others: bool,
        to_light: Vec3,
        focus: Option<Vec3>,
        on_world: bool,
    ) -> bool {
        let gpu = renderer.gpu();
        let Self { list, scratch, .. } = self;
        scratch.volumes.clear();
        scratch.volumes.extend(list.iter().map(|body| body.volume));
        scratch.eyes.clear();
        scratch.eyes.extend(list.iter().map(Body::eyes_and_hair));
        scratch.faces.clear();
        scratch.faces.extend(list.iter().map(|body| body.face_light(to_light)));
        let has_other_maps = self.fit_maps(gpu, focus, on_world);
        let Self { list, troupes, shadow, crowd, .. } = self;
        let crowd = crowd.get_or_insert_with(|| Crowd::new(gpu));
        // The stage itself comes last.
        let has_others = crowd.fit(gpu, list.len() + 1) | has_other_maps | has_others;
        for troupe in troupes.iter_mut().filter(|t| has_others || t.groups.is_none()) {
            troupe.groups = Some(renderer.troupe_groups(crowd, troupe, shadow.as_ref()));
        }
        self.number_eyes();
        self.fill_lists(to_light);
        has_other_maps
    }

    /// Who has a shadow map of its own, those nearest to `focus` first; whether there are other maps now.
    fn fit_maps(&mut self, gpu: &Gpu, focus: Option<Vec3>, on_world: bool) -> bool {
        let Self { list, shadow, world_map, scratch, .. } = self;
        let Scratch { order, volumes, .. } = scratch;
        order.clear();
        order.extend((0..list.len()).filter(|i| list[*i].data().shadow.is_some()));
        if let Some(focus) = focus {
            order.sort_by(|a, b| {
                let away = |i: &usize| volumes[*i].middle.distance_squared(focus);
                away(a).total_cmp(&away(b))
            });
        }
        let own = order.len().min(MOST_SHADOWED as usize);
        let has_world = on_world || order.len() > own;
        let side = order.iter().filter_map(|i| list[*i].data().shadow.as_ref()).map(|f| f.settings.side).max();
        let side = side.unwrap_or(SelfShadow::default().side);
        let wanted = own as u32 + u32::from(has_world);
        let has_others = wanted > 0 && ShadowMap::fit(shadow, gpu, side, wanted);
        let mut free = [true; MOST_SHADOWED as usize];
        for (i, body) in list.iter_mut().enumerate() {
            // Whoever keeps a map keeps its layer.
            body.shadow_layer = body.shadow_layer.filter(|l| (*l as usize) < own && order[..own].contains(&i));
            body.shadow_layer.into_iter().for_each(|l| free[l as usize] = false);
        }
        for i in &order[..own] {
            let next = free.iter().position(|f| *f).unwrap_or_default();
            let layer = list[*i].shadow_layer.get_or_insert(next as u32);
            free[*layer as usize] = false;
        }
        world_map.layer = shadow.as_ref().filter(|_| has_world).map(|s| s.layers() as u32 - 1);
        if has_others {
            // What was in the layers is gone.
            list.iter_mut().for_each(|body| body.maps = Made::not_yet(()));
            world_map.made = Made::not_yet(());
        }
        has_others
    }

    /// Gives those a number each whose eyes might be seen through the hair of another, and others the same one.
    fn number_eyes(&mut self) {
        let Self { list, scratch: Scratch { eyes, numbers, .. }, .. } = self;
        numbers.clear();
        for i in 0..list.len() {
            let mut taken = 0u64;
            if let Some([own_eyes, own_hair]) = eyes[i] {
                let window = |b: usize| list[b].data().scene.eyes_through.map_or(0.0, |t| t.window_m);
                for j in 0..i {
                    let Some([other_eyes, other_hair]) = eyes[j] else { continue };
                    if own_eyes.meets(other_hair, window(i)) || other_eyes.meets(own_hair, window(j)) {
                        taken |= 1 << numbers[j];
                    }
                }
            }
            let free = taken.trailing_ones();
            numbers.push(if free < Mark::NUMBERS {
                free
            } else {
                i as u32 % Mark::NUMBERS
            });
        }
    }

    /// What stands for what in draws: actors by troupe, shells of coats, and what casts where.
    fn fill_lists(&mut self, to_light: Vec3) {
        let Self { list, troupes, crowd: Some(crowd), world_map, scratch, .. } = self else { return };
        let Scratch { volumes, faces, numbers, near, order, .. } = scratch;
        let entries = &mut crowd.list;
        entries.clear();
        let instance = |body: &Body, actor: usize, extra: usize| Instance {
            world: body.world.into(),
            actor: actor as u32,
            first_vertex: body.slot * body.data().source.vertices(),
            extra: extra as u32,
        };
        for (t, troupe) in troupes.iter_mut().enumerate() {
            order.clear();
            order.extend((0..list.len()).filter(|i| list[*i].troupe == t));
            order.sort_by_key(|i| numbers[*i]);
            let first = entries.len() as u32;
            troupe.numbered.clear();
            for &i in &*order {
                let at = entries.len() as u32;
                entries.push(instance(&list[i], i, i));
                list[i].instance = at;
                match troupe.numbered.last_mut() {
                    Some((number, range)) if *number == numbers[i] => range.end = at + 1,
                    _ => troupe.numbered.push((numbers[i], at..at + 1)),
                }
            }
            troupe.instances = first..entries.len() as u32;
            let first = entries.len() as u32;
            for shell in 1..=troupe.data().shells {
                entries.extend(order.iter().map(|i| instance(&list[*i], *i, shell as usize)));
            }
            troupe.shells = first..entries.len() as u32;
            let first = entries.len() as u32;
            if world_map.layer.is_some() {
                entries.extend(order.iter().map(|i| instance(&list[*i], *i, list.len())));
            }
            troupe.on_world = first..entries.len() as u32;
        }
        for i in 0..list.len() {
            list[i].casters.clear();
            list[i].face_casters.clear();
            if list[i].shadow_layer.is_some() {
                let own = (list[i].troupe, entries.len() as u32);
                list[i].casters.push(own);
                entries.push(instance(&list[i], i, i));
                casting(near, volumes, i, volumes[i], to_light);
                for &(_, o) in near.iter().take(MOST_CASTING) {
                    let caster = (list[o].troupe, entries.len() as u32);
                    list[i].casters.push(caster);
                    entries.push(instance(&list[o], o, i));
                }
            }
            if let Some(face) = faces[i] {
                casting(near, volumes, i, face.head, face.to_light);
                for &(_, o) in near.iter().take(MOST_CASTING) {
                    let caster = (list[o].troupe, entries.len() as u32);
                    list[i].face_casters.push(caster);
                    entries.push(instance(&list[o], o, i));
                }
            }
        }
        world_map.rows = ShadowRows::default();
        if let Some(layer) = world_map.layer
            && let Some(shadow) = &self.shadow
        {
            world_map.rows = world_rows(list, volumes, shadow.side(), to_light);
            world_map.rows.layer = Some(layer);
        }
    }

    /// Sends what has changed: poses, materials, and what depends on places and light.
    pub fn send(
        &mut self,
        gpu: &Gpu,
        uploads: &mut Uploads,
        encoder: &mut wgpu::CommandEncoder,
        to_light: Vec3,
        ground: Option<&Ground>,
    ) {
        let Self { list, troupes, shadow, world_map, crowd, ground: body, .. } = self;
        if let (Some(ground), Some(body)) = (ground, body) {
            body.send(uploads, encoder, ground, &world_map.rows);
        }
        for troupe in troupes.iter_mut() {
            troupe.send(uploads, encoder);
        }
        for body in list.iter_mut() {
            body.edits.send(gpu, &body.character.0.looks, uploads, encoder);
        }
        let side = shadow.as_ref().map_or(1, ShadowMap::side);
        if let Some(crowd) = crowd {
            let states = list.iter().map(|body| body.state(troupes, side, to_light, world_map.rows));
            let of_stage = ActorState::of_stage(world_map.rows);
            crowd.send(gpu, uploads, encoder, states.chain([of_stage]));
        }
    }

    /// Bodies and troupes whose maps were made from something else.
    pub fn stale_maps(&mut self, to_light: Vec3, time_s: f32) -> StaleMaps {
        let Self { list, troupes, world_map, crowd, .. } = self;
        let mut stale = StaleMaps::default();
        let Some(crowd) = crowd else { return stale };
        let actor = |at: u32| crowd.list[at as usize].actor as usize;
        let key = |shadow_layer, bodies: &mut dyn Iterator<Item = usize>, list: &[Body]| {
            let mut key = MapsKey { to_light, time_s: 0.0, shadow_layer, cast: Vec::new() };
            for body in bodies.map(|i| &list[i]) {
                if body.data().cuts_move {
                    key.time_s = time_s;
                }
                let Body { id, revisions, world, head, hips, .. } = *body;
                key.cast.push(Cast { id, revisions, world, head, hips });
            }
            key
        };
        for i in 0..list.len() {
            let Some(layer) = list[i].shadow_layer else { continue };
            let key = key(Some(layer), &mut list[i].casters.iter().map(|(_, at)| actor(*at)), list);
            if list[i].maps.stale(key).is_some() {
                stale.shadows.push(i);
            }
        }
        for (t, troupe) in troupes.iter_mut().enumerate() {
            if troupe.bangs.is_none() {
                continue;
            }
            let own = troupe.instances.clone().map(actor);
            let of = own.clone().flat_map(|i| list[i].face_casters.iter().map(|(_, at)| actor(*at)));
            let key = key(None, &mut own.chain(of), list);
            if troupe.maps.stale(key).is_some() {
                stale.faces.push(t);
            }
        }
        if world_map.layer.is_some() {
            let key = key(world_map.layer, &mut (0..list.len()), list);
            stale.world = world_map.made.stale(key).is_some();
        }
        stale
    }
}

/// Maps that must be drawn.
#[derive(Debug, Default)]
pub(crate) struct StaleMaps {
    /// Bodies with shadow maps of their own.
    pub shadows: Vec<usize>,
    /// Troupes with shadows on faces.
    pub faces: Vec<usize>,
    /// That of the whole stage.
    pub world: bool,
}

/// Finds what casts on something of a body, the nearest first.
fn casting(near: &mut Vec<(f32, usize)>, volumes: &[Volume], of: usize, on: Volume, to_light: Vec3) {
    near.clear();
    let right = to_light.any_orthonormal_vector();
    let axes = [right, to_light.cross(right), to_light];
    let others = volumes.iter().enumerate().filter(|(o, volume)| *o != of && on.is_cast_on_by(volume, axes));
    near.extend(others.map(|(o, volume)| (on.middle.distance(volume.middle) - volume.radius(), o)));
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
}

/// A box round spheres that joints have moved; morphs do not count.
fn bounds(moved: &[Option<(Vec3, f32)>], joints: &[AffineRows]) -> (Vec3, Vec3) {
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for (joint, (middle, radius)) in joints.iter().zip(moved).filter_map(|(j, m)| Some((j, (*m)?))) {
        let middle = joint.transform_point(middle);
        let radius = radius * joint.scale();
        (low, high) = (low.min(middle - radius), high.max(middle + radius));
    }
    if low.cmple(high).all() {
        (low, high)
    } else {
        (Vec3::ZERO, Vec3::ZERO)
    }
}

/// The map that holds everybody.
fn world_rows(list: &[Body], volumes: &[Volume], side: u32, to_light: Vec3) -> ShadowRows {
    let there = || volumes.iter().filter(|v| v.radius() > 0.0);
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for volume in there() {
        let reach = Vec3::new(volume.reach(Vec3::X), volume.reach(Vec3::Y), volume.reach(Vec3::Z));
        (low, high) = (low.min(volume.middle - reach), high.max(volume.middle + reach));
    }
    if !low.cmple(high).all() {
        return ShadowRows::default();
    }
    let middle = (low + high) * 0.5;
    let radius = there().map(|v| middle.distance(v.middle) + v.radius()).fold(0.0, f32::max);
    let settings = list.iter().find_map(|b| Some(b.data().shadow.as_ref()?.settings)).unwrap_or_default();
    ShadowFit { settings, middle, radius }.rows(side, middle, 1.0, to_light)
}

impl Body {
    fn new(actor: &Actor, troupe: usize, slot: u32) -> Self {
        Self {
            id: actor.id,
            character: actor.character.clone(),
            troupe,
            slot,
            instance: 0,
            casters: Vec::new(),
            face_casters: Vec::new(),
            world: actor.world,
            key_light: actor.key_light,
            bounds: (Vec3::ZERO, Vec3::ZERO),
            volume: Volume::default(),
            shadow_layer: None,
            head: Mat4::IDENTITY,
            hips: Mat4::IDENTITY,
            edits: Edits::default(),
            revisions: [0; 2],
            maps: Made::not_yet(()),
            nodes: Vec::new(),
            joints: Vec::new(),
            weights: Vec::new(),
            has_moved: false,
        }
    }

    fn is_of(&self, actor: &Actor) -> bool {
        self.id == actor.id && self.character.is(&actor.character)
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

    /// Its middle in the world.
    pub fn middle(&self) -> Vec3 {
        self.volume.middle
    }

    /// Its slot in its troupe.
    pub fn slot(&self) -> u32 {
        self.slot
    }

    /// Layer of its own shadow map.
    pub fn shadow_layer(&self) -> Option<u32> {
        self.shadow_layer
    }

    /// Takes place and pose of an actor.
    fn pose(&mut self, shaders: &Shaders, actor: &Actor) -> Result<()> {
        let CharacterData { scene, rig, looks, .. } = &*self.character.0;
        let pose = &actor.pose;
        pose.check(scene)?;
        scene.world_from_nodes_into(&pose.locals, &mut self.nodes);
        if let Some(at) = self.nodes.iter().position(|node| !node.is_finite()) {
            // Parents stand before their children: it is the first one's own fault.
            let what = format!("pose.locals[{at}] {:?}", scene.nodes[at].name);
            return Err(Error::Argument { what, message: "is not finite".to_owned() });
        }
        self.world = actor.world;
        self.key_light = actor.key_light;
        let matrix = |node: usize| self.nodes.get(node).copied().unwrap_or(Mat4::IDENTITY);
        let moved = |bone: Option<(usize, Mat4)>| bone.map_or(Mat4::IDENTITY, |(node, inverse)| matrix(node) * inverse);
        (self.head, self.hips) = (moved(rig.head), moved(rig.hips));
        // Each is compared as it is written.
        let mut is_other = self.revisions[0] == 0;
        let joints = rig.palettes.iter().flat_map(|palette| palette.joints());
        self.joints.resize(self.character.0.source.joint_count(), AffineRows::default());
        for (last, (node, bind)) in self.joints.iter_mut().zip(joints) {
            let joint = AffineRows::from(bind.map_or_else(|| matrix(node), |bind| matrix(node) * bind));
            is_other |= *last != joint;
            *last = joint;
        }
        self.weights.resize(self.character.0.source.weight_count(), 0.0);
        let mut at = 0;
        for &(node, targets) in &rig.weights {
            let of_node = pose.morph_weights.get(node).map_or(&[] as &[f32], Vec::as_slice);
            for target in 0..targets {
                let weight = of_node.get(target).copied().unwrap_or(0.0);
                is_other |= self.weights[at] != weight;
                self.weights[at] = weight;
                at += 1;
            }
        }
        if is_other {
            self.revisions[0] += 1;
            self.has_moved = true;
            self.bounds = bounds(&rig.moved, &self.joints);
        }
        let (low, high) = self.bounds;
        self.volume = Volume::of(low, high, &self.world);
        if self.edits.take(shaders, looks, actor)? {
            self.revisions[1] += 1;
        }
        Ok(())
    }

    /// Spheres round its eyes and its hair in the world, where the ones are seen through the other.
    fn eyes_and_hair(&self) -> Option<[Sphere; 2]> {
        let spheres = self.data().rig.eyes_and_hair?;
        Some(
            spheres.map(|(middle, radius)| {
                Sphere { middle: self.head.transform_point3(middle), radius }.moved(&self.world)
            }),
        )
    }

    /// Where the light of the shadow on its face comes from.
    fn face_light(&self, to_light: Vec3) -> Option<FaceLight> {
        let fit = self.data().bangs.as_ref()?;
        let of_character = self.world.inverse().transform_vector3(to_light).normalize_or(Vec3::Z);
        let direction = fit.light_direction(self.head, of_character);
        // The map may be turned about the light.
        let half = Vec3::splat(fit.half * std::f32::consts::SQRT_2);
        let middle = self.head.transform_point3(fit.middle);
        let to_light = self.world.transform_vector3(direction).normalize_or(to_light);
        Some(FaceLight { head: Volume::of(middle - half, middle + half, &self.world), to_light })
    }

    fn state<'a>(
        &'a self,
        troupes: &'a [Troupe],
        shadow_side: u32,
        to_light: Vec3,
        of_world: ShadowRows,
    ) -> ActorState<'a> {
        let data = self.data();
        let from_world = self.world.inverse();
        let own = |layer: u32| {
            let fit = data.shadow.as_ref()?;
            let middle = self.world.transform_point3(self.hips.transform_point3(fit.middle));
            let rows = fit.rows(shadow_side, middle, self.world.x_axis.truncate().length(), to_light);
            Some(ShadowRows { layer: Some(layer), ..rows })
        };
        ActorState {
            head: self.head,
            head_middle: data.rig.head_middle,
            bangs: data.bangs.as_ref(),
            tile: troupes[self.troupe].bangs.as_ref().map(|atlas| atlas.place(self.slot)).unwrap_or_default(),
            through: data.scene.eyes_through,
            to_light: from_world.transform_vector3(to_light).normalize_or(Vec3::Z),
            from_world,
            shadow: self.shadow_layer.and_then(own).unwrap_or(of_world),
            key_light: self.key_light,
        }
    }
}
