//! Opaque and alpha-masked surfaces.

use super::{Drawing, Mark, Picture, surface_cull};
use crate::material::{AlphaMode, Material};
use crate::render::draw_list::{self, Pipelines};
use crate::render::gpu_scene::GpuScene;
use crate::render::material::Composition;
use crate::render::variants::{Drawn, Request};

/// What draws a material.
pub(crate) fn request(
    picture: &Picture<'_>,
    of: &Composition,
    material: &Material,
    colors: bool,
    mark: Mark,
) -> Request {
    let is_masked = of.alpha == AlphaMode::Mask;
    // With several samples a cut can cover part of a pixel.
    let (covers, dithers) = (is_masked && picture.has_samples(), of.takes_part("samples") && picture.has_samples());
    let recipe = of
        .recipe("opaque", colors, |_| true)
        .with("alpha_mask", is_masked)
        .with("alpha_coverage", covers)
        .with("dither_samples", dithers)
        .with("covered", covers || dithers);
    picture.request(recipe, Drawing { cull: surface_cull(material), blend: false, write_depth: true, mark })
}

/// Draws all opaque surfaces, then all masked ones (the order of upload). Where eyes are to be seen through hair, they
/// follow what is neither, and hair comes last.
pub(crate) fn encode(pass: &mut wgpu::RenderPass<'_>, scene: &GpuScene, shown: &[Pipelines<Drawn>]) {
    for (draw, pipelines) in scene.draws.iter().zip(shown).filter(|(d, _)| !d.blend) {
        if draw.mark == Mark::None {
            draw_list::record(pass, scene, draw, &pipelines.surface);
        } else {
            draw_list::record_marked(pass, scene, draw, &pipelines.surface, draw.mark);
        }
    }
}
