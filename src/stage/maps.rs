//! Maps of shadows: who has one, and what each is made from.

use glam::{Mat4, Vec3};

use super::bodies::{Bodies, Scratch};
use super::body::Body;
use super::volume::Volume;
use crate::Gpu;
use crate::render::made::Made;
use crate::render::pass::shadow::{ShadowFit, ShadowMap, ShadowRows};
use crate::scene::{Lights, MOST_SHADOWED, SelfShadow};

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

/// What light on skin depends on, with the maps of shadows.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SkinKey {
    lights: Lights,
    /// Where it moves what surfaces show.
    time_s: f32,
    bodies: Vec<Cast>,
    /// Layers of skin and of shadows, and the share of the key light.
    layers: Vec<(Option<u32>, Option<u32>, f32)>,
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

impl Bodies {
    /// Who has a shadow map of its own, those nearest to `focus` first; whether there are other maps now.
    pub(super) fn fit_maps(&mut self, gpu: &Gpu, focus: Option<Vec3>, on_world: bool) -> bool {
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
        let side = order.iter().filter_map(|i| list[*i].data().shadow.as_ref()).map(ShadowFit::side).max();
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

    /// Whether light on skin was drawn from something else.
    pub fn stale_skin(&mut self, lights: &Lights, time_s: f32) -> bool {
        let moves = self.list.iter().any(|body| body.data().cuts_move);
        let bodies = self.list.iter().map(|&Body { id, revisions, world, head, hips, .. }| Cast {
            id,
            revisions,
            world,
            head,
            hips,
        });
        let key = SkinKey {
            lights: lights.clone(),
            time_s: if moves { time_s } else { 0.0 },
            bodies: bodies.collect(),
            layers: self.list.iter().map(|body| (body.skin_layer, body.shadow_layer, body.key_light)).collect(),
        };
        self.skin.drawn.stale(key).is_some()
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

/// Finds what casts on something of a body, the nearest first.
pub(super) fn casting(near: &mut Vec<(f32, usize)>, volumes: &[Volume], of: usize, on: Volume, to_light: Vec3) {
    near.clear();
    let right = to_light.any_orthonormal_vector();
    let axes = [right, to_light.cross(right), to_light];
    let others = volumes.iter().enumerate().filter(|(o, volume)| *o != of && on.is_cast_on_by(volume, axes));
    near.extend(others.map(|(o, volume)| (on.middle.distance(volume.middle) - volume.radius(), o)));
    near.sort_by(|a, b| a.0.total_cmp(&b.0));
}

/// The map that holds everybody.
pub(super) fn world_rows(list: &[Body], volumes: &[Volume], side: u32, to_light: Vec3) -> ShadowRows {
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
