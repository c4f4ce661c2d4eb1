//! The bodies of a stage's actors together: their troupes, and the lists that draws and maps go by.

use std::collections::HashMap;

use glam::Vec3;
use rayon::prelude::*;

use super::body::{Body, FaceLight};
use super::crowd::Crowd;
use super::maps::{WorldMap, casting, world_rows};
use super::past::StagePast;
use super::troupe::Troupe;
use super::volume::{Sphere, Volume};
use super::{Actor, Ground, Stage};
use crate::render::Renderer;
use crate::render::numbers::ActorState;
use crate::render::pass::Mark;
use crate::render::pass::ground::GroundBody;
use crate::render::pass::shadow::{ShadowMap, ShadowRows};
use crate::render::skin_layers::{MOST_LAYERS, SkinLayers};
use crate::render::uploads::Uploads;
use crate::render::vertex::Instance;
use crate::scene::Lights;
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
    pub past: StagePast,
    pub skin: SkinLayers,
    pub(super) scratch: Scratch,
}

/// Lists that every frame fills anew, kept so that it allocates nothing.
#[derive(Debug, Default)]
pub(super) struct Scratch {
    pub(super) volumes: Vec<Volume>,
    /// By body, where it has them: what the shadow on its face may come through, its eyes, its hair, their number.
    pub(super) faces: Vec<Option<FaceLight>>,
    pub(super) eyes: Vec<Option<[Sphere; 2]>>,
    pub(super) numbers: Vec<u32>,
    pub(super) near: Vec<(f32, usize)>,
    pub(super) order: Vec<usize>,
}

/// So many actors are posed on all cores; fewer are done before other cores have woken.
const MANY: usize = 8;
/// Other actors that cast on one, at most.
const MOST_CASTING: usize = 16;

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
        self.fit_skin(gpu);
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

    /// Gives each actor layers for the light on its skin, as long as there are some.
    fn fit_skin(&mut self, gpu: &Gpu) {
        let mut used = 0;
        let mut lacks = false;
        for body in &mut self.list {
            let wanted = body.data().skin_layers.len() as u32;
            let fits = used + wanted <= MOST_LAYERS;
            lacks |= !fits;
            body.skin_layer = (wanted > 0 && fits).then_some(used);
            used += if fits { wanted } else { 0 };
        }
        self.skin.fit(gpu, used);
        if lacks && !self.skin.lacks {
            tracing::warn!(
                "texture-space skin has {MOST_LAYERS} layers; actors beyond these are lit without scattering"
            );
        }
        self.skin.lacks = lacks;
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

    /// Moves pupils towards what the light asks of them.
    pub fn adapt(&mut self, lights: &Lights, time_s: f32) {
        self.list.iter_mut().for_each(|body| body.adapt(lights, time_s));
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
}
