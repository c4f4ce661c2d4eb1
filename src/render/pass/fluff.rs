//! Fluff: shells of a coat of short hair, drawn as instances of the surface.

use super::{Drawing, Mark, Picture};
use crate::material::Fluff;
use crate::render::draw_list::{self, Pipelines};
use crate::render::gpu_scene::GpuScene;
use crate::render::material::Composition;
use crate::render::variants::{Drawn, Request};

/// Shells of a coat: `fluff_shells` of `wgsl/lib/fluff.wgsl`.
fn shells(fluff: &Fluff, px_per_m: f32) -> u32 {
    let most = fluff.shells;
    ((fluff.length_m * px_per_m).ceil() as u32).clamp(most.min(4), most)
}

/// What draws the coat of a material.
pub(crate) fn request(picture: &Picture<'_>, of: &Composition, colors: bool) -> Request {
    let dithers = of.takes_part("samples") && picture.has_samples();
    // A coat has no contour of its own, and its holes are strands.
    let recipe = of
        .recipe("fluff", colors, |c| !c.about.needs.contains(&"prepass"))
        .with("level", true)
        .with("dither_samples", dithers)
        .with("covered", dithers);
    // Shells lie over each other in their order.
    let drawing = Drawing { cull: Some(wgpu::Face::Back), blend: true, write_depth: false, mark: Mark::None };
    picture.request(recipe, drawing)
}

/// Draws every coat, root to tips. `px_per_m`: size of a metre on the nearest character, pixels.
pub(crate) fn encode(pass: &mut wgpu::RenderPass<'_>, scene: &GpuScene, shown: &[Pipelines<Drawn>], px_per_m: f32) {
    let instances = scene.instance_rows.len() as u32;
    for (draw, pipelines) in scene.draws.iter().zip(shown) {
        let (Some(coat), Some(fluff)) = (&pipelines.fluff, scene.material(draw).fluff) else { continue };
        // The first copy of the instances is the surface itself.
        let last = instances * (1 + shells(&fluff, px_per_m));
        draw_list::record_instances(pass, scene, draw, coat, instances..last);
    }
}
