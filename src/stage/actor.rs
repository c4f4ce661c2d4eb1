//! One character on a stage.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::{Mat4, Quat, Vec3};

use crate::material::Material;
use crate::motion::{Animator, Pose};
use crate::render::Character;

/// A character on a stage, in a place and a pose of its own.
#[derive(Debug)]
pub struct Actor {
    /// What it is.
    pub character: Character,
    /// `world_from_character`: rotates, moves and scales evenly. Default: identity; characters face +Z.
    pub world: Mat4,
    /// How it is posed. Default: rest. [`Actor::update`] writes it anew.
    pub pose: Pose,
    /// What moves it. Default: nothing but springs.
    pub animator: Animator,
    /// Frames for each of which [`Stage::update`](crate::Stage::update) moves it once, by the time of all of them: 2 for every
    /// second one. Range 1... Default: 1.
    pub every: u32,
    /// Materials that it has otherwise than its character, by index ([`Actor::edit`]): colours and numbers of sections, amounts
    /// of fading or dissolving. Expressions shift these in turn. What was settled at the upload stays: sections that were off,
    /// options, textures ([`Renderer::replace_base_texture`](crate::Renderer::replace_base_texture)), alpha mode. Default: none.
    pub materials: BTreeMap<usize, Material>,
    /// Share of the key light that arrives at it, as a host finds it with shadows of its own. Received like any other shadow:
    /// by materials with a [`CastShadow`](crate::material::CastShadow). Range 0..1. Default: 1.
    pub key_light: f32,
    /// What tells it from others of its character.
    pub(crate) id: u64,
    /// Time that has passed since it was moved last, seconds.
    pub(super) waiting_s: f32,
}

static NEXT: AtomicU64 = AtomicU64::new(0);

impl Actor {
    /// A character at rest, at the origin.
    #[must_use]
    pub fn new(character: &Character) -> Self {
        let pose = Pose::rest(character.scene());
        let id = NEXT.fetch_add(1, Ordering::Relaxed);
        Self {
            character: character.clone(),
            world: Mat4::IDENTITY,
            pose,
            animator: Animator::default(),
            every: 1,
            materials: BTreeMap::new(),
            key_light: 1.0,
            id,
            waiting_s: 0.0,
        }
    }

    /// The same at a place, metres, turned about the vertical axis: positive towards its left.
    #[must_use]
    pub fn at(mut self, position: impl Into<Vec3>, yaw_rad: f32) -> Self {
        self.world = Mat4::from_rotation_translation(Quat::from_rotation_y(yaw_rad), position.into());
        self
    }

    /// A material to change, a copy of its character's at first; `None` where there is no such index.
    pub fn edit(&mut self, material: usize) -> Option<&mut Material> {
        let source = self.character.scene().materials.get(material)?;
        Some(self.materials.entry(material).or_insert_with(|| source.clone()))
    }

    /// The same in a pose, which its clips begin from.
    #[must_use]
    pub fn posed(mut self, pose: Pose) -> Self {
        self.animator.base = Some(pose.clone());
        self.pose = pose;
        self
    }

    /// Moves it on by a time, seconds: clips, gaze, blinking, expressions, constraints, springs, in this order
    /// ([`Animator::update`]). Writes [`Actor::pose`], and moves [`Actor::world`] by clips whose way is the actor's.
    pub fn update(&mut self, dt: f32) {
        let Self { character, animator, world, pose, .. } = self;
        animator.update(character.skeleton(), world, pose, dt);
    }

    /// Puts it elsewhere, its hair and clothes with it: setting [`Actor::world`] alone would throw them through the room.
    pub fn jump_to(&mut self, world: Mat4) {
        self.animator.warp(self.character.skeleton(), &self.world, &world);
        self.world = world;
    }
}
