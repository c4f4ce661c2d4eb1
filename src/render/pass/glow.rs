//! Light of surfaces that bloom, hidden by whatever the prepass shows before them.

use super::{ADD, HDR_FORMAT, surface_cull};
use crate::Gpu;
use crate::material::{AlphaMode, Material};
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::targets;
use crate::render::variants::{Drawn, Request, State};

/// What the pass reads and writes.
pub(crate) struct GlowInputs<'a> {
    /// With the depth of the prepass.
    pub actors: Actors<'a>,
    /// By troupe and draw; `None` leaves it out.
    pub drawn: &'a dyn Fn(usize, usize) -> Option<&'a Drawn>,
    /// Of [`target`].
    pub light: &'a wgpu::TextureView,
}

/// Where it draws: half the size of the picture.
pub(crate) fn target(gpu: &Gpu, size: [u32; 2]) -> wgpu::TextureView {
    targets::sampled(gpu, "glow", size.map(|s| s.div_ceil(2)), HDR_FORMAT)
}

/// What draws the light of a material.
pub(crate) fn request(of: &Composition, material: &Material, colors: bool) -> Request {
    // Neither rims nor the shadow of bangs change what glows; what fades glows less.
    let recipe = of
        .recipe("glow", colors, |c| !c.about.needs.iter().any(|n| ["prepass", "bangs"].contains(n)))
        .with("dither_samples", true)
        .with("blend", of.alpha == AlphaMode::Blend)
        .with("alpha_mask", of.alpha == AlphaMode::Mask);
    let target = wgpu::ColorTargetState { format: HDR_FORMAT, blend: Some(ADD), write_mask: wgpu::ColorWrites::ALL };
    Request { recipe, state: State { cull: surface_cull(material), depth: None, samples: 1, targets: vec![target] } }
}

/// Draws the light.
pub(crate) fn encode(
    encoder: &mut wgpu::CommandEncoder,
    inputs: &GlowInputs<'_>,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) {
    let light = targets::color(inputs.light, wgpu::LoadOp::Clear(wgpu::Color::BLACK));
    let mut pass = targets::begin(encoder, "glow", Some(light), None, timestamps);
    let actors = &inputs.actors;
    for (of, troupe) in actors.bodies.troupes.iter().enumerate() {
        actors.bind(&mut pass, troupe);
        for (index, draw) in troupe.data().draws.iter().enumerate() {
            if let Some(glow) = (inputs.drawn)(of, index) {
                actors.record(&mut pass, troupe, draw.triangles(), glow, troupe.instances.clone());
            }
        }
    }
}
