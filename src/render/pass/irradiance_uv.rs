//! Light that falls on skin, over its texture coordinates.

use super::{HDR_FORMAT, Sight};
use crate::Gpu;
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::targets;
use crate::render::variants::{Drawn, Request, State};
use crate::stage::body::Body;

/// Texels along a side of a layer.
pub(crate) const LAYER_SIDE: u32 = 1024;

/// Texels round its border that stay empty: the sampler goes round there.
const BORDER: f32 = 2.0;

/// Scale and offset of texture coordinates in a layer, of these least ones and their extent.
pub(crate) fn layer_uv([least, extent]: [[f32; 2]; 2]) -> [f32; 4] {
    let border = BORDER / LAYER_SIDE as f32;
    let scale = extent.map(|e| (1.0 - 2.0 * border) / e.max(1e-12));
    [scale[0], scale[1], border - least[0] * scale[0], border - least[1] * scale[1]]
}

const PLACE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// What it draws into, one layer after another.
#[derive(Debug)]
pub(crate) struct UvTargets {
    /// Irradiance over pi.
    pub light: wgpu::TextureView,
    /// World places, real mm.
    pub places: wgpu::TextureView,
    /// What texels span, real mm.
    pub spans: wgpu::TextureView,
}

impl UvTargets {
    pub fn new(gpu: &Gpu) -> Self {
        let make = |label, format| targets::sampled(gpu, label, [LAYER_SIDE; 2], format);
        Self {
            light: make("irradiance over uv", HDR_FORMAT),
            places: make("places over uv", PLACE_FORMAT),
            spans: make("spans over uv", HDR_FORMAT),
        }
    }
}

/// What draws the light on a material, by these lights.
pub(crate) fn request(of: &Composition, colors: bool, sight: Sight<'_>) -> Request {
    // What reads the depth of the picture changes no light that falls on skin.
    let recipe = of
        .recipe("irradiance_uv", colors, |c| !c.about.needs.contains(&"prepass"))
        .with("punctual", sight.punctual)
        .with("environment", sight.environment);
    let targets = vec![HDR_FORMAT.into(), PLACE_FORMAT.into(), HDR_FORMAT.into()];
    Request { recipe, state: State { cull: None, depth: None, samples: 1, targets } }
}

/// Draws a material of a body.
pub(crate) fn encode(
    encoder: &mut wgpu::CommandEncoder,
    actors: Actors<'_>,
    (body, material): (&Body, usize),
    drawn: &[Option<Drawn>],
    into: &UvTargets,
) {
    let cleared = |view| Some(targets::color(view, wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)));
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("irradiance over uv"),
        color_attachments: &[cleared(&into.light), cleared(&into.places), cleared(&into.spans)],
        ..Default::default()
    });
    let troupe = &actors.bodies.troupes[body.troupe];
    actors.bind(&mut pass, troupe);
    for (draw, drawn) in troupe.data().draws.iter().zip(drawn).filter(|(draw, _)| draw.material == material) {
        if let Some(drawn) = drawn {
            actors.record(&mut pass, troupe, draw.triangles(), drawn, body.instance..body.instance + 1);
        }
    }
}
