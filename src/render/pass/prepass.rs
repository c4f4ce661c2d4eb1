//! Depth, normal and part, one sample a pixel, for effects and channels that read them.

use super::{depth_state, surface_cull};
use crate::material::Material;
use crate::render::draw_list::Actors;
use crate::render::material::Composition;
use crate::render::targets::{self, PrepassTargets};
use crate::render::variants::{Drawn, Request, State};

/// Format of the world normal (octahedral, two halves of a word) and the part index + 1.
pub(crate) const SURFACES_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Uint;

/// What the pass reads and writes.
pub(crate) struct PrepassInputs<'a> {
    pub actors: Actors<'a>,
    pub targets: &'a PrepassTargets,
    /// Whether normals and parts are drawn, too.
    pub surfaces: bool,
    /// By troupe and draw; `None` leaves it out.
    pub drawn: &'a dyn Fn(usize, usize) -> Option<&'a Drawn>,
}

/// What draws a material; without `surfaces`, normal and part are left out.
pub(crate) fn request(of: &Composition, material: &Material, colors: bool, surfaces: bool) -> Request {
    let recipe = of.cut("prepass", colors, true).with("seen", true).with("part", surfaces).with("normal", surfaces);
    let targets = surfaces.then(|| SURFACES_FORMAT.into()).into_iter().collect();
    Request {
        recipe,
        state: State { cull: surface_cull(material), depth: Some(depth_state(true)), samples: 1, targets },
    }
}

/// Draws surfaces.
pub(crate) fn encode(
    encoder: &mut wgpu::CommandEncoder,
    inputs: PrepassInputs<'_>,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) {
    let PrepassTargets { surfaces_view, depth_view, .. } = inputs.targets;
    let surfaces =
        inputs.surfaces.then(|| targets::color(surfaces_view, wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)));
    let depth = targets::depth(depth_view, 0.0, wgpu::StoreOp::Store);
    let mut pass = targets::begin(encoder, "prepass", surfaces, Some(depth), timestamps);
    let actors = &inputs.actors;
    for (of, troupe) in actors.bodies.troupes.iter().enumerate() {
        actors.bind(&mut pass, troupe);
        for (index, draw) in troupe.data().draws.iter().enumerate() {
            if let Some(drawn) = (inputs.drawn)(of, index) {
                actors.record(&mut pass, troupe, draw.triangles(), drawn, troupe.instances.clone());
            }
        }
    }
}
