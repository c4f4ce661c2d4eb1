//! Opaque and alpha-masked surfaces, and the opaque part of blended ones.

use super::{Drawing, Mark, Picture, surface_cull};
use crate::material::{AlphaMode, Material};
use crate::render::character::Shown;
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::variants::Request;

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

/// Draws all opaque surfaces of each actor, then all masked ones (the order of upload). Where eyes are to be seen through
/// hair, those of all actors follow what is neither, and hair comes last.
pub(crate) fn encode(pass: &mut wgpu::RenderPass<'_>, actors: &Actors<'_>, shown: &[Shown]) {
    for mark in [Mark::None, Mark::Eyes, Mark::Hair] {
        for (troupe, shown) in actors.shown(shown) {
            let draws = || troupe.solid_draws().filter(|(_, draw)| draw.mark == mark);
            if draws().next().is_none() {
                continue;
            }
            actors.bind(pass, troupe);
            let all = [(0, troupe.instances.clone())];
            let numbered = if mark == Mark::Hair { &troupe.numbered[..] } else { &all };
            for (number, instances) in numbered {
                if mark != Mark::None {
                    pass.set_stencil_reference(mark.reference(*number));
                }
                for (i, draw) in draws() {
                    let drawn = shown[i].core.as_ref().unwrap_or(&shown[i].surface);
                    actors.record(pass, troupe, draw.triangles(), drawn, instances.clone());
                }
            }
        }
    }
}
