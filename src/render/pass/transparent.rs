//! Blended surfaces with their outlines, far before near.

use super::{Drawing, Mark, Picture, surface_cull};
use crate::material::Material;
use crate::render::blended::Blended;
use crate::render::character::Shown;
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::variants::Request;

/// What draws a material.
pub(crate) fn request(picture: &Picture<'_>, of: &Composition, material: &Material, colors: bool) -> Request {
    // What is blended fades by its alpha.
    let recipe = of.recipe("transparent", colors, |_| true).with("dither_samples", true);
    let write_depth = material.alpha.write_depth;
    picture.request(recipe, Drawing { cull: surface_cull(material), blend: true, write_depth, mark: Mark::None })
}

/// Draws each surface, then its outline, in the order of the view; `actors` have its instances.
pub(crate) fn encode(pass: &mut wgpu::RenderPass<'_>, actors: &Actors<'_>, shown: &[Shown], order: &[Blended]) {
    let mut last = None;
    for Blended { troupe: of, draw, instances, .. } in order {
        let troupe = &actors.bodies.troupes[*of];
        if last != Some(of) {
            actors.bind(pass, troupe);
            last = Some(of);
        }
        let (draw, pipelines) = (&troupe.data().draws[*draw], &shown[*of][*draw]);
        actors.record(pass, troupe, draw.triangles(), &pipelines.surface, instances.clone());
        if let Some(outline) = &pipelines.outline {
            actors.record(pass, troupe, draw.triangles(), outline, instances.clone());
        }
    }
}
