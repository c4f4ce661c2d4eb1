//! Blended surfaces with their outlines, far before near.

use super::{Drawing, Mark, Picture, surface_cull};
use crate::material::Material;
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

/// Draws each surface, then its outline, in this order of bodies and their draws.
pub(crate) fn encode(pass: &mut wgpu::RenderPass<'_>, actors: &Actors<'_>, shown: &[Shown], order: &[(usize, usize)]) {
    let mut last = None;
    for &(of, index) in order {
        let body = &actors.bodies.list[of];
        let troupe = &actors.bodies.troupes[body.troupe];
        if last != Some(body.troupe) {
            actors.bind(pass, troupe);
            last = Some(body.troupe);
        }
        let (draw, pipelines) = (&troupe.data().draws[index], &shown[body.troupe][index]);
        let instance = body.instance..body.instance + 1;
        actors.record(pass, troupe, draw.triangles(), &pipelines.surface, instance.clone());
        if let Some(outline) = &pipelines.outline {
            actors.record(pass, troupe, draw.triangles(), outline, instance);
        }
    }
}
