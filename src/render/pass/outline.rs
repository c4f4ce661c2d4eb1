//! Outlines of opaque surfaces: back faces pushed outwards.

use super::{Drawing, Mark, Picture};
use crate::material::{AlphaMode, Material};
use crate::render::character::Shown;
use crate::render::draw_list::Actors;
use crate::render::material::{Component, Composition};
use crate::render::variants::Request;

const SECTION: &str = "outline";

/// What draws the line round a material; `None` where it has none.
pub(crate) fn request(picture: &Picture<'_>, of: &Composition, material: &Material, colors: bool) -> Option<Request> {
    if !of.has(SECTION) {
        return None;
    }
    let blend = of.alpha == AlphaMode::Blend;
    let dithers = of.takes_part("samples") && !blend && picture.has_samples();
    let vanishes = of.any(|c| c.takes_part("vanish") && !(dithers && c.takes_part("samples")));
    let [is_mixed, is_tinted, is_masked_wide] =
        ["outline_mixed", "outline_tint", "outline_width_mask"].map(|option| of.is_on(option));
    // The surface's shading is needed: for its colour, or beside a plain one for its alpha and its cut-outs.
    let shaded = is_mixed || !is_tinted && (vanishes || of.alpha != AlphaMode::Opaque);
    // A plain colour needs nothing of the surface but the UVs of its mask: fewer pipelines.
    let is_plain = !shaded && !is_tinted;
    let moves_mask = |c: &Component| is_masked_wide && c.takes_part("vertex_uv");
    // A line in the colour of its surface needs what that is before light falls on it.
    let before_light = ["place", "line", "vanish", "samples", "uv", "surface"];
    let of_color = |c: &Component| {
        let takes_part = before_light.into_iter().any(|stage| c.takes_part(stage));
        (c.about.is_model || c.about.key == "shade_ramp" || takes_part) && c.about.key != "emission"
    };
    let keep = |c: &Component| {
        let counts = c.about.on_line && !is_plain && (shaded || of_color(c));
        c.about.key == SECTION || counts || moves_mask(c) || (dithers && c.takes_part("samples"))
    };
    // A colour without cut-outs or numbers of parts is known well enough at vertices.
    let is_smooth =
        |c: &Component| !c.takes_part("uv") && (!c.takes_part("surface") || c.about.is_model || c.about.key == "base");
    let is_whole = of.alpha == AlphaMode::Opaque && !vanishes && !dithers && !of.is_on("outline_part_ids");
    let at_vertices = is_tinted && !shaded && is_whole && !of.any(|c| keep(c) && !is_smooth(c));
    let mut recipe = of
        .recipe("outline", colors, keep)
        .with("line", true)
        .with("shaded", shaded)
        .with("blend", blend)
        .with("world", is_tinted && !at_vertices)
        .with("at_vertices", at_vertices)
        .with("dither_samples", dithers)
        .with("covered", dithers)
        .with("alpha_mask", of.alpha == AlphaMode::Mask);
    if !shaded {
        recipe = recipe.with("lit", false).with("normal", false);
    }
    let write_depth = !blend || material.alpha.write_depth;
    // Thin lines are faint.
    Some(picture.request(recipe, Drawing { cull: Some(wgpu::Face::Front), blend: true, write_depth, mark: Mark::None }))
}

/// Draws the outlines of all opaque surfaces.
pub(crate) fn encode(pass: &mut wgpu::RenderPass<'_>, actors: &Actors<'_>, shown: &[Shown]) {
    for (troupe, shown) in actors.shown(shown) {
        actors.bind(pass, troupe);
        for (i, draw) in troupe.solid_draws().filter(|(_, draw)| !draw.blend) {
            if let Some(outline) = &shown[i].outline {
                actors.record(pass, troupe, draw.triangles(), outline, troupe.instances.clone());
            }
        }
    }
}
