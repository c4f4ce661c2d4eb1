//! Time goes on for all actors.

use rayon::prelude::*;

use super::{Actor, Stage};
use crate::View;

/// So many actors are moved on all cores; fewer are done before other cores have woken.
const MANY: usize = 8;

/// Height in the picture, pixels, from which on an actor is moved in every frame, in every second, every third; smaller ones in
/// every fourth.
const HEIGHTS_PX: [f32; 3] = [160.0, 80.0, 40.0];
/// Height of a person, metres: what an actor is taken for.
const PERSON_M: f32 = 1.6;

impl Stage {
    /// Moves all actors on by a time, seconds ([`Actor::update`]), on all cores where there are many, and [`Stage::time_s`] with
    /// them. Those of [`Actor::every`] over 1 take turns.
    pub fn update(&mut self, dt: f32) {
        self.time_s += dt;
        self.frames = self.frames.wrapping_add(1);
        let frame = self.frames;
        let update = |actor: &mut Actor| {
            actor.waiting_s += dt;
            // By number, so that not all are due at once.
            if frame.wrapping_add(actor.id).is_multiple_of(u64::from(actor.every.max(1))) {
                let waiting = std::mem::take(&mut actor.waiting_s);
                actor.update(waiting);
            }
        };
        if self.actors.len() < MANY {
            self.actors.iter_mut().for_each(update);
        } else {
            self.actors.par_iter_mut().for_each(update);
        }
    }

    /// Sets [`Actor::every`] by how large each actor is in a picture: those that nobody would see move are moved less often.
    pub fn calm_far(&mut self, view: &View) {
        for actor in &mut self.actors {
            let height_m = PERSON_M * actor.world.y_axis.truncate().length();
            let height = view.px_per_m(std::iter::once(&actor.world)) * height_m;
            actor.every = HEIGHTS_PX.iter().filter(|least| height < **least).count() as u32 + 1;
        }
    }
}
