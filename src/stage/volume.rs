//! Shapes that say what may cast on what.

use glam::{Mat4, Vec3};

/// Something round, world space.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sphere {
    pub(super) middle: Vec3,
    pub(super) radius: f32,
}

/// A box that stands in any way, world space: half of its edges.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Volume {
    pub(super) middle: Vec3,
    pub(super) edges: [Vec3; 3],
}

/// How far towards the light something may stand and cast, beyond sizes, metres.
const REACH_M: f32 = 4.0;

impl Sphere {
    pub(super) fn meets(self, other: Self, window: f32) -> bool {
        self.middle.distance(other.middle) < self.radius + other.radius + window
    }

    /// Moved with an actor.
    pub(super) fn moved(self, by: &Mat4) -> Self {
        Self { middle: by.transform_point3(self.middle), radius: self.radius * by.x_axis.truncate().length() }
    }
}

impl Volume {
    /// A box of an actor's space in the world.
    pub(super) fn of(low: Vec3, high: Vec3, world: &Mat4) -> Self {
        let half = (high - low) * 0.5;
        let edge = |axis: Vec3| world.transform_vector3(axis);
        let edges = [edge(Vec3::X * half.x), edge(Vec3::Y * half.y), edge(Vec3::Z * half.z)];
        Self { middle: world.transform_point3((low + high) * 0.5), edges }
    }

    /// How far it reaches from its middle along a unit axis.
    pub(super) fn reach(&self, axis: Vec3) -> f32 {
        self.edges.iter().map(|edge| edge.dot(axis).abs()).sum()
    }

    pub(super) fn radius(&self) -> f32 {
        self.edges.iter().map(|edge| edge.length_squared()).sum::<f32>().sqrt()
    }

    /// Whether something may cast on it along a light: what stands towards that, within reach.
    pub(super) fn is_cast_on_by(&self, other: &Self, [right, up, to_light]: [Vec3; 3]) -> bool {
        let away = other.middle - self.middle;
        let meets = |axis: Vec3| away.dot(axis).abs() < self.reach(axis) + other.reach(axis);
        let (along, both) = (away.dot(to_light), self.reach(to_light) + other.reach(to_light));
        along > -both && along < both + REACH_M && meets(right) && meets(up)
    }
}
