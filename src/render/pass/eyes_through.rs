//! Eyes and brows over the hair that hangs before them, where the opaque pass marked both.

use super::{Drawing, Mark, Picture, surface_cull};
use crate::material::{AlphaMode, Material};
use crate::render::draw_list::{self, Pipelines};
use crate::render::gpu_scene::GpuScene;
use crate::render::material::Composition;
use crate::render::variants::{Drawn, Request};

/// What draws a material.
pub(crate) fn request(picture: &Picture<'_>, of: &Composition, material: &Material, colors: bool) -> Request {
    let recipe = of
        .recipe("eyes_through", colors, |_| true)
        .with("opacity", true)
        .with("alpha_mask", of.alpha == AlphaMode::Mask);
    let drawing = Drawing { cull: surface_cull(material), blend: true, write_depth: false, mark: Mark::Through };
    picture.request(recipe, drawing)
}

/// Draws every eye and brow once more; each sample takes the foremost of them.
pub(crate) fn encode(pass: &mut wgpu::RenderPass<'_>, scene: &GpuScene, shown: &[Pipelines<Drawn>]) {
    for &index in &scene.through_order {
        if let Some(through) = &shown[index].through {
            draw_list::record_marked(pass, scene, &scene.draws[index], through, Mark::Through);
        }
    }
}
