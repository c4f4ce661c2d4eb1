//! A stage: characters in places and poses of their own, and the light on them.

mod actor;
pub(crate) mod bodies;
pub(crate) mod body;
pub(crate) mod crowd;
mod ground;
pub(crate) mod maps;
pub(crate) mod past;
mod shadow;
pub(crate) mod troupe;
mod update;
mod volume;

pub use actor::Actor;
pub use ground::{Grid, Ground};
pub use shadow::StageShadow;

use glam::{Mat4, Vec3};

use crate::material::out_of_range;
use crate::render::Character;
use crate::scene::{Lights, Post};
use crate::{Error, Result};
use bodies::Bodies;

/// What is drawn: actors, and what falls on all of them. Plain data that an application changes as it likes between frames;
/// [`Renderer::prepare`](crate::Renderer::prepare) finds what has changed.
#[derive(Debug, Default)]
pub struct Stage {
    /// The actors.
    pub actors: Vec<Actor>,
    /// Light on all of them. Default: that of the first actor's scene, else [`Lights::default`].
    pub lights: Lights,
    /// Time of everything that is animated by time alone, seconds. Default: 0.
    pub time_s: f32,
    /// What is done to the whole picture. Default: what the first actor's scene says.
    pub post: Option<Post>,
    /// What they stand on. Default: nothing.
    pub ground: Option<Ground>,
    /// Where shadows matter most, world space: as many actors as there may be
    /// ([`MOST_SHADOWED`](crate::scene::MOST_SHADOWED)) have a shadow map of their own, those nearest to it first; the rest
    /// share one. Default: `None`, in their order.
    pub focus: Option<Vec3>,
    /// Draws what all actors cast into one map, for the shaders of a host. Default: false.
    pub casts_on_world: bool,
    /// How often it has been moved.
    frames: u64,
    pub(crate) bodies: Bodies,
}

impl Stage {
    /// A stage of these actors, under the light of the first one's scene.
    #[must_use]
    pub fn of(actors: impl IntoIterator<Item = Actor>) -> Self {
        let actors: Vec<Actor> = actors.into_iter().collect();
        let first = actors.first().map(|a| a.character.scene());
        Self {
            lights: first.and_then(|s| s.lights.clone()).unwrap_or_default(),
            post: first.and_then(|s| s.post),
            actors,
            ..Self::default()
        }
    }

    /// Refuses what cannot be drawn.
    pub(crate) fn check(&self) -> Result<()> {
        let fault = |what: String, message: String| Err(Error::Argument { what, message });
        for (i, actor) in self.actors.iter().enumerate() {
            if !actor.world.is_finite() || actor.world.determinant() == 0.0 {
                let message = "is not finite, or flat; expected a place in the world".to_owned();
                return fault(format!("actors[{i}].world"), message);
            }
            if !(0.0..=1.0).contains(&actor.key_light) {
                let message = format!("is {}; expected 0 to 1", actor.key_light);
                return fault(format!("actors[{i}].key_light"), message);
            }
            if let Some(j) = self.actors[..i].iter().position(|other| other.id == actor.id) {
                let message = format!("is the actor at {j}; an actor stands once on a stage, Actor::new makes another");
                return fault(format!("actors[{i}]"), message);
            }
        }
        if !self.time_s.is_finite() {
            return fault("time".to_owned(), format!("is {} s; expected a number", self.time_s));
        }
        if let Some((key, message)) = self.post.and_then(|mut post| out_of_range(&mut post)) {
            return fault(format!("post.{key}"), message);
        }
        self.ground.as_ref().map_or(Ok(()), Ground::check)?;
        self.lights.check()
    }

    /// Places of the actors.
    pub(crate) fn places(&self) -> impl Iterator<Item = &Mat4> {
        self.actors.iter().map(|a| &a.world)
    }

    /// Draw calls of a frame's colour pass with everything in view, outlines and coats of fluff included. Actors of one
    /// character are drawn together, but for blended materials of up to eight of them, for materials that an actor has changed,
    /// and for hair and eyes where heads come so near each other that eyes might be seen through another's hair; these last two
    /// are not counted.
    #[must_use]
    pub fn draw_count(&self) -> usize {
        let is_first = |i: usize| !self.actors[..i].iter().any(|a| a.character.is(&self.actors[i].character));
        let firsts = (0..self.actors.len()).filter(|i| is_first(*i)).map(|i| &self.actors[i].character);
        let of = |c: &Character| self.actors.iter().filter(|a| a.character.is(c)).count();
        firsts.map(|c| c.draw_count_of(of(c))).sum()
    }
}
