//! Blended surfaces in any order, each weighted by its depth; [`resolve`](super::resolve) lays their sums over the picture.

use super::{ADD, Drawing, HDR_FORMAT, Mark, Picture, surface_cull};
use crate::Gpu;
use crate::material::Material;
use crate::render::blended::Blended;
use crate::render::character::Shown;
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::targets;
use crate::render::variants::Request;

/// Format of what layers leave of what is behind them.
const LEFT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R16Float;

/// Takes away of what is there.
const COVER: wgpu::BlendState = {
    let cover = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::Zero,
        dst_factor: wgpu::BlendFactor::OneMinusSrc,
        operation: wgpu::BlendOperation::Add,
    };
    wgpu::BlendState { color: cover, alpha: cover }
};

/// What the pass draws into.
#[derive(Debug)]
pub(crate) struct WeightedTargets {
    pub size: [u32; 2],
    /// Colour and alpha by weight.
    pub sums: wgpu::TextureView,
    /// Share of what is behind that is seen.
    pub left: wgpu::TextureView,
}

impl WeightedTargets {
    pub fn new(gpu: &Gpu, size: [u32; 2], samples: u32) -> Self {
        let read = wgpu::TextureUsages::TEXTURE_BINDING;
        let make = |label, format| targets::view(&targets::texture(gpu, label, size, samples, format, read));
        Self { size, sums: make("weighted sums", HDR_FORMAT), left: make("left of behind", LEFT_FORMAT) }
    }
}

/// What draws a material.
pub(crate) fn request(picture: &Picture<'_>, of: &Composition, material: &Material, colors: bool) -> Request {
    let recipe = of
        .recipe("weighted", colors, |_| true)
        .with("dither_samples", true)
        .with("weighed", true)
        .with("has_core", material.has_core());
    let drawing = Drawing { cull: surface_cull(material), blend: true, write_depth: false, mark: Mark::None };
    let mut request = picture.strict_request(recipe, drawing);
    let target =
        |format, blend| wgpu::ColorTargetState { format, blend: Some(blend), write_mask: wgpu::ColorWrites::ALL };
    request.state.targets = vec![target(HDR_FORMAT, ADD), target(LEFT_FORMAT, COVER)];
    request
}

/// Draws every weighted surface of a view into sums that are cleared first; `depth` holds what is solid.
pub(crate) fn encode(
    encoder: &mut wgpu::CommandEncoder,
    into: &WeightedTargets,
    depth: Option<wgpu::RenderPassDepthStencilAttachment<'_>>,
    actors: &Actors<'_>,
    shown: &[Shown],
    order: &[Blended],
) {
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("weighted"),
        color_attachments: &[
            Some(targets::color(&into.sums, wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT))),
            Some(targets::color(&into.left, wgpu::LoadOp::Clear(wgpu::Color::WHITE))),
        ],
        depth_stencil_attachment: depth,
        ..Default::default()
    });
    let mut last = None;
    for Blended { troupe: of, draw, instances, .. } in order {
        let troupe = &actors.bodies.troupes[*of];
        let (draw, pipelines) = (&troupe.data().draws[*draw], &shown[*of][*draw]);
        if !draw.weighted {
            continue;
        }
        if last != Some(of) {
            actors.bind(&mut pass, troupe);
            last = Some(of);
        }
        actors.record(&mut pass, troupe, draw.triangles(), &pipelines.surface, instances.clone());
    }
}
