//! Blended surfaces with their outlines, far before near.

use super::{Drawing, Mark, Picture, surface_cull};
use crate::material::Material;
use crate::render::draw_list::{self, Pipelines};
use crate::render::gpu_scene::GpuScene;
use crate::render::material::Composition;
use crate::render::variants::{Drawn, Request};

/// What draws a material.
pub(crate) fn request(picture: &Picture<'_>, of: &Composition, material: &Material, colors: bool) -> Request {
    // What is blended fades by its alpha.
    let recipe = of.recipe("transparent", colors, |_| true).with("dither_samples", true);
    let write_depth = material.alpha.write_depth;
    picture.request(recipe, Drawing { cull: surface_cull(material), blend: true, write_depth, mark: Mark::None })
}

/// Draws each surface, then its outline; `scene.transparent_order` is sorted for the view.
pub(crate) fn encode(pass: &mut wgpu::RenderPass<'_>, scene: &GpuScene, shown: &[Pipelines<Drawn>]) {
    for (draw, pipelines) in scene.transparent_order.iter().map(|&i| (&scene.draws[i], &shown[i])) {
        draw_list::record(pass, scene, draw, &pipelines.surface);
        if let Some(outline) = &pipelines.outline {
            draw_list::record(pass, scene, draw, outline);
        }
    }
}
