//! Fluff: shells of a coat of short hair, drawn as instances of the surface.

use super::{Drawing, Mark, Picture};
use crate::material::Fluff;
use crate::render::character::Shown;
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::variants::Request;

/// Shells of a coat: `fluff_shells` of `wgsl/lib/fluff.wgsl`.
fn shells(fluff: &Fluff, px_per_m: f32) -> u32 {
    let most = fluff.shells;
    ((fluff.length_m * px_per_m / 1.5).ceil() as u32).clamp(most.min(4), most)
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
pub(crate) fn encode(pass: &mut wgpu::RenderPass<'_>, actors: &Actors<'_>, shown: &[Shown], px_per_m: f32) {
    for (troupe, shown) in actors.shown(shown).filter(|(troupe, _)| !troupe.shells.is_empty()) {
        actors.bind(pass, troupe);
        let data = troupe.data();
        for (draw, pipelines) in data.draws.iter().zip(&**shown) {
            let (Some(coat), Some(fluff)) = (&pipelines.fluff, data.material(draw).fluff) else { continue };
            let last = troupe.shells.start + shells(&fluff, px_per_m) * troupe.instances.len() as u32;
            actors.record(pass, troupe, draw.triangles(), coat, troupe.shells.start..last.min(troupe.shells.end));
        }
    }
}
