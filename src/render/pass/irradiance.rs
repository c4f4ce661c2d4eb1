//! Light that falls on skin whose light spreads over the picture, and how far it goes there.

use super::{DEPTH_FORMAT, HDR_FORMAT, Sight, depth_state, surface_cull};
use crate::Gpu;
use crate::material::Material;
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::targets;
use crate::render::variants::{Drawn, Request, State};

/// Of a packed `SkinLight` of `wgsl/lib/skin_light.wgsl`.
pub(crate) const SKIN_LIGHT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

/// What it draws into.
#[derive(Debug)]
pub(crate) struct IrradianceTargets {
    pub size: [u32; 2],
    /// Irradiance over pi, and where it is.
    pub light: wgpu::TextureView,
    /// Scattering distances, mm in the scene.
    pub distance: wgpu::TextureView,
    /// 0 where there is no skin.
    pub depth: wgpu::TextureView,
}

impl IrradianceTargets {
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let make = |label, format| targets::sampled(gpu, label, size, format);
        Self {
            size,
            light: make("irradiance", SKIN_LIGHT_FORMAT),
            distance: make("scattering distance", HDR_FORMAT),
            depth: make("skin depth", DEPTH_FORMAT),
        }
    }
}

/// What the pass reads and writes.
pub(crate) struct IrradianceInputs<'a> {
    pub actors: Actors<'a>,
    pub targets: &'a IrradianceTargets,
    /// By troupe and draw; `None` leaves it out.
    pub drawn: &'a dyn Fn(usize, usize) -> Option<&'a Drawn>,
}

/// What draws the light on a material, by these lights.
pub(crate) fn request(of: &Composition, material: &Material, colors: bool, sight: Sight<'_>) -> Request {
    // What reads the depth of the picture changes no light that falls on skin.
    let recipe = of
        .recipe("irradiance", colors, |c| !c.about.needs.contains(&"prepass"))
        .with("punctual", sight.punctual)
        .with("environment", sight.environment);
    let targets = vec![SKIN_LIGHT_FORMAT.into(), HDR_FORMAT.into()];
    Request {
        recipe,
        state: State { cull: surface_cull(material), depth: Some(depth_state(true)), samples: 1, targets },
    }
}

/// Draws skin.
pub(crate) fn encode(
    encoder: &mut wgpu::CommandEncoder,
    inputs: &IrradianceInputs<'_>,
    timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
) {
    let IrradianceInputs { actors, targets, drawn } = inputs;
    let cleared = |view| Some(targets::color(view, wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)));
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("irradiance"),
        color_attachments: &[cleared(&targets.light), cleared(&targets.distance)],
        depth_stencil_attachment: Some(targets::depth(&targets.depth, 0.0, wgpu::StoreOp::Store)),
        timestamp_writes,
        ..Default::default()
    });
    for (of, troupe) in actors.bodies.troupes.iter().enumerate() {
        actors.bind(&mut pass, troupe);
        for (index, draw) in troupe.data().draws.iter().enumerate() {
            if let Some(drawn) = drawn(of, index) {
                actors.record(&mut pass, troupe, draw.triangles(), drawn, troupe.instances.clone());
            }
        }
    }
}
