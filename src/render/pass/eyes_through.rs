//! Eyes and brows over the hair that hangs before them, where the opaque pass marked both.

use super::{Drawing, Mark, Picture, surface_cull};
use crate::material::{AlphaMode, Material};
use crate::render::character::Shown;
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::variants::Request;

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
pub(crate) fn encode(pass: &mut wgpu::RenderPass<'_>, actors: &Actors<'_>, shown: &[Shown]) {
    for (troupe, shown) in actors.shown(shown) {
        let data = troupe.data();
        if data.through_order.is_empty() {
            continue;
        }
        actors.bind(pass, troupe);
        for (number, instances) in &troupe.numbered {
            pass.set_stencil_reference(Mark::Through.reference(*number));
            for &index in &data.through_order {
                if let Some(through) = &shown[index].through {
                    actors.record(pass, troupe, data.draws[index].triangles(), through, instances.clone());
                }
            }
        }
    }
}
