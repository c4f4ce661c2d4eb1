//! The shadow of a whole stage, for the shaders of a host.

use glam::{Mat4, Vec4};

use super::Stage;
use crate::Gpu;
use crate::render::pass::shadow::{self, ShadowRows};

/// What all actors of a stage cast from the key light, in one map: how a host's own ground and walls receive it.
///
/// Bind [`StageShadow::map`] (`texture_depth_2d_array`), a sampler of [`StageShadow::sampler`] (`sampler_comparison`) and the
/// [numbers](StageShadow::numbers) (uniform, the struct `StageShadow` of [`StageShadow::WGSL`]); then
/// `stage_shadow(numbers, map, map_sampler, position, normal)` is the share of the key light that arrives at a place of the
/// world.
#[derive(Clone, Copy, Debug)]
pub struct StageShadow<'a> {
    /// Depth from the light, 0 near to 1 far; the layer is the last of the numbers.
    pub map: &'a wgpu::TextureView,
    rows: ShadowRows,
}

impl StageShadow<'_> {
    /// The struct of the numbers, and the functions that read the map. It binds nothing.
    pub const WGSL: &'static str = include_str!("../../wgsl/lib/shadow.wgsl");

    /// The uniform: 64 bytes that change with actors and light.
    #[must_use]
    pub fn numbers(&self) -> [[f32; 4]; 4] {
        self.rows.numbers()
    }

    /// Place in the map of a point of the world: u, v downwards and depth, each 0..1. For hosts that read the map in their own
    /// way.
    #[must_use]
    pub fn map_from_world(&self) -> Mat4 {
        let ShadowRows { right, up, to_light, scale, middle, .. } = self.rows;
        let row = |axis: glam::Vec3| (axis * scale).extend(0.5 - axis.dot(middle) * scale);
        Mat4::from_cols(row(right), row(-up), row(-to_light), Vec4::W).transpose()
    }

    /// What compares depths of the map.
    #[must_use]
    pub fn sampler(gpu: &Gpu) -> wgpu::Sampler {
        shadow::sampler(gpu)
    }
}

impl Stage {
    /// The shadow of all actors as it was last prepared. `None` before that, and unless the stage has a
    /// [`ground`](Stage::ground), [`casts_on_world`](Stage::casts_on_world), or more actors than have maps of their own.
    #[must_use]
    pub fn shadow(&self) -> Option<StageShadow<'_>> {
        let rows = self.bodies.world_map.rows;
        rows.layer?;
        Some(StageShadow { map: &self.bodies.shadow.as_ref()?.view, rows })
    }
}
