//! Blended surfaces with their outlines, far before near.

use super::{Drawing, Mark, Picture, surface_cull};
use crate::material::{Blending, Material};
use crate::render::blended::Blended;
use crate::render::character::Shown;
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::variants::Request;

/// Which of its triangles a pipeline draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layer {
    /// All, or the front faces where the back faces have a pipeline of their own.
    Front,
    /// Back faces.
    Back,
}

/// What draws a material.
pub(crate) fn request(
    picture: &Picture<'_>,
    of: &Composition,
    material: &Material,
    colors: bool,
    layer: Layer,
) -> Request {
    // What is blended fades by its alpha.
    let recipe = of.recipe("transparent", colors, |_| true).with("dither_samples", true);
    let alpha = &material.alpha;
    let mut drawing =
        Drawing { cull: surface_cull(material), blend: true, write_depth: alpha.write_depth, mark: Mark::None };
    let blending = material.blending();
    if blending == Blending::Sorted {
        return picture.request(recipe, drawing);
    }
    if blending == Blending::ThreePass {
        (drawing.cull, drawing.write_depth) = match layer {
            Layer::Back => (Some(wgpu::Face::Front), false),
            Layer::Front => (Some(wgpu::Face::Back), alpha.front_writes_depth),
        };
    }
    picture.strict_request(recipe.with("layered", true).with("has_core", material.has_core()), drawing)
}

/// What draws the opaque part of a material that is blended.
pub(crate) fn core_request(
    picture: &Picture<'_>,
    of: &Composition,
    material: &Material,
    colors: bool,
    mark: Mark,
) -> Request {
    let recipe = of.recipe("transparent", colors, |_| true).with("dither_samples", true).with("core", true);
    picture.request(recipe, Drawing { cull: surface_cull(material), blend: false, write_depth: true, mark })
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
        if let Some(back) = &pipelines.back {
            actors.record(pass, troupe, draw.triangles(), back, instances.clone());
        }
        if !draw.weighted {
            actors.record(pass, troupe, draw.triangles(), &pipelines.surface, instances.clone());
        }
        if let Some(outline) = &pipelines.outline {
            actors.record(pass, troupe, draw.triangles(), outline, instances.clone());
        }
    }
}
